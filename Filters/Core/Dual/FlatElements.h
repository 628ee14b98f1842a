// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/DualMesh.h"
#include "Support/RunContext.h"

namespace atria {

/// What became of a mesh's elements and points: their new numbers, noIndex for those that are gone.
struct MeshRenumbering
{
  std::vector<Index> elements;
  std::vector<Index> points;
  bool isIdentity() const { return elements.empty(); }
};

/// How flat is flat.
struct Flatness
{
  /// Height over longest edge.
  double thickness = 1e-6;
  /// Area of faces that are turned the wrong way over that of all.
  double fold = 1e-6;
};

/// Elements on the boundary that lie flat in it: all their points are on the boundary and near one plane, their faces
/// on the boundary on one side of it and the others on the other. Where the level of octants changes at a surface, all
/// vertices of a transition element may be on the surface.
std::vector<char> findFlatElements(const DualMesh& mesh, const Flatness& flatness, const RunContext& context);

/// Takes elements out of the mesh. The faces by which other elements touched them become boundary faces, with the tag
/// of their largest boundary face: of an element that is flat, nothing is lost. Points may then have several sectors
/// (splitSheets). Removes nothing, and returns the identity, where nothing is marked.
MeshRenumbering removeElements(DualMesh& mesh, const std::vector<char>& marked);

} // namespace atria
