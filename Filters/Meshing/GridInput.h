// SPDX-License-Identifier: GPL-3.0-or-later
/// What both filters take from their properties and input: the surface, the frame, the model.
#pragma once

#include "Domain/GridFrame.h"
#include "Surface/SurfaceModel.h"

class vtkAtriaGridAlgorithm;
class vtkDataObject;

namespace atria {

struct GridInput
{
  TriangleSurface surface;
  std::size_t ignoredCells = 0;

  /// The domain as the properties say. Throws Error where they cannot be met.
  Box3 domain(vtkAtriaGridAlgorithm& filter) const;
  GridFrame frame(vtkAtriaGridAlgorithm& filter) const;
  SurfaceModel model(vtkAtriaGridAlgorithm& filter, const GridFrame& frame) const;
};

/// `data` may be null: a domain without surfaces.
GridInput readGridInput(vtkDataObject* data);

} // namespace atria
