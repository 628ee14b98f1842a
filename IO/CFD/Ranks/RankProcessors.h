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

/// Writes the same as writeProcessors(). All ranks call it at the same time. The first rank makes one part after the
/// other and sends it, and the others write theirs. The first rank puts all in place once they are complete. `mesh` is
/// null except on the first rank, and has a part for each rank. All ranks see the folder of the case. If a part cannot
/// be written, nothing is put in place: the first rank throws Error, or Aborted, and the others return false.
bool writeProcessorsOnRanks(const std::filesystem::path& caseFolder, const DividedMesh* mesh, OpenFOAMFormat format,
                            vtkMultiProcessController& controller, const ProgressRange& progress);

} // namespace atria
