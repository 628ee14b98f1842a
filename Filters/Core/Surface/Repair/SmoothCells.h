// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <span>
#include <vector>

namespace atria {

/// What triangles are part of. They should be wound consistently.
struct SmoothPieces
{
  SmoothPieces(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses, double degrees, const Executor& executor);

  /// Per triangle; zero where it has no area.
  std::vector<Vec3> unitNormals;
  /// Per triangle the smooth piece of one surface that it is of, by its first triangle: those that share an edge with
  /// no third one and bend by no more than the angle there.
  std::vector<Index> pieces;
};

/// Marks triangles that can meet no other one than along common edges and at common points.
///
/// In a cell of the size of an octant at features that holds one connected patch, whose normals are within 45 degrees
/// of their mean, nothing meets: such a patch does not fold onto itself (Volino and Magnenat-Thalmann 1994). Triangles
/// are marked of which all cells within `reach` are like that. A body of many small triangles is then searched for
/// contacts only where it may have any. O(n) on average.
std::vector<char> findLoneTriangles(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses,
                                    const SmoothPieces& smooth, std::int64_t cellSize, std::int64_t reach);

} // namespace atria
