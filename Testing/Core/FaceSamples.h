// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of sample cells taken one by one, and random polygons.
#pragma once

#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/Geometry.h"
#include "Support/SampleMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace atria::testing {

using Loop = std::vector<Index>;

/// Leaves out repeated corners.
inline Loop withoutRepeats(Loop loop)
{
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.back() == loop.front())
  {
    loop.pop_back();
  }
  return loop;
}

/// Returns the faces of a cell of a sample as written, corner by corner.
inline std::vector<Loop> rawFaces(const SampleMesh& sample, std::size_t cell)
{
  std::vector<Loop> faces;
  const auto first = static_cast<std::size_t>(sample.offsets[cell]);
  for (const LocalFace& local : shapeOf(sample.types[cell]).faces)
  {
    faces.emplace_back();
    for (int i = 0; i < local.size; ++i)
    {
      faces.back().push_back(static_cast<Index>(sample.connectivity[first + local.corners[i]]));
    }
  }
  if (sample.types[cell] == polyhedronCell)
  {
    sample.view().faces.each(cell, [&](const IdView& points) {
      faces.emplace_back();
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        faces.back().push_back(static_cast<Index>(points[i]));
      }
    });
  }
  return faces;
}

/// Returns the faces of a cell that have three corners at least.
inline std::vector<Loop> facesOf(const SampleMesh& sample, std::size_t cell)
{
  std::vector<Loop> faces = rawFaces(sample, cell);
  std::ranges::transform(faces, faces.begin(), withoutRepeats);
  std::erase_if(faces, [](const Loop& loop) { return loop.size() < 3; });
  return faces;
}

/// Draws numbers, places and polygons.
class RandomShapes
{
public:
  explicit RandomShapes(unsigned seed) : random(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 place() { return {in(-2, 2), in(-2, 2), in(-2, 2)}; }
  /// Points on a circle that is squeezed and turned, counterclockwise around `normal`.
  std::vector<Vec3> convexPolygon(std::size_t size, Vec3& normal)
  {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    const Vec3 shift = place();
    const double squeezed = in(0.2, 1.0);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < size; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + in(0.0, 0.9)) / static_cast<double>(size);
      points.push_back(turn * Vec3(std::cos(angle), squeezed * std::sin(angle), 0.0) + shift);
    }
    normal = turn * Vec3::UnitZ();
    return points;
  }

private:
  std::mt19937 random;
};

inline CellMeasureInOrder measureCellOf(const std::vector<Vec3>& points, const std::vector<Loop>& faces)
{
  return measureCellInOrder(faces.size(), [&](std::size_t i) { return measurePolygon(points, faces[i]); });
}

} // namespace atria::testing
