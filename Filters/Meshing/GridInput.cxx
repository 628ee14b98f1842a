// SPDX-License-Identifier: GPL-3.0-or-later
#include "GridInput.h"

#include "Octree/Sizing/SizeRules.h"
#include "VtkSurface.h"
#include "vtkAtriaGridAlgorithm.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <utility>

namespace atria {

namespace {

/// Gaps closed where the filter says none, against SizeMin.
constexpr double gapRatio = 0.05;

} // namespace

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

SizingOptions sizingOf(vtkAtriaGridAlgorithm& filter, const Placement& grid)
{
  SizingOptions options;
  for (int i = 0; i < filter.GetNumberOfSurfaceSizes(); ++i)
  {
    options.surfaceSizes.push_back(surfaceSizeFrom(filter.GetSurfaceSize(i)));
  }
  for (int i = 0; i < filter.GetNumberOfRefinementBoxes(); ++i)
  {
    double v[7];
    filter.GetRefinementBox(i, v);
    // In a turned grid, the box along its axes that holds the one given.
    const PlacedBox box{Placement(), {Vec3(v[0], v[2], v[4]), Vec3(v[1], v[3], v[5])}};
    options.boxes.push_back({boundsAlong(grid, box), v[6]});
  }
  for (int i = 0; i < filter.GetNumberOfDistanceSizes(); ++i)
  {
    const std::vector<DistanceSize> sizes = distanceSizesFrom(filter.GetDistanceSize(i));
    options.distanceSizes.insert(options.distanceSizes.end(), sizes.begin(), sizes.end());
  }
  options.curvatureAngle = filter.GetCurvatureAngle();
  options.cellsAcrossGap = filter.GetCellsAcrossGap();
  options.cellsPerLevel = filter.GetCellsPerLevel();
  options.maxElements = static_cast<std::size_t>(filter.GetMaxElements());
  return options;
}

void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out)
{
  vtkNew<vtkStringArray> texts;
  texts->SetName("SizingWarning");
  if (!warning.empty())
  {
    texts->InsertNextValue(warning);
    vtkWarningWithObjectMacro(&filter, << warning);
  }
  out->GetFieldData()->AddArray(texts);
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
  options.finestAsked = finestSizeOf(sizingOf(filter, {}));
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

SurfaceModel surfaceModelOf(vtkAtriaGridAlgorithm& filter, const PlacedModel& placed, const RunContext& context)
{
  FeatureOptions options;
  options.featureAngle = filter.GetFeatureAngle();
  const double size = placed.frame.sizeOf(placed.frame.featureLevel);
  options.weldDistance = weldRatio * size;
  options.sideDistance = sideRatio * size;
  options.gapTolerance = filter.GetGapTolerance() < 0.0 ? gapRatio * size : filter.GetGapTolerance();
  return makeSurfaceModel(placed.surface, placed.frame, options, context);
}

} // namespace atria
