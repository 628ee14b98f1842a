// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the texts about bodies and the ground for the user.
#pragma once

#include "Domain/GroundReport.h"

namespace atria {

struct GroundTextOptions
{
  double sizeMin = 1.0;
  /// True if the height of the ground is given, so that no body is moved.
  bool isGiven = false;
  bool hasTerrain = false;
};

/// Adds the warnings and notes that follow from the report's lists.
void addTexts(GroundReport& report, const GroundTextOptions& options);

} // namespace atria
