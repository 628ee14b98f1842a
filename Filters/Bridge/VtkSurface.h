// SPDX-License-Identifier: GPL-3.0-or-later
/// Surface models from VTK to the core.
#pragma once

#include "Surface/TriangleSurface.h"

#include <vector>

class vtkDataObject;

namespace atria {

/// A surface model converted from VTK, with what was left out.
struct VtkSurface
{
  TriangleSurface surface;
  std::size_t ignoredCells = 0; ///< lines, vertices and cells that are not surfaces
};

/// Reads polygons, triangles, quads and triangle strips of one polydata or of every polydata in a composite. Names come
/// from SurfaceId and SurfaceName where both are there, else from the block's name, else "surface"; equal names
/// of different blocks are one surface. Polygons are triangulated. Throws Error for points that are not finite and for
/// a SurfaceId outside of SurfaceName.
VtkSurface surfaceFromVtk(const std::vector<vtkDataObject*>& inputs);

} // namespace atria
