// SPDX-License-Identifier: GPL-3.0-or-later
/// What writers warn of.
#pragma once

#include "VtkErrorGuard.h"

#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <string>

namespace atria::testing {

/// Expects a warning for each check that fails by a writer's table of checks, and none for another. Returns how many
/// fail.
inline int expectCheckWarnings(VtkErrorGuard& messages, vtkTable* checks)
{
  int failed = 0;
  for (vtkIdType row = 0; row < checks->GetNumberOfRows(); ++row)
  {
    const auto value = [&](const char* column) { return checks->GetValueByName(row, column); };
    const bool fails = value("IsError").ToInt() != 0 && value("Failing").ToLongLong() > 0;
    const std::string name = value("Check").ToString();
    EXPECT_EQ(messages.takeWarnings("check " + name + " fails").size(), fails ? 1u : 0u) << name;
    failed += fails ? 1 : 0;
  }
  EXPECT_GT(checks->GetNumberOfRows(), 0);
  return failed;
}

} // namespace atria::testing
