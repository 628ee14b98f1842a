// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/Alignment.h"

#include "Support/Angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

struct Wall
{
  double angle; ///< direction of the normal, modulo 90 degrees
  double area;
};

constexpr double quarter = 90.0;

/// Returns the angle modulo a quarter turn, in [-45, 45).
double folded(double degrees)
{
  const double rest = degrees - quarter * std::floor(degrees / quarter + 0.5);
  return rest < 0.5 * quarter ? rest : rest - quarter;
}

std::vector<Wall> wallsOf(const TriangleSurface& surface)
{
  static const double mostVertical = std::sin(radians(5.0));
  std::vector<Wall> walls;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3& p = surface.points[a];
    const Vec3 normal = 0.5 * (surface.points[b] - p).cross(surface.points[c] - p);
    const double area = normal.norm();
    if (area > 0.0 && std::abs(normal[2]) <= mostVertical * area)
    {
      walls.push_back({folded(std::atan2(normal[1], normal[0]) * 180.0 / std::numbers::pi), area});
    }
  }
  return walls;
}

/// Returns the middle of the bin of a quarter degree that, with its neighbors, has the most area.
double peakOf(const std::vector<Wall>& walls)
{
  constexpr int bins = 360;
  constexpr double width = quarter / bins;
  std::vector<double> area(bins, 0.0);
  const auto at = [&](int bin) -> double& { return area[(bin % bins + bins) % bins]; };
  for (const Wall& wall : walls)
  {
    at(static_cast<int>(std::lround(wall.angle / width))) += wall.area;
  }
  int best = 0;
  double most = -1.0;
  for (int bin = 0; bin < bins; ++bin)
  {
    const double around = at(bin - 1) + 2.0 * at(bin) + at(bin + 1);
    // The direction next to the axes, which comes first, wins among equals.
    if (around > most * (1.0 + 1e-9))
    {
      most = around;
      best = bin;
    }
  }
  return folded(best * width);
}

} // namespace

double dominantWallAngle(const TriangleSurface& surface)
{
  std::vector<Wall> walls = wallsOf(surface);
  if (walls.empty())
  {
    return 0.0;
  }
  const double peak = peakOf(walls);
  constexpr double reach = 0.5; // degrees: scatter of hand-drawn walls, less than another direction of walls
  double total = 0.0;
  for (Wall& wall : walls)
  {
    wall.angle = folded(wall.angle - peak);
    total += std::abs(wall.angle) <= reach ? wall.area : 0.0;
  }
  // The median by area is the direction of a wall, even where a few beside it are a little askew.
  std::sort(walls.begin(), walls.end(), [](const Wall& l, const Wall& r) { return l.angle < r.angle; });
  double below = 0.0;
  for (const Wall& wall : walls)
  {
    below += std::abs(wall.angle) <= reach ? wall.area : 0.0;
    if (below >= 0.5 * total && std::abs(wall.angle) <= reach)
    {
      const double angle = folded(peak + wall.angle);
      constexpr double rounding = 1e-9;
      return std::abs(angle) < rounding ? 0.0 : angle;
    }
  }
  return 0.0;
}

} // namespace atria
