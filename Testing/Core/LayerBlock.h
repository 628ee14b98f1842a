// SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of cubes whose walls have layers.
#pragma once

#include "DualBlock.h"
#include "Layer/ConformingLayer.h"
#include "Layer/LayerCoverage.h"
#include "Layer/LayerDirections.h"
#include "Layer/LayerRules.h"
#include "Support/QuietContext.h"

#include <algorithm>
#include <array>
#include <vector>

namespace atria::testing {

/// Returns the tag of a side of the domain, beside that of the one surface.
inline Index sideTag(int direction) { return 1 + static_cast<Index>(direction); }

/// Returns a block whose outer faces are the sides of the domain. The one surface is a level sheet above the elements
/// `below`, if there are any.
inline Block blockInDomain(std::array<Index, 3> size, const std::vector<Index>& below = {})
{
  const auto isSheet = [&](Index e, int direction) {
    return direction == zMax && std::ranges::find(below, e) != below.end();
  };
  return {size, isSheet, {.sheet = 0, .firstSide = sideTag(xMin)}};
}

inline LayerOptions optionsFor(const std::vector<LayerRule>& rules)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules(rules, {"Wall"});
  return options;
}

/// A block whose walls have layers, with the directions at their points.
struct Grown
{
  Grown(std::array<Index, 3> size, const std::vector<LayerRule>& rules)
      : block(blockInDomain(size)), options(optionsFor(rules))
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
