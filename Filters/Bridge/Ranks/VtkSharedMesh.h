// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts meshes that ranks made together from the core to VTK.
#pragma once

#include "Ranks/SharedModel.h"
#include "Support/RankExchange.h"

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria {

/// Converts a rank's piece and its patches, with the same arrays as a distributed mesh of one process: see MeshShares.
/// All ranks call it at the same time. They record the patches of the whole mesh in the field arrays of
/// recordPatches(). Frees the model's piece. Throws Error for meshes with more cells or points than these arrays can
/// number.
void sharedMeshToVtk(SharedModel& model, RankExchange& exchange, const Executor& executor, vtkUnstructuredGrid* volume,
                     vtkPartitionedDataSetCollection* patches);

} // namespace atria
