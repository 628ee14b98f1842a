// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds windows, doors and hatches by rule.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Options of the search. Lengths are in lattice units.
struct OpeningOptions
{
  /// One flag per surface: nonzero if openings in it are searched. Empty for all.
  std::vector<char> surfaces;
  /// Least width; narrower openings are cracks.
  double leastWidth = 0.0;
  /// Distance from a plane up to which points lie in it.
  double planarDistance = 0.0;
  /// True if all sides of the domain close openings as walls do; else only its bottom does.
  bool sidesAreWalls = false;
};

struct FoundOpening
{
  /// The surface that it is an opening of, which has most of its border.
  Index surface;
  /// The opening's front is on the same side as that surface's.
  std::vector<LatticePoint> points;
  std::vector<std::array<Index, 3>> triangles;
};

/// Returns faces that span the openings in plane walls. Plane charts in one plane count as one wall. The model crosses
/// or covers parts of this plane and so divides it into regions. An opening is a region that nothing covers and that is
/// closed all around: by the walls' own ends, which are boundary edges or creases that the wall goes back from; and by
/// floors, ceilings, the ground and other walls that pass through the plane. So a window is an opening, as is a door
/// down to the floor, a hatch, and a gap between two walls. The space beyond the end of a free-standing wall is none. A
/// window around the corner of two sheets is one in each. In addition, an opening meets two conditions:
/// - The largest circle in it is no narrower than `leastWidth`.
/// - Ends of walls are all of its border. Otherwise they are at least a quarter of it, and at least half together with
///   walls that stand up to it; and the walls in the plane are at least as large as it. With less, each table would
///   divide the room it stands in.
///
/// If there are openings at both ends of one reveal, the smaller is taken, as it is of two that are nearer to each
/// other than `leastWidth`. Openings are sorted by surface, then by place (x, y, z of their centroids). The result does
/// not depend on threads. Throws Aborted on demand.
std::vector<FoundOpening> findOpenings(const SurfaceModel& model, const GridFrame& frame, const OpeningOptions& options,
                                       const RunContext& context);

} // namespace atria
