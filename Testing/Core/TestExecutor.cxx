// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Executor.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace {

std::vector<std::unique_ptr<atria::Executor>> executors()
{
  std::vector<std::unique_ptr<atria::Executor>> all;
  all.push_back(std::make_unique<atria::SerialExecutor>());
  for (const int n : {1, 2, 7})
  {
    all.push_back(std::make_unique<atria::ThreadExecutor>(n));
  }
  return all;
}

TEST(Executor, CoversEveryIndexOnceWhateverTheGrain)
{
  for (const auto& executor : executors())
  {
    for (const std::size_t count : {0u, 1u, 17u, 1000u})
    {
      for (const std::size_t grain : {0u, 1u, 16u, 5000u})
      {
        std::vector<int> hits(count, 0);
        executor->forEach(count, grain, [&](std::size_t i) { ++hits[i]; });
        EXPECT_EQ(hits, std::vector<int>(count, 1));
      }
    }
  }
}

TEST(Executor, PassesOnAnExceptionAfterAllPiecesEnded)
{
  for (const auto& executor : executors())
  {
    EXPECT_THROW(executor->forEach(100, 10,
                                   [](std::size_t i) {
                                     if (i == 55)
                                     {
                                       throw std::runtime_error("piece");
                                     }
                                   }),
                 std::runtime_error);
  }
}

} // namespace
