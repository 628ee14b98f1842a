// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOctreeSource.h"

#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/Refinement.h"
#include "PropertyRange.h"
#include "VtkOctree.h"

#include <vtkHyperTreeGrid.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGrid.h>

vtkStandardNewMacro(vtkAtriaOctreeSource);

namespace {

atria::GroundedInput groundedInput(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces,
                                   std::vector<std::string>& warnings)
{
  const atria::TriangleSurface surface = atria::readSurfaces(surfaces, warnings);
  return atria::groundModel(surface, atria::modelOptionsOf(filter, surfaces, surface));
}

} // namespace

vtkAtriaOctreeSource::vtkAtriaOctreeSource() = default;
vtkAtriaOctreeSource::~vtkAtriaOctreeSource() = default;

int vtkAtriaOctreeSource::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

void vtkAtriaOctreeSource::CheckProperties()
{
  this->Superclass::CheckProperties();
  atriaCheckRange(OutputType);
}

int vtkAtriaOctreeSource::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkAtriaOctreeSource::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const char* wanted = this->OutputType == HyperTreeGrid ? "vtkHyperTreeGrid" : "vtkUnstructuredGrid";
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject* present = vtkDataObject::GetData(info);
  if (!present || !present->IsA(wanted))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    if (this->OutputType == HyperTreeGrid)
    {
      fresh = vtkSmartPointer<vtkHyperTreeGrid>::New();
    }
    else
    {
      fresh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    }
    info->Set(vtkDataObject::DATA_OBJECT(), fresh);
    this->GetOutputPortInformation(0)->Set(vtkDataObject::DATA_EXTENT_TYPE(), fresh->GetExtentType());
  }
  return 1;
}

int vtkAtriaOctreeSource::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  atria::clearOutputs(outputs);
  return atria::runFilter(*this, outputs, "", [&](const atria::RunContext& context) {
    context.progress.report(0.0, "Reading surfaces");
    std::vector<std::string> warnings;
    const atria::GroundedInput grounded = groundedInput(*this, vtkDataObject::GetData(inputs[0]), warnings);
    const auto& [surface, options, ground] = grounded;
    const atria::SitePlan plan = atria::planSite(surface, options);
    atria::addTo(warnings, atria::checkDomain(surface, plan, options));
    atria::addTo(warnings, ground.warnings);
    const atria::PlacedModel placed = atria::placeModel(surface, plan, options);
    context.progress.report(0.02, "Repairing surfaces");
    const atria::SurfaceModel model = atria::makeSurfaceModel(placed, options, context.part(0.02, 0.1));
    const atria::SizedOctants sized = atria::sizeOctants(model, placed.frame, options, context.part(0.1, 0.5));
    const atria::Octree octree = atria::buildOctree(model, placed.frame, sized, context.part(0.5, 0.8));
    context.progress.report(0.8, "Converting octants");
    if (auto* trees = vtkHyperTreeGrid::SafeDownCast(output))
    {
      atria::octreeToVtk(octree, trees);
    }
    else
    {
      atria::octreeToVtk(octree, vtkUnstructuredGrid::SafeDownCast(output));
    }
    atria::addInputWarnings(warnings, *this, output);
    atria::addSizingWarning(sized.warning, *this, output);
    context.progress.report(1.0, "Octree made");
  });
}

bool vtkAtriaOctreeSource::Estimate()
{
  this->EstimatedOctants.clear();
  this->EstimatedElements = 0;
  this->EstimatedBytes = 0;
  this->EstimateIsTooLarge = false;
  this->EstimateWarning.clear();
  return atria::onCurrentInput(*this, {}, [&](vtkDataObject* surfaces) {
    this->CheckProperties();
    this->SetAbortExecute(0);
    const atria::AlgorithmRun run(*this);
    const atria::RunContext& context = run.context;
    context.progress.report(0.0, "Estimating");
    std::vector<std::string> warnings;
    const atria::GroundedInput grounded = groundedInput(*this, surfaces, warnings);
    const auto& [surface, options, ground] = grounded;
    const atria::SitePlan plan = atria::planSite(surface, options);
    atria::addTo(warnings, atria::checkDomain(surface, plan, options));
    atria::addTo(warnings, ground.warnings);
    const atria::PlacedModel placed = atria::placeModel(surface, plan, options);
    const atria::GridFrame& frame = placed.frame;
    const atria::MeshEstimate estimate =
        atria::estimateElements(atria::makeSurfaceModel(placed, options, context), frame, options, context);
    for (std::size_t level = 0; level < estimate.octants.size(); ++level)
    {
      this->EstimatedOctants.emplace_back(frame.sizeOf(static_cast<int>(level)),
                                          static_cast<vtkIdType>(estimate.octants[level]));
    }
    this->EstimatedElements = static_cast<vtkIdType>(estimate.elements);
    this->EstimatedBytes = static_cast<vtkTypeInt64>(estimate.bytes);
    this->EstimateIsTooLarge = estimate.isTooLarge;
    warnings.push_back(estimate.warning);
    for (const std::string& text : warnings)
    {
      const bool both = !this->EstimateWarning.empty() && !text.empty();
      this->EstimateWarning += (both ? "\n" : "") + text;
    }
  });
}

vtkIdType vtkAtriaOctreeSource::GetEstimatedOctants(int level)
{
  return level >= 0 && level < this->GetNumberOfEstimatedLevels() ? this->EstimatedOctants[level].second : 0;
}

double vtkAtriaOctreeSource::GetEstimatedOctantSize(int level)
{
  return level >= 0 && level < this->GetNumberOfEstimatedLevels() ? this->EstimatedOctants[level].first : 0.0;
}

void vtkAtriaOctreeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputType: " << this->OutputType << "\n";
}
