// SPDX-License-Identifier: GPL-3.0-or-later
#include "ClosedShell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

namespace atria::model {

namespace {

using Edge = std::pair<std::size_t, std::size_t>;

/// Edges with an odd number of polygons; adding one again removes it.
using LooseEdges = std::set<Edge>;

void toggle(LooseEdges& edges, std::size_t a, std::size_t b)
{
  const Edge edge = std::minmax(a, b);
  if (a != b && !edges.erase(edge))
  {
    edges.insert(edge);
  }
}

/// Finds the first point within the reach of each.
class Merger
{
public:
  explicit Merger(double reach) : cell(2.0 * reach), squared(reach * reach) {}

  std::size_t numberOf(const Vec3& p, const std::vector<Vec3>& points, std::size_t own)
  {
    const std::array<std::int64_t, 3> low = cellOf(p - Vec3::Constant(0.5 * cell));
    for (int corner = 0; corner < 8; ++corner)
    {
      const auto found = cells.find(keyOf({low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2)}));
      for (std::size_t i = 0; found != cells.end() && i < found->second.size(); ++i)
      {
        if ((points[found->second[i]] - p).squaredNorm() <= squared)
        {
          return found->second[i];
        }
      }
    }
    cells[keyOf(cellOf(p))].push_back(own);
    return own;
  }

private:
  std::array<std::int64_t, 3> cellOf(const Vec3& p) const
  {
    return {std::llround(std::floor(p.x() / cell)), std::llround(std::floor(p.y() / cell)),
            std::llround(std::floor(p.z() / cell))};
  }
  static std::uint64_t keyOf(const std::array<std::int64_t, 3>& place)
  {
    return static_cast<std::uint64_t>(place[0]) * 0x9e3779b97f4a7c15 ^
           static_cast<std::uint64_t>(place[1]) * 0xc2b2ae3d27d4eb4f ^
           static_cast<std::uint64_t>(place[2]) * 0x165667b19e3779f9;
  }

  double cell;
  double squared;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
};

/// Cuts each edge at the ends of others that lie on it.
LooseEdges cutAtPoints(const LooseEdges& edges, const std::vector<Vec3>& points, double reach)
{
  std::set<std::size_t> ends;
  for (const Edge& edge : edges)
  {
    ends.insert({edge.first, edge.second});
  }
  LooseEdges out;
  for (const Edge& edge : edges)
  {
    const Vec3& from = points[edge.first];
    const Vec3 along = points[edge.second] - from;
    const double length = along.norm();
    std::vector<std::pair<double, std::size_t>> on{{0.0, edge.first}, {length, edge.second}};
    for (const std::size_t end : ends)
    {
      const Vec3 way = points[end] - from;
      const double at = way.dot(along) / length;
      if (at > reach && at < length - reach && (way - at / length * along).norm() <= reach)
      {
        on.emplace_back(at, end);
      }
    }
    std::ranges::sort(on);
    for (std::size_t i = 0; i + 1 < on.size(); ++i)
    {
      toggle(out, on[i].second, on[i + 1].second);
    }
  }
  return out;
}

} // namespace

bool ClosedShell::isClosed() const
{
  constexpr double reachShare = 1e-4;
  constexpr std::size_t mostToCut = 3000; // the cutting takes the square of it
  Box3 box;
  for (const Vec3& p : points)
  {
    box.extend(p);
  }
  const double reach = reachShare * box.size().norm();
  if (polygons.empty() || !(reach > 0.0) || !std::isfinite(reach))
  {
    return false;
  }
  Merger merger(reach);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    numbers.push_back(merger.numberOf(points[i], points, i));
  }
  LooseEdges loose;
  for (const std::vector<std::size_t>& corners : polygons)
  {
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const std::size_t a = corners[i];
      const std::size_t b = corners[(i + 1) % corners.size()];
      if (a < numbers.size() && b < numbers.size())
      {
        toggle(loose, numbers[a], numbers[b]);
      }
    }
  }
  if (!loose.empty() && loose.size() <= mostToCut)
  {
    loose = cutAtPoints(loose, points, reach);
  }
  double open = 0.0;
  for (const Edge& edge : loose)
  {
    open += (points[edge.second] - points[edge.first]).norm();
  }
  return open <= 10.0 * reach;
}

} // namespace atria::model
