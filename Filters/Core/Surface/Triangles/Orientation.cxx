// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/Orientation.h"

#include "Grid/Predicates.h"
#include "Surface/Triangles/EachEdge.h"

#include <Eigen/Geometry>

namespace atria {

namespace {

/// The triangle across each edge of each triangle; noIndex if the edge does not have exactly two triangles.
struct Neighbors
{
  std::vector<std::array<Index, 3>> across;
  /// True if the triangle across is wound like this one.
  std::vector<std::array<bool, 3>> alike;

  Neighbors(const TriangleSoup& soup, std::span<const SoupEdgeUse> all)
      : across(soup.triangles.size(), {noIndex, noIndex, noIndex}), alike(soup.triangles.size())
  {
    eachEdge(all, [&](std::span<const SoupEdgeUse> uses) {
      if (uses.size() == 2)
      {
        join(soup, uses[0], uses[1]);
        join(soup, uses[1], uses[0]);
      }
    });
  }

private:
  void join(const TriangleSoup& soup, const SoupEdgeUse& from, const SoupEdgeUse& to)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (edgeKey(soup.triangles[from.triangle], i) == from.edge)
      {
        across[from.triangle][i] = to.triangle;
        alike[from.triangle][i] = from.forward != to.forward;
      }
    }
  }
};

struct Piece
{
  std::vector<Index> triangles;
  bool closed = true;
  bool twoSided = true;
};

/// Returns the triangles connected with `first`; sets `turned` for those wound against it.
Piece pieceOf(Index first, const Neighbors& neighbors, std::vector<char>& seen, std::vector<char>& turned)
{
  Piece piece;
  piece.triangles.push_back(first);
  seen[first] = 1;
  for (std::size_t i = 0; i < piece.triangles.size(); ++i)
  {
    const Index t = piece.triangles[i];
    for (int e = 0; e < 3; ++e)
    {
      const Index next = neighbors.across[t][e];
      if (next == noIndex)
      {
        piece.closed = false;
        continue;
      }
      const char wanted = neighbors.alike[t][e] ? turned[t] : static_cast<char>(!turned[t]);
      if (!seen[next])
      {
        seen[next] = 1;
        turned[next] = wanted;
        piece.triangles.push_back(next);
      }
      piece.twoSided = piece.twoSided && turned[next] == wanted;
    }
  }
  return piece;
}

Vec3 areaOf(const TriangleSoup& soup, Index t)
{
  const LatticeNormal normal(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2));
  return {static_cast<double>(normal.n[0]), static_cast<double>(normal.n[1]), static_cast<double>(normal.n[2])};
}

/// True if the whole piece, as wound by `turned`, has to be turned over.
bool mustTurnOver(const TriangleSoup& soup, const Piece& piece, const std::vector<char>& turned)
{
  double volume = 0.0;
  double kept = 0.0;
  double against = 0.0;
  const LatticePoint& origin = soup.corner(piece.triangles[0], 0);
  for (const Index t : piece.triangles)
  {
    const Vec3 area = areaOf(soup, t);
    volume += (turned[t] ? -1.0 : 1.0) * area.dot(between(origin, soup.corner(t, 0)));
    (turned[t] ? against : kept) += area.norm();
  }
  constexpr double tie = 1e-6; // areas of pieces add up except for rounding
  return piece.closed ? volume < 0.0 : against > (1.0 + tie) * kept;
}

} // namespace

std::size_t orientTriangles(TriangleSoup& soup, const Executor& executor)
{
  std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, executor);
  return orientTriangles(soup, uses);
}

std::size_t orientTriangles(TriangleSoup& soup, std::span<SoupEdgeUse> uses)
{
  const Neighbors neighbors(soup, uses);
  std::vector<char> seen(soup.triangles.size(), 0);
  std::vector<char> turned(soup.triangles.size(), 0);
  std::vector<char> isTurned(soup.triangles.size(), 0);
  std::size_t count = 0;
  for (Index first = 0; first < soup.triangles.size(); ++first)
  {
    if (seen[first])
    {
      continue;
    }
    const Piece piece = pieceOf(first, neighbors, seen, turned);
    const char over = mustTurnOver(soup, piece, turned) ? 1 : 0;
    for (const Index t : piece.triangles)
    {
      if (piece.twoSided && turned[t] != over)
      {
        std::swap(soup.triangles[t][1], soup.triangles[t][2]);
        ++count;
        isTurned[t] = 1;
      }
    }
  }
  for (SoupEdgeUse& use : uses)
  {
    use.forward = use.forward != (isTurned[use.triangle] != 0);
  }
  return count;
}

} // namespace atria
