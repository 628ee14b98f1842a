// SPDX-License-Identifier: GPL-3.0-or-later
/// Records patches in a mesh's field data, so that their names are not lost when the mesh is passed on alone: through
/// ParaView's Save Data, .vtu files, and filters that keep its cells and points.
#pragma once

#include "VtkArrays.h"

#include <optional>

namespace atria {

/// Records the patches of a mesh in its field arrays PatchName, PatchFaceCount and PatchFace, 20 bytes per face. Face
/// zones, if any, are recorded in FaceZoneName, FaceZoneFaceCount and FaceZoneFace. Throws Error for a face of more
/// than four points, and as patchesFromVtk() does.
void recordPatches(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

/// The same for patches and face zones whose cells and points may be those of the whole mesh, of which `volume` is a
/// piece.
void recordPatches(const VtkPatches& patches, const VtkPatches& faceZones, vtkUnstructuredGrid* volume);

/// True if patches were recorded in the mesh, or in the mesh that other filters made it from.
bool hasRecordedPatches(vtkUnstructuredGrid* volume);

/// Returns the recorded patches. They may belong to a mesh with other cells, as filters pass on field data whatever
/// they do to the cells. Returns nullopt if the arrays are not as recordPatches() makes them.
std::optional<VtkPatches> recordedPatches(vtkUnstructuredGrid* volume);

/// The same for face zones.
std::optional<VtkPatches> recordedFaceZones(vtkUnstructuredGrid* volume);

} // namespace atria
