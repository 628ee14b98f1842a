// SPDX-License-Identifier: GPL-3.0-or-later
/// Surface models from VTK to the core.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace atria {

/// A surface model converted from VTK, with what was left out.
struct VtkSurface
{
  TriangleSurface surface;
  std::vector<Index> faceIds;    ///< per triangle: the polygon it was cut from; ascending
  std::size_t crossingFaces = 0; ///< polygons whose outline crosses itself; what has no area with its sign is left out
  Index firstCrossing = noIndex; ///< the surface of the first of them
  std::size_t ignoredCells = 0;  ///< lines, vertices, and cells of datasets that are not polydata
  bool singlePrecision = false;  ///< of the points of any polydata with faces
};

/// By how much numbers of 32 bits round the points at most, if that is more than a hundred-thousandth of the model's
/// size; else 0.
double coarseRounding(const TriangleSurface& surface);

/// Reads polygons, triangles, quads and triangle strips of one polydata or of every polydata in a composite, however
/// deep. Names come from the cells' SurfaceId and the field array SurfaceName where both are there, else from a cell
/// array of strings SurfaceName, else from the block's name or, if it has none, that of the nearest block around it,
/// else they are "surface"; equal names of different blocks are one surface. Polygons are triangulated. Throws Error
/// for points that are not finite, for cells whose points do not exist, and for a SurfaceId outside of SurfaceName.
VtkSurface surfaceFromVtk(const std::vector<vtkDataObject*>& inputs);

/// The names of the surfaces that surfaceFromVtk finds, without reading points and triangles.
std::vector<std::string> surfaceNamesFromVtk(vtkDataObject* input);

/// The names of those surfaces that the field array IsGround, by SurfaceId, marks as ground.
std::vector<std::string> groundNamesFromVtk(vtkDataObject* input);

} // namespace atria
