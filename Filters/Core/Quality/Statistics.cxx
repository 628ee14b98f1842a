// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// Sum of f over the finite values, with Kahan's compensation: millions of small terms keep their digits.
template <typename F> double sumOfFinite(std::span<const double> values, F&& f)
{
  double sum = 0.0;
  double lost = 0.0;
  for (const double value : values)
  {
    if (std::isfinite(value))
    {
      const double term = f(value) - lost;
      const double next = sum + term;
      lost = (next - sum) - term;
      sum = next;
    }
  }
  return sum;
}

} // namespace

Statistics summarise(std::span<const double> values)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Statistics out{0, none, none, none, none};
  for (const double value : values)
  {
    out.count += std::isfinite(value) ? 1 : 0;
    // fmin and fmax prefer a number to none.
    out.minimum = std::fmin(out.minimum, value);
    out.maximum = std::fmax(out.maximum, value);
  }
  if (out.count > 0)
  {
    const auto count = static_cast<double>(out.count);
    out.mean = sumOfFinite(values, [](double value) { return value; }) / count;
    const auto square = [&](double value) { return (value - out.mean) * (value - out.mean); };
    out.standardDeviation = std::sqrt(sumOfFinite(values, square) / count);
  }
  return out;
}

Histogram makeHistogram(std::span<const double> values, std::size_t bins)
{
  const std::size_t binCount = std::max<std::size_t>(bins, 1);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values)
  {
    if (std::isfinite(value))
    {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  Histogram out;
  out.centres.assign(binCount, 0.0);
  out.density.assign(binCount, 0.0);
  out.cumulative.assign(binCount, 0.0);
  if (low > high)
  {
    return out;
  }
  const double width = (high - low) / static_cast<double>(binCount);
  // A range so narrow that its bins cannot be told apart counts as one value.
  const bool single = !(low + width > low && high - width < high);
  out.binWidth = single ? 1.0 / static_cast<double>(binCount) : width;
  const double start = single ? 0.5 * (low + high) - 0.5 : low;
  std::vector<std::size_t> counts(binCount, 0);
  std::size_t total = 0;
  for (const double value : values)
  {
    if (std::isfinite(value))
    {
      const double position = std::max((value - start) / out.binWidth, 0.0);
      ++counts[std::min(static_cast<std::size_t>(position), binCount - 1)];
      ++total;
    }
  }
  std::size_t running = 0;
  for (std::size_t b = 0; b < binCount; ++b)
  {
    running += counts[b];
    out.centres[b] = start + (static_cast<double>(b) + 0.5) * out.binWidth;
    out.density[b] = static_cast<double>(counts[b]) / (static_cast<double>(total) * out.binWidth);
    out.cumulative[b] = static_cast<double>(running) / static_cast<double>(total);
  }
  return out;
}

} // namespace atria
