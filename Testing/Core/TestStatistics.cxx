// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/Statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <thread>

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

double integral(const atria::Histogram& h)
{
  return std::accumulate(h.density.begin(), h.density.end(), 0.0) * h.binWidth;
}

TEST(Statistics, OfAKnownSample)
{
  const std::vector<double> values{2, 4, 4, 4, 5, 5, 7, 9};
  const atria::Statistics s = atria::distributionOf(values, 1).statistics;
  EXPECT_EQ(s.count, 8u);
  EXPECT_EQ(s.minimum, 2.0);
  EXPECT_EQ(s.maximum, 9.0);
  EXPECT_DOUBLE_EQ(s.mean, 5.0);
  EXPECT_DOUBLE_EQ(s.standardDeviation, 2.0);
}

TEST(Statistics, LeaveOutWhatIsNotANumber)
{
  const std::vector<double> values{nan, 1, nan, 3};
  const atria::Statistics s = atria::distributionOf(values, 1).statistics;
  EXPECT_EQ(s.count, 2u);
  EXPECT_DOUBLE_EQ(s.mean, 2.0);
  EXPECT_EQ(s.minimum, 1.0);
  EXPECT_EQ(s.maximum, 3.0);
}

TEST(Statistics, ShowAnInfiniteExtremeButKeepTheMeanFinite)
{
  const std::vector<double> values{1, 3, inf};
  const atria::Statistics s = atria::distributionOf(values, 1).statistics;
  EXPECT_EQ(s.maximum, inf);
  EXPECT_EQ(s.count, 2u);
  EXPECT_DOUBLE_EQ(s.mean, 2.0);
}

TEST(Statistics, FindExtremesWhereverTheyAreAndWhateverIsBesideThem)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const std::size_t size : {1u, 63u, 64u, 65u, 1000u, 70000u})
  {
    std::vector<double> values(size);
    std::generate(values.begin(), values.end(), [&] { return number(random); });
    for (const double other : {0.0, nan, inf, -inf})
    {
      values[random() % size] = other;
      const atria::Statistics s = atria::distributionOf(values, 7).statistics;
      std::vector<double> numbers = values;
      std::erase_if(numbers, [](double value) { return std::isnan(value); });
      EXPECT_EQ(s.count, std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
      if (!numbers.empty())
      {
        EXPECT_EQ(s.minimum, *std::min_element(numbers.begin(), numbers.end()));
        EXPECT_EQ(s.maximum, *std::max_element(numbers.begin(), numbers.end()));
      }
    }
  }
}

TEST(Statistics, OfNothingAreNoNumbers)
{
  const atria::Statistics s = atria::distributionOf({}, 1).statistics;
  EXPECT_EQ(s.count, 0u);
  EXPECT_TRUE(std::isnan(s.minimum) && std::isnan(s.maximum) && std::isnan(s.mean) && std::isnan(s.standardDeviation));
}

TEST(Statistics, KeepTheDigitsOfManySmallDifferences)
{
  std::vector<double> values(1000000, 1e8);
  for (std::size_t i = 0; i < values.size(); i += 2)
  {
    values[i] += 1.0;
  }
  const atria::Statistics s = atria::distributionOf(values, 1).statistics;
  EXPECT_DOUBLE_EQ(s.mean, 1e8 + 0.5);
  EXPECT_NEAR(s.standardDeviation, 0.5, 1e-9);
}

TEST(Statistics, AndHistogramsHaveTheSameBitsForAnyNumberOfThreads)
{
  std::vector<double> values(300000);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = std::sin(static_cast<double>(i)) + 1e-3 * static_cast<double>(i % 1000);
  }
  const atria::Statistics one = atria::distributionOf(values, 1).statistics;
  const atria::Statistics many = atria::distributionOf(values, 1, atria::ThreadExecutor(7)).statistics;
  EXPECT_EQ(one.count, many.count);
  EXPECT_EQ(one.minimum, many.minimum);
  EXPECT_EQ(one.maximum, many.maximum);
  EXPECT_EQ(one.mean, many.mean);
  EXPECT_EQ(one.standardDeviation, many.standardDeviation);
  EXPECT_EQ(atria::distributionOf(values, 33).histogram.density,
            atria::distributionOf(values, 33, atria::ThreadExecutor(7)).histogram.density);
}

