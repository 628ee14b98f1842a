// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshQuality.h"

#include "AlgorithmProgress.h"
#include "Quality/Metrics.h"
#include "Quality/Statistics.h"
#include "SmpExecutor.h"
#include "VtkFaceMesh.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <exception>
#include <string>

vtkStandardNewMacro(vtkAtriaMeshQuality);

namespace {

/// A metric with its cell values and the values that the tables are made of.
struct NamedMetric
{
  const char* name;
  const std::vector<double>* cells;
  const std::vector<double>* sample;
};

std::vector<NamedMetric> listMetrics(const atria::QualityMetrics& q)
{
  std::vector<NamedMetric> metrics;
  const auto add = [&](const char* name, const std::vector<double>& cells) {
    metrics.push_back({name, &cells, &cells});
  };
  add("CellSquish", q.cellSquish);
  metrics.push_back({"FaceSquish", &q.faceSquish, &q.squishOfFaces});
  add("AspectRatio", q.aspectRatio);
  add("InverseAspectRatio", q.inverseAspectRatio);
  add("OrthogonalQuality", q.orthogonalQuality);
  add("NonOrthogonality", q.nonOrthogonality);
  add("Skewness", q.skewness);
  add("Volume", q.volume);
  add("FacePyramids", q.facePyramids);
  add("ScaledJacobian", q.scaledJacobian);
  return metrics;
}

vtkSmartPointer<vtkDoubleArray> makeColumn(const std::string& name, const std::vector<double>& values)
{
  auto column = vtkSmartPointer<vtkDoubleArray>::New();
  column->SetName(name.c_str());
  column->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), column->GetPointer(0));
  return column;
}

void addCellArrays(vtkUnstructuredGrid* grid, const atria::QualityMetrics& quality)
{
  for (const NamedMetric& metric : listMetrics(quality))
  {
    grid->GetCellData()->AddArray(makeColumn(metric.name, *metric.cells));
  }
  vtkNew<vtkUnsignedCharArray> valid;
  valid->SetName("Valid");
  valid->SetNumberOfValues(static_cast<vtkIdType>(quality.valid.size()));
  std::copy(quality.valid.begin(), quality.valid.end(), valid->GetPointer(0));
  grid->GetCellData()->AddArray(valid);
}

void fillSummary(vtkTable* table, const atria::QualityMetrics& quality)
{
  vtkNew<vtkStringArray> names;
  names->SetName("Metric");
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName("Count");
  std::vector<double> minima;
  std::vector<double> maxima;
  std::vector<double> means;
  std::vector<double> deviations;
  for (const NamedMetric& metric : listMetrics(quality))
  {
    const atria::Statistics s = atria::summarise(*metric.sample);
    names->InsertNextValue(metric.name);
    counts->InsertNextValue(static_cast<vtkIdType>(s.count));
    minima.push_back(s.minimum);
    maxima.push_back(s.maximum);
    means.push_back(s.mean);
    deviations.push_back(s.standardDeviation);
  }
  table->AddColumn(names);
  table->AddColumn(makeColumn("Minimum", minima));
  table->AddColumn(makeColumn("Maximum", maxima));
  table->AddColumn(makeColumn("Mean", means));
  table->AddColumn(makeColumn("StandardDeviation", deviations));
  table->AddColumn(counts);
}

void fillHistogram(vtkTable* table, const atria::QualityMetrics& quality, int bins)
{
  for (const NamedMetric& metric : listMetrics(quality))
  {
    const std::string name = metric.name;
    const atria::Histogram h = atria::makeHistogram(*metric.sample, static_cast<std::size_t>(bins));
    table->AddColumn(makeColumn(name, h.centres));
    table->AddColumn(makeColumn(name + "_PDF", h.density));
    table->AddColumn(makeColumn(name + "_CDF", h.cumulative));
  }
}

} // namespace

vtkAtriaMeshQuality::vtkAtriaMeshQuality()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

void vtkAtriaMeshQuality::SetPatchesConnection(vtkAlgorithmOutput* patches) { this->SetInputConnection(1, patches); }

void vtkAtriaMeshQuality::SetPatchesData(vtkPartitionedDataSetCollection* patches)
{
  this->SetInputDataInternal(1, patches);
}

vtkTable* vtkAtriaMeshQuality::GetSummary() { return vtkTable::SafeDownCast(this->GetOutputDataObject(1)); }

vtkTable* vtkAtriaMeshQuality::GetHistogram() { return vtkTable::SafeDownCast(this->GetOutputDataObject(2)); }

int vtkAtriaMeshQuality::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkAtriaMeshQuality::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkAtriaMeshQuality::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* volume = vtkUnstructuredGrid::GetData(inputs[0], 0);
  vtkPartitionedDataSetCollection* patches = vtkPartitionedDataSetCollection::GetData(inputs[1], 0);
  this->NumberOfInvalidCells = 0;
  try
  {
    atria::AlgorithmProgress monitor(*this);
    const atria::SmpExecutor executor;
    const atria::RunContext context{executor, atria::ProgressRange(monitor)};
    context.progress.report(0.0, "Finding faces");
    const atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, patches);
    const atria::QualityMetrics quality =
        atria::computeQuality(source.mesh, source.cells.view(), context.part(0.4, 0.9));
    vtkNew<vtkTable> summary;
    vtkNew<vtkTable> histogram;
    fillSummary(summary, quality);
    context.progress.report(0.95, "Counting");
    fillHistogram(histogram, quality, this->NumberOfBins);
    context.progress.report(1.0, "Quality known");
    vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs, 0);
    output->ShallowCopy(volume);
    addCellArrays(output, quality);
    vtkTable::GetData(outputs, 1)->ShallowCopy(summary);
    vtkTable::GetData(outputs, 2)->ShallowCopy(histogram);
    this->NumberOfInvalidCells = static_cast<vtkIdType>(quality.invalidCells);
  }
  catch (const atria::Aborted&)
  {
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cannot measure the mesh: " << error.what());
    return 0;
  }
  return 1;
}

void vtkAtriaMeshQuality::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfBins: " << this->NumberOfBins << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
}
