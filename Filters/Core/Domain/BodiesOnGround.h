// SPDX-License-Identifier: GPL-3.0-or-later
/// Lets bodies down to the ground; see groundModel().
#pragma once

#include "Domain/BaseSupport.h"
#include "Domain/GroundReport.h"

namespace atria {

struct SnapOptions
{
  double sizeMin = 1.0;
  double tolerance = 1e-3;
  /// As SiteOptions::groundSnapRatio; 0 where the ground is given.
  double ratio = 0.0;
  /// By surface; empty for none.
  SurfaceFlags asDrawn;
};

/// How the bodies of a model stand, and how much lower the points of some are to be.
struct StandingBodies
{
  GroundReport report; ///< lists and counts, without texts
  /// By place; not a number for those that stay.
  std::vector<double> heights;
};

/// Judges all bodies but those smaller than an octant.
StandingBodies standOnGround(const TriangleSurface& surface, const ModelBodies& bodies,
                             const std::vector<BodyBase>& bases, const SupportSearch& supports,
                             const GroundBelow& ground, const SnapOptions& options);

/// Moves points to the heights of their places, in triangles of bodies alone: the ground stays as it is.
void lowerPlaces(TriangleSurface& surface, const ModelBodies& bodies, const std::vector<double>& heights);

} // namespace atria
