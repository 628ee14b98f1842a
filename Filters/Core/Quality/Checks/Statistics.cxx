// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/Statistics.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// Values per piece. Pieces do not depend on the number of threads, so sums do not either.
constexpr std::size_t pieceLength = 65536;

/// Number of values that are added up plainly: so few lose no relevant digits, and need not wait for the compensation.
constexpr std::size_t blockLength = 64;

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

std::size_t pieceCountOf(std::span<const double> values) { return (values.size() + pieceLength - 1) / pieceLength; }

/// Returns the sum of f over the finite values.
template <typename F> double sumOfBlock(std::span<const double> values, F&& f)
{
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sums[i % 4] += std::isfinite(values[i]) ? f(values[i]) : 0.0;
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Count and extremes of the finite values, and flags for infinite ones.
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

  void addBlock(std::span<const double> values)
  {
    if (values.size() != blockLength || !addFinite(values.first<blockLength>()))
    {
      std::ranges::for_each(values, [this](double value) { add(value); });
    }
  }

  /// Adds values in four lanes, none of which waits for another. Adds nothing and returns false if a value is not
  /// finite.
  bool addFinite(std::span<const double, blockLength> values)
  {
    std::array<double, 4> least, greatest, nothing{};
    least.fill(infinity);
    greatest.fill(-infinity);
    for (std::size_t i = 0; i < blockLength; i += 4)
    {
      for (std::size_t lane = 0; lane < 4; ++lane)
      {
        const double value = values[i + lane];
        least[lane] = value < least[lane] ? value : least[lane];
        greatest[lane] = value > greatest[lane] ? value : greatest[lane];
        nothing[lane] += 0.0 * value; // not a number if a value is not finite, and neither is its sum
      }
    }
    if (std::isnan((nothing[0] + nothing[1]) + (nothing[2] + nothing[3])))
    {
      return false;
    }
    count += blockLength;
    minimum = std::min(minimum, std::ranges::min(least));
    maximum = std::max(maximum, std::ranges::max(greatest));
    return true;
  }

  void add(const Extremes& other)
  {
    count += other.count;
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
    hasInfinite[0] = hasInfinite[0] || other.hasInfinite[0];
    hasInfinite[1] = hasInfinite[1] || other.hasInfinite[1];
  }

  /// Returns the minimum, infinite values included; not a number if there is no value.
  double leastOfAll() const
  {
    return hasInfinite[0] ? -infinity : count > 0 ? minimum : hasInfinite[1] ? infinity : std::nan("");
  }
  double greatestOfAll() const
  {
    return hasInfinite[1] ? infinity : count > 0 ? maximum : hasInfinite[0] ? -infinity : std::nan("");
  }
};

/// Calls body(piece, values of the piece) for all pieces.
template <typename F> void forPieces(std::span<const double> values, const Executor& executor, F&& body)
{
  executor.forEach(pieceCountOf(values), 1, [&](std::size_t piece) {
    const std::size_t first = piece * pieceLength;
    body(piece, values.subspan(first, std::min(pieceLength, values.size() - first)));
  });
}

/// Calls body(block) for the blocks of a piece, in order.
template <typename F> void forBlocks(std::span<const double> values, F&& body)
{
  for (std::size_t first = 0; first < values.size(); first += blockLength)
  {
    body(values.subspan(first, std::min(blockLength, values.size() - first)));
  }
}

double total(std::span<const Sum> parts)
{
  Sum sum;
  for (const Sum& part : parts)
  {
    sum.add(part.value);
  }
  return sum.value;
}

/// First pass over the values.
struct FirstLook
{
  FirstLook(std::span<const double> values, const Executor& executor)
  {
    std::vector<Extremes> extremesOf(pieceCountOf(values));
    std::vector<Sum> sums(extremesOf.size());
    forPieces(values, executor, [&](std::size_t piece, std::span<const double> part) {
      forBlocks(part, [&](std::span<const double> block) {
        extremesOf[piece].addBlock(block);
        sums[piece].add(sumOfBlock(block, [](double value) { return value; }));
      });
    });
    for (const Extremes& part : extremesOf)
    {
      extremes.add(part);
    }
    sum = total(sums);
  }

  void add(const Repeated& repeated)
  {
    if (repeated.count > 0)
    {
      extremes.add(repeated.value);
      extremes.count += repeated.count - 1;
      sum += repeated.value * static_cast<double>(repeated.count);
    }
  }

