// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaGridAlgorithm.h"

#include "Grid/Prism.h"
#include "GridInput.h"
#include "Mesher/SuggestedSizes.h"
#include "Octree/Sizing/SizeRules.h"
#include "PropertyLists.h"
#include "PropertyRange.h"
#include "Ranks/Ranks.h"

#include <vtkDemandDrivenPipeline.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>

#include <algorithm>
#include <array>
#include <exception>

vtkAtriaGridAlgorithm::vtkAtriaGridAlgorithm()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

vtkAtriaGridAlgorithm::~vtkAtriaGridAlgorithm() = default;

void vtkAtriaGridAlgorithm::SetInputData(vtkDataObject* data) { this->SetInputDataInternal(0, data); }

void vtkAtriaGridAlgorithm::SetInputData(int port, vtkDataObject* data) { this->SetInputDataInternal(port, data); }

bool vtkAtriaGridAlgorithm::CompleteSizes() { return this->FillSizes(this->SizeMax, this->SizeMid, this->SizeMin); }

bool vtkAtriaGridAlgorithm::SuggestSizes() { return this->FillSizes(0.0, 0.0, 0.0); }

bool vtkAtriaGridAlgorithm::FillSizes(double sizeMax, double sizeMid, double sizeMin)
{
  std::array<double, 3> sizes{};
  const bool completed = atria::onCurrentInput(*this, sizes, [&](vtkDataObject* input) {
    std::vector<std::string> warnings; // the run repeats them
    atria::ModelOptions options = atria::modelOptionsOf(*this, input);
    options.sizes.sizeMax = sizeMax;
    options.sizes.sizeMid = sizeMid;
    options.sizes.sizeMin = sizeMin;
    const atria::GridOptions found = atria::completeSizes(atria::readSurfaces(input, warnings), options);
    sizes = {found.sizeMax, found.sizeMid, found.sizeMin};
  });
  if (completed)
  {
    this->SetSizeMax(sizes[0]);
    this->SetSizeMid(sizes[1]);
    this->SetSizeMin(sizes[2]);
  }
  return completed;
}

vtkTypeBool vtkAtriaGridAlgorithm::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return atria::processOnRanks(
      *this, request, inputs, outputs, [&] { return this->ProcessRequestHere(request, inputs, outputs); },
      this->GetDealtOutputs(),
      [&](vtkMultiProcessController& controller) { return this->RequestDataOnRanks(controller, inputs, outputs); });
}

std::optional<int> vtkAtriaGridAlgorithm::RequestDataOnRanks(vtkMultiProcessController&, vtkInformationVector**,
                                                             vtkInformationVector*)
{
  return std::nullopt;
}

atria::DealtOutputs vtkAtriaGridAlgorithm::GetDealtOutputs() const { return {}; }

vtkTypeBool vtkAtriaGridAlgorithm::ProcessRequestHere(vtkInformation* request, vtkInformationVector** inputs,
                                                      vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputs, outputs);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    try
    {
      this->CheckProperties();
    }
    catch (const std::exception& error)
    {
      vtkErrorMacro(<< error.what());
      return 0;
    }
    return this->RequestData(request, inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

void vtkAtriaGridAlgorithm::CheckProperties()
{
  atriaCheckRange(SizeMax);
  atriaCheckRange(SizeMid);
  atriaCheckRange(SizeMin);
  atriaCheckRange(StartLevel);
  atriaCheckRange(FeatureAngle);
  atriaCheckRange(CurvatureAngle);
  atriaCheckRange(CellsAcrossGap);
  atriaCheckRange(CellsPerLevel);
  atriaCheckRange(ElementType);
  atriaCheckRange(MaxElements);
  atriaCheckRange(MemoryLimit);
  atriaCheckRange(GapTolerance);
  atriaCheckRange(SmallPartSize);
  atriaCheckRange(DomainMode);
  atriaCheckRange(DomainAngle);
  atriaCheckRange(DomainSides);
  atriaCheckRange(WindAngle);
  atriaCheckRange(AlignGrid);
  atriaCheckRange(GroundSnapRatio);
}

int vtkAtriaGridAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != 0)
  {
    return 0;
  }
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

void vtkAtriaGridAlgorithm::AddSurfaceSizeRule(const std::string& pattern, double size)
{
  this->AddSurfaceSizeRule(atria::textOf(atria::SurfaceSize{pattern, size, {}}).c_str());
}

