// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace atria::vrml {

/// What the user has said about a model; only what was left open is guessed at.
struct Stated
{
  bool unit = false;
  bool upAxis = false;
  bool recentered = false;
};

/// What speaks against taking a model as it was taken: units and axes its file mentions (`head`, its first lines), the
/// program that wrote it, a size no site or building has, ground and roofs that face along y, a place so far off
/// that single precision loses centimeters. `scene` is as placed. Sentences; nothing is changed by them.
std::vector<std::string> hintsOf(const Scene& scene, std::string_view head, const Stated& stated);

/// Where shapes have numbers for names, as SketchUp gives them (id1, id2), and groups have words: a sentence that says
/// how these become the names of surfaces. Empty else.
std::string hintAtGroupNames(const Scene& scene);

} // namespace atria::vrml
