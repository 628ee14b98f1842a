// SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of cubes whose walls have layers.
#pragma once

#include "Layer/ConformingLayer.h"
#include "Layer/LayerCoverage.h"
#include "Layer/LayerDirections.h"
#include "Layer/LayerRules.h"
#include "Support/QuietContext.h"

#include <array>
#include <tuple>
#include <vector>

namespace atria::testing {

/// Cubes of 1 m in rows along x, whose outer faces are the sides of the domain. The one surface is a level sheet above
/// the elements `below`, if there are any.
class Block
{
public:
  static constexpr Index surfaces = 1;
  static Index tagOf(int direction) { return surfaces + static_cast<Index>(direction); }

  explicit Block(std::array<Index, 3> count, const std::vector<Index>& below = {}) : size(count)
  {
    for (Index i = 0; i < (size[0] + 1) * (size[1] + 1) * (size[2] + 1); ++i)
    {
      mesh.points.emplace_back(i % (size[0] + 1), i / (size[0] + 1) % (size[1] + 1),
                               i / ((size[0] + 1) * (size[1] + 1)));
    }
    for (Index e = 0; e < size[0] * size[1] * size[2]; ++e)
    {
      addCube(e);
    }
    for (const Index e : below)
    {
      addSheet(e);
    }
  }

  Index pointAt(Index i, Index j, Index k) const { return i + (size[0] + 1) * (j + (size[1] + 1) * k); }

  DualMesh mesh;

private:
  void addCube(Index e)
  {
    const std::array<Index, 3> cell{e % size[0], e / size[0] % size[1], e / (size[0] * size[1])};
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const Index bits = hexahedronCorner.at(c);
      corners.at(c) = pointAt(cell[0] + (bits & 1), cell[1] + (bits >> 1 & 1), cell[2] + (bits >> 2));
    }
    const std::array<Index, 3> steps{1, size[0], size[0] * size[1]};
    std::array<std::int32_t, 6> neighbors{};
    for (int direction = 0; direction < 6; ++direction)
    {
      const auto axis = static_cast<std::size_t>(axisOf(direction));
      const bool isOutside = isUpper(direction) ? cell.at(axis) + 1 == size.at(axis) : cell.at(axis) == 0;
      const Index next = isUpper(direction) ? e + steps.at(axis) : e - steps.at(axis);
      const auto face = static_cast<std::int32_t>(mesh.boundaryFaces.size());
      neighbors.at(static_cast<std::size_t>(direction)) = isOutside ? ~face : static_cast<std::int32_t>(next);
      if (isOutside)
      {
        const auto way = static_cast<std::uint8_t>(direction);
        mesh.boundaryFaces.push_back({e, tagOf(direction), noIndex, way, SheetSide::front, true, noIndex});
      }
    }
    mesh.corners.push_back(corners);
    mesh.neighbors.push_back(neighbors);
    mesh.levels.push_back(std::uint8_t{0});
    mesh.zones.push_back(std::int32_t{0});
  }

  void addSheet(Index e)
  {
    const Index above = e + size[0] * size[1];
    for (const auto& [element, other, way] : {std::tuple(e, above, zMax), std::tuple(above, e, zMin)})
    {
      mesh.neighbors[element].at(way) = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
      const auto side = way == zMax ? SheetSide::back : SheetSide::front;
      mesh.boundaryFaces.push_back({element, 0, other, way, side, false, noIndex});
    }
  }

  std::array<Index, 3> size;
};

inline LayerOptions optionsFor(const std::vector<LayerRule>& rules)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules(rules, {"Wall"});
  return options;
}

/// A block whose walls have layers, with the directions at their points.
struct Grown
{
  Grown(std::array<Index, 3> size, const std::vector<LayerRule>& rules) : block(size), options(optionsFor(rules))
  {
    findWalls();
  }

  void findWalls() { walls = findLayerWalls(block.mesh, options, quietContext()); }

  LayerDirection directionAt(Index point) const
  {
    LayerDirections directions(walls, options);
    directions.update(block.mesh, walls.counts, quietContext());
    return directions.at(point);
  }
  Vec3& place(Index i, Index j, Index k) { return block.mesh.points[block.pointAt(i, j, k)]; }
  Vec3 wayAt(Index i, Index j, Index k) const { return directionAt(block.pointAt(i, j, k)).direction; }

  LayerMesh grow(const std::vector<char>& excluded = {})
  {
    return LayerGrower(walls, options).grow(block.mesh, excluded, quietContext());
  }
  std::vector<double> sizes() const { return sizesBesideWalls(block.mesh, walls, quietContext()); }

  Block block;
  LayerOptions options;
  LayerWalls walls;
};

} // namespace atria::testing
