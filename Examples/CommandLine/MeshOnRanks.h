// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes and measures meshes on all ranks together.
#pragma once

#include "OutputFiles.h"
#include "Report.h"

#include <vtkType.h>

class vtkAtriaDualMesher;
class vtkAtriaMeshQuality;
class vtkMultiProcessController;

namespace CLI {
class App;
}

namespace atria::tool {

class Workers;
struct MeshOptions;

/// True if all ranks make the mesh, and not the first one alone.
bool isMadeTogether(const MeshOptions& options, const Workers& workers);
/// True if each rank then keeps its piece, since no file needs the whole.
bool staysInPieces(const MeshOptions& options, const Workers& workers);

/// Runs a mesher with all ranks, which get the options of the command; sizes may differ by now. The first rank then
/// holds the mesh, unless it stays in pieces. Errors are reported through VTK. Returns the number of elements, ghosts
/// included.
vtkIdType makeTogether(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options,
                       const Workers& workers);
/// Measures a mesh in pieces, on the first rank by `quality`. Returns the sums over all pieces.
Json measureTogether(vtkAtriaMeshQuality* quality, const Workers& workers);

/// Do a worker's part of that. The worker keeps the piece.
void makeWithOthers(const Json& task, MeshPiece& piece, vtkMultiProcessController& controller);
void measureWithOthers(MeshPiece& piece, vtkMultiProcessController& controller);

} // namespace atria::tool
