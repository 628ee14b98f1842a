// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverSource.h"

#include "Quality/Faces/Geometry.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace atria {

namespace {

Buffer<std::int64_t> idsOf(vtkUnstructuredGrid* volume, const char* name, const Executor& executor)
{
  vtkDataArray* array = volume->GetCellData()->GetArray(name);
  Buffer<std::int64_t> ids(array ? static_cast<std::size_t>(array->GetNumberOfTuples()) : 0);
  executor.forEach(ids.size(), 65536, [&](std::size_t cell) {
    ids[cell] = static_cast<std::int64_t>(array->GetComponent(static_cast<vtkIdType>(cell), 0));
  });
  return ids;
}

/// Zones that a cell array numbers and a field array names, if there are both.
void addNamedZones(SolverSource& source, vtkUnstructuredGrid* volume, const char* ids, const char* names,
                   const Executor& executor)
{
  auto* texts = vtkStringArray::SafeDownCast(volume->GetFieldData()->GetAbstractArray(names));
  CellLabels zones{{}, idsOf(volume, ids, executor)};
  for (vtkIdType i = 0; texts && i < texts->GetNumberOfValues(); ++i)
  {
    zones.names.push_back(texts->GetValue(i));
  }
  if (texts && !zones.ofCell.empty())
  {
    source.cellZones.push_back(std::move(zones));
  }
}

Vec3 areaOf(const FaceMesh& mesh, Index face) { return measurePolygon(mesh.points, mesh.face(face)).area; }

void addFaceZones(SolverSource& source, const VtkFaceMesh& from)
{
  const VtkPatches& zones = from.zones;
  for (const VtkPatches::Patch& zone : zones.patches)
  {
    FaceZone& out = source.faceZones.emplace_back();
    std::vector<Vec3>& normals = source.zoneNormals.emplace_back();
    out.name = zone.name;
    for (std::size_t f = zone.firstFace; f < zone.firstFace + zone.faceCount; ++f)
    {
      const Index face = from.zoneFaces[f];
      const bool isOwner = from.mesh.owner[face] == zones.owners[f];
      out.faces.push_back(face);
      normals.push_back((isOwner ? 1.0 : -1.0) * areaOf(from.mesh, face));
    }
  }
}

/// Gives labels to the cells there are now: where some became one, that of the last.
void renumberCells(Buffer<std::int64_t>& labels, const JudgedMesh& written)
{
  if (written.cellOf.empty() || labels.empty())
  {
    return;
  }
  for (std::size_t cell = 0; cell < written.cellOf.size(); ++cell)
  {
    labels[written.cellOf[cell]] = labels[cell]; // never a higher number
  }
  labels.resize(written.pyramid(0));
  std::ranges::transform(written.added, std::back_inserter(labels),
                         [&](Index cell) { return std::int64_t(labels[cell]); });
}

/// Gives faces their new numbers.
void renumberFaces(SolverSource& source, const std::vector<Index>& faceOf)
{
  if (faceOf.empty())
  {
    return;
  }
  const auto renumber = [&](std::vector<Index>& faces) {
    std::ranges::transform(faces, faces.begin(), [&](Index face) { return faceOf[face]; });
  };
  for (BoundaryPatch& patch : source.patches)
  {
    renumber(patch.faces);
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  }
  for (FaceZone& zone : source.faceZones)
  {
    renumber(zone.faces);
  }
}

/// Of each face of a zone, whether its owner is on the side that the zone's normal points to.
void flipZones(SolverSource& source, const FaceMesh& mesh)
{
  for (std::size_t z = 0; z < source.faceZones.size(); ++z)
  {
    FaceZone& zone = source.faceZones[z];
    std::map<Index, Vec3> normals; // faces that were merged are there more than once
    for (std::size_t i = 0; i < zone.faces.size(); ++i)
    {
      normals.try_emplace(zone.faces[i], Vec3::Zero()).first->second += source.zoneNormals[z][i];
    }
    zone.faces.clear();
    zone.flips.clear();
    for (const auto& [face, normal] : normals)
    {
      zone.faces.push_back(face);
      zone.flips.push_back(areaOf(mesh, face).dot(normal) < 0.0 ? 1 : 0);
    }
  }
}

/// Zones with names as lists of cells, those of each array in the order of its names; empty ones are left out.
std::vector<CellZone> cellZonesOf(const SolverSource& source)
{
  std::vector<CellZone> all;
  for (const CellLabels& zones : source.cellZones)
  {
    const std::size_t first = all.size();
    std::ranges::transform(zones.names, std::back_inserter(all), [](const std::string& name) {
      return CellZone{name, {}};
    });
    for (std::size_t cell = 0; cell < zones.ofCell.size(); ++cell)
    {
      const std::int64_t zone = zones.ofCell[cell];
      if (zone >= 0 && zone < static_cast<std::int64_t>(zones.names.size()))
      {
        all[first + static_cast<std::size_t>(zone)].cells.push_back(static_cast<Index>(cell));
      }
    }
  }
  std::erase_if(all, [](const CellZone& zone) { return zone.cells.empty(); });
  return all;
}

} // namespace

