// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseMesh.h"

#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/Geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace atria {

namespace {

/// Share of a patch's area that its area vector must have for the patch to count as plane.
constexpr double planeShare = 0.99;
constexpr double uprightCosine = 0.05;
/// The same for an opening, whose faces layers may bend at the border.
constexpr double planeShareOfOpening = 0.95;

bool isSide(const CasePatch& patch)
{
  return patch.type != "wall" && patch.flatness() > planeShare &&
         std::abs(patch.areaVector[2]) < uprightCosine * patch.area;
}

/// Returns the distance below which a share of the area lies. `distances` are pairs of a distance and an area, sorted.
double quantile(const std::vector<std::pair<double, double>>& distances, double share)
{
  double rest = 0.0;
  for (const auto& [distance, area] : distances)
  {
    rest += share * area;
  }
  for (const auto& [distance, area] : distances)
  {
    rest -= area;
    if (rest <= 0.0)
    {
      return distance;
    }
  }
  return 0.0;
}

CenterDistances measureCenters(const PolyMesh& poly, const PolyPatch& patch, const MeshGeometry& geometry)
{
  std::vector<std::pair<double, double>> distances;
  for (const Index f : patch.faces)
  {
    const double area = geometry.faceAreas[f].norm();
    const Vec3 way = geometry.faceCentroids[f] - geometry.cellCentroids[poly.mesh.owner[f]];
    if (area > 0.0)
    {
      distances.emplace_back(way.dot(geometry.faceAreas[f]) / area, area);
    }
  }
  std::ranges::sort(distances);
  return {quantile(distances, 0.05), quantile(distances, 0.5)};
}

CasePatch measurePatch(const PolyMesh& poly, const PolyPatch& patch, const MeshGeometry& geometry)
{
  const Buffer<Vec3>& areas = geometry.faceAreas;
  CasePatch measured;
  measured.name = patch.name;
  measured.type = patch.type;
  for (const Index f : patch.faces)
  {
    measured.areaVector += areas[f];
    measured.area += areas[f].norm();
    for (const Index p : poly.mesh.face(f))
    {
      measured.bounds.extend(poly.mesh.points[p]);
    }
  }
  measured.centers = measureCenters(poly, patch, geometry);
  return measured;
}

void findPatchesAtSides(const PolyMesh& poly, std::vector<CasePatch>& patches)
{
  std::vector<bool> onSide(poly.mesh.points.size(), false);
  const auto forPoints = [&](std::size_t patch, auto&& look) {
    for (const Index f : poly.patches[patch].faces)
    {
      for (const Index point : poly.mesh.face(f))
      {
        look(point);
      }
    }
  };
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (isSide(patches[i]))
    {
      forPoints(i, [&](Index point) { onSide[point] = true; });
    }
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (!isSide(patches[i]))
    {
      forPoints(i, [&](Index point) { patches[i].meetsSides = patches[i].meetsSides || onSide[point]; });
    }
  }
}

/// Returns the zone of every cell, -1 for none. The last of overlapping zones holds.
std::vector<int> zonesOfCells(const PolyMesh& poly)
{
  std::vector<int> zoneOf(poly.mesh.cellCount, -1);
  for (std::size_t z = 0; z < poly.cellZones.size(); ++z)
  {
    for (const Index cell : poly.cellZones[z].cells)
    {
      zoneOf[cell] = static_cast<int>(z);
    }
  }
  return zoneOf;
}

/// Returns the rooms behind and before most of a zone's faces.
std::array<std::string, 2> roomsBeside(const PolyMesh& poly, const FaceZone& zone, const std::vector<int>& zoneOf)
{
  std::array<std::map<std::string, std::size_t>, 2> found;
  for (std::size_t i = 0; i < zone.faces.size(); ++i)
  {
    const Index face = zone.faces[i];
    if (face >= poly.mesh.internalFaceCount())
    {
      continue;
    }
    const std::array<Index, 2> cells{poly.mesh.owner[face], poly.mesh.neighbor[face]};
    for (std::size_t side = 0; side < 2; ++side)
    {
      const int room = zoneOf[cells[zone.flips[i] ? 1 - side : side]];
      ++found[side][room < 0 ? outdoors : poly.cellZones[static_cast<std::size_t>(room)].name];
    }
  }
  std::array<std::string, 2> rooms{outdoors, outdoors};
  for (std::size_t side = 0; side < 2; ++side)
  {
    const auto most = std::max_element(found[side].begin(), found[side].end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != found[side].end())
    {
      rooms[side] = most->first;
    }
  }
  return rooms;
}

