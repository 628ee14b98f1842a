// SPDX-License-Identifier: GPL-3.0-or-later
/// The ground of a model, and its bodies on it.
#pragma once

#include "Domain/GroundReport.h"
#include "Domain/PlacedModel.h"

namespace atria {

struct GroundRules
{
  /// Edge length of octants at features, by which films of air are thin.
  double sizeMin = 1.0;
  /// Bottom of a domain that is given, if it is.
  std::optional<double> bottom;
  /// Surfaces, by id, whose bodies stay as drawn, such as zones of cells; empty for none.
  SurfaceFlags asDrawn;
};

/// What takes the place of the surface and of the options in planSite() and placeModel().
struct GroundedModel
{
  TriangleSurface surface;
  SiteOptions site;
  GroundReport report;
};

/// Finds the ground and has bodies stand on it.
///
/// Of closed ground surfaces, such as slabs, the upper side alone stays. Where no surface is ground, a wide slab below
/// all else is (see findGroundSlab), or else a level floor, at the height at which most of the model stands: the one
/// that is least costly if each square meter of the lowest faces costs its distance above the floor, up to a part of
/// its height, and thrice its depth below it.
///
/// Bodies with nothing but air between their bases and the ground are let down: the points of their bases are moved to
/// the ground, and below terrain by `sizeMin`, where the gap is at most `groundSnapRatio` of their height. Bases beside
/// lower parts of the model, which may hang there on purpose, are let down if the gap is also less than a passage, and
/// less than half as high as wide. In mode `bounds` the floor is the one given, and nothing is moved; in mode
/// `surfaces`, for rooms, nothing is done.
GroundedModel groundModel(const TriangleSurface& surface, const SiteOptions& options, const GroundRules& rules);

} // namespace atria
