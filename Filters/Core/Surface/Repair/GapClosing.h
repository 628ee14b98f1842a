// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

/// What a soup was before it was cut, by its sources.
struct SoupAsDrawn
{
  explicit SoupAsDrawn(const TriangleSoup& soup);

  /// See partsOf.
  std::vector<Index> parts;
  std::vector<double> shortestEdges;
};

struct GapOptions
{
  /// In lattice units; below 1 nothing is moved.
  double tolerance = 0.0;
  const SoupAsDrawn& drawn;
  ClusterCells& clusters;
};

/// Moves points onto what they nearly touch, so that no gap narrower than `tolerance` (lattice units) is left between
/// them. The soup should be cut already (autorefine), so that what touches has common points: these move together, and
/// no contact is lost; and it should be cut again afterwards. One pass: what moves onto what stands still meanwhile.
///
/// A point is moved onto the nearest point within the tolerance, else onto the nearest edge, else onto the nearest
/// face; the nearest pairs first, and points and edges only up to twice as far away as the face. Points of a part, as
/// it was drawn, move onto a larger part, then those of a larger one onto a smaller one. Points at boundary edges also
/// move onto their own part: onto what is ahead (isAhead); elsewhere not onto what is connected with them within three
/// times the tolerance, so that details stay. A move is left out that would take a point off a side of the domain it
/// lies on, or turn a triangle by more than 60 degrees out of its plane, or leave one without area that has a boundary
/// edge, but for those between the point and what it moves onto. No point moves where an edge shorter than twice the
/// tolerance was drawn, as what is that fine could fold, and none in clusters; what lies near too many others is
/// hidden. Points only move: triangles are not cut. Returns for each point whether it was moved. O(n log n + pairs of
/// triangles and points near them that are at boundary edges or of another part).
std::vector<char> closeGaps(TriangleSoup& soup, const GridFrame& frame, const GapOptions& options,
                            const RunContext& context);

} // namespace atria
