// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts surface models from VTK to the core.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace atria {

/// A surface model converted from VTK, and counts of omitted parts.
struct VtkSurface
{
  TriangleSurface surface;
  std::vector<Index> faceIds;    ///< one entry per triangle: the polygon it was cut from; rising
  std::size_t crossingFaces = 0; ///< polygons whose outline crosses itself; parts without area of its sign are omitted
  Index firstCrossing = noIndex; ///< the surface of the first of them
  std::size_t ignoredCells = 0;  ///< lines, vertices, and cells of datasets that are not polydata
  bool singlePrecision = false;  ///< true if any polydata with faces has points in single precision
};

/// Returns the largest rounding of the points by 32-bit numbers, in model units, if it is more than a
/// hundred-thousandth of the model's size; else 0.
double coarseRounding(const TriangleSurface& surface);

/// Reads polygons, triangles, quads and triangle strips of one polydata or of every polydata in a composite, at any
/// depth. Names come from the cells' SurfaceId and the field array SurfaceName if both exist, else from a cell array of
/// strings SurfaceName, else from the block or the nearest named block around it; the default is "surface". Equal names
/// of different blocks are one surface. Polygons are triangulated. Throws Error for points that are not finite, for
/// cells whose points do not exist, and for a SurfaceId outside of SurfaceName.
VtkSurface surfaceFromVtk(const std::vector<vtkDataObject*>& inputs);

/// Returns the names of the surfaces that surfaceFromVtk finds, without reading points and triangles.
std::vector<std::string> surfaceNamesFromVtk(vtkDataObject* input);

/// Returns the names of surfaces that the field array IsGround (one entry per SurfaceId) marks as ground.
std::vector<std::string> groundNamesFromVtk(vtkDataObject* input);

} // namespace atria
