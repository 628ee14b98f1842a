// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkFaceMesh.h"

#include "Support/Error.h"
#include "VtkRecordedPatches.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace atria {

namespace {

const VtkPatches::Patch& patchOf(const VtkPatches& patches, std::size_t face)
{
  std::size_t p = 0;
  while (face >= patches.patches[p].firstFace + patches.patches[p].faceCount)
  {
    ++p;
  }
  return patches.patches[p];
}

std::string describe(const VtkPatches& patches, std::size_t face)
{
  const VtkPatches::Patch& patch = patchOf(patches, face);
  return "face " + std::to_string(face - patch.firstFace) + " of patch '" + patch.name + "'";
}

void checkPatchFaces(const VtkFaceMesh& result)
{
  const std::size_t internal = result.mesh.internalFaceCount();
  std::vector<Index> taken(result.mesh.faceCount() - internal, noIndex); // one entry per boundary face
  for (std::size_t f = 0; f < result.patchFaces.size(); ++f)
  {
    const Index face = result.patchFaces[f];
    if (face == noIndex)
    {
      throw Error(describe(result.patches, f) + " is no face of its owner, cell " +
                  std::to_string(result.patches.owners[f]));
    }
    Index& first = taken[face - internal];
    if (first != noIndex)
    {
      throw Error(describe(result.patches, f) + " is already " + describe(result.patches, first));
    }
    first = static_cast<Index>(f);
  }
}

/// True if the patches have each boundary face of the mesh exactly once.
bool patchesAreTheBoundary(const VtkFaceMesh& result)
{
  const std::size_t internal = result.mesh.internalFaceCount();
  std::vector<bool> met(result.mesh.faceCount() - internal, false);
  const auto isNew = [&](Index face) {
    const bool fresh = face != noIndex && !met[face - internal];
    if (fresh)
    {
      met[face - internal] = true;
    }
    return fresh;
  };
  return result.patchFaces.size() == met.size() && std::ranges::all_of(result.patchFaces, isNew);
}

/// Makes the mesh of `cells`, with the faces of `patches` kept on its boundary.
void findFaces(VtkFaceMesh& result, vtkUnstructuredGrid* volume, const Executor& executor)
{
  const std::vector<BoundaryFaceKey> keys = result.patches.keys();
  result.mesh = makeFaceMesh(pointsFromVtk(volume->GetPoints(), executor), result.cells.view(), keys, executor);
  result.patchFaces = findBoundaryFaces(result.mesh, keys, executor);
}

/// Finds the faces of zones in the mesh. Returns the index of the first one that is not there, or their number.
std::size_t findZoneFaces(VtkFaceMesh& result, const Executor& executor)
{
  const std::vector<BoundaryFaceKey> keys = result.zones.keys();
  result.zoneFaces = findInternalFaces(result.mesh, keys, result.zones.neighbors, executor);
  return static_cast<std::size_t>(std::ranges::find(result.zoneFaces, noIndex) - result.zoneFaces.begin());
}

void takeGivenZones(VtkFaceMesh& result, vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume,
                    const Executor& executor)
{
  result.zones = faceZonesFromVtk(patches, volume);
  if (const std::size_t lost = findZoneFaces(result, executor); lost < result.zoneFaces.size())
  {
    throw Error(describe(result.zones, lost) + " is no face between its cells, " +
                std::to_string(result.zones.owners[lost]) + " and " + std::to_string(result.zones.neighbors[lost]));
  }
}

/// Takes the recorded zones; none if they belong to other cells.
void takeRecordedZones(VtkFaceMesh& result, vtkUnstructuredGrid* volume, const Executor& executor)
{
  result.zones = recordedFaceZones(volume).value_or(VtkPatches());
  if (findZoneFaces(result, executor) < result.zoneFaces.size())
  {
    result.zones = {};
    result.zoneFaces.clear();
  }
}

/// Takes the recorded patches. Returns false if there are none or if they belong to other cells; the result then has no
/// patches.
bool findRecordedFaces(VtkFaceMesh& result, vtkUnstructuredGrid* volume, const Executor& executor)
{
  std::optional<VtkPatches> recorded = recordedPatches(volume);
  if (!recorded)
  {
    return false;
  }
  result.patches = std::move(*recorded);
  findFaces(result, volume, executor);
  if (patchesAreTheBoundary(result))
  {
    return true;
  }
  result.patches = {};
  return false;
}

} // namespace

int acceptMeshAndPatches(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
            port == 0 ? "vtkUnstructuredGrid" : "vtkPartitionedDataSetCollection");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

VtkFaceMesh faceMeshFromVtk(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches,
                            const Executor& executor)
{
  if (!volume || volume->GetNumberOfCells() == 0)
  {
    throw Error("the volume mesh has no cells");
  }
  VtkFaceMesh result;
  result.cells = VtkCells(volume);
  const bool given = patches && patches->GetNumberOfPartitionedDataSets() > 0;
  if (!given && hasRecordedPatches(volume))
  {
    if (findRecordedFaces(result, volume, executor))
    {
      result.origin = PatchOrigin::Recorded;
      takeRecordedZones(result, volume, executor);
      return result;
    }
    result.origin = PatchOrigin::Lost;
  }
  if (given)
  {
    result.patches = patchesFromVtk(patches, volume);
    result.origin = PatchOrigin::Given;
  }
  findFaces(result, volume, executor);
  checkPatchFaces(result);
  if (given)
  {
    takeGivenZones(result, patches, volume, executor);
  }
  return result;
}

} // namespace atria
