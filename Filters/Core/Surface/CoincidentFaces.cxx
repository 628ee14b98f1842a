// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/CoincidentFaces.h"

#include "Support/IndexTable.h"
#include "Surface/PointPlaces.h"

#include <algorithm>
#include <numeric>

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

std::uint64_t hashOf(Index a, Index b) { return mixed((std::uint64_t{a} << 32) | b); }

class Search
{
public:
  Search(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const Index> faceIds)
      : faces(faceIds), corners(triangles.begin(), triangles.end())
  {
    const std::vector<Index> places = placesOfModel(points);
    for (Triangle& t : corners)
    {
      t = {places[t[0]], places[t[1]], places[t[2]]};
    }
    out.kept.resize(corners.size());
    std::iota(out.kept.begin(), out.kept.end(), Index{0});
  }

  CoincidentFaces run()
  {
    comparePolygons();
    compareTriangles();
    return std::move(out);
  }

private:
  /// Edges of a polygon that bound it, those of its triangles that are there once, each in its direction and sorted by
  /// ends.
  std::vector<Edge> outlineOf(std::size_t first) const
  {
    std::vector<Edge> edges;
    for (std::size_t i = first; i < corners.size() && faces[i] == faces[first]; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        edges.emplace_back(corners[i][k], corners[i][(k + 1) % 3]);
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

  static bool sameEnds(const std::vector<Edge>& a, const std::vector<Edge>& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Edge& x, const Edge& y) {
      return std::minmax(x.first, x.second) == std::minmax(y.first, y.second);
    });
  }

  void comparePolygons()
  {
    std::vector<Index> starts;
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      const bool isStart = i == 0 || faces[i] != faces[i - 1];
      if (isStart && i + 1 < faces.size() && faces[i + 1] == faces[i])
      {
        starts.push_back(static_cast<Index>(i));
      }
    }
    IndexTable table(starts.size());
    for (const Index start : starts)
    {
      const std::vector<Edge> outline = outlineOf(start);
      std::uint64_t hash = 0;
      for (const auto& [a, b] : outline)
      {
        hash += hashOf(std::min(a, b), std::max(a, b));
      }
      const Index same = outline.empty() ? start : table.findOrAdd(mixed(hash), start, [&](Index i) {
        return sameEnds(outlineOf(i), outline);
      });
      if (same != start)
      {
        replace(start, same, outlineOf(same).front() != outline.front());
      }
    }
  }

  void replace(Index first, Index by, bool turned)
  {
    for (std::size_t i = first; i < corners.size() && faces[i] == faces[first]; ++i)
    {
      out.kept[i] = by;
    }
    ++out.faces;
    out.opposite += turned ? 1 : 0;
  }

  void compareTriangles()
  {
    const auto sorted = [&](Index i) {
      Triangle t = corners[i];
      std::sort(t.begin(), t.end());
      return t;
    };
    IndexTable table(corners.size());
    for (Index i = 0; i < corners.size(); ++i)
    {
      if (out.kept[i] != i || isFlat(corners[i]))
      {
        continue;
      }
      const Triangle key = sorted(i);
      const Index same =
          table.findOrAdd(hashOf(key[0], key[1]) ^ mixed(key[2]), i, [&](Index other) { return sorted(other) == key; });
      if (same != i)
      {
        out.kept[i] = same;
        ++out.faces;
        out.opposite += isTurned(corners[i], corners[same]) ? 1 : 0;
      }
    }
  }

  /// Of triangles with the same corners.
  static bool isTurned(const Triangle& a, const Triangle& b)
  {
    const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return a[1] != b[(at + 1) % 3];
  }

  std::span<const Index> faces;
  std::vector<Triangle> corners; ///< by place
  CoincidentFaces out;
};

} // namespace

CoincidentFaces findCoincidentFaces(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                    std::span<const Index> faceIds)
{
  return Search(points, triangles, faceIds).run();
}

} // namespace atria
