// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// A point that lies on an edge without being one of its ends.
struct EdgeContact
{
  EdgeKey edge;
  Index point;
  friend auto operator<=>(const EdgeContact&, const EdgeContact&) = default;
};

/// A point that lies on a triangle, off its edges.
struct FaceContact
{
  Index triangle;
  Index point;
  friend auto operator<=>(const FaceContact&, const FaceContact&) = default;
};

/// Where pieces of different triangles touch or cut each other other than along common edges and at common points.
struct Contacts
{
  /// Points where edges cut edges or faces; contacts number them on from the points of the soup.
  std::vector<LatticePoint> newPoints;
  std::vector<EdgeContact> edges;
  std::vector<FaceContact> faces;
  /// Triangles that touch, the lower index first.
  std::vector<std::pair<Index, Index>> pairs;

  bool empty() const { return edges.empty() && faces.empty(); }
};

/// Finds all contacts outside of clusters of triangles of which one is marked in `changed`, but for those of which the
/// sources of both are in `isLeft`, which may be empty. A point within `reach`
/// lattice units of an edge or a triangle lies on it. Sides are decided exactly, distances in double precision. All
/// lists are sorted, without repeats. Throws TooManyPairs (Clusters.h). O(n log n + pairs of triangles whose boxes
/// touch).
Contacts findContacts(const TriangleSoup& soup, const std::vector<char>& changed, const std::vector<char>& isLeft,
                      std::int64_t reach, const ClusterCells& clusters, const RunContext& context);

} // namespace atria
