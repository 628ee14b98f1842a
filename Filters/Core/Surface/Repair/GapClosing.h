// SPDX-License-Identifier: GPL-3.0-or-later
/// Closes gaps between parts of a soup by moving points.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

/// Properties of a soup before it was cut, one entry per source.
struct SoupAsDrawn
{
  explicit SoupAsDrawn(const TriangleSoup& soup);

  /// See partsOf.
  std::vector<Index> parts;
  std::vector<double> shortestEdges;
};

struct GapOptions
{
  /// Width of gaps to close, in lattice units; below 1 nothing is moved.
  double tolerance = 0.0;
  const SoupAsDrawn& drawn;
  ClusterCells& clusters;
};

/// Moves points onto nearby points, edges and faces, so that no gap narrower than `tolerance` (lattice units) is left
/// between them. Returns one flag per point: nonzero if it was moved. The soup should be cut already (autorefine), so
/// that touching triangles have common points: these move together, and no contact is lost. It should be cut again
/// afterwards. Makes one pass: targets do not move during it.
///
/// A point is moved onto the nearest point within the tolerance, else onto the nearest edge, else onto the nearest
/// face. Points and edges count only up to twice as far away as the face. Points of a part, as it was drawn, move onto
/// a larger part, then those of a larger part onto a smaller one. In each case the nearest pairs come first, and moves
/// onto points come before those onto edges and faces. Points at boundary edges also move onto their own part: onto
/// places ahead of them (isAhead). Elsewhere they do not move onto triangles that are connected with them within three
/// times the tolerance, so that details stay.
///
/// Points stay in these cases:
/// - The move would take the point off a side of the domain it lies on.
/// - The move would turn a triangle by more than 45 degrees out of its plane.
/// - The move would take all area from a triangle with a boundary edge. Triangles between the point and its target may
///   vanish.
/// - An edge shorter than twice the tolerance was drawn there, as details that fine could fold.
/// - The point is in a cluster.
///
/// Triangles near too many others are hidden. Points only move: triangles are not cut. O(n log n + pairs of triangles
/// and points near them that are at boundary edges or of another part).
std::vector<char> closeGaps(TriangleSoup& soup, const GridFrame& frame, const GapOptions& options,
                            const RunContext& context);

} // namespace atria
