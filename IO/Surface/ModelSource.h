// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"

#include <string>

namespace atria::vrml {

/// What a reader of some format makes of a file, before options that are the same for all formats are applied.
struct ModelSource
{
  Scene scene;
  std::string name;       ///< of the file, for messages
  std::string head;       ///< its first characters, where programs say who they are; empty for binary files
  int upAxis = 2;         ///< 1 y, 2 z, where nothing else is stated
  bool unitKnown = false; ///< the format defines its unit, which then is the meter
  bool axisKnown = false; ///< the format defines what is up
};

} // namespace atria::vrml