void vtkAtriaGridAlgorithm::AddSurfaceSizeRule(const std::string& pattern, double size, double featureSize)
{
  this->AddSurfaceSizeRule(atria::textOf(atria::SurfaceSize{pattern, size, featureSize}).c_str());
}

void vtkAtriaGridAlgorithm::AddSurfaceSizeRule(const char* rule)
{
  atria::addText(*this, this->SurfaceSizeRules, rule);
}
int vtkAtriaGridAlgorithm::GetNumberOfSurfaceSizeRules() { return atria::numberOf(this->SurfaceSizeRules); }
std::string vtkAtriaGridAlgorithm::GetSurfaceSizeRule(int i) { return atria::entryAt(this->SurfaceSizeRules, i); }
void vtkAtriaGridAlgorithm::RemoveAllSurfaceSizeRules() { atria::removeAll(*this, this->SurfaceSizeRules); }

void vtkAtriaGridAlgorithm::AddRefinementBox(const double b[6], double size)
{
  this->RefinementBoxes.push_back({b[0], b[1], b[2], b[3], b[4], b[5], size});
  this->Modified();
}

void vtkAtriaGridAlgorithm::AddRefinementBox(double x0, double x1, double y0, double y1, double z0, double z1,
                                             double size)
{
  const double bounds[6] = {x0, x1, y0, y1, z0, z1};
  this->AddRefinementBox(bounds, size);
}

int vtkAtriaGridAlgorithm::GetNumberOfRefinementBoxes() { return atria::numberOf(this->RefinementBoxes); }

void vtkAtriaGridAlgorithm::GetRefinementBox(int i, double boundsAndSize[7])
{
  if (i < 0 || i >= this->GetNumberOfRefinementBoxes())
  {
    vtkErrorMacro("There is no refinement box " << i << ".");
    return;
  }
  std::copy(this->RefinementBoxes[i].begin(), this->RefinementBoxes[i].end(), boundsAndSize);
}

void vtkAtriaGridAlgorithm::RemoveAllRefinementBoxes() { atria::removeAll(*this, this->RefinementBoxes); }

void vtkAtriaGridAlgorithm::AddDistanceSizeRule(const std::string& pattern, double distance, double size)
{
  this->AddDistanceSizeRule(atria::textOf(atria::DistanceSize{pattern, distance, size}).c_str());
}

void vtkAtriaGridAlgorithm::AddDistanceSizeRule(const char* rule)
{
  atria::addText(*this, this->DistanceSizeRules, rule);
}
int vtkAtriaGridAlgorithm::GetNumberOfDistanceSizeRules() { return atria::numberOf(this->DistanceSizeRules); }
std::string vtkAtriaGridAlgorithm::GetDistanceSizeRule(int i) { return atria::entryAt(this->DistanceSizeRules, i); }
void vtkAtriaGridAlgorithm::RemoveAllDistanceSizeRules() { atria::removeAll(*this, this->DistanceSizeRules); }

void vtkAtriaGridAlgorithm::AddFaceZone(const char* pattern) { atria::addText(*this, this->FaceZones, pattern); }
int vtkAtriaGridAlgorithm::GetNumberOfFaceZones() { return atria::numberOf(this->FaceZones); }
std::string vtkAtriaGridAlgorithm::GetFaceZone(int i) { return atria::entryAt(this->FaceZones, i); }
void vtkAtriaGridAlgorithm::RemoveAllFaceZones() { atria::removeAll(*this, this->FaceZones); }

void vtkAtriaGridAlgorithm::AddSurfaceWithoutOpenings(const char* pattern)
{
  atria::addText(*this, this->SurfacesWithoutOpenings, pattern);
}
int vtkAtriaGridAlgorithm::GetNumberOfSurfacesWithoutOpenings()
{
  return atria::numberOf(this->SurfacesWithoutOpenings);
}
std::string vtkAtriaGridAlgorithm::GetSurfaceWithoutOpenings(int i)
{
  return atria::entryAt(this->SurfacesWithoutOpenings, i);
}
void vtkAtriaGridAlgorithm::RemoveAllSurfacesWithoutOpenings()
{
  atria::removeAll(*this, this->SurfacesWithoutOpenings);
}

