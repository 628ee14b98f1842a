// SPDX-License-Identifier: GPL-3.0-or-later
/// Scaled Jacobian of cells, as Verdict measures it.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/Buffer.h"
#include "Support/RunContext.h"

#include <array>

namespace atria {

/// Verdict's scaled Jacobian of a cell (Knupp et al., The Verdict Geometric Quality Library, 2006; wedges and pyramids
/// as in Verdict 1.4 and later). Dimensionless; 1 for the ideal cell, not above 0 when inverted.
/// - hexahedron, voxel: least normalized determinant at the 8 corners and of the principal axes; [-1, 1]
/// - tetrahedron: determinant over the greatest product of three edges at a corner, times √2; [-1, 1]
/// - wedge: least normalized determinant at the 6 corners, times 2/√3
/// - pyramid: least of the four tetrahedra of three base corners and the apex, times √2; 0 when inverted
/// - polyhedron: not a number
/// Returns 0 where Verdict returns its largest number, for cells with an edge of no length. Wedges are read in VTK's
/// order, base outward, so a good one is positive; vtkMeshQuality 9.2 gives those the other sign.
double scaledJacobian(unsigned char cellType, const std::array<Vec3, 8>& corners);

/// Terms of which the scaled Jacobian of a cell is the least: all determinants of hexahedra and wedges, a single term
/// for other cells.
struct JacobianTerms
{
  std::array<double, 9> values;
  std::size_t count = 0;
};
JacobianTerms jacobianTerms(unsigned char cellType, const std::array<Vec3, 8>& corners);

/// Returns the scaled Jacobian of every cell.
Buffer<double> scaledJacobians(std::span<const Vec3> points, const CellArrays& cells, const RunContext& context);

} // namespace atria
