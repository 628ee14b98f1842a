// SPDX-License-Identifier: GPL-3.0-or-later
/// The narrowest places of a model.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

struct Narrow
{
  /// Infinite where there is no such place.
  double width = std::numeric_limits<double>::infinity();
  /// The points between which it is measured, along the grid's axes.
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  /// The surfaces there, by id.
  std::array<Index, 2> surfaces{noIndex, noIndex};

  bool found() const { return width < std::numeric_limits<double>::infinity(); }
};

struct NarrowPlaces
{
  /// The shortest way across an opening: between two boundary edges that do not share a point and face each other, so
  /// that the way leads away from the surface at either within 45 degrees; between boundary edges that are not joined
  /// end to end only where one is at least as long as the way. That holds of windows and doors cut out of a sheet, and
  /// of slots between sheets. Openings that other surfaces border, such as reveals, have no boundary edges: they are
  /// gaps.
  Narrow opening;
  /// The shortest way between two triangles that do not share a point, are parallel within 15 degrees and lie across
  /// each other within 30: between walls, or through one with thickness. Measured from the triangles' points, middles
  /// of edges and centroids, so between large triangles that overlap in part it may be missed.
  Narrow gap;
};

/// Measures what lies in the domain; ways shorter than `least` (model units), which are seams rather than spaces, do
/// not count, nor does what lies on sides of a turned domain, nor openings in what lies on a domain side. For each
/// triangle a search of the model's tree, no farther than the shortest way known. Throws Aborted on demand.
NarrowPlaces findNarrowPlaces(const SurfaceModel& model, const GridFrame& frame, double least,
                              const RunContext& context);

} // namespace atria
