// SPDX-License-Identifier: GPL-3.0-or-later
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
  double standardDeviation; ///< of the population: divided by count
};

/// A histogram of equal bins from the smallest to the greatest finite value. A sample of one value has bins
/// one wide in all; all is zero for an empty one.
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

/// Of values and of repeated ones. Goes through the values twice. At least one bin is made. The same bits for any
/// number of threads.
Distribution distributionOf(std::span<const double> values, std::size_t binCount,
                            const Executor& executor = SerialExecutor(), const Repeated& repeated = {});

} // namespace atria
