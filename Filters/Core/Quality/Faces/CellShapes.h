// SPDX-License-Identifier: GPL-3.0-or-later
/// The cell types of a mesh and their faces, in VTK's numbering.
#pragma once

#include <cstdint>
#include <span>

namespace atria {

/// VTK's numbers of the cell types known here.
enum CellType : unsigned char
{
  tetrahedronCell = 10,
  voxelCell = 11,
  hexahedronCell = 12,
  wedgeCell = 13,
  pyramidCell = 14,
  polyhedronCell = 42
};

/// One face of a cell type by the cell's corners, its normal (right-hand rule) outward.
struct LocalFace
{
  std::uint8_t size;
  std::uint8_t corners[4];
};

/// Corners and faces of a cell type; polyhedra have no fixed shape and come with their own faces.
struct CellShape
{
  std::size_t corners = 0;
  std::span<const LocalFace> faces;
};

/// Returns the shape of a tetrahedron, voxel, hexahedron, wedge or pyramid; no corners for any other type. VTK's wedge
/// has the normal of its points 0, 1, 2 outward, away from 3, 4, 5.
CellShape shapeOf(unsigned char cellType);

} // namespace atria
