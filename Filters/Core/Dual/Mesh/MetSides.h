// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the surfaces that a mesh has faces on, and the sides of these.
#pragma once

#include "Dual/Mesh/DualMesh.h"

namespace atria {

/// Faces that a mesh has on a surface or a bare side of the domain.
struct MetSides
{
  bool front = false;
  bool back = false;
  /// True if a face has elements on both its front and its back.
  bool atOnce = false;
  /// True if it has faces within the mesh.
  bool within = false;

  bool hasBoundary() const { return front || back; }
  /// True if its faces on the front and on the back are kept apart. The front alone can have faces at once where a
  /// solid is thinner than the octants and became a sheet.
  bool isTwoSided() const { return front && back && atOnce; }
  void add(const MetSides& more)
  {
    front = front || more.front;
    back = back || more.back;
    atOnce = atOnce || more.atOnce;
    within = within || more.within;
  }
};

/// Returns one entry per tag of boundary faces: surfaces, then `sideNumbers` sides of the domain. `hasOpposite`, if
/// given, says of each boundary face whether there is an element on the other side of the sheet, which may not be in
/// this part of a mesh.
std::vector<MetSides> findMetSides(const DualMesh& mesh, std::size_t surfaceCount,
                                   const std::vector<char>& hasOpposite = {});

} // namespace atria
