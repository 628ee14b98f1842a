// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads and writes files, with errors that name the file and a remedy.
#pragma once

#include "Commands.h"
#include "ModelOptions.h"
#include "Report.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkAlgorithm;
class vtkAtriaSurfaceReader;
class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria::tool {

class Console;
class Workers;

/// Formats of models, for the help of commands.
inline constexpr const char* modelFormats =
    "VRML (.wrl, .vrml, .wrz, .wrl.gz), OBJ, STL, PLY, glTF (.gltf, .glb), COLLADA (.dae), IFC, DXF, FBX, 3DS, "
    "CityJSON (.json, .jsonl) or VTK's .vtp, .vtm, .vtpc";

/// Returns a reader that has read `file`. The format follows from the file's ending, or for an unknown ending from a
/// header of VRML. Warnings and notes have been printed. Throws Failure(BadInput).
vtkSmartPointer<vtkAtriaSurfaceReader> readModel(const std::string& file, const ModelOptions& options,
                                                 Console& console);
/// Reads a .vtu file, or all pieces of a .pvtu file as one mesh.
vtkSmartPointer<vtkUnstructuredGrid> readMesh(const std::string& file, Console& console);
/// Reads a file of writePatches().
vtkSmartPointer<vtkPartitionedDataSetCollection> readPatches(const std::string& file, Console& console);

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
/// True if a file holds a mesh in pieces, by its name.
bool isInPieces(const std::string& file);

/// Throw Failure(Usage) unless `file` ends in `ending`, such as ".vtu", and its folder exists. A folder to write need
/// not exist, but the one that contains it must.
void checkFolder(const std::string& option, const std::string& folder);
void checkOutput(const std::string& option, const std::string& file, const std::string& ending);

/// If VTK reported errors, throws Failure with them, prefixed by `about`.
void throwIfErrors(Console& console, ExitStatus status, const std::string& about);

/// Updates an algorithm. If VTK reported errors, throws Failure with them, prefixed by `about`.
void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console);

} // namespace atria::tool
