// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/CoincidentFaces.h"

#include "Support/Buckets.h"
#include "Support/IndexTable.h"
#include "Support/Memory.h"
#include "Surface/Triangles/FacePrecedence.h"
#include "Surface/Triangles/PointPlaces.h"
#include "Surface/Triangles/WoundSolids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <optional>

namespace atria {

namespace {

using Triangle = std::array<Index, 3>;
using Edge = std::pair<Index, Index>;

std::vector<Index> placesOfModel(std::span<const Vec3> points)
{
  Box3 bounds;
  for (const Vec3& p : points)
  {
    bounds.extend(p);
  }
  return placesOf(points, placeStep(bounds));
}

bool isFlat(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

class Search
{
public:
  Search(std::span<const Vec3> givenPoints, std::span<const Triangle> triangles, std::span<const Index> faceIds,
         std::span<const Index> surfaceIds)
      : points(givenPoints), soup(triangles), faces(faceIds), surfaces(surfaceIds), places(placesOfModel(givenPoints))
  {
    reserveLarge(out.kept, soup.size());
    out.kept.resize(soup.size());
    std::iota(out.kept.begin(), out.kept.end(), Index{0});
  }

  CoincidentFaces run()
  {
    comparePolygons();
    settle(true);
    compareTriangles();
    settle(false);
    return std::move(out);
  }

private:
  Triangle corners(std::size_t i) const
  {
    const Triangle& t = soup[i];
    return {places[t[0]], places[t[1]], places[t[2]]};
  }

  /// Returns the edges that bound a polygon: those of its triangles that occur once, each in its direction and sorted
  /// by ends.
  std::vector<Edge> outlineOf(std::size_t first) const
  {
    std::vector<Edge> edges;
    for (std::size_t i = first; i < soup.size() && faces[i] == faces[first]; ++i)
    {
      const Triangle t = corners(i);
      for (int k = 0; k < 3; ++k)
      {
        edges.emplace_back(t[k], t[(k + 1) % 3]);
      }
    }
    const auto ends = [](const Edge& e) { return std::minmax(e.first, e.second); };
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return std::pair(ends(a), a.first) < std::pair(ends(b), b.first); });
    std::vector<Edge> outline;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      if (i + 1 < edges.size() && ends(edges[i]) == ends(edges[i + 1]))
      {
        ++i;
        continue;
      }
      outline.push_back(edges[i]);
    }
    return outline;
  }

  /// Returns the edges by their ends alone, whichever their direction.
  static std::vector<Edge> endsOf(std::vector<Edge> outline)
  {
    for (Edge& e : outline)
    {
      e = {std::min(e.first, e.second), std::max(e.first, e.second)};
    }
    return outline;
  }

  void comparePolygons()
  {
    std::vector<Index> starts;
    std::vector<Index> lowest;
    starts.reserve(faces.size() / 2);
    lowest.reserve(faces.size() / 2);
    for (std::size_t i = 0, next = 0; i < faces.size(); i = next)
    {
      Index low = noIndex;
      for (next = i; next < faces.size() && faces[next] == faces[i]; ++next)
      {
        const Triangle t = corners(next);
        low = std::min({low, t[0], t[1], t[2]});
      }
      if (next - i > 1)
      {
        starts.push_back(static_cast<Index>(i));
        lowest.push_back(low);
      }
    }
    std::vector<std::pair<std::uint64_t, Index>> candidates; // polygons with the sums of their outlines
    forBuckets(lowest, [&](std::span<const Index> bucket) {
      candidates.clear();
      for (const Index i : bucket)
      {
        candidates.emplace_back(outlineSum(starts[i]), starts[i]);
      }
      if (allDiffer(candidates))
      {
        return;
      }
      std::sort(candidates.begin(), candidates.end());
      for (std::size_t i = 0, next = 0; i < candidates.size(); i = next)
      {
        for (next = i + 1; next < candidates.size() && candidates[next].first == candidates[i].first; ++next)
        {
        }
        if (next - i > 1)
        {
          compareOutlines(std::span(candidates).subspan(i, next - i));
        }
      }
    });
  }

  /// Returns a sum that is the same for equal outlines, whichever their direction, and most likely differs for others.
  /// Edges that occur twice cancel out.
  std::uint64_t outlineSum(std::size_t first) const
  {
    std::uint64_t sum = 0;
    for (std::size_t i = first; i < soup.size() && faces[i] == faces[first]; ++i)
    {
      const Triangle t = corners(i);
      for (int k = 0; k < 3; ++k)
      {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        // One round of mixing is enough: sums that are equal by chance only cost a comparison.
        const std::uint64_t edge = ((std::uint64_t{low} << 32) | high) * 0x9e3779b97f4a7c15ull;
        sum ^= edge ^ (edge >> 29);
      }
    }
    return sum;
  }

