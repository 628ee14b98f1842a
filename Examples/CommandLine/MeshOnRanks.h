// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that all ranks make together.
#pragma once

#include "Report.h"

class vtkAtriaDualMesher;
class vtkMultiProcessController;

namespace CLI {
class App;
}

namespace atria::tool {

class Workers;
struct MeshOptions;

/// Runs a mesher with all ranks, which get the options of the command; sizes may be others by now. The mesh then is
/// with the first rank, as it is without others. What goes wrong is among VTK's errors.
void updateOnRanks(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options,
                   const Workers& workers);

/// A worker's part of that.
void makeMeshWithOthers(const Json& task, vtkMultiProcessController& controller);

} // namespace atria::tool
