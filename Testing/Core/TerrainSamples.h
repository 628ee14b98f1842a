// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers, surfaces of filled cells and areas of triangles, for tests of models on their ground.
#pragma once

#include "Random.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace atria::testing {

inline std::vector<Index> allTriangles(const TriangleSurface& surface)
{
  std::vector<Index> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

inline Vec3 areaVector(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return 0.5 * (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
}

inline Vec3 middleOf(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
}

/// Signed sum of the areas seen from above; positive for triangles that face up.
inline double areaFromAbove(const TriangleSurface& surface)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    sum += areaVector(surface, t)[2];
  }
  return sum;
}

/// Two triangles for each quad, all of one surface.
inline void addQuads(TriangleSurface& to, const std::string& name, const std::vector<std::array<Vec3, 4>>& quads)
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& quad : quads)
  {
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), quad.begin(), quad.end());
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  addSurface(to, name, points, triangles);
}

/// Cells of a block that are filled.
using IsFilled = std::function<bool(int, int, int)>;

inline std::array<Vec3, 4> cellFace(const Vec3& low, const Vec3& size, int direction)
{
  const int axis = axisOf(direction);
  Vec3 u = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  u[(axis + 1) % 3] = size[(axis + 1) % 3];
  v[(axis + 2) % 3] = size[(axis + 2) % 3];
  Vec3 corner = low;
  corner[axis] += isUpper(direction) ? size[axis] : 0.0;
  return isUpper(direction) ? std::array{corner, Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)}
                            : std::array{corner, Vec3(corner + v), Vec3(corner + u + v), Vec3(corner + u)};
}

/// The surface of the filled cells among n x n x n, normals outwards.
inline void addCells(TriangleSurface& to, const std::string& name, int n, const Vec3& size, const IsFilled& isFilled)
{
  const auto has = [&](const std::array<int, 3>& c) {
    return std::ranges::all_of(c, [n](int i) { return i >= 0 && i < n; }) && isFilled(c[0], c[1], c[2]);
  };
  std::vector<std::array<Vec3, 4>> quads;
  for (int i = 0; i < n * n * n; ++i)
  {
    const std::array<int, 3> cell{i % n, i / n % n, i / (n * n)};
    for (int direction = 0; direction < 6 && has(cell); ++direction)
    {
      std::array<int, 3> next = cell;
      next.at(static_cast<std::size_t>(axisOf(direction))) += isUpper(direction) ? 1 : -1;
      if (!has(next))
      {
        const Vec3 low = Vec3(cell[0], cell[1], cell[2]).cwiseProduct(size);
        quads.push_back(cellFace(low, size, direction));
      }
    }
  }
  addQuads(to, name, quads);
}

} // namespace atria::testing
