// SPDX-License-Identifier: GPL-3.0-or-later
/// What both filters take from their properties and input: the surface, the frame, the model.
#pragma once

#include "Domain/PlacedModel.h"
#include "Octree/Sizing/Sizing.h"
#include "Surface/Model/SurfaceModel.h"

class vtkAtriaGridAlgorithm;
class vtkDataObject;

namespace atria {

struct GridInput
{
  TriangleSurface surface;
  std::size_t ignoredCells = 0;

  /// The model in its grid. Throws Error where the properties cannot be met.
  PlacedModel placed(vtkAtriaGridAlgorithm& filter) const;
  /// In a grid that is given.
  PlacedModel placed(vtkAtriaGridAlgorithm& filter, const GridFrame& frame) const;
};

SiteOptions siteOptionsOf(vtkAtriaGridAlgorithm& filter);
GridOptions sizesOf(vtkAtriaGridAlgorithm& filter);
SurfaceModel surfaceModelOf(vtkAtriaGridAlgorithm& filter, const PlacedModel& placed, const RunContext& context);
/// The rules of the filter's properties, with boxes along the grid's axes. Throws Error for those that are no rules.
SizingOptions sizingOf(vtkAtriaGridAlgorithm& filter, const Placement& grid);

/// `data` may be null: a domain without surfaces.
GridInput readGridInput(vtkDataObject* data);

/// Adds the field array SizingWarning, with one text or none, and warns.
void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

} // namespace atria
