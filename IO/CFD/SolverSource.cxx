// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverSource.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
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

/// Adds zones that a cell array numbers and a field array names, if both exist.
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

std::vector<ZonedFaces> zonedFacesOf(const VtkFaceMesh& from)
{
  const VtkPatches& zones = from.zones;
  std::vector<ZonedFaces> out;
  for (const VtkPatches::Patch& zone : zones.patches)
  {
    ZonedFaces& zoned = out.emplace_back(ZonedFaces{zone.name, {}});
    for (std::size_t f = zone.firstFace; f < zone.firstFace + zone.faceCount; ++f)
    {
      zoned.faces.push_back(zonedFace(from.mesh, from.zoneFaces[f], zones.owners[f]));
    }
  }
  return out;
}

/// Gives labels to present cells; a union has that of its last cell.
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
  for (BoundaryPatch& patch : source.patches)
  {
    std::ranges::transform(patch.faces, patch.faces.begin(), [&](Index face) { return faceOf[face]; });
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  }
  for (ZonedFaces& zone : source.faceZones)
  {
    std::ranges::for_each(zone.faces, [&](ZonedFace& zoned) { zoned.face = faceOf[zoned.face]; });
  }
}

/// Returns zones with names as lists of cells, in the order of the names of each array. Empty ones are left out.
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
  SolverSource source{boundaryPatchesOf(faces), zonedFacesOf(faces), {{}, idsOf(volume, "ZoneId", executor)}, {}, {}};
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
  markZones(source.faceZones, zoneOf);
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
  std::vector<FaceZone> faceZones = faceZonesOf(source.faceZones, {}, mesh);
  SolverMesh out = makeSolverMesh(std::move(mesh), source.patches, source.zones.ofCell, executor);
  out.faceZones = std::move(faceZones);
  if (std::vector<CellZone> named = cellZonesOf(source); !named.empty())
  {
    out.cellZones = std::move(named); // named zones say more than numbers
  }
  out.partOf.assign(source.partOf.begin(), source.partOf.end());
  return out;
}

} // namespace atria
