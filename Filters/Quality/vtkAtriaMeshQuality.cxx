// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshQuality.h"

#include "AlgorithmProgress.h"
#include "PieceChecks.h"
#include "PropertyRange.h"
#include "Quality/Checks/BoxQuality.h"
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Checks/Metrics.h"
#include "QualityOutputs.h"
#include "Ranks/ControllerExchange.h"
#include "Ranks/MeshPiece.h"
#include "Ranks/Ranks.h"
#include "Support/Error.h"
#include "VtkChecks.h"
#include "VtkFaceMesh.h"
#include "VtkRecordedPatches.h"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkAtriaMeshQuality);

namespace {

using atria::QualityOutputs;

struct Verdict
{
  vtkIdType invalidCells = 0;
  int failedChecks = 0;
};

/// Adds the metrics to the outputs and frees them.
Verdict addMetrics(QualityOutputs& outputs, atria::QualityMetrics& q)
{
  outputs.addBoth("CellSquish", q.cellSquish);
  outputs.addCells("FaceSquish", q.faceSquish);
  outputs.addFaces("FaceSquish", q.squishOfFaces, 0);
  outputs.addBoth("AspectRatio", q.aspectRatio);
  outputs.addBoth("InverseAspectRatio", q.inverseAspectRatio);
  outputs.addBoth("OrthogonalQuality", q.orthogonalQuality);
  outputs.addBoth("NonOrthogonality", q.nonOrthogonality);
  outputs.addFaces("FaceNonOrthogonality", q.nonOrthogonalityOfFaces, 0);
  outputs.addBoth("Skewness", q.skewness);
  outputs.addFaces("FaceSkewness", q.skewnessOfFaces, 0);
  outputs.addBoth("Volume", q.volume);
  outputs.addBoth("FacePyramids", q.facePyramids);
  outputs.addBoth("ScaledJacobian", q.scaledJacobian);
  outputs.addValid(q.valid.size(), q.valid, {});
  return {static_cast<vtkIdType>(q.invalidCells), 0};
}

/// The same for a mesh of mostly boxes, whose metrics that depend on directions are ideal.
Verdict addMetrics(QualityOutputs& outputs, atria::QualityByBoxes& boxes)
{
  atria::QualityMetrics& q = boxes.metrics;
  outputs.addBoth("CellSquish", boxes, q.cellSquish, 0.0);
  outputs.addBoth("FaceSquish", boxes, q.faceSquish, 0.0, false);
  outputs.addFaces("FaceSquish", q.squishOfFaces, boxes.idealFaces);
  outputs.addBoth("AspectRatio", boxes, q.aspectRatio, [&](std::size_t c) { return boxes.aspectRatios[c]; });
  outputs.addBoth("InverseAspectRatio", boxes, q.inverseAspectRatio,
                  [&](std::size_t c) { return 1.0 / boxes.aspectRatios[c]; });
  outputs.addBoth("OrthogonalQuality", boxes, q.orthogonalQuality, 1.0);
  outputs.addBoth("NonOrthogonality", boxes, q.nonOrthogonality, 0.0);
  outputs.addFaces("FaceNonOrthogonality", q.nonOrthogonalityOfFaces, boxes.idealFaces);
  outputs.addBoth("Skewness", boxes, q.skewness, 0.0);
  outputs.addFaces("FaceSkewness", q.skewnessOfFaces, boxes.idealFaces);
  outputs.addBoth("Volume", boxes, q.volume, [&](std::size_t c) { return boxes.volumes[c]; });
  outputs.addBoth("FacePyramids", boxes, q.facePyramids, [&](std::size_t c) { return boxes.volumes[c] / 6.0; });
  outputs.addBoth("ScaledJacobian", boxes, q.scaledJacobian, 1.0);
  outputs.addValid(boxes.isRegular.size(), q.valid, boxes.others);
  return {static_cast<vtkIdType>(q.invalidCells), 0};
}

/// Adds one quantity after the other, as each has up to one value per face.
void addCheckQuantities(QualityOutputs& outputs, const atria::MeasuredMesh& mesh, const atria::RunContext& context)
{
  double done = 0.0;
  for (const atria::CheckQuantityInfo& info : atria::checkQuantities())
  {
    context.progress.report(done / atria::checkQuantityCount, "Measuring what checkMesh does");
    done += 1.0;
    const std::vector<double> values = atria::measure(mesh, info.quantity, context);
    outputs.addCells(info.name,
                     info.ofFaces ? atria::worstOverFaces(mesh, values, info.greaterIsWorse, context) : values);
    const std::span<const double> all(values);
    outputs.addSample({info.name, info.ofFaces, info.needsTwoCells ? all.first(mesh.mesh.internalFaceCount()) : all});
  }
}

/// Adds the metrics of a mesh of mostly boxes without finding all faces; see computeQualityByBoxes. Returns nullopt if
/// this is not possible.
std::optional<Verdict> measureByBoxes(QualityOutputs& outputs, vtkUnstructuredGrid* volume,
                                      vtkPartitionedDataSetCollection* given, const atria::RunContext& context)
{
  if (!volume || volume->GetNumberOfCells() == 0)
  {
    return std::nullopt;
  }
  const bool areGiven = given && given->GetNumberOfPartitionedDataSets() > 0;
  const bool areRecorded = !areGiven && atria::hasRecordedPatches(volume);
  std::optional<atria::VtkPatches> patches(std::in_place);
  atria::VtkPatches zones;
  if (areGiven)
  {
    patches = atria::patchesFromVtk(given, volume);
    zones = atria::faceZonesFromVtk(given, volume);
  }
  else if (areRecorded)
  {
    patches = atria::recordedPatches(volume);
    zones = atria::recordedFaceZones(volume).value_or(atria::VtkPatches());
  }
  if (!patches)
  {
    return std::nullopt;
  }
  const std::vector<atria::BoundaryFaceKey> patchFaces = patches->keys();
  const std::vector<atria::BoundaryFaceKey> zoneFaces = zones.keys();
  const atria::VtkCells cells(volume);
  const atria::VtkPoints points(volume->GetPoints(), context.executor);
  std::optional<atria::QualityByBoxes> quality = atria::computeQualityByBoxes(
      points.view(), cells.view(), {patchFaces, areRecorded, zoneFaces, zones.neighbors}, context);
  if (!quality)
  {
    return std::nullopt;
  }
  return addMetrics(outputs, *quality);
}

/// Adds the metrics, and the checks if requested, of all cells and faces.
Verdict measureAll(QualityOutputs& outputs, vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches,
                   bool checkMesh, vtkTable* checks, const atria::RunContext& context)
{
  context.progress.report(0.0, "Finding faces");
  const atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, patches, context.executor);
  const double metricsEnd = checkMesh ? 0.6 : 0.95;
  const atria::MeasuredMesh measured = atria::measureMesh(source.mesh, context.part(0.3, 0.5));
  Verdict verdict;
  {
    atria::QualityMetrics quality = atria::computeQuality(measured, source.cells.view(), context.part(0.5, metricsEnd));
    verdict = addMetrics(outputs, quality);
  }
  if (checkMesh)
  {
    addCheckQuantities(outputs, measured, context.part(metricsEnd, 0.8));
    const atria::MeshVerdict found = atria::checkMesh(measured, context.part(0.8, 0.98));
    outputs.addFailedChecks(atria::failedChecksOfCells(measured, found));
    atria::checksToVtk(found, checks);
    verdict.failedChecks = found.failedChecks();
  }
  return verdict;
}