TEST(Histogram, IntegratesToOneAndEndsAtOne)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(3.0, 2.0);
  for (const std::size_t bins : {1u, 2u, 50u, 10000u})
  {
    std::vector<double> values(5000);
    std::generate(values.begin(), values.end(), [&] { return normal(random); });
    values.push_back(nan);
    const atria::Histogram h = atria::distributionOf(values, bins).histogram;
    ASSERT_EQ(h.centers.size(), bins);
    EXPECT_NEAR(integral(h), 1.0, 1e-12);
    EXPECT_EQ(h.cumulative.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(h.cumulative.begin(), h.cumulative.end()));
    EXPECT_TRUE(std::is_sorted(h.centers.begin(), h.centers.end()));
  }
}

TEST(Histogram, PutsTheGreatestValueIntoTheLastBin)
{
  const std::vector<double> values{0, 1, 2, 3, 4};
  const atria::Histogram h = atria::distributionOf(values, 4).histogram;
  EXPECT_DOUBLE_EQ(h.binWidth, 1.0);
  EXPECT_DOUBLE_EQ(h.centers[0], 0.5);
  EXPECT_DOUBLE_EQ(h.density[0], 0.2);
  EXPECT_DOUBLE_EQ(h.density[3], 0.4);
  EXPECT_DOUBLE_EQ(h.cumulative[2], 0.6);
}

TEST(Histogram, OfOneValueIsCenterdOnIt)
{
  for (const double value : {0.0, 1e20, -5e-300})
  {
    const std::vector<double> values(7, value);
    const atria::Histogram h = atria::distributionOf(values, 10).histogram;
    EXPECT_NEAR(integral(h), 1.0, 1e-12);
    EXPECT_EQ(h.cumulative.back(), 1.0);
  }
}

TEST(Histogram, OfNothingIsZero)
{
  const atria::Histogram h = atria::distributionOf({}, 5).histogram;
  EXPECT_EQ(h.density, std::vector<double>(5, 0.0));
  EXPECT_EQ(h.cumulative, std::vector<double>(5, 0.0));
}

/// Threads that have a part each and wait for one another.
class Threads : public atria::Reduction
{
public:
  explicit Threads(int count) : barrier(count) {}

  void sum(std::span<double> values) const override
  {
    reduce(values, [](double a, double b) { return a + b; });
  }
  void least(std::span<double> values) const override
  {
    reduce(values, [](double a, double b) { return std::min(a, b); });
  }
  void greatest(std::span<double> values) const override
  {
    reduce(values, [](double a, double b) { return std::max(a, b); });
  }

private:
  template <typename F> void reduce(std::span<double> values, F&& both) const
  {
    {
      const std::lock_guard lock(mutex);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        all.size() > i ? void(all[i] = both(all[i], values[i])) : all.push_back(values[i]);
      }
    }
    barrier.arrive_and_wait();
    std::copy_n(all.begin(), values.size(), values.begin());
    barrier.arrive_and_wait();
    {
      const std::lock_guard lock(mutex);
      all.clear();
    }
    barrier.arrive_and_wait();
  }

  mutable std::barrier<> barrier;
  mutable std::mutex mutex;
  mutable std::vector<double> all;
};

TEST(Statistics, OfPartsAreThoseOfTheWhole)
{
  std::mt19937 random(5);
  std::normal_distribution<double> some(3.0, 2.0);
  std::vector<std::vector<double>> parts(3);
  for (const std::size_t part : {0, 2}) // one has nothing
  {
    parts[part].resize(1000 + part);
    std::ranges::generate(parts[part], [&] { return some(random); });
  }
  parts[2][5] = inf;
  std::vector<double> values(7, 1.5);
  std::ranges::for_each(parts, [&](const auto& part) { values.insert(values.end(), part.begin(), part.end()); });
  const atria::Distribution whole = atria::distributionOf(values, 20);
  const Threads together(3);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 3; ++i)
  {
    threads.emplace_back([&, i] {
      const atria::Repeated repeated{1.5, i == 1 ? 7u : 0u};
      const atria::Distribution d = atria::distributionOf(parts[i], 20, atria::SerialExecutor(), repeated, &together);
      EXPECT_EQ(d.statistics.count, whole.statistics.count);
      EXPECT_EQ(d.statistics.minimum, whole.statistics.minimum);
      EXPECT_EQ(d.statistics.maximum, inf);
      EXPECT_NEAR(d.statistics.mean, whole.statistics.mean, 1e-13);
      EXPECT_NEAR(d.statistics.standardDeviation, whole.statistics.standardDeviation, 1e-13);
      EXPECT_EQ(d.histogram.density, whole.histogram.density);
    });
  }
  std::ranges::for_each(threads, &std::thread::join);
}

} // namespace
