// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sums that are independent of order, angles, the clock of stages, and how progress and abort are passed on.
#include "Support/ExactSum.h"

#include "Support/Angles.h"
#include "Support/Executor.h"
#include "Support/Progress.h"
#include "Support/RunContext.h"
#include "Support/StageClock.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

ExactSum sumOf(const std::vector<double>& values, const SumUnits& units)
{
  ExactSum sum;
  for (const double value : values)
  {
    sum.add(value, units);
  }
  return sum;
}

/// Numbers of either sign with magnitudes from 2^`low` to 2^`high`.
std::vector<double> someValues(std::size_t count, double low, double high, std::mt19937& random)
{
  std::uniform_real_distribution<double> exponent(low, high);
  std::vector<double> values(count);
  std::ranges::generate(values, [&] { return (random() % 2 == 0 ? 1.0 : -1.0) * std::exp2(exponent(random)); });
  return values;
}

TEST(SumUnits, ArePowersOfTwoThatHoldSumsAndLoseLittle)
{
  std::mt19937 random(1);
  std::vector<double> scales = someValues(200, -300.0, 300.0, random);
  scales.insert(scales.end(), {1.0, 2.0, 0.25, 3.0, 1.0 - 1e-10, 1.0 + 1e-10});
  for (const double signedScale : scales)
  {
    const double scale = std::abs(signedScale);
    const SumUnits units(scale);
    int exponent = 0;
    EXPECT_EQ(std::frexp(units.coarse, &exponent), 0.5) << scale;
    EXPECT_GE(std::ldexp(units.coarse, 53), std::ldexp(scale, 9)) << "sums of 2^9 scales are below 2^53 units";
    EXPECT_LT(0.5 * units.fine(), std::ldexp(scale, -68)) << "rounding loses half a fine unit";
    EXPECT_GE(std::ldexp(units.fine(), 53), std::ldexp(0.5 * units.coarse, 29)) << "2^29 rests are below 2^53 units";
  }
}

#ifdef __SIZEOF_INT128__
__extension__ using Wide = __int128;

TEST(ExactSum, OfNumbersThatAreMultiplesOfTheFineUnitIsExact)
{
  std::mt19937 random(2);
  const SumUnits units(1.0);
  ASSERT_EQ(units.fine(), std::ldexp(1.0, -68));
  for (const std::size_t count : {1u, 2u, 3u, 500u, 20000u})
  {
    // Numbers of at least 2^-15 are multiples of 2^-68.
    std::vector<double> values = someValues(count, -15.0, 0.0, random);
    Wide exact = 0;
    for (const double value : values)
    {
      exact += static_cast<Wide>(std::ldexp(value, 68));
    }
    EXPECT_EQ(sumOf(values, units).value(), std::ldexp(static_cast<double>(exact), -68));
  }
}

TEST(ExactSum, IsExactUpToItsLimit)
{
  const SumUnits units(1.0);
  const double small = std::ldexp(1.0, -53);
  ExactSum sum;
  Wide exact = 0;
  for (int i = 0; i < 512; ++i)
  {
    sum.add(1.0 - small * i, units);
    exact += (Wide{1} << 53) - i;
  }
  EXPECT_EQ(sum.value(), std::ldexp(static_cast<double>(exact), -53));
  for (int i = 0; i < 512; ++i)
  {
    sum.add(-1.0, units);
  }
  EXPECT_EQ(sum.value(), -small * 512 * 511 / 2) << "no bit was lost on the way";
}
#endif

TEST(ExactSum, IsTheSameInAnyOrderAndGrouping)
{
  std::mt19937 random(3);
  const SumUnits units(7.0);
  std::vector<double> values = someValues(300, -80.0, 2.0, random);
  const ExactSum wanted = sumOf(values, units);
  for (int round = 0; round < 20; ++round)
  {
    std::ranges::shuffle(values, random);
    const auto cut = values.begin() + static_cast<std::ptrdiff_t>(random() % values.size());
    ExactSum sum = sumOf({values.begin(), cut}, units);
    sum.add(sumOf({cut, values.end()}, units));
    EXPECT_EQ(sum.coarse, wanted.coarse);
    EXPECT_EQ(sum.fine, wanted.fine);
    EXPECT_EQ(sum.value(), wanted.value());
  }
}

