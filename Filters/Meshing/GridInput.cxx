// SPDX-License-Identifier: GPL-3.0-or-later
#include "GridInput.h"

#include "Domain/Domain.h"
#include "Octree/SizeRules.h"
#include "Support/Error.h"
#include "VtkSurface.h"
#include "vtkAtriaGridAlgorithm.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <utility>

namespace atria {

namespace {

/// How exactly points are taken for one, and for lying on a side, against octants of SizeMin.
constexpr double weldRatio = 1e-5;
constexpr double sideRatio = 1e-4;

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

SizingOptions sizingOf(vtkAtriaGridAlgorithm& filter)
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
    options.boxes.push_back({{Vec3(v[0], v[2], v[4]), Vec3(v[1], v[3], v[5])}, v[6]});
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

Box3 GridInput::domain(vtkAtriaGridAlgorithm& filter) const
{
  Box3 box;
  switch (filter.GetDomainMode())
  {
    case vtkAtriaGridAlgorithm::Explicit: {
      const double* b = filter.GetDomainBounds();
      box.min = Vec3(b[0], b[2], b[4]);
      box.max = Vec3(b[1], b[3], b[5]);
      return box;
    }
    case vtkAtriaGridAlgorithm::Site:
      return siteDomain(surface, filter.GetSiteName());
    default:
      box = boundsOf(surface);
      if (box.empty())
      {
        throw Error("there are no surfaces to take the domain from: connect some, or give DomainBounds with DomainMode "
                    "Explicit");
      }
      return box;
  }
}

GridFrame GridInput::frame(vtkAtriaGridAlgorithm& filter) const
{
  GridOptions options;
  options.domain = this->domain(filter);
  options.sizeMin = filter.GetSizeMin();
  options.sizeMid = filter.GetSizeMid();
  options.sizeMax = filter.GetSizeMax();
  options.startLevel = filter.GetStartLevel();
  options.finestAsked = finestSizeOf(sizingOf(filter));
  return makeGridFrame(options, boundsOf(surface));
}

SurfaceModel GridInput::model(vtkAtriaGridAlgorithm& filter, const GridFrame& frame) const
{
  FeatureOptions options;
  options.featureAngle = filter.GetFeatureAngle();
  options.weldDistance = weldRatio * frame.sizeOf(frame.featureLevel);
  options.sideDistance = sideRatio * frame.sizeOf(frame.featureLevel);
  return makeSurfaceModel(surface, frame, options);
}

} // namespace atria
