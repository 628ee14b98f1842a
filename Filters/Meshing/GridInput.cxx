// SPDX-License-Identifier: GPL-3.0-or-later
#include "GridInput.h"

#include "Domain/Domain.h"
#include "Support/Error.h"
#include "VtkSurface.h"
#include "vtkAtriaGridAlgorithm.h"

#include <utility>

namespace atria {

namespace {

/// How exactly points are taken for one, and for lying on a side, against the finest octant.
constexpr double weldRatio = 1e-5;
constexpr double sideRatio = 1e-4;
/// Gaps closed where the filter says none, against the finest octant.
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
  return makeGridFrame(options, boundsOf(surface));
}

SurfaceModel GridInput::model(vtkAtriaGridAlgorithm& filter, const GridFrame& frame) const
{
  FeatureOptions options;
  options.featureAngle = filter.GetFeatureAngle();
  options.weldDistance = weldRatio * frame.finestSize;
  options.sideDistance = sideRatio * frame.finestSize;
  options.gapTolerance = filter.GetGapTolerance() < 0.0 ? gapRatio * frame.finestSize : filter.GetGapTolerance();
  return makeSurfaceModel(surface, frame, options);
}

} // namespace atria
