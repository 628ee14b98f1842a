// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts features of the model from the core to VTK; docs/arrays.md lists the arrays.
#pragma once

#include "Surface/Model/SurfaceModel.h"

class vtkPolyData;

namespace atria {

/// Makes a vertex for each corner, then a line for each feature edge.
void featureCurvesToVtk(const SurfaceModel& model, const GridFrame& frame, vtkPolyData* out);

/// Converts the triangles as the mesher sees them.
void modelToVtk(const SurfaceModel& model, const GridFrame& frame, vtkPolyData* out);

} // namespace atria
