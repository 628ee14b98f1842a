// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaDualMesher.h"

#include "AddArray.h"
#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "Layer/WallUnits.h"
#include "Mesher/MeshModel.h"
#include "Mesher/SuggestedSizes.h"
#include "PropertyLists.h"
#include "PropertyRange.h"
#include "Ranks/ControllerExchange.h"
#include "Ranks/DealtMesh.h"
#include "Ranks/Ranks.h"
#include "Ranks/VtkSharedMesh.h"
#include "Support/PatternRule.h"
#include "Support/StageClock.h"
#include "VtkDualMesh.h"
#include "VtkOctree.h"
#include "VtkRecordedPatches.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <limits>

vtkStandardNewMacro(vtkAtriaDualMesher);

namespace {

using Points = std::vector<std::array<double, 3>>;

void setPoint(Points& points, int i, double x, double y, double z)
{
  if (i >= static_cast<int>(points.size()))
  {
    points.resize(i + 1, {0.0, 0.0, 0.0});
  }
  points[i] = {x, y, z};
}

void printPoints(const Points& points, ostream& os, vtkIndent indent)
{
  for (const auto& p : points)
  {
    os << indent << "  " << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
}

std::vector<atria::Vec3> toCore(const Points& points)
{
  std::vector<atria::Vec3> out;
  for (const auto& p : points)
  {
    out.emplace_back(p[0], p[1], p[2]);
  }
  return out;
}

/// Adds field arrays of the whole mesh.
void addFields(const atria::MeshedModel& result, const atria::Vec3& offset, vtkUnstructuredGrid* volume)
{
  vtkFieldData* data = volume->GetFieldData();
  atria::addArrayOf<vtkIntArray>(data, "MaxLevel", std::array{result.maximumLevel});
  atria::addArray<vtkDoubleArray>(data, "ModelOffset", 3)->InsertNextTuple(offset.data());
}

/// Adds diagnostics, and warns. `warnings` are those of the input.
void reportTo(vtkPolyData* diagnostics, const atria::MeshedModel& result, std::vector<std::string> warnings,
              vtkAtriaDualMesher& filter)
{
  atria::diagnosticsToVtk(result, result.names, diagnostics);
  atria::addTo(warnings, result.inputWarnings);
  atria::addInputWarnings(warnings, filter, diagnostics);
  atria::addInputNotes(result.notes, diagnostics);
  atria::addSizingWarning(result.sizingWarning, filter, diagnostics);
  atria::repairToVtk(result.repair, diagnostics);
  atria::hiddenDetailToVtk(result.repair.hidden, result.names, diagnostics->GetFieldData());
  atria::auditToVtk(result, diagnostics->GetFieldData());
  atria::layersToVtk(result.layers, diagnostics);
  atria::roomsToVtk(result.rooms, result.names, diagnostics->GetFieldData());
}

/// Returns the layers for all surfaces, then the rules.
std::vector<atria::LayerRule> layerRulesOf(vtkAtriaDualMesher& filter)
{
  const atria::WallLayers all{filter.GetNumberOfLayers(), filter.GetFirstLayerHeight(), filter.GetLayerGrowth()};
  std::vector<atria::LayerRule> rules{{"*", all}};
  for (int i = 0; i < filter.GetNumberOfLayerRules(); ++i)
  {
    rules.push_back(atria::layerRuleFrom(filter.GetLayerRule(i), all));
  }
  return rules;
}

/// Returns the options of the filter. Sizes of 0 must still be completed.
atria::MesherOptions mesherOptionsOf(vtkAtriaDualMesher& filter, vtkDataObject* surfaces, const Points& seeds,
                                     const Points& sealedSeeds)
{
  atria::MesherOptions options;
  static_cast<atria::ModelOptions&>(options) = atria::modelOptionsOf(filter, surfaces);
  options.mesh.zoneRule = static_cast<atria::ZoneRule>(filter.GetZoneRule());
  options.mesh.seeds = toCore(seeds);
  options.mesh.sealedSeeds = toCore(sealedSeeds);
  options.mesh.layers = layerRulesOf(filter);
  options.mesh.supportElements = filter.GetSupportElements();
  options.mesh.curvedWalls = {filter.GetTargetNonOrthogonality(), filter.GetTargetSkewness()};
  options.mesh.crackTolerance = filter.GetCrackTolerance();
  options.mesh.blockSize = static_cast<std::size_t>(filter.GetBlockSize());
  return options;
}

} // namespace

vtkAtriaDualMesher::vtkAtriaDualMesher()
    : TargetNonOrthogonality(atria::CurvedWallTargets{}.nonOrthogonality),
      TargetSkewness(atria::CurvedWallTargets{}.skewness), CrackTolerance(atria::DualMeshOptions{}.crackTolerance),
      Cache(std::make_unique<atria::StageCache>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkAtriaDualMesher::~vtkAtriaDualMesher() = default;

void vtkAtriaDualMesher::AddSeed(double x, double y, double z)
{
  this->SeedPoints.push_back({x, y, z});
  this->Modified();
}

void vtkAtriaDualMesher::SetSeed(int i, double x, double y, double z)
{
  if (i < 0)
  {
    vtkErrorMacro("There is no seed " << i << ".");
    return;
  }
  setPoint(this->SeedPoints, i, x, y, z);
  this->Modified();
}

void vtkAtriaDualMesher::SetNumberOfSeeds(int count)
{
  this->SeedPoints.resize(std::max(count, 0), {0.0, 0.0, 0.0});
  this->Modified();
}

int vtkAtriaDualMesher::GetNumberOfSeeds() { return static_cast<int>(this->SeedPoints.size()); }

void vtkAtriaDualMesher::GetSeed(int i, double seed[3])
{
  if (i < 0 || i >= this->GetNumberOfSeeds())
  {
    vtkErrorMacro("There is no seed " << i << ".");
    return;
  }
  std::copy(this->SeedPoints[i].begin(), this->SeedPoints[i].end(), seed);
}

void vtkAtriaDualMesher::RemoveAllSeeds() { this->SetNumberOfSeeds(0); }

void vtkAtriaDualMesher::AddSealedSeed(double x, double y, double z)
{
  this->SealedSeedPoints.push_back({x, y, z});
  this->Modified();
}

void vtkAtriaDualMesher::SetSealedSeed(int i, double x, double y, double z)
{
  if (i < 0)
  {
    vtkErrorMacro("There is no sealed seed " << i << ".");
    return;
  }
  setPoint(this->SealedSeedPoints, i, x, y, z);
  this->Modified();
}

void vtkAtriaDualMesher::SetNumberOfSealedSeeds(int count)
{
  this->SealedSeedPoints.resize(std::max(count, 0), {0.0, 0.0, 0.0});
  this->Modified();
}

int vtkAtriaDualMesher::GetNumberOfSealedSeeds() { return static_cast<int>(this->SealedSeedPoints.size()); }

void vtkAtriaDualMesher::GetSealedSeed(int i, double seed[3])
{
  if (i < 0 || i >= this->GetNumberOfSealedSeeds())
  {
    vtkErrorMacro("There is no sealed seed " << i << ".");
    return;
  }
  std::copy(this->SealedSeedPoints[i].begin(), this->SealedSeedPoints[i].end(), seed);
}

void vtkAtriaDualMesher::RemoveAllSealedSeeds() { this->SetNumberOfSealedSeeds(0); }

void vtkAtriaDualMesher::AddLayerRule(const std::string& pattern, int layers)
{
  this->AddLayerRule(atria::textOf(atria::PatternRule{pattern, {static_cast<double>(layers)}}).c_str());
}

void vtkAtriaDualMesher::AddLayerRule(const std::string& pattern, int layers, double firstHeight, double growth)
{
  const atria::PatternRule rule{pattern, {static_cast<double>(layers), firstHeight, growth}};
  this->AddLayerRule(atria::textOf(rule).c_str());
}

void vtkAtriaDualMesher::AddLayerRule(const char* rule) { atria::addText(*this, this->LayerRules, rule); }
int vtkAtriaDualMesher::GetNumberOfLayerRules() { return atria::numberOf(this->LayerRules); }
std::string vtkAtriaDualMesher::GetLayerRule(int i) { return atria::entryAt(this->LayerRules, i); }
void vtkAtriaDualMesher::RemoveAllLayerRules() { atria::removeAll(*this, this->LayerRules); }

void vtkAtriaDualMesher::SetCacheStages(bool cache)
{
  this->CacheStages = cache; // not Modified: the mesh is the same
  if (!cache)
  {
    this->Cache->clear();
  }
}

int vtkAtriaDualMesher::GetNumberOfStages() { return static_cast<int>(this->Stages.size()); }

std::string vtkAtriaDualMesher::GetStageName(int i)
{
  return i >= 0 && i < this->GetNumberOfStages() ? this->Stages[i].first : std::string();
}

double vtkAtriaDualMesher::GetStageSeconds(int i)
{
  return i >= 0 && i < this->GetNumberOfStages() ? this->Stages[i].second : 0.0;
}

double vtkAtriaDualMesher::ComputeFirstLayerHeight(double yPlus, double speed)
{
  return yPlus > 0.0 && speed > 0.0 ? atria::heightAtYPlus(yPlus, speed) : std::numeric_limits<double>::quiet_NaN();
}

double vtkAtriaDualMesher::ComputeYPlus(double firstLayerHeight, double speed)
{
  return firstLayerHeight > 0.0 && speed > 0.0 ? atria::yPlusOf(firstLayerHeight, speed)
                                               : std::numeric_limits<double>::quiet_NaN();
}

vtkIdType vtkAtriaDualMesher::EstimateLayerElements()
{
  double elements = -1.0;
  const bool estimated = atria::onCurrentInput(*this, {&elements, 1}, [&](vtkDataObject* input) {
    this->CheckProperties();
    this->SetAbortExecute(0);
    const atria::AlgorithmRun run(*this);
    std::vector<std::string> warnings; // the run repeats them
    const atria::TriangleSurface surface = atria::readSurfaces(input, warnings);
    atria::MesherOptions options = mesherOptionsOf(*this, input, this->SeedPoints, this->SealedSeedPoints);
    options.sizes = atria::completeSizes(surface, options);
    elements = static_cast<double>(atria::estimateLayerElements(surface, options, run.context));
  });
  return estimated ? static_cast<vtkIdType>(elements) : -1;
}

void vtkAtriaDualMesher::CheckProperties()
{
  this->Superclass::CheckProperties();
  atriaCheckRange(ZoneRule);
  atriaCheckRange(NumberOfLayers);
  atriaCheckRange(FirstLayerHeight);
  atriaCheckRange(LayerGrowth);
  atriaCheckRange(TargetNonOrthogonality);
  atriaCheckRange(TargetSkewness);
  atriaCheckRange(CrackTolerance);
  atriaCheckRange(BlockSize);
}

atria::DealtOutputs vtkAtriaDualMesher::GetDealtOutputs() const
{
  return this->DistributeOutput ? atria::DealtOutputs{0, 1, true} : atria::DealtOutputs{};
}

int vtkAtriaDualMesher::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkAtriaDualMesher::FillOutputPortInformation(int port, vtkInformation* info)
{
  static const char* const types[3] = {"vtkUnstructuredGrid", "vtkPartitionedDataSetCollection", "vtkPolyData"};
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

int vtkAtriaDualMesher::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const auto ensure = [&](int port, auto* fresh) {
    vtkInformation* info = outputs->GetInformationObject(port);
    vtkDataObject* present = vtkDataObject::GetData(info);
    if (!present || !present->IsA(fresh->GetClassName()))
    {
      info->Set(vtkDataObject::DATA_OBJECT(), fresh);
    }
  };
  ensure(0, vtkNew<vtkUnstructuredGrid>().Get());
  ensure(1, vtkNew<vtkPartitionedDataSetCollection>().Get());
  ensure(2, vtkNew<vtkPolyData>().Get());
  return 1;
}

int vtkAtriaDualMesher::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* volume = vtkUnstructuredGrid::GetData(outputs, 0);
  auto* patches = vtkPartitionedDataSetCollection::GetData(outputs, 1);
  auto* diagnostics = vtkPolyData::GetData(outputs, 2);
  this->Stages.clear();
  atria::clearOutputs(outputs);
  return atria::runFilter(*this, outputs, "", [&](const atria::RunContext& context) {
    context.progress.report(0.0, "Reading surfaces");
    std::vector<std::string> warnings;
    const atria::TriangleSurface surface = atria::readSurfaces(vtkDataObject::GetData(inputs[0]), warnings);
    atria::MesherOptions options =
        mesherOptionsOf(*this, vtkDataObject::GetData(inputs[0]), this->SeedPoints, this->SealedSeedPoints);
    vtkDataObject* octree = vtkDataObject::GetData(inputs[1]);
    options.sizes = octree ? options.sizes : atria::completeSizes(surface, options);
    atria::StageCache* cache = this->CacheStages ? this->Cache.get() : nullptr;
    const atria::RunContext meshing = context.part(0.01, 0.9);
    const atria::MeshedModel result =
        octree ? atria::meshModel(surface, atria::octreeFromVtk(octree), options, meshing, cache)
               : atria::meshModel(surface, options, meshing, cache);
    atria::StageClock clock;
    context.progress.report(0.9, "Converting elements");
    atria::volumeToVtk(result.mesh, volume, context.executor);
    atria::roomsToVtk(result.rooms, volume);
    atria::cellZonesToVtk(result.mesh, result.names, result.kinds, volume, context.executor);
    context.progress.report(0.95, "Converting patches");
    atria::patchesToVtk(result.mesh, result.metSides, result.names, result.kinds, result.layers, patches);
    atria::recordPatches(patches, volume);
    reportTo(diagnostics, result, std::move(warnings), *this);
    clock.lap("output");
    addFields(result, atria::modelOffsetOf(vtkDataObject::GetData(inputs[0])), volume);
    this->Stages = result.stages;
    this->Stages.push_back(clock.stages().back());
    context.progress.report(1.0, "Mesh made");
  });
}

std::optional<int> vtkAtriaDualMesher::RequestDataOnRanks(vtkMultiProcessController& controller,
                                                          vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->BlockSize == 0 || inputs[1]->GetNumberOfInformationObjects() > 0)
  {
    return std::nullopt;
  }
  this->Stages.clear();
  const int ghostLevels = atria::ghostLevelsAsked(outputs, controller);
  return atria::runOnRanks(
      *this, outputs, controller, [&](atria::RankExchange& ranks, const atria::RunContext& context) {
        this->CheckProperties();
        atria::MesherOptions options = mesherOptionsOf(*this, nullptr, this->SeedPoints, this->SealedSeedPoints);
        // Machines of ranks may have different limits. The exchange also reports earlier errors to all ranks.
        options.sizing.memoryLimit = atria::gatherAll(ranks, options.sizing.memoryLimit).front();
        const atria::SharedSurfaces input =
            atria::readSurfacesOnRanks(vtkDataObject::GetData(inputs[0]), controller, ranks);
        options.site.grounds = input.grounds;
        options.sizes = atria::completeSizes(input.surface, options);
        std::optional<atria::SharedModel> made =
            atria::meshSharedModel(input.surface, options, ghostLevels, ranks, context.part(0.01, 0.9));
        if (!made)
        {
          return false;
        }
        atria::StageClock clock;
        context.progress.report(0.9, "Converting elements");
        auto* volume = vtkUnstructuredGrid::GetData(outputs, 0);
        auto* patches = vtkPartitionedDataSetCollection::GetData(outputs, 1);
        atria::sharedMeshToVtk(*made, ranks, context.executor, volume, patches);
        addFields(made->meshed, input.offset, volume);
        for (vtkDataObject* output : {static_cast<vtkDataObject*>(volume), static_cast<vtkDataObject*>(patches)})
        {
          if (!this->DistributeOutput)
          {
            ranks.gather({}); // ensures that no rank has failed
            atria::moveToRoot(output, controller);
          }
        }
        if (ranks.rank() == 0)
        {
          reportTo(vtkPolyData::GetData(outputs, 2), made->meshed, input.warnings, *this);
        }
        clock.lap("output");
        this->Stages = made->meshed.stages;
        this->Stages.push_back(clock.stages().back());
        context.progress.report(1.0, "Mesh made");
        return true;
      });
}

