// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts a volume mesh and its patches from VTK to faces of the core.
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
  Lost ///< recorded for other cells or points than the mesh has now
};

/// A volume mesh by its faces, with the faces of its patches found in it.
struct VtkFaceMesh
{
  FaceMesh mesh;
  VtkCells cells;                ///< cells that `mesh` was made of
  VtkPatches patches;            ///< empty if there are none
  std::vector<Index> patchFaces; ///< one entry per face of `patches`: the face of `mesh`
  VtkPatches zones;              ///< the faces of face zones, seen from their owners; empty if there are none
  std::vector<Index> zoneFaces;  ///< one entry per face of `zones`: the internal face of `mesh`
  PatchOrigin origin = PatchOrigin::None;
};

/// Implements FillInputPortInformation(): port 0 takes a volume mesh, port 1, optional, its patches.
int acceptMeshAndPatches(int port, vtkInformation* info);

/// Returns the faces of a mesh. If `patches` is null or empty, the patches recorded in the mesh are used, if they are
/// exactly its boundary. Face zones come from the same source as patches. `volume` must outlive the result. Throws
/// Error as makeFaceMesh() and patchesFromVtk() do, for a mesh without cells, for a patch face that is no face of its
/// owner cell or is in two patches, and for a face of a zone that is not between its two cells. The text names the
/// patches and the face.
VtkFaceMesh faceMeshFromVtk(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches,
                            const Executor& executor = SerialExecutor());

} // namespace atria
