// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces as the meshing filters take them.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <vtkSmartPointer.h>

#include <filesystem>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace atria::testing {

/// One polydata with SurfaceId and SurfaceName.
vtkSmartPointer<vtkPolyData> toPolyData(const TriangleSurface& surface);

/// A named block for each surface, without arrays.
vtkSmartPointer<vtkMultiBlockDataSet> toBlocks(const TriangleSurface& surface);

/// What the VRML reader makes of a file.
vtkSmartPointer<vtkPolyData> readModel(const std::filesystem::path& file);

/// A model of Examples/Data.
vtkSmartPointer<vtkPolyData> exampleModel(const char* name);

} // namespace atria::testing
