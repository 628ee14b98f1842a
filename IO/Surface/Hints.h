// SPDX-License-Identifier: GPL-3.0-or-later
/// Warns of units and axes that do not fit a model.
#pragma once

#include "Scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace atria::scene {

/// Statements of the user, the file or the format about a model. User statements are not judged. Statements of the file
/// alone are judged by shape and size, since the file may be wrong. Without any, the file's words and the model's shape
/// and size are judged.
struct Stated
{
  bool unit = false;
  bool upAxis = false;
  bool recentered = false;
  bool unitByFile = false;
  bool unitConverted = false; ///< LengthUnit is left out then
  bool axisByFile = false;
};

/// Returns sentences on what contradicts the unit and axis that a model was read with; changes nothing. `scene` is as
/// placed. Signs are
/// - units and axes its file mentions (`head`, its first lines), and the program that wrote it;
/// - a size no site or building has;
/// - ground and roofs that face along y, or a base that all stands on along y but not along z;
/// - a place so far off that single precision loses centimeters.
std::vector<std::string> hintsOf(const Scene& scene, std::string_view head, const Stated& stated);

/// Returns advice to take the names of groups for surfaces if shapes have numbers for names, as in SketchUp's files
/// (id1, id2), and groups have words. Empty else.
std::string hintAtGroupNames(const Scene& scene);

} // namespace atria::scene
