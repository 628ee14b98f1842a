// SPDX-License-Identifier: GPL-3.0-or-later
/// Progress and abort of the core, at every kind of moment.
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

namespace {

using atria::Vec3;

/// Aborts at a certain question.
class CountingMonitor : public atria::ProgressMonitor
{
public:
  explicit CountingMonitor(std::size_t abortAt = static_cast<std::size_t>(-1)) : limit(abortAt) {}

  void report(double fraction, const char* phase) override
  {
    fractions.push_back(fraction);
    phases.emplace_back(phase);
  }
  bool aborted() const override { return ++asked >= limit; }

  std::vector<double> fractions;
  std::vector<std::string> phases;
  mutable std::atomic<std::size_t> asked{0};

private:
  std::size_t limit;
};

/// A building with a canopy whose boundary edge ends in the open, next to a dome: walls, sheets and curved surfaces.
atria::TriangleSurface scene()
{
  atria::TriangleSurface surface;
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  atria::testing::addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  atria::testing::addSphere(surface, "Dome", Vec3(3.6, 1.3, 2.2), 1.2, 2);
  return surface;
}

atria::testing::Meshed meshUnder(atria::ProgressMonitor& monitor, const atria::Executor& threads)
{
  atria::GridOptions grid;
  grid.domain = {Vec3(-4, -4, 0), Vec3(6, 4, 5)};
  grid.sizeMin = 0.25;
  grid.sizeMid = 0.5;
  grid.sizeMax = 1.0;
  atria::DualMeshOptions options;
  options.layers = {{"*", {1}}};
  const atria::AbortableExecutor executor(threads, monitor);
  return atria::testing::meshIt(scene(), grid, options, {executor, atria::ProgressRange(monitor)});
}

TEST(Progress, RisesToOneAndEveryStepHasAName)
{
  CountingMonitor monitor;
  meshUnder(monitor, atria::SerialExecutor());
  ASSERT_FALSE(monitor.fractions.empty());
  EXPECT_TRUE(std::is_sorted(monitor.fractions.begin(), monitor.fractions.end()));
  EXPECT_GE(monitor.fractions.front(), 0.0);
  EXPECT_DOUBLE_EQ(monitor.fractions.back(), 1.0);
  EXPECT_EQ(std::count(monitor.phases.begin(), monitor.phases.end(), ""), 0);
}

TEST(Abort, AtAnyQuestionEndsTheRunAtOnce)
{
  CountingMonitor whole;
  const atria::testing::Meshed wanted = meshUnder(whole, atria::SerialExecutor());
  const std::size_t all = whole.asked;
  ASSERT_GT(all, 100u);
  const std::size_t step = std::max<std::size_t>(1, all / 30);
  for (std::size_t n = 1; n <= all; n += n < 8 ? 1 : step)
  {
    CountingMonitor monitor(n);
    EXPECT_THROW(meshUnder(monitor, atria::SerialExecutor()), atria::Aborted) << "question " << n << " of " << all;
    EXPECT_EQ(monitor.asked, n);
  }
  CountingMonitor again;
  EXPECT_TRUE(atria::testing::identical(wanted.mesh(), meshUnder(again, atria::SerialExecutor()).mesh()));
  EXPECT_EQ(again.asked, all);
}

TEST(Abort, EndsTheRunOnSeveralThreads)
{
  CountingMonitor whole;
  meshUnder(whole, atria::ThreadExecutor(3));
  for (const std::size_t part : {10, 4, 2})
  {
    CountingMonitor monitor(whole.asked / part);
    EXPECT_THROW(meshUnder(monitor, atria::ThreadExecutor(3)), atria::Aborted);
  }
}

TEST(Abort, ALoopAsksBeforeEveryRange)
{
  constexpr std::size_t count = 100000;
  constexpr std::size_t grain = 100;
  CountingMonitor monitor;
  std::vector<char> seen(count, 0);
  const atria::ThreadExecutor threads(3);
  atria::AbortableExecutor(threads, monitor).forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
    EXPECT_LE(end - begin, grain);
    std::for_each(seen.begin() + begin, seen.begin() + end, [](char& c) { ++c; });
  });
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
  EXPECT_GE(monitor.asked, count / grain);
}

} // namespace
