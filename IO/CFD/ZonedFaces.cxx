// SPDX-License-Identifier: GPL-3.0-or-later
#include "ZonedFaces.h"

#include "Quality/Faces/Geometry.h"

#include <algorithm>
#include <map>

namespace atria {

namespace {

Vec3 areaOf(const FaceMesh& mesh, Index face) { return measurePolygon(mesh.points, mesh.face(face)).area; }

} // namespace

ZonedFace zonedFace(const FaceMesh& mesh, Index face, Index behind)
{
  return {face, (mesh.owner[face] == behind ? 1.0 : -1.0) * areaOf(mesh, face)};
}

void markZones(const std::vector<ZonedFaces>& zones, std::vector<Index>& zoneOf)
{
  for (Index zone = 0; zone < zones.size(); ++zone)
  {
    std::ranges::for_each(zones[zone].faces, [&](const ZonedFace& zoned) { zoneOf[zoned.face] = zone; });
  }
}

std::vector<FaceZone> faceZonesOf(const std::vector<ZonedFaces>& zones, const std::vector<Index>& faceOf,
                                  const FaceMesh& mesh)
{
  std::vector<FaceZone> out;
  for (const ZonedFaces& zoned : zones)
  {
    FaceZone& zone = out.emplace_back(FaceZone{zoned.name, {}, {}});
    std::map<Index, Vec3> normals; // merged faces occur more than once
    for (const auto& [face, normal] : zoned.faces)
    {
      const Index now = faceOf.empty() ? face : faceOf[face];
      if (now != noIndex)
      {
        normals.try_emplace(now, Vec3::Zero()).first->second += normal;
      }
    }
    for (const auto& [face, normal] : normals)
    {
      zone.faces.push_back(face);
      zone.flips.push_back(areaOf(mesh, face).dot(normal) < 0.0 ? 1 : 0);
    }
  }
  return out;
}

} // namespace atria