/// Results for a rank's piece: either `boxes` or `checks` with `metrics`.
struct MeasuredPiece
{
  std::optional<atria::QualityByBoxes> boxes;
  std::unique_ptr<atria::PieceChecks> checks; ///< set if checks are requested
  atria::QualityMetrics metrics;              ///< set with `checks`

  std::size_t invalidCells() const { return boxes ? boxes->metrics.invalidCells : metrics.invalidCells; }
};

/// Outcome of measuring, the same on all ranks.
enum class Outcome
{
  Measured,
  Aborted,
  Impossible
};

Outcome measurePiece(const atria::MeshPiece& piece, bool withChecks, vtkMultiProcessController& controller,
                     MeasuredPiece& out, const atria::RunContext& context)
{
  try
  {
    atria::ControllerExchange ranks(controller);
    ranks.run([&] {
      if (withChecks)
      {
        out.checks = std::make_unique<atria::PieceChecks>(piece, ranks, context.part(0.0, 0.7));
        out.metrics = out.checks->metrics(context.part(0.7, 0.95));
        return;
      }
      out.boxes.emplace();
      out.boxes = piece.cellCount() > 0 ? piece.measure(context.part(0.0, 0.95)) : out.boxes;
      if (!out.boxes)
      {
        throw atria::Error("a piece cannot be measured by itself");
      }
    });
    return Outcome::Measured;
  }
  catch (const atria::Aborted&)
  {
    return Outcome::Aborted;
  }
  catch (const std::exception&)
  {
    return Outcome::Impossible;
  }
}