void vtkAtriaDualMesher::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ZoneRule: " << this->ZoneRule << "\n";
  os << indent << "NumberOfSeeds: " << this->SeedPoints.size() << "\n";
  printPoints(this->SeedPoints, os, indent);
  os << indent << "TargetNonOrthogonality: " << this->TargetNonOrthogonality << "\n";
  os << indent << "TargetSkewness: " << this->TargetSkewness << "\n";
  os << indent << "CrackTolerance: " << this->CrackTolerance << "\n";
  os << indent << "NumberOfSealedSeeds: " << this->SealedSeedPoints.size() << "\n";
  printPoints(this->SealedSeedPoints, os, indent);
  os << indent << "NumberOfLayers: " << this->NumberOfLayers << "\n";
  os << indent << "CacheStages: " << (this->CacheStages ? "on" : "off") << "\n";
  os << indent << "DistributeOutput: " << (this->DistributeOutput ? "on" : "off") << "\n";
  os << indent << "BlockSize: " << this->BlockSize << "\n";
  os << indent << "SupportElements: " << (this->SupportElements ? "on" : "off") << "\n";
  os << indent << "FirstLayerHeight: " << this->FirstLayerHeight << "\n";
  os << indent << "LayerGrowth: " << this->LayerGrowth << "\n";
  for (const std::string& rule : this->LayerRules)
  {
    os << indent << "LayerRule: " << rule << "\n";
  }
}
