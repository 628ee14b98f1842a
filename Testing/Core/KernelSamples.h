// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes as sources of cells, and what sources tell of their cells, for tests of the optimizer.
#pragma once

#include "Optimize/Kernel/CellSource.h"
#include "Quality/Faces/Geometry.h"
#include "Support/SampleMesh.h"

#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace atria::testing {

using Loop = std::vector<Index>;

/// A mesh of faces with the arrays that a source needs.
struct Sample
{
  explicit Sample(SampleMesh cells)
      : sample(std::move(cells)), mesh(makeFaceMesh(sample.points, sample.view())), cellFaces(makeCellFaces(mesh)),
        arrays(sample.view()), source(mesh, cellFaces, arrays)
  {
  }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  SampleMesh sample;
  FaceMesh mesh;
  CellFaces cellFaces;
  CellArrays arrays;
  FaceMeshSource source;
};

/// Boxes along the axes as a dual mesh.
inline DualMesh boxesOf(const std::array<std::vector<double>, 3>& lengths)
{
  DualMesh mesh;
  const std::array<std::size_t, 3> n{lengths[0].size(), lengths[1].size(), lengths[2].size()};
  const auto placeOf = [&](std::size_t axis, std::size_t i) {
    return std::accumulate(lengths[axis].begin(), lengths[axis].begin() + static_cast<std::ptrdiff_t>(i), 0.0);
  };
  const auto eachOf = [](const std::array<std::size_t, 3>& counts, auto&& use) {
    for (std::size_t i = 0; i < counts[0] * counts[1] * counts[2]; ++i)
    {
      use(std::array{i % counts[0], i / counts[0] % counts[1], i / counts[0] / counts[1]});
    }
  };
  const auto pointAt = [&](const std::array<std::size_t, 3>& at) {
    return static_cast<Index>(at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2]));
  };
  eachOf({n[0] + 1, n[1] + 1, n[2] + 1}, [&](const std::array<std::size_t, 3>& at) {
    mesh.points.emplace_back(placeOf(0, at[0]), placeOf(1, at[1]), placeOf(2, at[2]));
  });
  eachOf(n, [&](const std::array<std::size_t, 3>& at) {
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const std::size_t bits = hexahedronCorner[c];
      corners[c] = pointAt({at[0] + (bits & 1U), at[1] + (bits >> 1 & 1U), at[2] + (bits >> 2 & 1U)});
    }
    std::array<std::int32_t, 6> neighbors{};
    const std::array<std::size_t, 3> steps{1, n[0], n[0] * n[1]};
    const auto own = static_cast<std::int32_t>(mesh.corners.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto step = static_cast<std::int32_t>(steps[axis]);
      neighbors[2 * axis] = at[axis] > 0 ? own - step : ~0;
      neighbors[2 * axis + 1] = at[axis] + 1 < n[axis] ? own + step : ~0;
    }
    mesh.corners.push_back(corners);
    mesh.neighbors.push_back(neighbors);
  });
  return mesh;
}

inline DualMesh cubes(std::array<std::size_t, 3> n)
{
  return boxesOf({std::vector<double>(n[0], 1.0), std::vector<double>(n[1], 1.0), std::vector<double>(n[2], 1.0)});
}

/// A face of a cell: its points outward, the lowest first, and the cell across.
using SeenFace = std::pair<Loop, Index>;

inline std::vector<SeenFace> facesOf(const CellSource& source, Index cell)
{
  CellSource::Scratch scratch;
  source.facesOf(cell, scratch);
  std::vector<SeenFace> out;
  for (const CellFace& face : scratch.faces)
  {
    out.push_back({{face.points.begin(), face.points.end()}, face.across});
  }
  return out;
}

inline Loop neighborsOf(const CellSource& source, Index cell)
{
  Loop out;
  source.neighborsOf(cell, out);
  return out;
}

inline Loop cornersOf(const CellSource& source, Index cell)
{
  Loop out;
  source.cornersOf(cell, out);
  return out;
}

} // namespace atria::testing
