// SPDX-License-Identifier: GPL-3.0-or-later
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
  clusters          ///< triangles among too many others in one place, not looked at for the three above
};
inline constexpr const char* problemNames[]{"open edges", "non-manifold edges", "duplicates", "overlaps", "slivers",
                                            "crossings",  "contacts",           "gaps",       "clusters"};

/// Problems of one kind in one place: connected edges, else what the same surfaces are part of.
struct Problem
{
  ProblemKind kind = ProblemKind::openEdges;
  std::size_t count = 0;
  /// Length of edges together, area of duplicates and of overlaps together, least height of slivers, width of the
  /// widest gap, in model units or their square; zero of crossings, contacts and clusters.
  double size = 0.0;
  Vec3 place = Vec3::Zero(); ///< of the first one, of the thinnest sliver, of the widest gap
  /// Ascending; of duplicates and overlaps first the one that keeps its faces (see FacePrecedence).
  std::vector<Index> surfaces;
};

struct ProblemOptions
{
  double gapTolerance = 0.01; ///< gaps are looked for up to this width, in model units; none with 0
  /// Pairs of triangles that are looked at for crossings, contacts and gaps; 64 times the number of triangles where
  /// that is more. Triangles that are in more pairs than others are left out first, and reported as clusters.
  std::size_t maximumPairs = 5'000'000;
  /// The same for how often three triangles may meet, as bounded by boundOfTriples(), in the search for gaps.
  std::size_t maximumMeetings = 1'000'000;
};

/// Finds what may be wrong with a model, by kind, each in the order of its first triangles. Points are one where
/// placesOf() with a step of placeStep() says so. Nothing of it keeps a model from being meshed. Throws Error for a
/// model without extent, Aborted on demand. O(n log n + pairs of triangles whose boxes touch), of which there is a
/// limit: where thousands of triangles lie upon each other, the first of them stand for all.
std::vector<Problem> findProblems(const TriangleSurface& surface, const ProblemOptions& options,
                                  const RunContext& context);

} // namespace atria
