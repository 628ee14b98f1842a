// SPDX-License-Identifier: GPL-3.0-or-later
/// Ranks that are threads of a test.
#pragma once

#include "Support/RankExchange.h"

#include <functional>

namespace atria::testing {

/// Runs `work` on so many ranks at the same time, and returns when all are done. Throws what the first of those threw
/// that failed.
void onRanks(int ranks, const std::function<void(RankExchange&)>& work);

} // namespace atria::testing