SolverSource solverSourceOf(vtkUnstructuredGrid* volume, const VtkFaceMesh& faces, const Executor& executor)
{
  SolverSource source{boundaryPatchesOf(faces), {}, {}, {{}, idsOf(volume, "ZoneId", executor)}, {}, {}};
  addFaceZones(source, faces);
  addNamedZones(source, volume, "RoomId", "RoomName", executor);
  addNamedZones(source, volume, "CellZoneId", "CellZoneName", executor);
  return source;
}

std::vector<Index> patchOfFaces(const SolverSource& source, const FaceMesh& mesh)
{
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<Index> patchOf(mesh.faceCount() - internal, noIndex);
  for (std::size_t p = 0; p < source.patches.size(); ++p)
  {
    for (const Index face : source.patches[p].faces)
    {
      patchOf[face - internal] = static_cast<Index>(p);
    }
  }
  return patchOf;
}

std::vector<Index> zoneOfFaces(const SolverSource& source, const FaceMesh& mesh, const Executor& executor)
{
  if (source.faceZones.empty() && source.cellZones.empty())
  {
    return {};
  }
  const auto between = static_cast<Index>(source.faceZones.size());
  std::vector<Index> zoneOf(mesh.internalFaceCount(), noIndex);
  executor.forEach(zoneOf.size(), 65536, [&](std::size_t f) {
    const bool differ = std::ranges::any_of(source.cellZones, [&](const CellLabels& zones) {
      return zones.ofCell[mesh.owner[f]] != zones.ofCell[mesh.neighbor[f]];
    });
    zoneOf[f] = differ ? between : noIndex;
  });
  for (std::size_t z = 0; z < source.faceZones.size(); ++z)
  {
    std::ranges::for_each(source.faceZones[z].faces, [&](Index face) { zoneOf[face] = static_cast<Index>(z); });
  }
  return zoneOf;
}

void followUnions(SolverSource& source, const JudgedMesh& written)
{
  renumberFaces(source, written.faceOf);
  renumberCells(source.zones.ofCell, written);
  renumberCells(source.partOf, written);
  for (CellLabels& zones : source.cellZones)
  {
    renumberCells(zones.ofCell, written);
  }
}

SolverMesh solverMeshFrom(SolverSource source, FaceMesh mesh, const Executor& executor)
{
  flipZones(source, mesh);
  SolverMesh out = makeSolverMesh(std::move(mesh), source.patches, source.zones.ofCell, executor);
  out.faceZones = std::move(source.faceZones);
  if (std::vector<CellZone> named = cellZonesOf(source); !named.empty())
  {
    out.cellZones = std::move(named); // which tell more than numbers
  }
  out.partOf.assign(source.partOf.begin(), source.partOf.end());
  return out;
}

} // namespace atria
