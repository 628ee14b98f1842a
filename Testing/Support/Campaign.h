// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// How much of a campaign a test runs: a usual part, or all of it where ATRIA_TEST_FULL is set, as `Testing/run.sh
/// --full` does.
#pragma once

#include <cstdlib>

namespace atria::testing {

inline bool isFullCampaign() { return std::getenv("ATRIA_TEST_FULL") != nullptr; }

template <typename T> T campaign(T usual, T full) { return isFullCampaign() ? full : usual; }

} // namespace atria::testing