void vtkAtriaGridAlgorithm::AddCellZone(const char* pattern) { atria::addText(*this, this->CellZones, pattern); }
int vtkAtriaGridAlgorithm::GetNumberOfCellZones() { return atria::numberOf(this->CellZones); }
std::string vtkAtriaGridAlgorithm::GetCellZone(int i) { return atria::entryAt(this->CellZones, i); }
void vtkAtriaGridAlgorithm::RemoveAllCellZones() { atria::removeAll(*this, this->CellZones); }

void vtkAtriaGridAlgorithm::AddDomainCorner(double x, double y)
{
  this->DomainPolygon.push_back({x, y});
  this->Modified();
}

int vtkAtriaGridAlgorithm::GetNumberOfDomainCorners() { return atria::numberOf(this->DomainPolygon); }

void vtkAtriaGridAlgorithm::GetDomainCorner(int i, double corner[2])
{
  if (i < 0 || i >= this->GetNumberOfDomainCorners())
  {
    vtkErrorMacro("There is no domain corner " << i << ".");
    return;
  }
  std::copy(this->DomainPolygon[i].begin(), this->DomainPolygon[i].end(), corner);
}

void vtkAtriaGridAlgorithm::RemoveAllDomainCorners() { atria::removeAll(*this, this->DomainPolygon); }

void vtkAtriaGridAlgorithm::SetDomainCylinder(double x, double y, double radius, double bottom, double top)
{
  const atria::Box3 box = atria::boundsAboutCircle({x, y}, radius, this->DomainSides, bottom, top);
  this->SetDomainBounds(box.min[0], box.max[0], box.min[1], box.max[1], box.min[2], box.max[2]);
  this->SetDomainModeToExplicit();
}

//------------------------------------------------------------------------------
void vtkAtriaGridAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SizeMax: " << this->SizeMax << "\n";
  os << indent << "SizeMid: " << this->SizeMid << "\n";
  os << indent << "SizeMin: " << this->SizeMin << "\n";
  os << indent << "StartLevel: " << this->StartLevel << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  for (const std::string& rule : this->SurfaceSizeRules)
  {
    os << indent << "SurfaceSizeRule: " << rule << "\n";
  }
  for (const auto& box : this->RefinementBoxes)
  {
    os << indent << "RefinementBox:";
    std::for_each(box.begin(), box.end(), [&](double value) { os << " " << value; });
    os << "\n";
  }
  for (const std::string& rule : this->DistanceSizeRules)
  {
    os << indent << "DistanceSizeRule: " << rule << "\n";
  }
  for (const std::string& pattern : this->FaceZones)
  {
    os << indent << "FaceZone: " << pattern << "\n";
  }
  for (const std::string& pattern : this->CellZones)
  {
    os << indent << "CellZone: " << pattern << "\n";
  }
  os << indent << "FindOpenings: " << (this->FindOpenings ? "on" : "off") << "\n";
  for (const std::string& pattern : this->SurfacesWithoutOpenings)
  {
    os << indent << "SurfaceWithoutOpenings: " << pattern << "\n";
  }
  os << indent << "CurvatureAngle: " << this->CurvatureAngle << "\n";
  os << indent << "CellsAcrossGap: " << this->CellsAcrossGap << "\n";
  os << indent << "CellsPerLevel: " << this->CellsPerLevel << "\n";
  os << indent << "ElementType: " << this->ElementType << "\n";
  os << indent << "MaxElements: " << this->MaxElements << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "GapTolerance: " << this->GapTolerance << "\n";
  os << indent << "SmallPartSize: " << this->SmallPartSize << "\n";
  os << indent << "DomainMode: " << this->DomainMode << "\n";
  os << indent << "DomainBounds:";
  for (const double bound : this->DomainBounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "DomainAngle: " << this->DomainAngle << "\n";
  os << indent << "DomainSides: " << this->DomainSides << "\n";
  for (const auto& [x, y] : this->DomainPolygon)
  {
    os << indent << "DomainCorner: " << x << " " << y << "\n";
  }
  os << indent << "WindAngle: " << this->WindAngle << "\n";
  os << indent << "SiteName: " << this->SiteName << "\n";
  os << indent << "TerrainName: " << this->TerrainName << "\n";
  os << indent << "AlignGrid: " << this->AlignGrid << "\n";
  os << indent << "GroundSnapRatio: " << this->GroundSnapRatio << "\n";
}
