// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/WoundSolids.h"

#include "Support/UnionFind.h"
#include "Surface/Triangles/EachEdge.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

/// A triangle at an edge.
struct Side
{
  Index triangle;
  /// True if the triangle's back comes first, counterclockwise around the edge seen from its higher point.
  bool showsBack;
  double angle = 0.0; ///< angle of the triangle around the edge
};

class Solids
{
public:
  Solids(std::span<const Vec3> p, std::span<const std::array<Index, 3>> t, Front f)
      : points(p), triangles(t), front(f), parts(t.size()), isOpen(t.size(), 0)
  {
  }

  std::vector<Index> find()
  {
    std::vector<Side> sides;
    eachEdge(sortedEdgeUses(triangles, points.size(), SerialExecutor()), [&](std::span<const SoupEdgeUse> uses) {
      sides.clear();
      for (const SoupEdgeUse& use : uses)
      {
        if (!hasRepeatedPoint(triangles[use.triangle]))
        {
          sides.push_back({use.triangle, use.forward == (front == Front::outside)});
        }
      }
      joinAbout(uses.front().edge, sides);
    });
    return numbered();
  }

private:
  /// Joins each triangle at an edge with the next one behind it.
  void joinAbout(const EdgeKey& edge, std::vector<Side>& sides)
  {
    if (sides.size() > 2)
    {
      sortAbout(edge, sides);
    }
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      const Side& side = sides[i];
      const Side& next = sides[(i + 1) % sides.size()];
      if (side.showsBack == next.showsBack)
      {
        isOpen[side.showsBack ? next.triangle : side.triangle] = 1;
      }
      else if (next.showsBack)
      {
        parts.join(side.triangle, next.triangle);
      }
    }
  }

  /// Sorts sides by angle. A solid ends before the next one begins at the same angle.
  void sortAbout(const EdgeKey& edge, std::vector<Side>& sides) const
  {
    constexpr double sameAngle = 1e-6; // radians
    constexpr double turn = 2.0 * std::numbers::pi;
    const Vec3& origin = points[edge.first];
    const Vec3 axis = (points[edge.second] - origin).normalized();
    const Vec3 across = axis.unitOrthogonal();
    const Vec3 along = axis.cross(across);
    const auto angleOf = [&](const Side& side) {
      const auto& corners = triangles[side.triangle];
      const Index apex = *std::ranges::find_if(corners, [&](Index p) { return p != edge.first && p != edge.second; });
      const Vec3 way = points[apex] - origin;
      return std::atan2(way.dot(along), way.dot(across));
    };
    const double first = angleOf(sides[0]) - sameAngle;
    for (Side& side : sides)
    {
      const double angle = angleOf(side);
      side.angle = angle < first ? angle + turn : angle;
    }
    std::ranges::stable_sort(sides, {}, &Side::angle);
    for (auto begin = sides.begin(); begin != sides.end();)
    {
      const auto end = std::adjacent_find(begin, sides.end(),
                                          [&](const Side& a, const Side& b) { return b.angle - a.angle > sameAngle; });
      const auto next = end == sides.end() ? end : end + 1;
      std::stable_sort(begin, next, [](const Side& a, const Side& b) { return a.showsBack > b.showsBack; });
      begin = next;
    }
  }

  std::vector<Index> numbered()
  {
    constexpr double least = 1e-9; // least volume, as a part of the sum of its parts without their signs
    std::vector<double> volumes(triangles.size(), 0.0);
    std::vector<double> sums(triangles.size(), 0.0);
    for (Index t = 0; t < triangles.size(); ++t)
    {
      const Index root = parts.find(t);
      const auto& [a, b, c] = triangles[t];
      const Vec3& origin = points[triangles[root][0]];
      const double volume = (points[a] - origin).dot((points[b] - origin).cross(points[c] - origin));
      volumes[root] += front == Front::outside ? volume : -volume;
      sums[root] += std::abs(volume);
      isOpen[root] |= isOpen[t];
    }
    std::vector<Index> solids(triangles.size(), noIndex);
    for (Index t = 0; t < triangles.size(); ++t)
    {
      const Index root = parts.find(t);
      solids[t] = !isOpen[root] && volumes[root] > least * sums[root] ? root : noIndex;
    }
    return solids;
  }

  std::span<const Vec3> points;
  std::span<const std::array<Index, 3>> triangles;
  Front front;
  UnionFind parts;
  std::vector<char> isOpen; ///< one flag per triangle
};

} // namespace

std::vector<Index> findWoundSolids(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                   Front front)
{
  return Solids(points, triangles, front).find();
}

} // namespace atria
