// SPDX-License-Identifier: GPL-3.0-or-later
/// What both filters take from their properties and input: the surface, the frame, the model.
#pragma once

#include "Domain/GridFrame.h"
#include "Octree/Sizing.h"
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

/// The rules of the filter's properties. Throws Error for those that are no rules.
SizingOptions sizingOf(vtkAtriaGridAlgorithm& filter);

/// `data` may be null: a domain without surfaces.
GridInput readGridInput(vtkDataObject* data);

/// Adds the field array SizingWarning, with one text or none, and warns.
void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

} // namespace atria
