// SPDX-License-Identifier: GPL-3.0-or-later
#include "WallSizes.h"

#include "Surface/Triangles/SmoothPieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace atria::scene {

namespace {

/// Upright faces.
struct Walls
{
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> shapes;
  std::vector<double> areas;
};

Walls wallsOf(const Scene& scene, int upAxis)
{
  constexpr double steepness = 0.1; // 6 degrees
  Walls walls;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i)
  {
    const auto& [a, b, c] = scene.triangles[i];
    const Vec3 n = (scene.points[b] - scene.points[a]).cross(scene.points[c] - scene.points[a]);
    const double length = n.norm();
    if (length > 0.0 && std::abs(n[upAxis]) < steepness * length)
    {
      walls.triangles.push_back(scene.triangles[i]);
      walls.shapes.push_back(scene.shapeIds[i]);
      walls.areas.push_back(0.5 * length);
    }
  }
  return walls;
}

/// Returns the lesser of a piece's height and width.
double sizeOf(const Box3& piece, int upAxis)
{
  Vec3 size = piece.size();
  const double height = std::exchange(size[upAxis], 0.0);
  return std::min(height, size.norm());
}

} // namespace

double wallSize(const Scene& scene, int upAxis, double least)
{
  Box3 all;
  for (const Vec3& p : scene.points)
  {
    all.extend(p);
  }
  if (all.empty() || sizeOf(all, upAxis) < least)
  {
    return 0.0;
  }
  constexpr double smooth = 30.0; // degrees
  const Walls walls = wallsOf(scene, upAxis);
  const std::vector<Index> pieces = smoothPieces(scene.points, walls.triangles, walls.shapes, smooth);
  struct Piece
  {
    Box3 box;
    double area = 0.0;
  };
  std::vector<Piece> found(pieces.empty() ? 0 : std::size_t{1} + *std::max_element(pieces.begin(), pieces.end()));
  double wanted = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    Piece& piece = found[pieces[i]];
    piece.area += walls.areas[i];
    wanted += walls.areas[i] / 3.0;
    for (const Index p : walls.triangles[i])
    {
      piece.box.extend(scene.points[p]);
    }
  }
  std::vector<std::pair<double, double>> sizes;
  std::transform(found.begin(), found.end(), std::back_inserter(sizes),
                 [&](const Piece& piece) { return std::pair(sizeOf(piece.box, upAxis), piece.area); });
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  for (const auto& [size, area] : sizes)
  {
    wanted -= area;
    if (wanted <= 0.0)
    {
      return size;
    }
  }
  return 0.0;
}

} // namespace atria::scene