  void compareOutlines(std::span<const std::pair<std::uint64_t, Index>> alike)
  {
    std::vector<std::pair<std::vector<Edge>, Index>> candidates;
    for (const auto& [sum, start] : alike)
    {
      candidates.emplace_back(endsOf(outlineOf(start)), start);
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t i = 0, next = 0; i < candidates.size(); i = next)
    {
      for (next = i; next < candidates.size() && candidates[next].first == candidates[i].first; ++next)
      {
        alikeFaces.push_back(candidates[next].second);
      }
      endAlike(candidates[i].first.empty() ? 1 : next - i);
    }
  }

  /// Ends a list of faces that coincide, the last `count` of those found.
  void endAlike(std::size_t count)
  {
    if (count > 1)
    {
      alikeEnds.push_back(alikeFaces.size());
    }
    else
    {
      alikeFaces.resize(alikeEnds.empty() ? 0 : alikeEnds.back());
    }
  }

  /// Calls `visit` for every set of items of the same lowest place, ascending. A polygon or triangle coincides only
  /// with one of its set. Sets are small and mostly of neighbors: this takes a fraction of the time of hashing.
  template <class Visit> void forBuckets(const std::vector<Index>& lowest, Visit&& visit) const
  {
    const Buckets items = fillBuckets(points.size(), SerialExecutor(), [&](auto&& use) {
      for (Index i = 0; i < lowest.size(); ++i)
      {
        use(lowest[i], i);
      }
    });
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (items.of(i).size() > 1)
      {
        visit(items.of(i));
      }
    }
  }

  /// True if all candidates of a small set differ; the set then need not be sorted. False for larger sets.
  static bool allDiffer(std::span<const std::pair<std::uint64_t, Index>> candidates)
  {
    constexpr std::size_t few = 8;
    if (candidates.size() > few)
    {
      return false;
    }
    for (std::size_t i = 1; i < candidates.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (candidates[i].first == candidates[j].first)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Chooses which of the coincident faces stays, and empties the lists of them. Faces are triangles, or polygons given
  /// by their first triangles.
  void settle(bool arePolygons)
  {
    for (std::size_t list = 0, begin = 0; list < alikeEnds.size(); begin = alikeEnds[list], ++list)
    {
      const std::span alike = std::span(alikeFaces).subspan(begin, alikeEnds[list] - begin);
      const bool isOneSurface = surfaces.empty() || std::ranges::all_of(alike, [&](Index face) {
                                  return surfaces[face] == surfaces[alike[0]];
                                });
      if (!isOneSurface && !precedence)
      {
        findPrecedence(arePolygons);
      }
      const std::vector<Index> compared =
          isOneSurface ? std::vector<Index>(alike.size(), alike[0]) : comparedOf(alike, arePolygons);
      const std::size_t kept = isOneSurface ? 0 : precedence->keptOf(compared);
      for (std::size_t k = 0; k < alike.size(); ++k)
      {
        if (k != kept && !areOfTouchingSolids(alike[k], alike[kept], arePolygons))
        {
          const bool isByOrder = !isOneSurface && precedence->areEqual(compared[k], compared[kept]);
          replace(alike[k], alike[kept], arePolygons, isByOrder);
        }
      }
    }
    alikeFaces.clear();
    alikeEnds.clear();
  }

  /// Returns a triangle to compare for each face: one of the first face of its surface, as only that was counted.
  std::vector<Index> comparedOf(std::span<const Index> alike, bool arePolygons) const
  {
    std::vector<Index> compared;
    for (const Index face : alike)
    {
      const Index first = *std::ranges::find_if(alike, [&](Index other) { return surfaces[other] == surfaces[face]; });
      compared.push_back(arePolygons ? largestOf(first) : first);
    }
    return compared;
  }

  /// Finds precedence. Polygons that one surface repeats count once, and so do triangles.
  void findPrecedence(bool arePolygons)
  {
    std::vector<Triangle> counted(soup.size());
    for (std::size_t i = 0; i < soup.size(); ++i)
    {
      counted[i] = out.kept[i] == i ? corners(i) : Triangle{};
    }
    std::vector<Index> seen; // surfaces
    for (std::size_t list = 0, begin = 0; arePolygons && list < alikeEnds.size(); begin = alikeEnds[list], ++list)
    {
      seen.clear();
      for (std::size_t k = begin; k < alikeEnds[list]; ++k)
      {
        const Index first = alikeFaces[k];
        const bool isRepeat = std::ranges::find(seen, surfaces[first]) != seen.end();
        seen.push_back(surfaces[first]);
        for (std::size_t i = first; isRepeat && i < soup.size() && faces[i] == faces[first]; ++i)
        {
          counted[i] = Triangle{};
        }
      }
    }
    const std::size_t count = *std::ranges::max_element(surfaces) + std::size_t{1};
    precedence.emplace(findPlanarPatches(points, counted, surfaces), surfaces, count);
  }

  /// Returns the largest triangle of a polygon, as triangles without area are in no patch.
  Index largestOf(Index first) const
  {
    Index largest = first;
    double most = 0.0;
    for (Index i = first; i < soup.size() && faces[i] == faces[first]; ++i)
    {
      const Vec3& p = points[soup[i][0]];
      const double area = (points[soup[i][1]] - p).cross(points[soup[i][2]] - p).norm();
      largest = area > most ? i : largest;
      most = std::max(area, most);
    }
    return largest;
  }

  /// True if coincident faces are the sides of two solids that face each other.
  bool areOfTouchingSolids(Index one, Index other, bool arePolygons)
  {
    if (!areOpposite(one, other, arePolygons))
    {
      return false;
    }
    if (solids.empty())
    {
      std::vector<Triangle> placed(soup.size());
      for (std::size_t i = 0; i < soup.size(); ++i)
      {
        placed[i] = corners(i);
      }
      solids = {findWoundSolids(points, placed, Front::outside), findWoundSolids(points, placed, Front::inside)};
    }
    const Index first = arePolygons ? largestOf(one) : one;
    const Index second = arePolygons ? largestOf(other) : other;
    return std::ranges::any_of(solids, [&](const std::vector<Index>& of) {
      return of[first] != noIndex && of[second] != noIndex && of[first] != of[second];
    });
  }

  bool areOpposite(Index one, Index other, bool arePolygons) const
  {
    return arePolygons ? outlineOf(one).front() != outlineOf(other).front() : isTurned(corners(one), corners(other));
  }

  void replace(Index face, Index by, bool arePolygons, bool isByOrder)
  {
    if (isByOrder && out.isByOrder.empty())
    {
      out.isByOrder.resize(soup.size(), 0);
    }
    for (std::size_t i = face; i < soup.size() && (arePolygons ? faces[i] == faces[face] : i == face); ++i)
    {
      out.kept[i] = by;
      if (isByOrder)
      {
        out.isByOrder[i] = 1;
      }
    }
    ++out.faces;
    out.opposite += areOpposite(face, by, arePolygons) ? 1 : 0;
  }

  void compareTriangles()
  {
    std::vector<Index> left;
    std::vector<Index> lowest;
    left.reserve(soup.size());
    lowest.reserve(soup.size());
    for (Index i = 0; i < soup.size(); ++i)
    {
      const Triangle t = corners(i);
      if (out.kept[i] == i && !isFlat(t))
      {
        left.push_back(i);
        lowest.push_back(std::min({t[0], t[1], t[2]}));
      }
    }
    std::vector<std::pair<std::uint64_t, Index>> candidates; // triangles with the two corners that are not the lowest
    forBuckets(lowest, [&](std::span<const Index> bucket) {
      candidates.clear();
      for (const Index i : bucket)
      {
        const auto [a, b, c] = corners(left[i]);
        const Index high = std::max({a, b, c});
        const Index middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
        candidates.emplace_back((std::uint64_t{middle} << 32) | high, left[i]);
      }
      if (allDiffer(candidates))
      {
        return;
      }
      std::sort(candidates.begin(), candidates.end());
      for (std::size_t i = 0, next = 0; i < candidates.size(); i = next)
      {
        for (next = i; next < candidates.size() && candidates[next].first == candidates[i].first; ++next)
        {
          alikeFaces.push_back(candidates[next].second);
        }
        endAlike(next - i);
      }
    });
  }

  /// True if triangles with the same corners are wound in opposite directions.
  static bool isTurned(const Triangle& a, const Triangle& b)
  {
    const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return a[1] != b[(at + 1) % 3];
  }

  std::span<const Vec3> points;
  std::span<const Triangle> soup;
  std::span<const Index> faces;
  std::span<const Index> surfaces;
  std::vector<Index> places; ///< one entry per point
  /// Coincident faces, list by list, and the ends of the lists.
  std::vector<Index> alikeFaces;
  std::vector<std::size_t> alikeEnds;
  std::optional<FacePrecedence> precedence; ///< set on first use
  std::vector<std::vector<Index>> solids;   ///< set on first use: one entry per triangle, for either side of fronts
  CoincidentFaces out;
};

} // namespace

CoincidentFaces findCoincidentFaces(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                    std::span<const Index> faceIds, std::span<const Index> surfaceIds)
{
  return Search(points, triangles, faceIds, surfaceIds).run();
}

} // namespace atria
