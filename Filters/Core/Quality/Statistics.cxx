// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Statistics.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// Values a piece; pieces do not depend on the number of threads, so sums do not either.
constexpr std::size_t pieceLength = 65536;

/// A sum with Kahan's compensation: millions of small terms keep their digits.
struct Sum
{
  double value = 0.0;
  double lost = 0.0;

  void add(double x)
  {
    const double term = x - lost;
    const double next = value + term;
    lost = (next - value) - term;
    value = next;
  }
};

/// Calls body(piece, values of the piece) for all pieces.
template <typename F> void forPieces(std::span<const double> values, const Executor& executor, F&& body)
{
  const std::size_t pieces = (values.size() + pieceLength - 1) / pieceLength;
  executor.forEach(pieces, 1, [&](std::size_t piece) {
    const std::size_t first = piece * pieceLength;
    body(piece, values.subspan(first, std::min(pieceLength, values.size() - first)));
  });
}

/// Plain sums of so few values lose nothing that matters, and need not wait for the compensation.
constexpr std::size_t blockLength = 64;

template <typename F> double sumOfBlock(std::span<const double> values, F&& f)
{
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sums[i % 4] += std::isfinite(values[i]) ? f(values[i]) : 0.0;
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Sum of f over the finite values.
template <typename F> double sumOfFinite(std::span<const double> values, const Executor& executor, F&& f)
{
  std::vector<double> parts((values.size() + pieceLength - 1) / pieceLength);
  forPieces(values, executor, [&](std::size_t piece, std::span<const double> part) {
    Sum sum;
    for (std::size_t first = 0; first < part.size(); first += blockLength)
    {
      sum.add(sumOfBlock(part.subspan(first, std::min(blockLength, part.size() - first)), f));
    }
    parts[piece] = sum.value;
  });
  Sum sum;
  for (const double part : parts)
  {
    sum.add(part);
  }
  return sum.value;
}

/// Count and extremes of the finite values; whether there are infinite ones.
struct Extremes
{
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::size_t count = 0;
  double minimum = infinity;
  double maximum = -infinity;
  bool hasInfinite[2] = {false, false}; ///< below, above

  void add(double value)
  {
    if (std::isfinite(value))
    {
      ++count;
      minimum = std::min(minimum, value);
      maximum = std::max(maximum, value);
    }
    else if (!std::isnan(value))
    {
      hasInfinite[value > 0.0] = true;
    }
  }

  void add(const Extremes& other)
  {
    count += other.count;
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
    hasInfinite[0] = hasInfinite[0] || other.hasInfinite[0];
    hasInfinite[1] = hasInfinite[1] || other.hasInfinite[1];
  }

  /// With the infinite values; not a number where there is no value.
  double leastOfAll() const
  {
    return hasInfinite[0] ? -infinity : count > 0 ? minimum : hasInfinite[1] ? infinity : std::nan("");
  }
  double greatestOfAll() const
  {
    return hasInfinite[1] ? infinity : count > 0 ? maximum : hasInfinite[0] ? -infinity : std::nan("");
  }
};

Extremes extremesOf(std::span<const double> values, const Executor& executor)
{
  std::vector<Extremes> parts((values.size() + pieceLength - 1) / pieceLength);
  forPieces(values, executor, [&](std::size_t piece, std::span<const double> part) {
    for (const double value : part)
    {
      parts[piece].add(value);
    }
  });
  Extremes all;
  for (const Extremes& part : parts)
  {
    all.add(part);
  }
  return all;
}

std::vector<std::size_t> countInBins(std::span<const double> values, double start, double width, std::size_t bins,
                                     const Executor& executor)
{
  std::vector<std::size_t> counts(bins, 0);
  forPieces(values, executor, [&](std::size_t, std::span<const double> part) {
    std::vector<std::size_t> own(bins, 0);
    for (const double value : part)
    {
      if (std::isfinite(value))
      {
        const double position = std::max((value - start) / width, 0.0);
        ++own[std::min(static_cast<std::size_t>(position), bins - 1)];
      }
    }
    for (std::size_t b = 0; b < bins; ++b)
    {
      std::atomic_ref<std::size_t>(counts[b]) += own[b];
    }
  });
  return counts;
}

} // namespace

Statistics summarise(std::span<const double> values, const Executor& executor)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Extremes extremes = extremesOf(values, executor);
  Statistics out{extremes.count, extremes.leastOfAll(), extremes.greatestOfAll(), none, none};
  if (out.count > 0)
  {
    const auto count = static_cast<double>(out.count);
    out.mean = sumOfFinite(values, executor, [](double value) { return value; }) / count;
    const auto square = [&](double value) { return (value - out.mean) * (value - out.mean); };
    out.standardDeviation = std::sqrt(sumOfFinite(values, executor, square) / count);
  }
  return out;
}

Histogram makeHistogram(std::span<const double> values, std::size_t bins, const Executor& executor)
{
  const std::size_t binCount = std::max<std::size_t>(bins, 1);
  const Extremes extremes = extremesOf(values, executor);
  const double low = extremes.minimum;
  const double high = extremes.maximum;
  Histogram out;
  out.centres.assign(binCount, 0.0);
  out.density.assign(binCount, 0.0);
  out.cumulative.assign(binCount, 0.0);
  if (extremes.count == 0)
  {
    return out;
  }
  const double width = (high - low) / static_cast<double>(binCount);
  // A range so narrow that its bins cannot be told apart counts as one value.
  const bool single = !(low + width > low && high - width < high);
  out.binWidth = single ? 1.0 / static_cast<double>(binCount) : width;
  const double start = single ? 0.5 * (low + high) - 0.5 : low;
  const std::vector<std::size_t> counts = countInBins(values, start, out.binWidth, binCount, executor);
  const auto total = static_cast<double>(extremes.count);
  std::size_t running = 0;
  for (std::size_t b = 0; b < binCount; ++b)
  {
    running += counts[b];
    out.centres[b] = start + (static_cast<double>(b) + 0.5) * out.binWidth;
    out.density[b] = static_cast<double>(counts[b]) / (total * out.binWidth);
    out.cumulative[b] = static_cast<double>(running) / total;
  }
  return out;
}

} // namespace atria
