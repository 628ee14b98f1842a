// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects polygons and cuts them into triangles.
#pragma once

#include "Support/Types.h"
#include "Surface/Triangulation/PolygonTriangulation.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace atria::vrml {

/// Triangles of one shape in its own coordinates.
struct LocalSurface
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> faceIds; ///< per triangle: the polygon it was cut from, counted from 0; ascending
};

/// Cuts polygons into triangles of one surface.
class SurfaceBuilder
{
public:
  explicit SurfaceBuilder(bool turned = false) : flip(turned) {}
  /// Reuses the memory of another surface, for callers with many small ones.
  SurfaceBuilder(bool turned, LocalSurface&& memory) : surface(std::move(memory)), flip(turned)
  {
    surface.points.clear();
    surface.triangles.clear();
    surface.faceIds.clear();
  }

  Index point(const Vec3& p)
  {
    surface.points.push_back(p);
    return static_cast<Index>(surface.points.size() - 1);
  }
  /// Makes room for so many points and triangles at least.
  void reserve(std::size_t points, std::size_t triangles)
  {
    surface.points.reserve(points);
    surface.triangles.reserve(triangles);
    surface.faceIds.reserve(triangles);
  }
  /// Adds a polygon. One without area is dropped and counted.
  void polygon(std::span<const Index> ids);
  void quad(Index a, Index b, Index c, Index d) { polygon(std::array<Index, 4>{a, b, c, d}); }

  std::size_t withoutArea() const { return flat; }
  std::size_t selfCrossing() const { return crossing; }
  LocalSurface take() { return std::move(surface); }

private:
  void triangle(Index a, Index b, Index c)
  {
    surface.faceIds.push_back(polygons);
    surface.triangles.push_back(flip ? std::array<Index, 3>{a, c, b} : std::array<Index, 3>{a, b, c});
  }

  LocalSurface surface;
  PolygonTriangles cut; ///< triangles of the last polygon
  bool flip;
  Index polygons = 0;
  std::size_t flat = 0;
  std::size_t crossing = 0;
};

} // namespace atria::vrml
