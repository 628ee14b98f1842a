// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches that a mesh carries in its field data, so that their names are not lost where a mesh goes alone: through
/// ParaView's Save Data, .vtu files, and filters that leave its cells and points as they are.
#pragma once

#include "VtkArrays.h"

#include <optional>

namespace atria {

/// Records the patches of a mesh in its field arrays PatchName, PatchFaceCount and PatchFace, 20 bytes a face, and face
/// zones among them, if there are any, in FaceZoneName, FaceZoneFaceCount and FaceZoneFace. Throws Error for a face of
/// more than four points, and as patchesFromVtk() does.
void recordPatches(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume);

/// The same of patches and face zones whose cells and points may be those of the mesh that `volume` is a piece of.
void recordPatches(const VtkPatches& patches, const VtkPatches& faceZones, vtkUnstructuredGrid* volume);

/// Whether patches were recorded in the mesh, or in what it was made of by other filters.
bool hasRecordedPatches(vtkUnstructuredGrid* volume);

/// The patches as they were recorded. Filters pass field data on whatever they do to the cells, so that they may belong
/// to a mesh of other cells. Nothing where the arrays are not as recordPatches() makes them.
std::optional<VtkPatches> recordedPatches(vtkUnstructuredGrid* volume);

/// The same of face zones.
std::optional<VtkPatches> recordedFaceZones(vtkUnstructuredGrid* volume);

} // namespace atria
