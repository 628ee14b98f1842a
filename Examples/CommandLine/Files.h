// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading and writing files, with errors that name the file and say what to do.
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

/// What the model of a command may be, for its help.
inline constexpr const char* modelFormats =
    "VRML (.wrl, .vrml, .wrz, .wrl.gz), OBJ, STL, PLY, glTF (.gltf, .glb), COLLADA (.dae), IFC, DXF, FBX, 3DS, "
    "CityJSON (.json, .jsonl) or VTK's .vtp, .vtm, .vtpc";

/// A reader that has read `file`, whose format follows from its ending, or if that is none of them from a header of
/// VRML. Its warnings and notes have been printed. Throws Failure(BadInput).
vtkSmartPointer<vtkAtriaSurfaceReader> readModel(const std::string& file, const ModelOptions& options,
                                                 Console& console);
/// Of a .vtu file, or the whole of a .pvtu file's pieces.
vtkSmartPointer<vtkUnstructuredGrid> readMesh(const std::string& file, Console& console);
/// What writePatches() wrote.
vtkSmartPointer<vtkPartitionedDataSetCollection> readPatches(const std::string& file, Console& console);

/// Appended binary data, compressed. Throws Failure(Failed). These write beside their place, and put files there once
/// they are complete.
void writeMesh(const std::string& file, vtkUnstructuredGrid* mesh, Console& console);
void writePolyData(const std::string& file, vtkPolyData* data, Console& console);
void writePatches(const std::string& file, vtkPartitionedDataSetCollection* patches, Console& console);
void writeText(const std::string& file, const std::string& text);

/// What a rank has of a mesh; nothing at first.
struct MeshPiece
{
  vtkSmartPointer<vtkUnstructuredGrid> mesh;
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
};

/// What is this rank's of a mesh that the first rank holds; of all ranks.
MeshPiece ownPart(const MeshPiece& whole, vtkMultiProcessController& controller);

/// A mesh (.pvtu) and, unless their file's name is empty, its patches (.vtpc) in pieces, one for each rank, that these
/// write: what each has, or parts of what the first one has.
void writePieces(const std::string& meshFile, const std::string& patchesFile, const MeshPiece& own, bool isDivided,
                 Console& console, const Workers& workers);
/// A worker's part of that.
void writePiecesWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller);
/// Whether a file holds a mesh in pieces, by its name.
bool isInPieces(const std::string& file);

/// Throws Failure(Usage) unless `file` ends in `ending`, such as ".vtu", and its folder exists.
/// The folder itself is made where it is not there, but not the one it is to stand in.
void checkFolder(const std::string& option, const std::string& folder);
void checkOutput(const std::string& option, const std::string& file, const std::string& ending);

/// If VTK reported errors, throws Failure with them, prefixed by `about`.
void throwIfErrors(Console& console, ExitStatus status, const std::string& about);

/// Updates an algorithm. If VTK reported errors, throws Failure with them, prefixed by `about`.
void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console);

} // namespace atria::tool