  void add(const Reduction& together)
  {
    double sums[] = {static_cast<double>(extremes.count), sum}; // whole numbers are exact up to 2^53
    double greatest[] = {extremes.maximum, extremes.hasInfinite[0] ? 1.0 : 0.0, extremes.hasInfinite[1] ? 1.0 : 0.0};
    together.sum(sums);
    together.least({&extremes.minimum, 1});
    together.greatest(greatest);
    extremes.count = static_cast<std::size_t>(sums[0]);
    sum = sums[1];
    extremes.maximum = greatest[0];
    extremes.hasInfinite[0] = greatest[1] > 0.0;
    extremes.hasInfinite[1] = greatest[2] > 0.0;
  }

  Extremes extremes;
  double sum; ///< sum of the finite values
};

/// Bins of a histogram.
struct Bins
{
  Bins(const Extremes& extremes, std::size_t number) : count(number)
  {
    const double low = extremes.minimum;
    const double high = extremes.maximum;
    width = (high - low) / static_cast<double>(count);
    // A range too narrow to separate its bins counts as one value.
    const bool single = !(low + width > low && high - width < high);
    width = single ? 1.0 / static_cast<double>(count) : width;
    start = single ? 0.5 * (low + high) - 0.5 : low;
  }

  std::size_t of(double value) const
  {
    const double position = std::max((value - start) / width, 0.0);
    return std::min(static_cast<std::size_t>(position), count - 1);
  }

  std::size_t count;
  double start;
  double width;
};

/// Second pass over the values, with their mean and extremes known.
struct SecondLook
{
  SecondLook(std::span<const double> values, double mean, const Bins& bins, const Executor& executor)
      : counts(bins.count)
  {
    std::vector<Sum> sums(pieceCountOf(values));
    const auto square = [mean](double value) { return (value - mean) * (value - mean); };
    forPieces(values, executor, [&](std::size_t piece, std::span<const double> part) {
      std::vector<std::size_t> own(bins.count, 0);
      forBlocks(part, [&](std::span<const double> block) {
        sums[piece].add(sumOfBlock(block, square));
        for (const double value : block)
        {
          own[std::isfinite(value) ? bins.of(value) : 0] += std::isfinite(value) ? 1 : 0;
        }
      });
      for (std::size_t b = 0; b < bins.count; ++b)
      {
        std::atomic_ref<std::size_t>(counts[b]) += own[b];
      }
    });
    squares = total(sums);
  }

  void add(const Repeated& repeated, double mean, const Bins& bins)
  {
    const double deviation = repeated.value - mean;
    squares += deviation * deviation * static_cast<double>(repeated.count);
    counts[bins.of(repeated.value)] += repeated.count;
  }

  void add(const Reduction& together)
  {
    std::vector<double> sums(counts.begin(), counts.end());
    sums.push_back(squares);
    together.sum(sums);
    squares = sums.back();
    std::transform(sums.begin(), sums.end() - 1, counts.begin(),
                   [](double count) { return static_cast<std::size_t>(count); });
  }

  double squares; ///< sum of squared deviations from the mean
  std::vector<std::size_t> counts;
};

Histogram makeHistogram(const Bins& bins, const std::vector<std::size_t>& counts, std::size_t total)
{
  Histogram out;
  out.binWidth = bins.width;
  std::size_t running = 0;
  for (std::size_t b = 0; b < bins.count; ++b)
  {
    running += counts[b];
    out.centers.push_back(bins.start + (static_cast<double>(b) + 0.5) * bins.width);
    out.density.push_back(static_cast<double>(counts[b]) / (static_cast<double>(total) * bins.width));
    out.cumulative.push_back(static_cast<double>(running) / static_cast<double>(total));
  }
  return out;
}

} // namespace

Distribution distributionOf(std::span<const double> values, std::size_t binCount, const Executor& executor,
                            const Repeated& repeated, const Reduction* together)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t atLeastOne = std::max<std::size_t>(binCount, 1);
  FirstLook first(values, executor);
  first.add(repeated);
  if (together)
  {
    first.add(*together);
  }
  const Extremes& extremes = first.extremes;
  Distribution out{{extremes.count, extremes.leastOfAll(), extremes.greatestOfAll(), none, none}, {}};
  if (extremes.count == 0)
  {
    const std::vector<double> zero(atLeastOne, 0.0);
    out.histogram = {zero, zero, zero, 0.0};
    return out;
  }
  const auto count = static_cast<double>(extremes.count);
  const Bins bins(extremes, atLeastOne);
  out.statistics.mean = first.sum / count;
  SecondLook second(values, out.statistics.mean, bins, executor);
  second.add(repeated, out.statistics.mean, bins);
  if (together)
  {
    second.add(*together);
  }
  out.statistics.standardDeviation = std::sqrt(second.squares / count);
  out.histogram = makeHistogram(bins, second.counts, extremes.count);
  return out;
}

} // namespace atria