TEST(ExactSum, LosesLittleOfEachNumber)
{
  std::mt19937 random(4);
  for (const double scale : {1.0, 1.9, 6.0, 1e-20})
  {
    const SumUnits units(scale);
    for (const double share : someValues(300, -75.0, 0.0, random))
    {
      const ExactSum sum = sumOf({share * scale}, units);
      const double lost = (share * scale - sum.coarse) - sum.fine;
      EXPECT_LT(std::abs(lost), std::ldexp(scale, -68)) << share;
      EXPECT_LE(std::abs(sum.fine), 0.5 * units.coarse) << "the rest to the nearest coarse multiple";
    }
  }
}

TEST(ExactSum, OfANumberAndItsOppositeIsZero)
{
  std::mt19937 random(5);
  const SumUnits units(1.0);
  ExactSum sum;
  for (const double value : someValues(200, -70.0, 3.0, random))
  {
    sum.add(value, units);
    sum.add(-value, units);
    ASSERT_EQ(sum.coarse, 0.0);
    ASSERT_EQ(sum.fine, 0.0);
  }
  EXPECT_EQ(ExactSum().value(), 0.0);
}

TEST(Angles, AreDegreesOfRadiansAndCosines)
{
  const std::vector<std::pair<double, double>> cosines{{0, 1}, {60, 0.5}, {90, 0}, {120, -0.5}, {180, -1}};
  for (const auto& [degrees, cosine] : cosines)
  {
    EXPECT_NEAR(cosOfDegrees(degrees), cosine, 1e-15);
    EXPECT_NEAR(cosOfDegrees(-degrees), cosine, 1e-15);
    EXPECT_NEAR(degreesOfCosine(cosine), degrees, 1e-12);
  }
  EXPECT_DOUBLE_EQ(radians(180.0), std::acos(-1.0));
  EXPECT_DOUBLE_EQ(radians(-90.0), -0.5 * std::acos(-1.0));
}

TEST(Angles, OfCosinesBeyondOneAreClamped)
{
  EXPECT_EQ(degreesOfCosine(1.0 + 1e-9), 0.0);
  EXPECT_EQ(degreesOfCosine(7.0), 0.0);
  EXPECT_EQ(degreesOfCosine(-1.0 - 1e-9), 180.0);
  EXPECT_GT(degreesOfCosine(1.0 - 1e-12), 0.0);
}

TEST(Angles, DirectionsAtTheDiagonalRunAlong)
{
  EXPECT_GT(cosOfDegrees(45.0), alongCosine);
  EXPECT_LT(cosOfDegrees(45.1), alongCosine);
}

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

TEST(StageClock, AddsUpToTheTimeThatPassed)
{
  const auto before = Clock::now();
  StageClock clock;
  EXPECT_THAT(clock.stages(), IsEmpty());
  std::vector<double> inner;
  for (const char* stage : {"b", "a", "b", "c"})
  {
    const auto begin = Clock::now();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    inner.push_back(secondsSince(begin));
    clock.lap(stage);
  }
  const double all = secondsSince(before);
  ASSERT_THAT(clock.stages(), ElementsAre(Pair("b", ::testing::_), Pair("a", ::testing::_), Pair("c", ::testing::_)));
  const auto& stages = clock.stages();
  EXPECT_GE(stages[0].second, inner[0] + inner[2]);
  EXPECT_GE(stages[1].second, inner[1]);
  EXPECT_GE(stages[2].second, inner[3]);
  EXPECT_LE(stages[0].second + stages[1].second + stages[2].second, all);
}

/// Notes reports, and asks to stop once it has `limit` of them.
class NotingMonitor : public ProgressMonitor
{
public:
  explicit NotingMonitor(std::size_t reports = 1000) : limit(reports) {}
  void report(double fraction, const char* phase) override { notes.emplace_back(fraction, phase); }
  bool aborted() const override { return notes.size() >= limit; }

  std::vector<std::pair<double, std::string>> notes;
  std::size_t limit;
};

