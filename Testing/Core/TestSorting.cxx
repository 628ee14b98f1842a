// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sorting on threads.
#include "Support/Error.h"
#include "Support/Progress.h"
#include "Support/QuietContext.h"
#include "Support/Sorting.h"
#include "SupportSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::ClaimedThreads;
using atria::testing::quietContext;
using atria::testing::someNumbers;
using ::testing::ElementsAreArray;

TEST(SortOnThreads, GivesTheOrderOfOneSort)
{
  for (const std::size_t count : {0u, 1u, 2u, 16384u, 16385u, 32770u, 50001u})
  {
    const std::vector<Index> given = someNumbers(count, 20000);
    std::vector<Index> wanted = given;
    std::ranges::sort(wanted);
    for (const int threads : {1, 2, 5, 1000})
    {
      std::vector<Index> list = given;
      const ClaimedThreads executor(threads);
      sortOnThreads(list, quietContext(executor));
      EXPECT_EQ(list, wanted) << count << " on " << threads;
    }
  }
}

TEST(SortOnThreads, SortsByTheGivenComparison)
{
  std::vector<Index> list = someNumbers(40000, 1000000);
  std::vector<Index> wanted = list;
  std::ranges::sort(wanted, std::greater<>());
  const ThreadExecutor threads(3);
  sortOnThreads(list, quietContext(threads), std::greater<>());
  EXPECT_EQ(list, wanted);
}

TEST(SortOnThreads, GivesEachThreadAPiece)
{
  for (const int threads : {1, 2, 4, 6})
  {
    std::vector<Index> list = someNumbers(200000, 100);
    const ClaimedThreads executor(threads);
    sortOnThreads(list, quietContext(executor));
    EXPECT_GE(executor.mostRanges, static_cast<std::size_t>(threads));
  }
}

/// Says that the user wants to stop, after `patience` questions.
class Impatient : public SilentMonitor
{
public:
  explicit Impatient(int patience) : left(patience) {}
  bool aborted() const override { return left-- <= 0; }

private:
  mutable int left;
};

TEST(SortOnThreads, EndsWhenTheUserAborts)
{
  for (const int patience : {0, 1})
  {
    Impatient monitor(patience);
    const ClaimedThreads executor(2);
    std::vector<Index> list = someNumbers(40000, 100);
    EXPECT_THROW(sortOnThreads(list, {executor, ProgressRange(monitor)}), Aborted) << "after " << patience;
  }
}

TEST(UniqueLists, AreSortedAndMerged)
{
  for (const std::size_t count : {0u, 1u, 2u, 50u})
  {
    for (const std::size_t more : {0u, 1u, 50u})
    {
      std::vector<Index> a = someNumbers(count, 40, 3);
      std::vector<Index> b = someNumbers(more, 40, 4);
      std::set<Index> wanted(a.begin(), a.end());
      sortUnique(a);
      EXPECT_THAT(a, ElementsAreArray(wanted));
      wanted.insert(b.begin(), b.end());
      sortUnique(b);
      mergeUnique(a, b);
      EXPECT_THAT(a, ElementsAreArray(wanted));
    }
  }
}

} // namespace
