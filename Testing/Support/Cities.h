// SPDX-License-Identifier: GPL-3.0-or-later
/// Houses whose bases, footprints and volumes are known.
#pragma once

#include "Shapes.h"

namespace atria::testing {

/// A box on [x, x + 10] by [y, y + 10], with a bottom or without one.
inline void addHouse(TriangleSurface& to, const std::string& name, double x, double y, double base, double top,
                     bool hasBottom = true)
{
  if (hasBottom)
  {
    addBox(to, name, {Vec3(x, y, base), Vec3(x + 10, y + 10, top)});
    return;
  }
  addSurface(
      to, name,
      {{x, y, base},
       {x + 10, y, base},
       {x + 10, y + 10, base},
       {x, y + 10, base},
       {x, y, top},
       {x + 10, y, top},
       {x + 10, y + 10, top},
       {x, y + 10, top}},
      {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}});
}

/// A solid over a profile in x and z, counterclockwise as seen from -y, from `y` on so deep. The profile's first corner
/// sees all others.
inline void addProfile(TriangleSurface& to, const std::string& name, const std::vector<Eigen::Vector2d>& profile,
                       double y, double depth)
{
  const auto count = static_cast<Index>(profile.size());
  std::vector<Vec3> points;
  for (const double at : {y, y + depth})
  {
    for (const auto& p : profile)
    {
      points.emplace_back(p[0], at, p[1]);
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < count; ++i)
  {
    const Index next = (i + 1) % count;
    triangles.push_back({next, i, i + count});
    triangles.push_back({next, i + count, next + count});
    if (i > 0 && i + 1 < count)
    {
      triangles.push_back({0, i, i + 1});
      triangles.push_back({count, i + 1 + count, i + count});
    }
  }
  addSurface(to, name, points, triangles);
}

} // namespace atria::testing