/// Adds the results of a piece. All ranks must call it, and none may leave it early.
void addPiece(QualityOutputs& outputs, MeasuredPiece& measured, vtkTable* checks, const atria::Executor& executor)
{
  if (measured.boxes)
  {
    addMetrics(outputs, *measured.boxes);
  }
  else
  {
    addMetrics(outputs, measured.metrics);
    atria::SilentMonitor silent;
    measured.checks->addTo(outputs, {executor, atria::ProgressRange(silent)});
    atria::checksToVtk(measured.checks->verdict(), checks);
  }
}

/// Returns the places of own cells in a list of cells.
std::vector<atria::Index> ownPlaces(const atria::MeshPiece& piece, const std::vector<atria::Index>& cells)
{
  std::vector<atria::Index> places;
  for (atria::Index i = 0; i < cells.size(); ++i)
  {
    if (piece.isOwn(cells[i]))
    {
      places.push_back(i);
    }
  }
  return places;
}

} // namespace

vtkAtriaMeshQuality::vtkAtriaMeshQuality()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
}

void vtkAtriaMeshQuality::SetPatchesConnection(vtkAlgorithmOutput* patches) { this->SetInputConnection(1, patches); }

void vtkAtriaMeshQuality::SetPatchesData(vtkPartitionedDataSetCollection* patches)
{
  this->SetInputDataInternal(1, patches);
}

vtkTable* vtkAtriaMeshQuality::GetSummary() { return vtkTable::SafeDownCast(this->GetOutputDataObject(1)); }

vtkTable* vtkAtriaMeshQuality::GetHistogram() { return vtkTable::SafeDownCast(this->GetOutputDataObject(2)); }

vtkTable* vtkAtriaMeshQuality::GetChecks() { return vtkTable::SafeDownCast(this->GetOutputDataObject(3)); }

int vtkAtriaMeshQuality::FillInputPortInformation(int port, vtkInformation* info)
{
  return atria::acceptMeshAndPatches(port, info);
}

int vtkAtriaMeshQuality::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

vtkTypeBool vtkAtriaMeshQuality::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  return atria::processOnRanks(
      *this, request, inputs, outputs, [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); }, {0},
      [&](vtkMultiProcessController& controller) { return this->MeasurePieces(inputs, outputs, controller); });
}

