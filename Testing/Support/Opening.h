// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace atria::testing {

/// A hole in a sheet: a planar simple polygon.
struct Opening
{
  std::string name;
  std::vector<Vec3> outline;
};

/// Reads lines `name,x,y,z,x,y,z,...` after a heading. Throws std::runtime_error for what is not that.
std::vector<Opening> readOpenings(const std::filesystem::path& file);

/// An opening's plane and its outline therein.
struct FlatOpening
{
  explicit FlatOpening(const Opening& opening);

  /// A jittered sample in each square of the given size: f takes those inside of the outline.
  template <typename F> void sample(double spacing, F&& f) const
  {
    std::size_t count = 0;
    for (double a = low[0]; a < high[0]; a += spacing)
    {
      for (double b = low[1]; b < high[1]; b += spacing)
      {
        // Low-discrepancy numbers: no bias where edges of faces run along the squares, and the same in every run.
        constexpr double g = 1.32471795724474602596;
        const double i = static_cast<double>(count++);
        const double x = a + spacing * (i / g - std::floor(i / g));
        const double y = b + spacing * (i / (g * g) - std::floor(i / (g * g)));
        if (contains(x, y))
        {
          f(Vec3(origin + x * u + y * v));
        }
      }
    }
  }
  bool contains(double x, double y) const;

  Vec3 origin, normal, u, v;
  double area = 0.0;
  std::vector<std::array<double, 2>> outline;
  std::array<double, 2> low, high;
};

} // namespace atria::testing