TEST(ProgressRange, MapsAPartOfAPart)
{
  NotingMonitor monitor;
  ProgressRange(monitor).report(0.3, "all");
  const ProgressRange range(monitor, 0.2, 0.6);
  range.report(0.0, "begin");
  range.report(0.5, "half");
  range.report(1.0, "end");
  const ProgressRange part = range.part(0.25, 0.75);
  part.report(0.0, "part");
  part.report(0.5, "part");
  part.part(0.5, 1.0).report(1.0, "last");
  EXPECT_THAT(monitor.notes,
              ElementsAre(Pair(DoubleEq(0.3), "all"), Pair(DoubleEq(0.2), "begin"), Pair(DoubleEq(0.4), "half"),
                          Pair(DoubleEq(0.6), "end"), Pair(DoubleEq(0.3), "part"), Pair(DoubleEq(0.4), "part"),
                          Pair(DoubleEq(0.5), "last")));
}

TEST(ProgressRange, ThrowsWhenTheUserAborts)
{
  NotingMonitor monitor(2);
  const ProgressRange range = ProgressRange(monitor).part(0.0, 0.5);
  EXPECT_FALSE(range.isAborted());
  EXPECT_NO_THROW(range.check());
  EXPECT_NO_THROW(range.report(0.5, "one"));
  EXPECT_THROW(range.report(1.0, "two"), Aborted);
  EXPECT_EQ(monitor.notes.size(), 2u) << "the monitor hears of the second, too";
  EXPECT_TRUE(range.isAborted());
  EXPECT_THROW(range.check(), Aborted);
}

TEST(StopMonitor, PassesOnTheRequestToStopOnly)
{
  NotingMonitor monitor(1);
  StopMonitor stop{ProgressRange(monitor)};
  EXPECT_NO_THROW(ProgressRange(stop).report(0.5, "task"));
  EXPECT_THAT(monitor.notes, IsEmpty());
  monitor.report(0.1, "own");
  EXPECT_TRUE(stop.aborted());
}

TEST(SilentMonitor, NeverAborts)
{
  SilentMonitor silent;
  EXPECT_NO_THROW(ProgressRange(silent).report(1.0, "end"));
}

TEST(RunContext, HandsOnItsExecutorAndAPartOfItsProgress)
{
  NotingMonitor monitor;
  const SerialExecutor serial;
  const RunContext part = RunContext{serial, ProgressRange(monitor, 0.5, 1.0)}.part(0.2, 0.4);
  EXPECT_EQ(&part.executor, &serial);
  part.progress.report(0.5, "half");
  EXPECT_THAT(monitor.notes, ElementsAre(Pair(DoubleEq(0.65), "half")));
}

TEST(AbortableExecutor, CoversEveryIndexOnceAroundTheRangesAtOnce)
{
  NotingMonitor monitor;
  const ThreadExecutor threads(5);
  const SerialExecutor serial;
  for (const Executor* target : {static_cast<const Executor*>(&threads), static_cast<const Executor*>(&serial)})
  {
    const AbortableExecutor executor(*target, monitor);
    EXPECT_EQ(executor.threads(), target->threads());
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 80u, 81u, 500u})
    {
      for (const std::size_t grain : {0u, 1u, 3u, 1000u})
      {
        std::vector<int> hits(count, 0);
        executor.forEach(count, grain, [&](std::size_t i) { ++hits.at(i); });
        EXPECT_EQ(hits, std::vector<int>(count, 1)) << count << " by " << grain;
      }
    }
  }
}

TEST(AbortableExecutor, RunsNoRangeAfterTheUserAborts)
{
  NotingMonitor monitor(1);
  const SerialExecutor serial;
  const AbortableExecutor executor(serial, monitor);
  std::size_t done = 0;
  const auto abortAtTen = [&](std::size_t i) {
    ++done;
    if (i == 10)
    {
      monitor.report(0.5, "stop");
    }
  };
  EXPECT_THROW(executor.forEach(1000, 1, abortAtTen), Aborted);
  EXPECT_EQ(done, 11u);
  EXPECT_THROW(executor.forEach(1, 1, abortAtTen), Aborted);
  EXPECT_EQ(done, 11u);
  EXPECT_NO_THROW(executor.forEach(0, 1, abortAtTen));
}

} // namespace
