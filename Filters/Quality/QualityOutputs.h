// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the arrays and tables of vtkAtriaMeshQuality.
#pragma once

#include "Quality/Checks/BoxQuality.h"
#include "Quality/Checks/Statistics.h"
#include "Support/Executor.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace atria {

/// The values of a metric for the tables.
struct QualitySample
{
  const char* name;
  bool ofFaces;
  std::span<const double> values;
  Repeated repeated = {};
  bool ofOthers = false; ///< true if `values` has only cells that are no regular boxes
};

/// The part of a mesh that a rank holds: the cells that count on it, and the port that combines all ranks into one
/// sample. All faces with values count.
struct SampledPiece
{
  std::vector<Index> cells;
  std::vector<Index> others; ///< places, among cells that are no regular boxes, of those that count
  const Reduction& together;
};

/// Collects cell arrays and the two tables of metrics.
class QualityOutputs
{
public:
  /// `sampled`, if given, must outlive this; all ranks then add the same metrics in the same order.
  QualityOutputs(int numberOfBins, const std::string& shownMetric, const Executor& threads,
                 const SampledPiece* sampled = nullptr);

  void addCells(const char* name, std::span<const double> values);
  void addSample(const QualitySample& sample);
  void addFaces(const char* name, std::span<const double> values, std::size_t ideal);
  /// Adds a metric as cell array and sample. Frees the values once they are copied.
  void addBoth(const char* name, Buffer<double>& values);
  /// The same if all regular boxes have one value, or each its own; `values` are those of other cells.
  void addBoth(const char* name, const QualityByBoxes& boxes, Buffer<double>& values, double ofBoxes,
               bool withSample = true);
  template <typename OfBox>
  void addBoth(const char* name, const QualityByBoxes& boxes, Buffer<double>& values, OfBox&& ofBox)
  {
    const std::span<const double> all = spread(name, boxes, values, ofBox);
    addSample({name, false, all});
    Buffer<double>().swap(values);
  }
  /// Adds the bits of failedChecksOfCells().
  void addFailedChecks(const std::vector<std::uint32_t>& bits);
  void addValid(std::size_t cellCount, std::span<const unsigned char> values, std::span<const Index> cells);

  void fill(vtkUnstructuredGrid* grid, vtkTable* summary, vtkTable* histograms);

  /// Throws Error if the metric shown in the histogram does not exist.
  void checkShown() const;

  std::vector<vtkSmartPointer<vtkDataArray>> arrays;

private:
  struct Metric
  {
    const char* name;
    const char* part; ///< parts that it is measured on
    Statistics statistics;
  };

  static vtkSmartPointer<vtkDoubleArray> emptyColumn(const std::string& name, std::size_t size);

  /// Adds a cell array. Returns a view of its values.
  template <typename OfBox>
  std::span<const double> spread(const char* name, const QualityByBoxes& boxes, std::span<const double> values,
                                 OfBox&& ofBox)
  {
    auto column = emptyColumn(name, boxes.isRegular.size());
    double* const to = column->GetPointer(0);
    executor.forEach(boxes.isRegular.size(), 65536,
                     [&](std::size_t c) { to[c] = boxes.isRegular[c] ? ofBox(c) : 0.0; });
    executor.forEach(values.size(), 65536, [&](std::size_t i) { to[boxes.others[i]] = values[i]; });
    arrays.push_back(column);
    return {to, boxes.isRegular.size()};
  }

  std::size_t bins;
  std::string shown;
  const Executor& executor;
  const SampledPiece* piece;
  std::vector<Metric> metrics;
  vtkNew<vtkTable> first; ///< first columns of the histogram, those of the shown metric
  vtkNew<vtkTable> histogram;
};

} // namespace atria
