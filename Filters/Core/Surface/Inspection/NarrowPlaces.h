// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the narrowest places of a model.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

struct Narrow
{
  /// Width in model units; infinite if there is no such place.
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
  /// The shortest way across an opening. It joins two boundary edges that do not share a point and face each other, so
  /// that the way leads away from the surface at either within 45 degrees. Boundary edges that are not joined end to
  /// end count only if one is at least as long as the way. That holds of windows and doors cut out of a sheet, and of
  /// slots between sheets. Openings that other surfaces border, such as reveals, have no boundary edges: they are gaps.
  Narrow opening;
  /// The shortest way between two triangles that do not share a point, are parallel within 15 degrees and lie across
  /// each other within 30: between walls, or through one with thickness. It is measured from the triangles' points,
  /// middles of edges and centroids, so it may be missed between large triangles that overlap in part.
  Narrow gap;
};

/// Returns the narrowest opening and gap in the domain. Ways shorter than `least` (model units), which are seams rather
/// than spaces, do not count. Parts on sides of a turned domain do not count, nor do openings in parts on a domain
/// side. Each triangle takes a search of the model's tree, no farther than the shortest way known. Throws Aborted on
/// demand.
NarrowPlaces findNarrowPlaces(const SurfaceModel& model, const GridFrame& frame, double least,
                              const RunContext& context);

} // namespace atria
