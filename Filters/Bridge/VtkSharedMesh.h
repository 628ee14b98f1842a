// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that ranks have made together, from the core to VTK.
#pragma once

#include "Mesher/SharedModel.h"
#include "Support/RankExchange.h"

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria {

/// A rank's piece and its patches, with the arrays that they have where a mesh of one process was dealt out: see
/// MeshShares. All ranks record the patches of the whole mesh in the field arrays of recordPatches(). All call it at
/// the same time. Frees the model's piece. Throws Error for meshes with more cells or points than these arrays can
/// number.
void sharedMeshToVtk(SharedModel& model, RankExchange& exchange, const Executor& executor, vtkUnstructuredGrid* volume,
                     vtkPartitionedDataSetCollection* patches);

} // namespace atria
