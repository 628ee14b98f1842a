// SPDX-License-Identifier: GPL-3.0-or-later
/// What a user is told of bodies and the ground.
#pragma once

#include "Domain/GroundReport.h"

namespace atria {

struct GroundTextOptions
{
  double sizeMin = 1.0;
  /// The height of the ground is given, so that no body is moved.
  bool isGiven = false;
  bool hasTerrain = false;
};

/// Adds warnings and notes that follow from the report's lists.
void addTexts(GroundReport& report, const GroundTextOptions& options);

} // namespace atria
