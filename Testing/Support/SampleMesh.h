// SPDX-License-Identifier: GPL-3.0-or-later
/// Small conformal volume meshes of known shape.
#pragma once

#include "Quality/Faces/FaceMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace atria::testing {

/// Points and cells that own their arrays.
struct SampleMesh
{
  std::vector<Vec3> points;
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> faceStream;
  std::vector<std::int64_t> faceLocations;

  CellArrays view() const { return {types, offsets, connectivity, PolyhedronFaces::Stream(faceStream, faceLocations)}; }
  void addCell(unsigned char type, const std::vector<std::int64_t>& ids);
  void addPolyhedron(const std::vector<std::vector<std::int64_t>>& faces);
};

/// One cell, its points in the order given.
SampleMesh singleCell(unsigned char type, const std::vector<Vec3>& points);

/// Hexahedra of edge 1 that fill [0, n0] x [0, n1] x [0, n2].
SampleMesh hexahedra(std::array<int, 3> n);

/// The same cubes, each whole (a hexahedron or voxel) or cut into pyramids, wedges or tetrahedra, with
/// polyhedra where cut and whole faces meet. Which, follows from the seed; every type is there from 3 x 3 x 3
/// cubes on. Grid points inside the box are moved by at most `distance` in each direction.
SampleMesh mixedCells(std::array<int, 3> n, unsigned seed, double distance = 0.0);

} // namespace atria::testing
