// SPDX-License-Identifier: GPL-3.0-or-later
#include "QualityOutputs.h"

#include "AddArray.h"
#include "Support/Error.h"
#include "Support/Text.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

std::vector<double> chosen(std::span<const double> values, std::span<const Index> numbers)
{
  std::vector<double> out(numbers.size());
  std::ranges::transform(numbers, out.begin(), [&](Index i) { return values[i]; });
  return out;
}

} // namespace

QualityOutputs::QualityOutputs(int numberOfBins, const std::string& shownMetric, const Executor& threads,
                               const SampledPiece* sampled)
    : bins(static_cast<std::size_t>(numberOfBins)), shown(shownMetric), executor(threads), piece(sampled)
{
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
  auto column = emptyColumn(name, values.size());
  double* const to = column->GetPointer(0);
  executor.forEach(values.size(), 65536, [&](std::size_t i) { to[i] = values[i]; });
  arrays.push_back(column);
}

void QualityOutputs::addSample(const QualitySample& sample)
{
  const bool isPart = piece && !sample.ofFaces;
  const std::vector<double> own =
      isPart ? chosen(sample.values, sample.ofOthers ? piece->others : piece->cells) : std::vector<double>();
  const Distribution distribution = distributionOf(isPart ? std::span<const double>(own) : sample.values, bins,
                                                   executor, sample.repeated, piece ? &piece->together : nullptr);
  metrics.push_back({sample.name, sample.ofFaces ? "faces" : "cells", distribution.statistics});
  const std::string name = sample.name;
  const Histogram& h = distribution.histogram;
  addArrayOf<vtkDoubleArray>(histogram->GetRowData(), name.c_str(), h.centers);
  addArrayOf<vtkDoubleArray>(histogram->GetRowData(), (name + "_PDF").c_str(), h.density);
  addArrayOf<vtkDoubleArray>(histogram->GetRowData(), (name + "_CDF").c_str(), h.cumulative);
  if (name == shown)
  {
    addArrayOf<vtkDoubleArray>(first->GetRowData(), "Value", h.centers);
    addArrayOf<vtkDoubleArray>(first->GetRowData(), "PDF", h.density);
    addArrayOf<vtkDoubleArray>(first->GetRowData(), "CDF", h.cumulative);
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
    addSample({name, false, values, {ofBoxes, boxes.regularCount}, true});
  }
  Buffer<double>().swap(values);
}

void QualityOutputs::addFailedChecks(const std::vector<std::uint32_t>& bits)
{
  vtkNew<vtkUnsignedIntArray> array;
  array->SetName("FailedChecks");
  array->SetNumberOfValues(static_cast<vtkIdType>(bits.size()));
  std::ranges::copy(bits, array->GetPointer(0));
  arrays.emplace_back(array);
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
  vtkDataSetAttributes* rows = summary->GetRowData();
  addArrayOf<vtkStringArray>(rows, "Metric", metrics, &Metric::name);
  addArrayOf<vtkStringArray>(rows, "Of", metrics, &Metric::part);
  const auto addFigure = [&](const char* name, double Statistics::*figure) {
    addArrayOf<vtkDoubleArray>(rows, name, metrics, [&](const Metric& metric) { return metric.statistics.*figure; });
  };
  addFigure("Minimum", &Statistics::minimum);
  addFigure("Maximum", &Statistics::maximum);
  addFigure("Mean", &Statistics::mean);
  addFigure("StandardDeviation", &Statistics::standardDeviation);
  addArrayOf<vtkIdTypeArray>(rows, "Count", metrics, [](const Metric& metric) { return metric.statistics.count; });
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
  std::vector<std::string> known;
  std::ranges::transform(metrics, std::back_inserter(known), &Metric::name);
  throw Error("HistogramMetric is '" + shown + "', which was not measured; there are " + joined(known) +
              ", and with CheckMesh more");
}

} // namespace atria
