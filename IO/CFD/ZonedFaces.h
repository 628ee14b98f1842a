// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones of a mesh of which cells and faces may still be merged.
#pragma once

#include "MeshZones.h"
#include "Quality/Faces/FaceMesh.h"

#include <string>
#include <vector>

namespace atria {

/// An internal face, and its area vector along the normal of its zone.
struct ZonedFace
{
  Index face;
  Vec3 normal;
};

/// With the cell behind it, from which the zone's normal points away.
ZonedFace zonedFace(const FaceMesh& mesh, Index face, Index behind);

struct ZonedFaces
{
  std::string name;
  std::vector<ZonedFace> faces;
};

/// Gives internal faces the numbers of their zones.
void markZones(const std::vector<ZonedFaces>& zones, std::vector<Index>& zoneOf);

/// With the faces of a mesh that was made of theirs by merging: `faceOf` has the number in it of each face there was,
/// noIndex where it is not there; without any, numbers are the same. Faces are rising.
std::vector<FaceZone> faceZonesOf(const std::vector<ZonedFaces>& zones, const std::vector<Index>& faceOf,
                                  const FaceMesh& mesh);

} // namespace atria
