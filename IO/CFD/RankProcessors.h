// SPDX-License-Identifier: GPL-3.0-or-later
/// The processors' meshes of an OpenFOAM case, each written by the rank of its number.
#pragma once

#include "Decomposition.h"

#include <filesystem>
#include <vector>

class vtkMultiProcessController;

namespace atria {

/// A mesh of OpenFOAM and the part of each of its cells.
struct DividedMesh
{
  PolyMesh poly;
  std::vector<Index> partOf;
};

/// As writeProcessors(), on all ranks at the same time: the first one makes one part after the other and sends it, the
/// others write theirs, and the first one puts all in place once they are complete. `mesh` is the first rank's, null on
/// others, and has a part for each rank. The folder of the case is one that all ranks see. Where a part cannot be
/// written nothing is put in place: the first rank throws Error, or Aborted, and the others return false.
bool writeProcessorsOnRanks(const std::filesystem::path& caseFolder, const DividedMesh* mesh, OpenFOAMFormat format,
                            vtkMultiProcessController& controller, const ProgressRange& progress);

} // namespace atria
