// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"

#include <string>
#include <vector>

namespace atria::vrml {

/// What a reader of some format makes of a file, before options that are the same for all formats are applied.
struct ModelSource
{
  Scene scene;
  std::string name;           ///< of the file, for messages
  std::string head;           ///< its first characters, where programs say who they are; empty for binary files
  int upAxis = 2;             ///< 1 y, 2 z, where nothing else is stated
  bool unitKnown = false;     ///< lengths are meters, as the format or the file says
  bool unitConverted = false; ///< they were something else in the file
  bool axisKnown = false;     ///< the format defines what is up
  /// What ground is in the format: the beginning of surfaces' names, behind those of groups, and names of materials.
  std::vector<std::string> groundNames;
  std::vector<std::string> groundMaterials;
};

} // namespace atria::vrml
