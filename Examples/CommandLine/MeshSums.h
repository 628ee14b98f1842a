// SPDX-License-Identifier: GPL-3.0-or-later
/// What reports sum over a mesh, or over the pieces that ranks have of one.
#pragma once

#include "Report.h"

class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria::tool {

/// Of all polygons.
double areaOf(vtkPolyData* surface);

/// vertices, elements, and elements by shape; without ghosts.
Json countsOf(vtkUnstructuredGrid* mesh);

/// {counts, zone_volumes, patches} of a mesh with quality, or of a rank's piece of it. Volumes of zones are from the
/// cell arrays ZoneId and Volume, and null without these.
Json sumsOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches);
/// Adds those of another piece.
void addSums(const Json& piece, Json& sums);

/// [{name, faces, area}], area in square model units. Face zones are no patches.
Json patchesOf(const Json& sums);

} // namespace atria::tool
