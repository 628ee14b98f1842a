// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over a mesh, or over the pieces that ranks hold of one, for reports.
#pragma once

#include "Report.h"

class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria::tool {

/// Returns the area of all polygons.
double areaOf(vtkPolyData* surface);

/// Returns vertices, elements, and elements by shape; without ghosts.
Json countsOf(vtkUnstructuredGrid* mesh);

/// Returns {counts, zone_volumes, patches} of a mesh with quality, or of a rank's piece of it. Volumes of zones are
/// from the cell arrays ZoneId and Volume, and null without these.
Json sumsOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches);
/// Adds the sums of another piece.
void addSums(const Json& piece, Json& sums);

/// Returns [{name, faces, area}], area in square model units. Face zones are no patches.
Json patchesOf(const Json& sums);

} // namespace atria::tool
