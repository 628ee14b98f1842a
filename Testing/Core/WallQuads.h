// SPDX-License-Identifier: GPL-3.0-or-later
/// Models of quadrilaterals on the lattice, for tests of walls.
#pragma once

#include "Surface/Model/SurfaceModel.h"

#include <algorithm>
#include <map>

namespace atria::testing {

/// A model of quads of two triangles. Points in one place are one.
struct Quads
{
  SurfaceModel model;
  std::map<LatticePoint, Index> known;

  Quads() { model.names = {"Wall", "Other"}; }

  Index point(const LatticePoint& p)
  {
    const auto [at, isNew] = known.try_emplace(p, static_cast<Index>(model.points.size()));
    if (isNew)
    {
      model.points.push_back(p);
    }
    return at->second;
  }

  void addTriangle(Index chart, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
  {
    model.triangles.push_back({point(a), point(b), point(c)});
    model.charts.push_back(chart);
    model.surfaceIds.push_back(0);
    model.domainSides.push_back(SurfaceModel::noSide);
  }

  /// Corners follow each other; the front is where they run counterclockwise.
  void add(Index chart, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d)
  {
    addTriangle(chart, a, b, c);
    addTriangle(chart, a, c, d);
  }

  /// Adds a square of the plane z = `height` with its front up.
  void addLevel(Index chart, std::int64_t x, std::int64_t y, std::int64_t size, std::int64_t height)
  {
    add(chart, {x, y, height}, {x + size, y, height}, {x + size, y + size, height}, {x, y + size, height});
  }

  void setSurface(std::size_t first, Index surface)
  {
    std::fill(model.surfaceIds.begin() + static_cast<std::ptrdiff_t>(first), model.surfaceIds.end(), surface);
  }
};

} // namespace atria::testing
