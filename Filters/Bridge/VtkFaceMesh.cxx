// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkFaceMesh.h"

#include "Support/Error.h"

#include <vtkUnstructuredGrid.h>

#include <string>

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
  std::vector<Index> taken(result.mesh.faceCount() - internal, noIndex); // by boundary face
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

} // namespace

VtkFaceMesh faceMeshFromVtk(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches,
                            const Executor& executor)
{
  if (!volume || volume->GetNumberOfCells() == 0)
  {
    throw Error("the volume mesh has no cells");
  }
  VtkFaceMesh result;
  result.cells = cellsFromVtk(volume);
  if (patches)
  {
    result.patches = patchesFromVtk(patches, volume);
  }
  const std::vector<BoundaryFaceKey> keys = result.patches.keys();
  result.mesh = makeFaceMesh(pointsFromVtk(volume->GetPoints(), executor), result.cells.view(), keys, executor);
  result.patchFaces = findBoundaryFaces(result.mesh, keys, executor);
  checkPatchFaces(result);
  return result;
}

} // namespace atria
