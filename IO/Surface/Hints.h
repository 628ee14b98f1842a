// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace atria::vrml {

/// What the user has said about a model, and what its file or format says. Where neither does, the file's words and the
/// model's shape and size are judged; where only the file does, shape and size, by which it may be wrong; what the user
/// has said is not judged.
struct Stated
{
  bool unit = false;
  bool upAxis = false;
  bool recentered = false;
  bool unitByFile = false;
  bool unitConverted = false; ///< LengthUnit is left out then
  bool axisByFile = false;
};

/// What speaks against taking a model as it was taken: units and axes its file mentions (`head`, its first lines), the
/// program that wrote it, a size no site or building has, ground and roofs that face along y, a base that all stands on
/// along y but not along z, a place so far off that single precision loses centimeters. `scene` is as placed.
/// Sentences; nothing is changed by them.
std::vector<std::string> hintsOf(const Scene& scene, std::string_view head, const Stated& stated);

/// Where shapes have numbers for names, as SketchUp gives them (id1, id2), and groups have words: a sentence that says
/// how these become the names of surfaces. Empty else.
std::string hintAtGroupNames(const Scene& scene);

} // namespace atria::vrml
