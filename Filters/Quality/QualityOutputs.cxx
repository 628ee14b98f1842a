// SPDX-License-Identifier: GPL-3.0-or-later
#include "QualityOutputs.h"

#include "Support/Error.h"

#include <vtkCellData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

namespace atria {

namespace {

vtkSmartPointer<vtkDoubleArray> makeColumn(const std::string& name, std::span<const double> values,
                                           const Executor& executor = SerialExecutor())
{
  auto column = vtkSmartPointer<vtkDoubleArray>::New();
  column->SetName(name.c_str());
  column->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  double* to = column->GetPointer(0);
  executor.forEach(values.size(), 65536, [&](std::size_t i) { to[i] = values[i]; });
  return column;
}

/// Those there are values for: some metrics have none for faces on the boundary, which come last.
std::vector<double> chosen(std::span<const double> values, std::span<const Index> numbers)
{
  std::vector<double> out;
  for (const Index i : numbers)
  {
    if (i < values.size())
    {
      out.push_back(values[i]);
    }
  }
  return out;
}

} // namespace

QualityOutputs::QualityOutputs(int numberOfBins, const std::string& shownMetric, const Executor& threads,
                               const SampledPiece* sampled)
    : bins(static_cast<std::size_t>(numberOfBins)), shown(shownMetric), executor(threads), piece(sampled)
{
  names->SetName("Metric");
  parts->SetName("Of");
  counts->SetName("Count");
}

vtkSmartPointer<vtkDoubleArray> QualityOutputs::emptyColumn(const std::string& name, std::size_t size)
{
  auto column = vtkSmartPointer<vtkDoubleArray>::New();
  column->SetName(name.c_str());
  column->SetNumberOfValues(static_cast<vtkIdType>(size));
  return column;
}

void QualityOutputs::addCells(const char* name, std::span<const double> values)
{
  arrays.push_back(makeColumn(name, values, executor));
}

void QualityOutputs::addSample(const QualitySample& sample)
{
  const std::vector<double> own =
      piece ? chosen(sample.values, sample.ofFaces ? piece->faces : piece->cells) : std::vector<double>();
  const Distribution distribution = distributionOf(piece ? std::span<const double>(own) : sample.values, bins, executor,
                                                   sample.repeated, piece ? &piece->together : nullptr);
  const Statistics& s = distribution.statistics;
  names->InsertNextValue(sample.name);
  parts->InsertNextValue(sample.ofFaces ? "faces" : "cells");
  counts->InsertNextValue(static_cast<vtkIdType>(s.count));
  minima.push_back(s.minimum);
  maxima.push_back(s.maximum);
  means.push_back(s.mean);
  deviations.push_back(s.standardDeviation);
  const std::string name = sample.name;
  const Histogram& h = distribution.histogram;
  histogram->AddColumn(makeColumn(name, h.centers));
  histogram->AddColumn(makeColumn(name + "_PDF", h.density));
  histogram->AddColumn(makeColumn(name + "_CDF", h.cumulative));
  if (name == shown)
  {
    first->AddColumn(makeColumn("Value", h.centers));
    first->AddColumn(makeColumn("PDF", h.density));
    first->AddColumn(makeColumn("CDF", h.cumulative));
  }
}

void QualityOutputs::addFaces(const char* name, std::span<const double> values, std::size_t ideal)
{
  addSample({name, true, values, {0.0, ideal}});
}

void QualityOutputs::addBoth(const char* name, Buffer<double>& values)
{
  addCells(name, values);
  addSample({name, false, values});
  Buffer<double>().swap(values);
}

void QualityOutputs::addBoth(const char* name, const QualityByBoxes& boxes, Buffer<double>& values, double ofBoxes,
                             bool withSample)
{
  spread(name, boxes, values, [ofBoxes](std::size_t) { return ofBoxes; });
  if (withSample)
  {
    addSample({name, false, values, {ofBoxes, boxes.regularCount}});
  }
  Buffer<double>().swap(values);
}

void QualityOutputs::addValid(std::size_t cellCount, std::span<const unsigned char> values,
                              std::span<const Index> cells)
{
  vtkNew<vtkUnsignedCharArray> valid;
  valid->SetName("Valid");
  valid->SetNumberOfValues(static_cast<vtkIdType>(cellCount));
  unsigned char* const to = valid->GetPointer(0);
  std::fill_n(to, cellCount, static_cast<unsigned char>(1));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    to[cells.empty() ? i : cells[i]] = values[i];
  }
  arrays.emplace_back(valid);
}

void QualityOutputs::fill(vtkUnstructuredGrid* grid, vtkTable* summary, vtkTable* histograms)
{
  for (const auto& array : arrays)
  {
    grid->GetCellData()->AddArray(array);
  }
  summary->AddColumn(names);
  summary->AddColumn(parts);
  summary->AddColumn(makeColumn("Minimum", minima));
  summary->AddColumn(makeColumn("Maximum", maxima));
  summary->AddColumn(makeColumn("Mean", means));
  summary->AddColumn(makeColumn("StandardDeviation", deviations));
  summary->AddColumn(counts);
  histograms->ShallowCopy(first);
  for (vtkIdType i = 0; i < histogram->GetNumberOfColumns(); ++i)
  {
    histograms->AddColumn(histogram->GetColumn(i));
  }
}

void QualityOutputs::checkShown() const
{
  if (first->GetNumberOfColumns() > 0)
  {
    return;
  }
  std::string known;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    known += (i == 0 ? "" : ", ") + names->GetValue(i);
  }
  throw Error("HistogramMetric is '" + shown + "', which was not measured; there are " + known +
              ", and with CheckMesh more");
}

} // namespace atria
