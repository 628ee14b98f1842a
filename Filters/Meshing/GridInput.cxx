// SPDX-License-Identifier: GPL-3.0-or-later
#include "GridInput.h"

#include "VtkSurface.h"
#include "vtkAtriaGridAlgorithm.h"

#include <utility>

namespace atria {

GridInput readGridInput(vtkDataObject* data)
{
  GridInput input;
  if (data)
  {
    VtkSurface read = surfaceFromVtk({data});
    input.surface = std::move(read.surface);
    input.ignoredCells = read.ignoredCells;
  }
  return input;
}

SiteOptions siteOptionsOf(vtkAtriaGridAlgorithm& filter)
{
  SiteOptions options;
  options.mode = static_cast<DomainMode>(filter.GetDomainMode());
  const double* b = filter.GetDomainBounds();
  options.bounds = {Vec3(b[0], b[2], b[4]), Vec3(b[1], b[3], b[5])};
  options.domainAngle = filter.GetDomainAngle();
  options.windAngle = filter.GetWindAngle();
  options.site = filter.GetSiteName();
  options.terrain = filter.GetTerrainName();
  options.alignment = static_cast<GridAlignment>(filter.GetAlignGrid());
  return options;
}

GridOptions sizesOf(vtkAtriaGridAlgorithm& filter)
{
  GridOptions options;
  options.sizeMin = filter.GetSizeMin();
  options.sizeMid = filter.GetSizeMid();
  options.sizeMax = filter.GetSizeMax();
  options.startLevel = filter.GetStartLevel();
  return options;
}

PlacedModel GridInput::placed(vtkAtriaGridAlgorithm& filter) const
{
  const GridOptions sizes = sizesOf(filter);
  return placeModel(surface, planSite(surface, siteOptionsOf(filter), sizes), sizes);
}

PlacedModel GridInput::placed(vtkAtriaGridAlgorithm& filter, const GridFrame& frame) const
{
  return placeModel(surface, siteOptionsOf(filter), frame);
}

SurfaceModel surfaceModelOf(vtkAtriaGridAlgorithm& filter, const PlacedModel& placed)
{
  FeatureOptions options;
  options.featureAngle = filter.GetFeatureAngle();
  options.weldDistance = weldRatio * placed.frame.finestSize;
  options.sideDistance = sideRatio * placed.frame.finestSize;
  return makeSurfaceModel(placed.surface, placed.frame, options);
}

} // namespace atria
