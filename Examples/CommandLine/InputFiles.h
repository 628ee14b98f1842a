// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads models, meshes and patches, with errors that name the file and a remedy.
#pragma once

#include "ModelOptions.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkAtriaSurfaceReader;
class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria::tool {

class Console;

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

} // namespace atria::tool
