// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes meshes, patches and texts, whole or in pieces of ranks, with errors that name the file and a remedy.
#pragma once

#include "Report.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria::tool {

class Console;
class Workers;

/// Write appended binary data, compressed. Files are written beside their place, and moved there once they are
/// complete. Throw Failure(Failed).
void writeMesh(const std::string& file, vtkUnstructuredGrid* mesh, Console& console);
void writePolyData(const std::string& file, vtkPolyData* data, Console& console);
void writePatches(const std::string& file, vtkPartitionedDataSetCollection* patches, Console& console);
void writeText(const std::string& file, const std::string& text);

/// The piece of a mesh that a rank holds; empty at first.
struct MeshPiece
{
  vtkSmartPointer<vtkUnstructuredGrid> mesh;
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
};

/// Returns this rank's part of a mesh that the first rank holds. All ranks call it at the same time.
MeshPiece ownPart(const MeshPiece& whole, vtkMultiProcessController& controller);

/// Writes a mesh (.pvtu) and, unless their file's name is empty, its patches (.vtpc) in pieces. Each rank writes one:
/// its own, or a part of the first rank's mesh.
void writePieces(const std::string& meshFile, const std::string& patchesFile, const MeshPiece& own, bool isDivided,
                 Console& console, const Workers& workers);
/// Writes a worker's part of that.
void writePiecesWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller);

} // namespace atria::tool