double areaOf(const FaceZone& zone, const Buffer<Vec3>& areas)
{
  Vec3 vector = Vec3::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < zone.faces.size(); ++i)
  {
    const Vec3& area = areas[zone.faces[i]];
    vector += zone.flips[i] ? Vec3(-area) : area;
    sum += area.norm();
  }
  return vector.norm() > planeShareOfOpening * sum ? vector.norm() : sum;
}

void describeZones(const PolyMesh& poly, const MeshGeometry& geometry, CaseMesh& described)
{
  const std::vector<int> zoneOf = zonesOfCells(poly);
  described.openings.reserve(poly.faceZones.size());
  for (const FaceZone& zone : poly.faceZones)
  {
    described.openings.push_back({zone.name, areaOf(zone, geometry.faceAreas), roomsBeside(poly, zone, zoneOf)});
  }
  for (const CellZone& zone : poly.cellZones)
  {
    double volume = 0.0;
    for (const Index cell : zone.cells)
    {
      volume += geometry.cellVolumes[cell];
    }
    described.hasOutdoors = described.hasOutdoors || zone.name == outdoors;
    if (zone.name != outdoors)
    {
      described.rooms.push_back({zone.name, volume});
    }
  }
}

} // namespace

CaseMesh describeMesh(const PolyMesh& poly, const RunContext& context)
{
  CaseMesh described;
  described.cells = poly.mesh.cellCount;
  described.faces = poly.mesh.faceCount();
  for (const Vec3& point : poly.mesh.points)
  {
    described.bounds.extend(point);
  }
  const MeasuredMesh measured = measureMesh(poly.mesh, context.part(0.0, 0.4));
  for (const double volume : measured.geometry.cellVolumes)
  {
    described.volume += volume;
  }
  const MeshVerdict verdict = checkMesh(measured, context.part(0.4, 1.0));
  described.worstNonOrthogonality = verdict["NonOrthogonality"].worst;
  described.meanNonOrthogonality = verdict["NonOrthogonality"].mean;
  described.worstSkewness = verdict["Skewness"].worst;
  described.failedChecks = verdict.failedChecks();
  for (const PolyPatch& patch : poly.patches)
  {
    described.patches.push_back(measurePatch(poly, patch, measured.geometry));
  }
  findPatchesAtSides(poly, described.patches);
  describeZones(poly, measured.geometry, described);
  return described;
}

std::vector<Vec3> probePlaces(const PolyMesh& poly, const std::vector<std::string>& ground, const Box3& over,
                              double height, std::size_t most)
{
  // Picks a face for each square of a grid with about as many squares as there may be places.
  const Vec3 size = over.size();
  const double step = std::sqrt(size[0] * size[1] / static_cast<double>(most));
  if (!(step > 0.0))
  {
    return {};
  }
  const auto across = static_cast<long>(std::floor(size[0] / step)); // rounded down: no more than `most` in all
  const auto along = static_cast<long>(std::floor(size[1] / step));
  std::map<std::pair<long, long>, std::pair<double, Vec3>> nearest;
  for (const PolyPatch& patch : poly.patches)
  {
    if (std::find(ground.begin(), ground.end(), patch.name) == ground.end())
    {
      continue;
    }
    for (const Index f : patch.faces)
    {
      const Vec3 center = measurePolygon(poly.mesh.points, poly.mesh.face(f)).centroid;
      const Eigen::Array2d at = (center - over.min).head<2>().array() / step;
      const std::pair square(static_cast<long>(std::floor(at[0])), static_cast<long>(std::floor(at[1])));
      if (square.first < 0 || square.second < 0 || square.first >= across || square.second >= along)
      {
        continue;
      }
      const double off = (at - at.floor() - 0.5).matrix().squaredNorm();
      const auto [known, isNew] = nearest.try_emplace(square, off, center);
      if (!isNew && off < known->second.first)
      {
        known->second = {off, center};
      }
    }
  }
  std::vector<Vec3> places;
  places.reserve(nearest.size());
  for (const auto& [square, place] : nearest)
  {
    places.push_back(place.second + Vec3(0.0, 0.0, height));
  }
  return places;
}

} // namespace atria
