// SPDX-License-Identifier: GPL-3.0-or-later
/// What must hold of every mesh, whatever it was made from.
#pragma once

#include "Mesher/DualMesher.h"

#include <gtest/gtest.h>

namespace atria::testing {

/// Neighbors agree from both sides and share the very same face; absent faces have no area; boundary faces and
/// elements name each other. Elements see each other in opposite directions, but from number `plainElements` on: those
/// of layers meet round the edges of walls.
::testing::AssertionResult isConformal(const DualMesh& mesh, Index plainElements = noIndex);

/// No two faces have the same points but those of neighbors, and those on both sides of a sheet.
::testing::AssertionResult facesAreUnique(const DualMesh& mesh);

/// Every element's faces meet two by two in opposite senses (closed, oriented), and Euler's relation V - E + F = 2
/// holds.
::testing::AssertionResult elementsAreClosed(const DualMesh& mesh);

/// Every edge of the mesh's whole boundary is run through as often one way as the other.
::testing::AssertionResult boundaryIsWatertight(const DualMesh& mesh);

/// The three of the above that hold of every mesh: it is conformal, its elements are closed, its boundary is
/// watertight.
::testing::AssertionResult isSound(const DualMesh& mesh, Index plainElements = noIndex);

/// isSound(), and every element's volume is positive.
::testing::AssertionResult isValid(const DualMesh& mesh, Index plainElements = noIndex);

/// Signed volume of each element, faces as triangles about the mean of their points.
std::vector<double> volumes(const DualMesh& mesh);
double totalVolume(const DualMesh& mesh);

/// Of hexahedra: where a layer is left out at a point, some elements are none. 1 without any.
double leastScaledJacobian(const DualMesh& mesh);

/// Every array of both is the same, bit for bit.
bool identical(const DualMesh& a, const DualMesh& b);

/// How many faces of an element have four and three corners: (6, 0) is a hexahedron, (3, 2) a wedge, (1, 4) a pyramid,
/// all else a polyhedron.
struct FaceCounts
{
  int quads = 0;
  int triangles = 0;
  bool operator==(const FaceCounts&) const = default;
};
FaceCounts faceCounts(const DualMesh& mesh, Index element);

struct ElementCounts
{
  std::size_t hexahedra = 0;
  std::size_t pyramids = 0;
  std::size_t wedges = 0;
  std::size_t polyhedra = 0;
};
ElementCounts countElements(const DualMesh& mesh, const std::vector<Index>& elements);

} // namespace atria::testing
