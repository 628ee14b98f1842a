// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the ground of a model and lets bodies stand on it.
#pragma once

#include "Domain/GroundReport.h"
#include "Domain/PlacedModel.h"

namespace atria {

struct GroundRules
{
  /// Edge length of octants at features, the scale by which films of air are thin.
  double sizeMin = 1.0;
  /// Bottom of the domain, if one is given.
  std::optional<double> bottom;
  /// One flag per surface: nonzero if its bodies stay as drawn, such as zones of cells. Empty for none.
  SurfaceFlags asDrawn;
};

/// Surface and options to use in planSite() and placeModel() instead of the original ones.
struct GroundedModel
{
  TriangleSurface surface;
  SiteOptions site;
  GroundReport report;
};

/// Returns the model with its bodies let down to the ground.
///
/// Closed ground surfaces, such as slabs, keep only their upper side. If no surface is ground, a wide slab below all
/// else is (see findGroundSlab), or else a level floor at the height at which most of the model stands. The floor is
/// the least costly height: each square meter of the lowest faces costs its distance above the floor, or the whole
/// height of the model over it if it hovers, and three times its depth below the floor.
///
/// Bodies with nothing but air between their bases and the ground are let down if the gap is at most `groundSnapRatio`
/// of their height. The points of their bases are moved to the ground, and below terrain by `sizeMin`. Bases beside
/// lower parts of the model, which may hang there on purpose, are let down if the gap is also less than a passage, and
/// less than half as high as wide. Mode `bounds` takes the given floor and moves nothing. Mode `surfaces`, for rooms,
/// does nothing.
GroundedModel groundModel(const TriangleSurface& surface, const SiteOptions& options, const GroundRules& rules);

} // namespace atria
