// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests buffers, and memory that is reserved and given back.
#include "Support/Buffer.h"
#include "Support/Memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace {

using namespace atria;
using ::testing::ElementsAre;

TEST(Buffer, ConstructsWhatHasAConstructor)
{
  Buffer<std::string> texts(2);
  texts.resize(3);
  texts.emplace_back(2, 'x');
  EXPECT_THAT(texts, ElementsAre("", "", "", "xx"));
  EXPECT_THAT(Buffer<int>(3, 7), ElementsAre(7, 7, 7));
}

TEST(Buffer, GivesItsMemoryBack)
{
  Buffer<int> buffer(100, 1);
  release(buffer);
  EXPECT_EQ(buffer.capacity(), 0u);
}

TEST(Memory, ForgetsWholePagesOnly)
{
#ifdef MADV_DONTNEED
  constexpr std::size_t page = std::size_t{1} << 21;
  Buffer<unsigned char> block(4 * page, 1);
  unsigned char* const aligned = block.data() + (page - std::bit_cast<std::uintptr_t>(block.data()) % page) % page;
  const auto forgotten = [](const unsigned char* first, std::size_t count) {
    return static_cast<std::size_t>(std::count(first, first + count, 0));
  };
  EXPECT_EQ(forgetPages(aligned, page - 1), 0u);
  EXPECT_EQ(forgetPages(aligned + 1, 2 * page - 2), 0u) << "no page lies within";
  EXPECT_EQ(forgotten(block.data(), block.size()), 0u);
  EXPECT_EQ(forgetPages(aligned + page - 5, page + 9), page + 5) << "one page, after five bytes";
  EXPECT_EQ(forgotten(aligned + page, page), page);
  EXPECT_EQ(forgotten(block.data(), block.size()), page) << "and no other";
  EXPECT_EQ(forgetPages(aligned, page), page);
  EXPECT_EQ(forgotten(aligned, page), page);
#endif
}

TEST(Memory, InLargePagesIsAlignedAsRequested)
{
  LargePages pages;
  void* const start = pages.allocate(std::size_t{5} << 20, 256);
  EXPECT_EQ(std::bit_cast<std::uintptr_t>(start) % 256, 0u);
  pages.deallocate(start, std::size_t{5} << 20, 256);
  EXPECT_TRUE(pages.is_equal(pages));
  EXPECT_FALSE(pages.is_equal(LargePages()));
}

TEST(Memory, IsReservedWithoutEntries)
{
  std::vector<int> list{4};
  reserveLarge(list, 1000);
  EXPECT_GE(list.capacity(), 1000u);
  EXPECT_THAT(list, ElementsAre(4));
}

} // namespace
