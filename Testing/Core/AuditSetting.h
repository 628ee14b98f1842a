// SPDX-License-Identifier: GPL-3.0-or-later
/// A model on the lattice of a domain and a mesh of boxes above it, for tests of audits.
#pragma once

#include "Audit/MeshDistances.h"
#include "Grid/GridFrame.h"
#include "Support/QuietContext.h"

#include <algorithm>
#include <array>
#include <vector>

namespace atria::testing {

using Corners = std::array<Vec3, 3>;

/// A model on the lattice of a domain, and a mesh of boxes above it that is not made of it.
struct Setting
{
  Setting()
  {
    GridOptions grid;
    grid.domain = {Vec3(-1, -1, -8), Vec3(9, 9, 8)};
    grid.sizeMin = 0.25;
    frame = makeGridFrame(grid, grid.domain);
    octree = Octree(frame, {});
    finest = static_cast<std::uint8_t>(frame.depth);
  }

  void addTriangle(Index surface, const Corners& corners)
  {
    const auto first = static_cast<Index>(model.points.size());
    std::ranges::for_each(corners, [&](const Vec3& p) { model.points.push_back(frame.toLattice(p)); });
    model.triangles.push_back({first, first + 1, first + 2});
    model.surfaceIds.push_back(surface);
    model.domainSides.push_back(SurfaceModel::noSide);
    while (model.names.size() <= surface)
    {
      model.names.emplace_back("S");
    }
  }
  void addPlane(Index surface, double z)
  {
    addTriangle(surface, {Vec3(-1, -1, z), Vec3(9, -1, z), Vec3(9, 9, z)});
    addTriangle(surface, {Vec3(-1, -1, z), Vec3(9, 9, z), Vec3(-1, 9, z)});
  }

  /// Adds a row of unit boxes from x = 0 on, whose bottoms are faces of a surface.
  void addRow(int count, double y, double z, Index tag)
  {
    for (int i = 0; i < count; ++i)
    {
      std::array<Index, 8> corners{};
      for (std::size_t c = 0; c < 8; ++c)
      {
        const unsigned bits = hexahedronCorner[c];
        const Vec3 at(i + (bits & 1U), y + (bits >> 1 & 1U), z + (bits >> 2 & 1U));
        corners[c] = numberOf(at);
      }
      const auto element = static_cast<Index>(mesh.corners.size());
      mesh.corners.push_back(corners);
      mesh.levels.push_back(std::uint8_t{finest});
      mesh.boundaryFaces.push_back({element, tag, noIndex, zMin, SheetSide::front, false, 0});
    }
  }
  Index numberOf(const Vec3& at)
  {
    const auto found = std::ranges::find(mesh.points, at);
    if (found == mesh.points.end())
    {
      mesh.points.push_back(at);
      return static_cast<Index>(mesh.points.size() - 1);
    }
    return static_cast<Index>(found - mesh.points.begin());
  }

  std::vector<SurfaceDistances> measure(const std::vector<SurfaceSample>& samples = {}, const OwnElements& part = {},
                                        int threads = 1) const
  {
    const ThreadExecutor executor(threads);
    const TriangleTreeOnDemand tree(model);
    return measureDistances(mesh, samples, part, MeshingContext{quietContext(executor), octree, model, tree});
  }

  GridFrame frame;
  Octree octree;
  std::uint8_t finest = 0;
  SurfaceModel model;
  DualMesh mesh;
};

} // namespace atria::testing
