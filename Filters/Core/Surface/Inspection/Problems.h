// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists what may be wrong with a model: open edges, overlaps, slivers, crossings, gaps.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <vector>

namespace atria {

enum class ProblemKind : std::uint8_t
{
  openEdges,        ///< edges that one triangle uses: boundary edges, and holes that should be none
  nonManifoldEdges, ///< edges that three triangles use or more
  duplicates,       ///< triangles with the corners of another one
  overlaps,         ///< places where triangles in one plane lie upon each other in part
  slivers,          ///< triangles whose height is less than a hundredth of their longest side
  crossings,        ///< places where an edge passes through a triangle or another edge
  contacts,         ///< points on an edge or triangle that does not have them as a corner
  gaps,             ///< points that fall short of what they nearly touch
  clusters          ///< triangles among too many others in one place, not searched for the three above
};
inline constexpr const char* problemNames[]{"open edges", "non-manifold edges", "duplicates", "overlaps", "slivers",
                                            "crossings",  "contacts",           "gaps",       "clusters"};

/// Problems of one kind in one place: at connected edges, else between the same surfaces.
struct Problem
{
  ProblemKind kind = ProblemKind::openEdges;
  std::size_t count = 0;
  /// Total length of edges, total area of duplicates or overlaps, least height of slivers, or width of the widest gap,
  /// in model units or their square. It is 0 for crossings, contacts and clusters.
  double size = 0.0;
  Vec3 place = Vec3::Zero(); ///< place of the first one, of the thinnest sliver or of the widest gap
  /// Ids, ascending. Duplicates and overlaps name first the surface that keeps its faces (see FacePrecedence).
  std::vector<Index> surfaces;
};

struct ProblemOptions
{
  double gapTolerance = 0.01; ///< gaps are searched up to this width, in model units; none with 0
  /// Largest number of pairs of triangles searched for crossings, contacts and gaps; 64 times the number of triangles
  /// if that is more. Triangles in the most pairs are left out first and reported as clusters.
  std::size_t maximumPairs = 5'000'000;
  /// Largest number of times that three triangles may meet in the search for gaps, as bounded by boundOfTriples().
  std::size_t maximumMeetings = 1'000'000;
};

/// Returns the possible faults of a model by kind, each in the order of its first triangles. Points are merged as
/// placesOf() with a step of placeStep() does. None of these problems keeps a model from being meshed. Throws Error for
/// a model without extent, Aborted on demand. O(n log n + pairs of triangles whose boxes touch). The number of pairs is
/// limited: where thousands of triangles lie upon each other, the first of them stand for all.
std::vector<Problem> findProblems(const TriangleSurface& surface, const ProblemOptions& options,
                                  const RunContext& context);

} // namespace atria
