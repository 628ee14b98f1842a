// SPDX-License-Identifier: GPL-3.0-or-later
/// Mean, deviation, extremes and histogram of a sample.
#pragma once

#include "Support/Executor.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atria {

/// Summary of a sample. Values that are not numbers are left out. An infinite value shows in minimum or
/// maximum, but neither in count, mean and deviation nor in histograms.
struct Statistics
{
  std::size_t count = 0; ///< finite values
  double minimum;        ///< not a number when the sample is empty, as are all below
  double maximum;
  double mean;
  double standardDeviation; ///< population standard deviation: divided by count
};

/// A histogram of equal bins from the smallest to the greatest finite value. The bins of a sample of one value have a
/// total width of 1. Everything is zero for an empty sample.
struct Histogram
{
  std::vector<double> centers;
  std::vector<double> density;    ///< integrates to 1 (PDF)
  std::vector<double> cumulative; ///< share of the values up to the bin's upper end; the last is 1 (CDF)
  double binWidth = 0.0;
};

struct Distribution
{
  Statistics statistics;
  Histogram histogram;
};

/// Values that are all the same.
struct Repeated
{
  double value = 0.0; ///< finite
  std::size_t count = 0;
};

/// Port that combines the parts of a sample that several processes hold. Each function replaces values by their sums,
/// minima or maxima over all processes. All processes make the same calls in the same order.
class Reduction
{
public:
  virtual ~Reduction() = default;
  virtual void sum(std::span<double> values) const = 0;
  virtual void least(std::span<double> values) const = 0;
  virtual void greatest(std::span<double> values) const = 0;
};

/// Returns the distribution of `values` and `repeated`. Reads the values twice. Makes at least one bin. The result has
/// the same bits for any number of threads. With `together`, all processes get the distribution of all their values;
/// sums are then the same up to rounding.
Distribution distributionOf(std::span<const double> values, std::size_t binCount,
                            const Executor& executor = SerialExecutor(), const Repeated& repeated = {},
                            const Reduction* together = nullptr);

} // namespace atria
