// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones of a mesh whose cells and faces may still be merged.
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

/// Returns a face with its normal; the zone's normal points away from the cell `behind`.
ZonedFace zonedFace(const FaceMesh& mesh, Index face, Index behind);

struct ZonedFaces
{
  std::string name;
  std::vector<ZonedFace> faces;
};

/// Gives internal faces the numbers of their zones.
void markZones(const std::vector<ZonedFaces>& zones, std::vector<Index>& zoneOf);

/// Returns the zones with faces of a merged mesh. `faceOf` has the new number of each earlier face, noIndex for one
/// that is gone; it is empty if numbers did not change. Faces are in ascending order.
std::vector<FaceZone> faceZonesOf(const std::vector<ZonedFaces>& zones, const std::vector<Index>& faceOf,
                                  const FaceMesh& mesh);

} // namespace atria
