// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Zones/Cracks.h"

namespace atria {

/// A step along a boundary edge that is beside a gap narrower than an octant.
struct CrackStep
{
  Index featureEdge;
  std::uint32_t step; ///< counted from the edge's first point
  bool last;          ///< ends at the edge's second point
  Vec3 begin;         ///< the step's ends, half way across the gap
  Vec3 end;
  double width;
  double size; ///< edge of the leaf there
  Index point;
  bool open; ///< an uncut octree edge passes through the gap
};

/// Joins the steps, sorted by edge and step, to cracks, closed and long ones first; those that lie along others are
/// left out. An open step opens the gap as far as the dual face of the edge reaches that passes through it.
std::vector<Crack> joinSteps(const std::vector<CrackStep>& steps, const SurfaceModel& model);

} // namespace atria
