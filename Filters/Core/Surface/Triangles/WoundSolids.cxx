// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/WoundSolids.h"

#include "Support/UnionFind.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace atria {

namespace {

struct EdgeUse
{
  Index low;
  Index high;
  Index triangle;
  /// Counterclockwise about the edge, seen from its higher point: whether one comes to the triangle's back or its
  /// front.
  bool showsBack;
  double angle = 0.0; ///< of the triangle about the edge
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
    std::vector<EdgeUse> uses = sortedUses();
    for (auto begin = uses.begin(); begin != uses.end();)
    {
      const auto end = std::find_if(
          begin, uses.end(), [&](const EdgeUse& use) { return use.low != begin->low || use.high != begin->high; });
      joinAbout(std::span(begin, end));
      begin = end;
    }
    return numbered();
  }

private:
  std::vector<EdgeUse> sortedUses() const
  {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (Index t = 0; t < triangles.size(); ++t)
    {
      const auto& corners = triangles[t];
      for (int k = 0; k < 3 && !hasRepeatedPoint(corners); ++k)
      {
        const Index from = corners[k];
        const Index to = corners[(k + 1) % 3];
        uses.push_back({std::min(from, to), std::max(from, to), t, (from < to) == (front == Front::outside)});
      }
    }
    std::ranges::sort(uses, {}, [](const EdgeUse& use) { return std::tuple(use.low, use.high, use.triangle); });
    return uses;
  }

  /// Joins each triangle at an edge with the next one behind it.
  void joinAbout(std::span<EdgeUse> uses)
  {
    if (uses.size() > 2)
    {
      sortAbout(uses);
    }
    for (std::size_t i = 0; i < uses.size(); ++i)
    {
      const EdgeUse& use = uses[i];
      const EdgeUse& next = uses[(i + 1) % uses.size()];
      if (use.showsBack == next.showsBack)
      {
        isOpen[use.showsBack ? next.triangle : use.triangle] = 1;
      }
      else if (next.showsBack)
      {
        parts.join(use.triangle, next.triangle);
      }
    }
  }

  /// By angle; at one angle a solid ends before the next one begins.
  void sortAbout(std::span<EdgeUse> uses) const
  {
    constexpr double sameAngle = 1e-6; // radians
    constexpr double turn = 2.0 * std::numbers::pi;
    const Vec3& origin = points[uses[0].low];
    const Vec3 axis = (points[uses[0].high] - origin).normalized();
    const Vec3 across = axis.unitOrthogonal();
    const Vec3 along = axis.cross(across);
    const auto angleOf = [&](const EdgeUse& use) {
      const auto& corners = triangles[use.triangle];
      const Index apex = *std::ranges::find_if(corners, [&](Index p) { return p != use.low && p != use.high; });
      const Vec3 way = points[apex] - origin;
      return std::atan2(way.dot(along), way.dot(across));
    };
    const double first = angleOf(uses[0]) - sameAngle;
    for (EdgeUse& use : uses)
    {
      const double angle = angleOf(use);
      use.angle = angle < first ? angle + turn : angle;
    }
    std::ranges::sort(uses, {}, &EdgeUse::angle);
    for (auto begin = uses.begin(); begin != uses.end();)
    {
      const auto end = std::adjacent_find(
          begin, uses.end(), [&](const EdgeUse& a, const EdgeUse& b) { return b.angle - a.angle > sameAngle; });
      const auto next = end == uses.end() ? end : end + 1;
      std::stable_sort(begin, next, [](const EdgeUse& a, const EdgeUse& b) { return a.showsBack > b.showsBack; });
      begin = next;
    }
  }

  std::vector<Index> numbered()
  {
    constexpr double least = 1e-9; // of the sum of its parts without their signs
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
  std::vector<char> isOpen; ///< by triangle
};

} // namespace

std::vector<Index> findWoundSolids(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                   Front front)
{
  return Solids(points, triangles, front).find();
}

} // namespace atria
