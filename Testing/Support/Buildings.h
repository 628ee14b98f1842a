// SPDX-License-Identifier: GPL-3.0-or-later
/// Buildings of sheets whose rooms and openings are known.
#pragma once

#include "Shapes.h"

#include <vector>

namespace atria::testing {

/// A rectangle in a wall, by its lower and upper corner in meters from the wall's.
struct Hole
{
  double left;
  double bottom;
  double right;
  double top;

  double area() const { return (right - left) * (top - bottom); }
};

/// A rectangle at `corner` with edges u and v, less holes. Its triangles share their edges.
inline void addWall(TriangleSurface& to, const std::string& name, const Vec3& corner, const Vec3& u, const Vec3& v,
                    const std::vector<Hole>& holes = {})
{
  std::vector<double> s{0.0, u.norm()};
  std::vector<double> t{0.0, v.norm()};
  for (const Hole& hole : holes)
  {
    s.insert(s.end(), {hole.left, hole.right});
    t.insert(t.end(), {hole.bottom, hole.top});
  }
  for (std::vector<double>* of : {&s, &t})
  {
    std::sort(of->begin(), of->end());
    of->erase(std::unique(of->begin(), of->end()), of->end());
  }
  std::vector<Vec3> points;
  for (const double b : t)
  {
    for (const double a : s)
    {
      points.push_back(corner + a * u.normalized() + b * v.normalized());
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j + 1 < t.size(); ++j)
  {
    for (Index i = 0; i + 1 < s.size(); ++i)
    {
      const double a = 0.5 * (s[i] + s[i + 1]);
      const double b = 0.5 * (t[j] + t[j + 1]);
      const bool open = std::any_of(holes.begin(), holes.end(), [&](const Hole& hole) {
        return hole.left < a && a < hole.right && hole.bottom < b && b < hole.top;
      });
      const auto p = static_cast<Index>(s.size() * j + i);
      const auto q = static_cast<Index>(p + s.size());
      if (!open)
      {
        triangles.push_back({p, p + 1, q + 1});
        triangles.push_back({p, q + 1, q});
      }
    }
  }
  addSurface(to, name, points, triangles);
}

/// Four walls from `low` to `high`, their fronts outwards, with holes by wall: south, east, north, west. Seen from
/// outside each wall begins at its left.
inline void addWalls(TriangleSurface& to, const Vec3& low, const Vec3& high,
                     const std::array<std::vector<Hole>, 4>& holes)
{
  const Vec3 size = high - low;
  const Vec3 x(size[0], 0, 0), y(0, size[1], 0), z(0, 0, size[2]);
  addWall(to, "South", low, x, z, holes[0]);
  addWall(to, "East", low + x, y, z, holes[1]);
  addWall(to, "North", low + x + y, -x, z, holes[2]);
  addWall(to, "West", low + y, -y, z, holes[3]);
}

} // namespace atria::testing
