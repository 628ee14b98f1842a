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
  /// Same as SiteOptions::groundSnapRatio; 0 if the height of the ground is given.
  double ratio = 0.0;
  /// One entry per surface: nonzero if its bodies stay as drawn. Empty for none.
  SurfaceFlags asDrawn;
};

/// Report on the bodies of a model, and the heights to which points of some are lowered.
struct StandingBodies
{
  GroundReport report; ///< lists and counts, without texts
  /// One height per place; not a number for places that stay.
  std::vector<double> heights;
};

/// Judges all bodies but those smaller than an octant.
StandingBodies standOnGround(const TriangleSurface& surface, const ModelBodies& bodies,
                             const std::vector<BodyBase>& bases, const SupportSearch& supports,
                             const GroundBelow& ground, const SnapOptions& options);

/// Moves points to the heights of their places, but only in triangles of bodies: the ground stays as it is.
void lowerPlaces(TriangleSurface& surface, const ModelBodies& bodies, const std::vector<double>& heights);

} // namespace atria
