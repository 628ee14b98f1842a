// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws random numbers, points, boxes and triangles.
#pragma once

#include "Grid/LatticeBox.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace atria::testing {

/// The same for the same seed.
class Draw
{
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  Index below(std::size_t count) { return static_cast<Index>(in(0, static_cast<std::int64_t>(count) - 1)); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector(double reach) { return {real(-reach, reach), real(-reach, reach), real(-reach, reach)}; }
  LatticePoint point(std::int64_t low, std::int64_t high) { return {in(low, high), in(low, high), in(low, high)}; }
  LatticePoint point(std::int64_t reach) { return point(-reach, reach); }

  /// Returns points of a small grid. Some are repeated.
  std::vector<Vec2> points(std::size_t count, std::int64_t last)
  {
    std::vector<Vec2> drawn(count);
    std::ranges::generate(drawn,
                          [&] { return Vec2(static_cast<double>(in(0, last)), static_cast<double>(in(0, last))); });
    return drawn;
  }

  /// Returns a box with its low corner in [low, high] and sides of 0 to `longest`.
  LatticeBox box(std::int64_t low, std::int64_t high, std::int64_t longest)
  {
    LatticeBox made{point(low, high), {}};
    for (int axis = 0; axis < 3; ++axis)
    {
      made.high[axis] = made.low[axis] + in(0, longest);
    }
    return made;
  }

  /// Returns a triangle of some of so many points. Some are repeated.
  std::array<Index, 3> triangle(std::size_t points) { return {below(points), below(points), below(points)}; }

  /// Returns triangles without repeated points between random points.
  TriangleSoup soup(std::size_t points, std::size_t triangles)
  {
    TriangleSoup made;
    for (std::size_t i = 0; i < points; ++i)
    {
      made.points.push_back(point(50));
    }
    while (made.triangles.size() < triangles)
    {
      const std::array<Index, 3> t = triangle(points);
      if (!hasRepeatedPoint(t))
      {
        made.add(t, 0, static_cast<Index>(made.triangles.size()));
      }
    }
    return made;
  }

private:
  std::mt19937 random_;
};

} // namespace atria::testing