std::optional<int> vtkAtriaMeshQuality::MeasurePieces(vtkInformationVector** inputs, vtkInformationVector* outputs,
                                                      vtkMultiProcessController& controller)
{
  vtkUnstructuredGrid* volume = vtkUnstructuredGrid::GetData(inputs[0], 0);
  vtkPartitionedDataSetCollection* patches = vtkPartitionedDataSetCollection::GetData(inputs[1], 0);
  const auto piece = atria::MeshPiece::of(volume, patches, controller);
  if (!piece)
  {
    return std::nullopt;
  }
  const atria::AlgorithmRun run(*this);
  MeasuredPiece measured;
  const Outcome outcome = measurePiece(*piece, this->CheckMesh, controller, measured, run.context);
  if (outcome == Outcome::Impossible)
  {
    return std::nullopt; // the first rank will report the reason
  }
  if (outcome == Outcome::Aborted)
  {
    atria::clearOutputs(outputs);
    atria::markAborted(outputs);
    return 1;
  }
  try
  {
    atriaCheckRange(NumberOfBins);
    const atria::RankReduction together(controller);
    const atria::SampledPiece sampled{
        piece->ownCells(), measured.boxes ? ownPlaces(*piece, measured.boxes->others) : std::vector<atria::Index>(),
        together};
    auto invalid = static_cast<double>(measured.invalidCells());
    together.sum({&invalid, 1});
    QualityOutputs collected(this->NumberOfBins, this->HistogramMetric, run.context.executor, &sampled);
    vtkNew<vtkTable> checks;
    addPiece(collected, measured, checks, run.context.executor);
    collected.checkShown();
    piece->fillGhosts(collected.arrays);
    vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs, 0);
    output->ShallowCopy(volume);
    vtkNew<vtkTable> summary, histogram;
    collected.fill(output, summary, histogram);
    if (controller.GetLocalProcessId() > 0) // only the first rank has tables
    {
      summary->Initialize();
      histogram->Initialize();
      checks->Initialize();
    }
    vtkTable::GetData(outputs, 1)->ShallowCopy(summary);
    vtkTable::GetData(outputs, 2)->ShallowCopy(histogram);
    vtkTable::GetData(outputs, 3)->ShallowCopy(checks);
    this->NumberOfInvalidCells = static_cast<vtkIdType>(invalid);
    this->NumberOfFailedChecks = measured.checks ? measured.checks->verdict().failedChecks() : 0;
  }
  catch (const atria::Error&)
  {
    return std::nullopt; // a property is wrong, which is the same on all ranks; the first one reports it
  }
  this->UpdateProgress(1.0); // nobody may leave now
  return 1;
}

int vtkAtriaMeshQuality::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* volume = vtkUnstructuredGrid::GetData(inputs[0], 0);
  vtkPartitionedDataSetCollection* patches = vtkPartitionedDataSetCollection::GetData(inputs[1], 0);
  this->NumberOfInvalidCells = 0;
  this->NumberOfFailedChecks = 0;
  return atria::runFilter(*this, outputs, "Cannot measure the mesh: ", [&](const atria::RunContext& context) {
    atriaCheckRange(NumberOfBins);
    QualityOutputs collected(this->NumberOfBins, this->HistogramMetric, context.executor);
    vtkNew<vtkTable> checks;
    const std::optional<Verdict> byBoxes =
        this->CheckMesh ? std::nullopt : measureByBoxes(collected, volume, patches, context.part(0.0, 0.5));
    const Verdict verdict = byBoxes ? *byBoxes
                                    : measureAll(collected, volume, patches, this->CheckMesh, checks,
                                                 context.part(this->CheckMesh ? 0.0 : 0.2, 0.98));
    collected.checkShown();
    context.progress.report(0.98, "Summarizing");
    vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs, 0);
    output->ShallowCopy(volume);
    collected.fill(output, vtkTable::GetData(outputs, 1), vtkTable::GetData(outputs, 2));
    vtkTable::GetData(outputs, 3)->ShallowCopy(checks);
    this->NumberOfInvalidCells = verdict.invalidCells;
    this->NumberOfFailedChecks = verdict.failedChecks;
    context.progress.report(1.0, "Quality known");
  });
}

void vtkAtriaMeshQuality::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfBins: " << this->NumberOfBins << "\n";
  os << indent << "HistogramMetric: " << this->HistogramMetric << "\n";
  os << indent << "CheckMesh: " << this->CheckMesh << "\n";
  os << indent << "NumberOfFailedChecks: " << this->NumberOfFailedChecks << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
}
