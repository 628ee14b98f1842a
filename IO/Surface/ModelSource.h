// SPDX-License-Identifier: GPL-3.0-or-later
/// The result of reading a file of any format, as vtkAtriaSurfaceReader takes it.
#pragma once

#include "Scene.h"

#include <string>
#include <vector>

namespace atria::scene {

/// The content of a file, before options common to all formats are applied.
struct ModelSource
{
  Scene scene;
  std::string name;           ///< name of the file, for messages
  std::string head;           ///< its first characters, where programs name themselves; empty for binary files
  int upAxis = 2;             ///< 1 y, 2 z, where nothing else is stated
  bool unitKnown = false;     ///< lengths are meters by the format or the file
  bool unitConverted = false; ///< lengths had another unit in the file
  bool axisKnown = false;     ///< the format defines the up axis
  /// Names of ground in the format: beginnings of surfaces' names, behind those of groups, and names of materials.
  std::vector<std::string> groundNames;
  std::vector<std::string> groundMaterials;
};

} // namespace atria::scene
