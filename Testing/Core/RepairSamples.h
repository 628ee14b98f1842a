// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles on the lattice and a frame around them, for tests of the repair.
#pragma once

#include "Draw.h"
#include "Grid/GridFrame.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>

#include <array>

namespace atria::testing {

using Triangle = std::array<Index, 3>;

/// Adds a triangle with points and a source of its own.
inline Index addTriangle(TriangleSoup& soup, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  const auto first = static_cast<Index>(soup.points.size());
  soup.points.insert(soup.points.end(), {a, b, c});
  const auto t = static_cast<Index>(soup.triangles.size());
  soup.add({first, first + 1, first + 2}, 0, t);
  return t;
}

/// Twice the area of a triangle, along its normal.
inline Vec3 areaOf(const TriangleSoup& soup, Index t)
{
  return between(soup.corner(t, 0), soup.corner(t, 1)).cross(between(soup.corner(t, 0), soup.corner(t, 2)));
}

/// Distance of the points of a grid of 3 x 3 x 3, and the reach of contacts, in lattice units.
inline constexpr std::int64_t step = 1000000;
inline constexpr std::int64_t reach = 4;

/// Place of a point of the grid, in steps.
inline LatticePoint gridPoint(Index p) { return {p % 3, p / 3 % 3, p / 9}; }

inline LatticePoint times(std::int64_t factor, const LatticePoint& p)
{
  return {factor * p[0], factor * p[1], factor * p[2]};
}

/// Triangles with areas between points of the grid.
inline TriangleSoup gridSoup(Draw& draw, std::size_t count)
{
  TriangleSoup soup;
  for (Index p = 0; p < 27; ++p)
  {
    soup.points.push_back(times(step, gridPoint(p)));
  }
  while (soup.triangles.size() < count)
  {
    const Triangle t = draw.triangle(27);
    soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
    if (!(areaOf(soup, static_cast<Index>(soup.triangles.size() - 1)).norm() > 0.0))
    {
      soup.triangles.pop_back();
      soup.surfaceIds.pop_back();
      soup.sources.pop_back();
    }
  }
  return soup;
}

/// Octants at features are 64 lattice units long.
inline GridFrame smallFrame()
{
  GridFrame frame;
  frame.depth = 4;
  frame.featureLevel = 4;
  frame.subBits = 6;
  frame.domainLow = {-100000, -100000, -100000};
  frame.domainHigh = {100000, 100000, 100000};
  return frame;
}

} // namespace atria::testing
