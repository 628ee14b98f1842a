// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes a scene after it was read: merges duplicate faces, turns, scales and moves it.
#pragma once

#include "Diagnostics.h"
#include "Scene.h"
#include "Surfaces.h"

namespace atria::scene {

/// Removes faces that coincide with others, within a surface or of another one, whichever way they face. The smaller
/// surface keeps its faces (see FacePrecedence). Notes how many, and which surfaces lose how much to which. Warns of
/// surfaces that are equally large and face the same way. Surfaces go by `by`, or by shape if that needs the merged
/// faces. Returns the number of removed faces.
std::size_t mergeDuplicateFaces(Scene& scene, SurfaceBy by, Diagnostics& diagnostics);

struct Placement
{
  int upAxis = 2;        ///< up axis of the file: 1 y, 2 z; the scene is turned about x so that z is up
  double scale = 1.0;    ///< from the file's unit to meters
  bool recenter = false; ///< move models that are far from the origin there
};

/// Turns, scales and moves a scene, in this order. Returns what was subtracted from its points: zero along axes on
/// which the model lies no farther from the origin than it is long, else its center rounded to whole hundreds.
Vec3 place(Scene& scene, const Placement& placement);

} // namespace atria::scene
