// SPDX-License-Identifier: GPL-3.0-or-later
/// The faces of a volume mesh and of its patches, from VTK.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "VtkArrays.h"

#include <vector>

class vtkInformation;

namespace atria {

enum class PatchOrigin
{
  Given,
  Recorded, ///< in the mesh, see VtkRecordedPatches.h
  None,
  Lost ///< recorded, but for other cells or points than the mesh has now
};

/// A volume mesh by its faces, with the faces of its patches found in it.
struct VtkFaceMesh
{
  FaceMesh mesh;
  VtkCells cells;                ///< what `mesh` was made of
  VtkPatches patches;            ///< empty without any
  std::vector<Index> patchFaces; ///< for each face of `patches` the face of `mesh`
  VtkPatches zones;              ///< the faces of face zones, seen from their owners; empty without any
  std::vector<Index> zoneFaces;  ///< for each face of `zones` the internal face of `mesh`
  PatchOrigin origin = PatchOrigin::None;
};

/// For FillInputPortInformation(): port 0 takes a volume mesh, port 1 its patches, if there are any.
int acceptMeshAndPatches(int port, vtkInformation* info);

/// Where `patches` is null or empty, those recorded in the mesh are taken, if they are all of its boundary and nothing
/// else; face zones are taken from where patches are. `volume` must outlive the result. Throws Error as makeFaceMesh()
/// and patchesFromVtk() do, for a mesh without cells, for a patch face that is no face of its owner cell, for one that
/// is in two patches, and for a face of a zone that is not between its two cells; names the patches and the face.
VtkFaceMesh faceMeshFromVtk(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches,
                            const Executor& executor = SerialExecutor());

} // namespace atria
