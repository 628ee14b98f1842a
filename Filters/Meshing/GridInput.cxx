// SPDX-License-Identifier: GPL-3.0-or-later
#include "GridInput.h"

#include "AddArray.h"
#include "Mesher/SuggestedSizes.h"
#include "Octree/Sizing/SizeRules.h"
#include "Ranks/Ranks.h"
#include "Support/Error.h"
#include "Support/MachineMemory.h"
#include "Support/Progress.h"
#include "VtkSurface.h"
#include "vtkAtriaGridAlgorithm.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkMultiProcessController.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <string>
#include <utility>

namespace atria {

namespace {

/// Returns the memory that meshing may take, in bytes: the filter's MemoryLimit, or what the machine allows.
std::size_t memoryLimitOf(vtkAtriaGridAlgorithm& filter)
{
  const double bytes = 1e9 * filter.GetMemoryLimit();
  if (!(bytes > 0.0))
  {
    return memoryOfMachine();
  }
  return bytes < static_cast<double>(unlimitedMemory) ? std::max<std::size_t>(static_cast<std::size_t>(bytes), 1)
                                                      : unlimitedMemory;
}

SizingOptions sizingOf(vtkAtriaGridAlgorithm& filter)
{
  SizingOptions options;
  for (int i = 0; i < filter.GetNumberOfSurfaceSizeRules(); ++i)
  {
    options.surfaceSizes.push_back(surfaceSizeFrom(filter.GetSurfaceSizeRule(i)));
  }
  for (int i = 0; i < filter.GetNumberOfRefinementBoxes(); ++i)
  {
    double v[7];
    filter.GetRefinementBox(i, v);
    const Box3 box{Vec3(v[0], v[2], v[4]), Vec3(v[1], v[3], v[5])};
    if (box.empty())
    {
      throw Error("refinement box " + std::to_string(i + 1) + " is empty: give bounds with min < max on every axis");
    }
    options.boxes.push_back({box, v[6]});
  }
  for (int i = 0; i < filter.GetNumberOfDistanceSizeRules(); ++i)
  {
    const std::vector<DistanceSize> sizes = distanceSizesFrom(filter.GetDistanceSizeRule(i));
    options.distanceSizes.insert(options.distanceSizes.end(), sizes.begin(), sizes.end());
  }
  options.curvatureAngle = filter.GetCurvatureAngle();
  options.cellsAcrossGap = filter.GetCellsAcrossGap();
  options.cellsPerLevel = filter.GetCellsPerLevel();
  options.hexahedra = filter.GetElementType() == vtkAtriaGridAlgorithm::Hexahedral;
  options.maxElements = static_cast<std::size_t>(filter.GetMaxElements());
  options.memoryLimit = memoryLimitOf(filter);
  return options;
}

void addWarnings(const char* name, const std::vector<std::string>& warnings, vtkAtriaGridAlgorithm& filter,
                 vtkDataObject* out)
{
  addArrayOf<vtkStringArray>(out->GetFieldData(), name, warnings);
  for (const std::string& warning : warnings)
  {
    vtkWarningWithObjectMacro(&filter, << warning);
  }
}

SiteOptions siteOptionsOf(vtkAtriaGridAlgorithm& filter)
{
  SiteOptions options;
  options.mode = static_cast<DomainMode>(filter.GetDomainMode());
  const double* b = filter.GetDomainBounds();
  options.bounds = {Vec3(b[0], b[2], b[4]), Vec3(b[1], b[3], b[5])};
  options.domainSides = filter.GetDomainSides();
  for (int i = 0; i < filter.GetNumberOfDomainCorners(); ++i)
  {
    Vec2 corner;
    filter.GetDomainCorner(i, corner.data());
    options.polygon.push_back(corner);
  }
  options.domainAngle = filter.GetDomainAngle();
  options.windAngle = filter.GetWindAngle();
  options.site = filter.GetSiteName();
  options.terrain = filter.GetTerrainName();
  options.groundSnapRatio = filter.GetGroundSnapRatio();
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

} // namespace

ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces)
{
  ModelOptions options;
  options.site = siteOptionsOf(filter);
  options.site.grounds = surfaces ? groundNamesFromVtk(surfaces) : std::vector<std::string>();
  options.sizes = sizesOf(filter);
  options.sizing = sizingOf(filter);
  options.featureAngle = filter.GetFeatureAngle();
  if (filter.GetGapTolerance() >= 0.0)
  {
    options.gapTolerance = filter.GetGapTolerance();
  }
  options.smallPartSize = filter.GetSmallPartSize();
  for (int i = 0; i < filter.GetNumberOfFaceZones(); ++i)
  {
    options.faceZones.push_back(filter.GetFaceZone(i));
  }
  options.findOpenings = filter.GetFindOpenings();
  for (int i = 0; i < filter.GetNumberOfSurfacesWithoutOpenings(); ++i)
  {
    options.withoutOpenings.push_back(filter.GetSurfaceWithoutOpenings(i));
  }
  for (int i = 0; i < filter.GetNumberOfCellZones(); ++i)
  {
    options.cellZones.push_back(filter.GetCellZone(i));
  }
  return options;
}

ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces, const TriangleSurface& surface)
{
  ModelOptions options = modelOptionsOf(filter, surfaces);
  options.sizes = completeSizes(surface, options);
  return options;
}

