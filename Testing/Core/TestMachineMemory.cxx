// SPDX-License-Identifier: GPL-3.0-or-later
/// How much memory there is, whoever limits it.
#include "Support/MachineMemory.h"
#include "Support/TestPaths.h"

#include <gtest/gtest.h>

#include <fstream>

#include <sys/resource.h>

namespace {

namespace fs = std::filesystem;

using atria::controlGroupLimit;
using atria::unlimitedMemory;

class ControlGroups : public ::testing::Test
{
protected:
  void write(const std::string& file, const std::string& text) const
  {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text << "\n";
  }

  const atria::testing::ScratchFolder scratch;
  const fs::path root = scratch.path();
};

TEST_F(ControlGroups, TheLeastLimitOfAGroupAndThoseAroundItHolds)
{
  write("memory.max", "max");
  write("user/memory.max", "4000000000");
  write("user/session/memory.max", "9000000000");
  EXPECT_EQ(controlGroupLimit(root, "0::/user/session\n"), 4000000000u);
  EXPECT_EQ(controlGroupLimit(root, "0::/\n"), unlimitedMemory);
}

TEST_F(ControlGroups, InAContainerTheTopIsItsOwn)
{
  write("memory.max", "2000000000");
  EXPECT_EQ(controlGroupLimit(root, "0::/docker/1234\n"), 2000000000u);
}

TEST_F(ControlGroups, TheFirstVersionHasAHierarchyForMemory)
{
  write("memory/batch/memory.limit_in_bytes", "3000000000");
  write("cpu/batch/memory.limit_in_bytes", "1");
  EXPECT_EQ(controlGroupLimit(root, "5:cpu,cpuacct:/batch\n4:hugetlb,memory:/batch\n"), 3000000000u);
  EXPECT_EQ(controlGroupLimit(root, "5:cpu,cpuacct:/batch\n"), unlimitedMemory);
}

TEST_F(ControlGroups, WhatIsNotThereLimitsNothing)
{
  EXPECT_EQ(controlGroupLimit(root, "0::/user\n"), unlimitedMemory);
  EXPECT_EQ(controlGroupLimit(root, "nonsense"), unlimitedMemory);
  EXPECT_EQ(controlGroupLimit(root, ""), unlimitedMemory);
}

TEST(MachineMemory, IsNoMoreThanTheShellAllows)
{
  const std::size_t before = atria::memoryOfMachine();
  EXPECT_GT(before, 100'000'000u);
  ASSERT_LT(before, unlimitedMemory);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &limit), 0);
  rlimit lower = limit;
  lower.rlim_cur = before / 2;
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &lower), 0);
  EXPECT_EQ(atria::memoryOfMachine(), before / 2);
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &limit), 0);
  EXPECT_EQ(atria::memoryOfMachine(), before);
}

} // namespace
