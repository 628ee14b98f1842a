// SPDX-License-Identifier: GPL-3.0-or-later
/// Ranks that are threads of a test.
#pragma once

#include "Support/Campaign.h"
#include "Support/RankExchange.h"

#include <gtest/gtest.h>

#include <functional>

namespace atria::testing {

/// Runs `work` on so many ranks at the same time, and returns when all are done. Throws what the first of those threw
/// that failed.
void onRanks(int ranks, const std::function<void(RankExchange&)>& work);

/// A test on as many ranks as its parameter says: on 2 and 5, and on 1 and 3 in a full campaign alone.
class OnNumbersOfRanks : public ::testing::TestWithParam<int>
{
protected:
  void SetUp() override
  {
    if ((GetParam() == 1 || GetParam() == 3) && !isFullCampaign())
    {
      GTEST_SKIP() << "set ATRIA_TEST_FULL for more numbers of ranks";
    }
  }
};

} // namespace atria::testing
