// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones that a case divides into pairs of cyclic patches, so that the pressure may jump there.
#pragma once

#include "PolyMesh.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace atria {

/// A face zone to divide. Its first side is behind it, where the zone's normal comes from; turned, it is before it.
struct DividedZone
{
  std::string zone;
  bool isTurned = false;
};

/// Returns the patches of a divided zone. The first has the faces of the zone; its normals are those of the zone unless
/// that is turned.
std::array<std::string, 2> sidesOfZone(const std::string& zone);
/// Returns the cell zone of the cells at both sides of a divided zone.
std::string cellsBesideZone(const std::string& zone);

/// Makes two cyclic patches of the faces of each zone, and a cell zone of the cells beside them. The zones keep their
/// faces, those of the first side. Cells and points keep their numbers, faces do not. Throws Error if a face is in two
/// of the zones or on the boundary, or if the mesh has patches or zones of these names.
void divideZones(PolyMesh& poly, std::span<const DividedZone> zones);

/// Undoes divideZones() in a mesh that was written and read again. Returns false if it has no such patches.
bool uniteSides(PolyMesh& poly);

/// Returns the numbers of the two patches of each divided zone.
std::vector<std::array<std::size_t, 2>> pairsOfSides(const PolyMesh& poly);

} // namespace atria
