// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests connected parts of triangles.
#include "Draw.h"
#include "SoupSamples.h"
#include "Surface/Triangles/SoupParts.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addStrip;
using atria::testing::Draw;

TEST(SoupParts, AreNumberedByTheGreatestFaceOfTheirBoxes)
{
  TriangleSoup soup;
  addBox(soup, {0, 0, 0}, 10);                                                                       // faces of 100
  addBox(soup, {100, 0, 0}, 9);                                                                      // 81
  addBox(soup, {200, 0, 0}, 11);                                                                     // 121
  addStrip(soup, 500, 9);                                                                            // 90 * 10 = 900
  soup.points.push_back({7, 7, 7});                                                                  // of no triangle
  const std::array<std::array<LatticePoint, 3>, 3> lone{{{{{0, 900, 0}, {0, 900, 40}, {0, 902, 0}}}, // 80 across x
                                                         {{{0, 990, 0}, {0, 990, 41}, {2, 990, 0}}}, // 82 across y
                                                         {{{0, 800, 0}, {42, 800, 0}, {42, 802, 0}}}}}; // 84 across z
  for (const auto& corners : lone)
  {
    const auto first = static_cast<Index>(soup.points.size());
    soup.points.insert(soup.points.end(), corners.begin(), corners.end());
    soup.add({first, first + 1, first + 2}, 0, static_cast<Index>(soup.triangles.size()));
  }
  std::vector<Index> expected(12, 4);
  expected.insert(expected.end(), 12, 1);
  expected.insert(expected.end(), 12, 5);
  expected.insert(expected.end(), 18, 6);
  expected.insert(expected.end(), {0, 2, 3});
  EXPECT_EQ(partsOf(soup), expected);
}

TEST(SoupParts, OfEqualSizeAreNumberedByTheirLowestPointDownward)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 3; ++i)
  {
    addBox(soup, {100 * i, 0, 0}, 10);
  }
  const std::vector<Index> parts = partsOf(soup);
  EXPECT_EQ(parts[0], 2u);
  EXPECT_EQ(parts[12], 1u);
  EXPECT_EQ(parts[24], 0u);
}

TEST(SoupParts, HaveOneEntryPerSource)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}, {50, 0, 0}, {60, 0, 0}, {50, 10, 0}};
  soup.add({0, 1, 2}, 0, 2); // two pieces of one source
  soup.add({1, 3, 2}, 0, 2);
  soup.add({4, 5, 6}, 0, 5);
  const std::vector<Index> parts = partsOf(soup);
  ASSERT_EQ(parts.size(), 6u);
  EXPECT_EQ(parts[2], 1u);
  EXPECT_EQ(parts[5], 0u);
  EXPECT_TRUE(partsOf(TriangleSoup{}).empty());
}

/// Gives each point the lowest one of its part.
std::vector<Index> naiveParts(const TriangleSoup& soup)
{
  std::vector<Index> lowest(soup.points.size());
  std::iota(lowest.begin(), lowest.end(), Index{0});
  for (std::size_t turns = 0; turns < soup.points.size(); ++turns)
  {
    for (const auto& [a, b, c] : soup.triangles)
    {
      lowest[a] = lowest[b] = lowest[c] = std::min({lowest[a], lowest[b], lowest[c]});
    }
  }
  return lowest;
}

TEST(SoupParts, AreConnectedByCommonPoints)
{
  Draw draw(8);
  for (int round = 0; round < 100; ++round)
  {
    const TriangleSoup soup = draw.soup(30, 1 + draw.below(15));
    const std::vector<Index> lowest = naiveParts(soup);
    const std::vector<Index> parts = partsOf(soup);
    ASSERT_EQ(parts.size(), soup.triangles.size());
    std::map<Index, Index> partOf;
    std::set<Index> numbers;
    for (std::size_t t = 0; t < parts.size(); ++t)
    {
      EXPECT_EQ(partOf.try_emplace(lowest[soup.triangles[t][0]], parts[t]).first->second, parts[t]);
      numbers.insert(parts[t]);
    }
    EXPECT_EQ(numbers.size(), partOf.size()) << "two parts have two numbers";
    EXPECT_EQ(*numbers.rbegin() + 1, partOf.size()) << "numbers follow each other";
  }
}

} // namespace
