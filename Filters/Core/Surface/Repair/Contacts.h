// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the contacts of triangles in a soup.
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

/// Marks the points at which an edge with points on it begins, so that triangles without any are skipped at once.
std::vector<char> beginsOfEdges(std::span<const EdgeContact> contacts, std::size_t pointCount);

/// Contacts: places where pieces of different triangles touch or cut each other, other than along common edges and at
/// common points.
struct Contacts
{
  /// Points where edges cut edges or faces. Contacts number them after the points of the soup.
  std::vector<LatticePoint> newPoints;
  std::vector<EdgeContact> edges;
  std::vector<FaceContact> faces;
  /// Triangles that touch, the lower index first.
  std::vector<std::pair<Index, Index>> pairs;

  bool empty() const { return edges.empty() && faces.empty(); }
};

/// Contacts as they were found, with those of each pair together.
struct FoundContacts
{
  struct Pair
  {
    Index first;
    Index second;
    std::size_t edgesBegin;
    std::size_t edgesEnd;
    std::size_t facesBegin;
    std::size_t facesEnd;
  };
  std::vector<LatticePoint> newPoints;
  std::vector<EdgeContact> edges;
  std::vector<FaceContact> faces;
  std::vector<Pair> pairs;

  /// Returns all contacts but those of pairs whose sources are both in `isLeft`; sorted, without repeats.
  Contacts sorted(const TriangleSoup& soup, const std::vector<char>& isLeft = {}) const;
  /// Returns the number of contacts of pairs whose sources are both in `isLeft`, without repeats.
  std::size_t countLeft(const TriangleSoup& soup, const std::vector<char>& isLeft) const;

private:
  void add(Contacts& to, std::size_t edgesBegin, std::size_t edgesEnd, std::size_t facesBegin,
           std::size_t facesEnd) const;
  void sort(Contacts& contacts, Index base) const;
};

/// Pairs of sources that touched each other.
class MetSources
{
public:
  void add(const TriangleSoup& soup, const std::vector<FoundContacts::Pair>& pairs);
  bool contains(Index a, Index b) const;

private:
  /// Sorted pairs, the lower source first. Pairs of a lower source begin at begins_[it].
  std::vector<std::pair<Index, Index>> pairs_;
  std::vector<Index> begins_;
};

/// Change of a triangle since contacts were last searched.
enum class Change : char
{
  none,
  cut, ///< it is a piece of an earlier triangle
  moved
};

/// The pairs of triangles to test: pairs of which one moved, or one was cut and their sources have met. A piece lies in
/// the triangle it was cut from, so it meets nothing else.
struct AskedPairs
{
  const std::vector<Change>& changes;
  const MetSources& met;
  /// One flag per source. Pairs with both sources flagged are not tested. May be empty.
  const std::vector<char>& isLeft;

  bool contains(const TriangleSoup& soup, Index a, Index b) const
  {
    const Index first = soup.sources[a];
    const Index second = soup.sources[b];
    return first != second && !(!isLeft.empty() && isLeft[first] && isLeft[second]) &&
           (changes[a] == Change::moved || changes[b] == Change::moved || met.contains(first, second));
  }
};

/// Returns all contacts of these pairs outside of clusters. A point within `reach` lattice units of an edge or a
/// triangle lies on it. Sides are decided exactly, distances in double precision. Throws TooManyPairs (Clusters.h). O(n
/// log n + pairs of triangles whose boxes touch).
FoundContacts findContacts(const TriangleSoup& soup, const AskedPairs& asked, std::int64_t reach,
                           const ClusterCells& clusters, const RunContext& context);

} // namespace atria
