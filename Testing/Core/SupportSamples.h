// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers, and threads that are claimed only, for tests of lists.
#pragma once

#include "Support/Executor.h"
#include "Support/Types.h"

#include <algorithm>
#include <random>
#include <vector>

namespace atria::testing {

/// Runs on one thread, and says that there are several.
class ClaimedThreads : public SerialExecutor
{
public:
  explicit ClaimedThreads(int threads) : claimed(threads) {}
  int threads() const override { return claimed; }
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override
  {
    mostRanges = std::max(mostRanges, (count + grain - 1) / grain);
    SerialExecutor::forRanges(count, grain, body);
  }

  mutable std::size_t mostRanges = 0;

private:
  int claimed;
};

/// Random numbers below `end`.
inline std::vector<Index> someNumbers(std::size_t count, Index end, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> below(0, end - 1);
  std::vector<Index> numbers(count);
  std::ranges::generate(numbers, [&] { return below(random); });
  return numbers;
}

} // namespace atria::testing
