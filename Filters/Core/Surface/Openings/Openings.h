// SPDX-License-Identifier: GPL-3.0-or-later
/// Windows, doors and hatches, by rule.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Lengths are in lattice units.
struct OpeningOptions
{
  /// Per surface whether openings in it are looked for; empty for all.
  std::vector<char> surfaces;
  /// Narrower ones are cracks.
  double leastWidth = 0.0;
  /// What is this near to a plane lies in it.
  double planarDistance = 0.0;
  /// Sides of the domain close openings as walls do; else its bottom alone.
  bool sidesAreWalls = false;
};

struct FoundOpening
{
  /// The surface that it is an opening of: that of most of its border.
  Index surface;
  /// Its front is on the side of that surface's.
  std::vector<LatticePoint> points;
  std::vector<std::array<Index, 3>> triangles;
};

/// Spans what is open in plane walls. In the plane of walls (plane charts, those in one plane together) what the model
/// crosses or covers parts the plane into regions. An opening is a region that nothing covers and that is closed all
/// round: by the walls' own ends, which are boundary edges, or creases that the wall goes back from; and by floors,
/// ceilings, the ground and other walls that pass through the plane. So a window is an opening, as is a door down to
/// the floor, a hatch, and a gap between two walls; what is beyond the end of a wall that stands free is none. A window
/// round the corner of two sheets is one in each. Besides
/// - the largest circle in it is no narrower than `leastWidth`;
/// - ends of walls are all of its border; or a quarter of it, half together with walls that stand up to it, and the
/// walls
///   in the plane are as large as it: else each table would part the room it stands in.
/// Of openings at both ends of one reveal the smaller is taken, and one of those that are nearer to each other than
/// `leastWidth`. They come by surface, then by place (x, y, z of their centroids). The result does not depend on
/// threads. Throws Aborted on demand.
std::vector<FoundOpening> findOpenings(const SurfaceModel& model, const GridFrame& frame, const OpeningOptions& options,
                                       const RunContext& context);

} // namespace atria