bool onCurrentInput(vtkAtriaGridAlgorithm& filter, std::span<double> values,
                    const std::function<void(vtkDataObject*)>& work)
{
  const bool isConnected = filter.GetNumberOfInputConnections(0) > 0;
  const Ranks ranks(isConnected ? filter.GetInputInformation(0, 0) : nullptr);
  if (isConnected)
  {
    filter.GetInputAlgorithm(0, 0)->Update();
  }
  const int done = ranks.run(filter, [&] {
    try
    {
      work(isConnected ? filter.GetInputDataObject(0, 0) : nullptr);
      return 1;
    }
    catch (const Aborted&)
    {
      return 0;
    }
    catch (const std::exception& error)
    {
      vtkErrorWithObjectMacro(&filter, << error.what());
      return 0;
    }
  });
  ranks.share(values);
  return done == 1;
}

TriangleSurface readSurfaces(vtkDataObject* data, std::vector<std::string>& warnings)
{
  if (!data)
  {
    return {};
  }
  VtkSurface read = surfaceFromVtk({data});
  if (const double rounding = read.singlePrecision ? coarseRounding(read.surface) : 0.0; rounding > 0.0)
  {
    std::ostringstream text;
    text.precision(2);
    text << "the model's points are in single precision, and so far from the origin that they are off by up to "
         << rounding << " m: move the model to the origin before it is exported, or read it with a reader of Atria";
    warnings.push_back(text.str());
  }
  return std::move(read.surface);
}

namespace {

/// Joins names, each followed by a zero byte.
std::string joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += name + '\0';
  }
  return text;
}

std::vector<std::string> parted(const std::string& text)
{
  std::vector<std::string> names;
  for (std::size_t first = 0; first < text.size(); first = text.find('\0', first) + 1)
  {
    names.emplace_back(text.c_str() + first);
  }
  return names;
}

} // namespace

SharedSurfaces readSurfacesOnRanks(vtkDataObject* own, vtkMultiProcessController& controller, RankExchange& exchange)
{
  const vtkSmartPointer<vtkDataObject> whole = gatherWhole(own, controller);
  SharedSurfaces out{{}, {}, modelOffsetOf(whole), {}};
  Bytes told; // filled by the first rank only
  if (exchange.rank() == 0)
  {
    out.surface = readSurfaces(whole, out.warnings);
    out.grounds = whole ? groundNamesFromVtk(whole) : std::vector<std::string>();
    told = bytesOf(out.surface.points, out.surface.triangles, out.surface.surfaceIds, joined(out.surface.names),
                   joined(out.grounds), out.offset);
  }
  const std::vector<Bytes> received = exchange.gather(told);
  if (exchange.rank() > 0)
  {
    std::string names;
    std::string grounds;
    readBytes(received.front(), out.surface.points, out.surface.triangles, out.surface.surfaceIds, names, grounds,
              out.offset);
    out.surface.names = parted(names);
    out.grounds = parted(grounds);
  }
  return out;
}

Vec3 modelOffsetOf(vtkDataObject* surfaces)
{
  vtkDataArray* given = surfaces ? surfaces->GetFieldData()->GetArray("ModelOffset") : nullptr;
  const bool isGiven = given && given->GetNumberOfValues() == 3;
  return isGiven ? Vec3(given->GetTuple3(0)) : Vec3(Vec3::Zero());
}

void addTo(std::vector<std::string>& warnings, const std::vector<std::string>& more)
{
  warnings.insert(warnings.end(), more.begin(), more.end());
}

void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out)
{
  addWarnings("SizingWarning", warning.empty() ? std::vector<std::string>() : std::vector{warning}, filter, out);
}

void addInputNotes(const std::vector<std::string>& notes, vtkDataObject* out)
{
  addArrayOf<vtkStringArray>(out->GetFieldData(), "InputNote", notes);
}

void addInputWarnings(const std::vector<std::string>& warnings, vtkAtriaGridAlgorithm& filter, vtkDataObject* out)
{
  addWarnings("InputWarning", warnings, filter, out);
}

} // namespace atria
