// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds smooth pieces of a soup, and triangles that can meet no others.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <span>
#include <vector>

namespace atria {

/// Normals of triangles and the smooth pieces they belong to. Triangles should be wound consistently.
struct SmoothPieces
{
  SmoothPieces(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses, double degrees, const Executor& executor);

  /// One entry per triangle; zero if it has no area.
  std::vector<Vec3> unitNormals;
  /// One entry per triangle: the smooth piece of one surface it belongs to, named by its first triangle. Neighbors in a
  /// piece share an edge with no third triangle and bend by no more than the angle there.
  std::vector<Index> pieces;
};

/// Marks triangles that can meet no other one than along common edges and at common points.
///
/// Nothing meets in a cell of the size of an octant at features if it holds one connected patch with normals within 45
/// degrees of their mean. Such a patch does not fold onto itself (Volino and Magnenat-Thalmann 1994). A triangle is
/// marked if all cells within `reach` of it are like that. A body of many small triangles is then searched for contacts
/// only where it may have any. O(n) on average.
std::vector<char> findLoneTriangles(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses,
                                    const SmoothPieces& smooth, std::int64_t cellSize, std::int64_t reach);

} // namespace atria
