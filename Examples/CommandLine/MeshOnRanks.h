// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that all ranks make together.
#pragma once

#include "Files.h"
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

/// Whether all ranks make the mesh, and not the first one alone.
bool isMadeTogether(const MeshOptions& options, const Workers& workers);
/// Whether each of them then keeps its piece, since no file needs the whole.
bool staysInPieces(const MeshOptions& options, const Workers& workers);

/// Runs a mesher with all ranks, which get the options of the command; sizes may be others by now. Unless it stays in
/// pieces, the mesh is with the first rank then. What goes wrong is among VTK's errors. Returns how many elements there
/// are, ghosts included.
vtkIdType makeTogether(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options,
                       const Workers& workers);
/// Measures a mesh in pieces, the first rank by `quality`. Returns the sums of all.
Json measureTogether(vtkAtriaMeshQuality* quality, const Workers& workers);

/// A worker's part of that; it keeps the piece.
void makeWithOthers(const Json& task, MeshPiece& piece, vtkMultiProcessController& controller);
void measureWithOthers(MeshPiece& piece, vtkMultiProcessController& controller);

} // namespace atria::tool
