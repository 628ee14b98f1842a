// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes whose elements do not fit the memory are refused before it is gone, with sizes that do fit.
#include "Layer/LayerBudget.h"
#include "Octree/Sizing/ElementBudget.h"
#include "SizedOctree.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t gigabyte = 1'000'000'000;

class MemoryLimit : public ::testing::Test
{
protected:
  RunContext context() { return quietContext(executor); }

  /// Of the refusal; empty where there is none.
  std::string refusal(const TriangleSurface& surface, const GridOptions& grid, const SizingOptions& sizing)
  {
    try
    {
      sized(surface, grid, sizing);
    }
    catch (const TooManyElements& error)
    {
      return error.what();
    }
    return {};
  }

  const ThreadExecutor executor{2};
};

TEST_F(MemoryLimit, WhatWouldTakeForEverIsRefusedAtOnce)
{
  // 10^11 octants and more: neither time nor memory of any machine would do.
  SizingOptions sizing;
  sizing.memoryLimit = 8 * gigabyte;
  const std::string fine = refusal(twoBoxes(), gridOf(24.0, 1e-4, 1e-4, 4.0), sizing);
  EXPECT_THAT(fine, AllOf(HasSubstr("8 GB"), HasSubstr("raise SizeMin and SizeMid to that"), HasSubstr("LengthUnit")));
  EXPECT_THAT(fine, Not(HasSubstr("SizeMax,")));
  EXPECT_THAT(refusal(twoBoxes(), gridOf(24.0, 1e-3, 1e-3, 1e-3), sizing), HasSubstr("raise SizeMax"));
  sizing.boxes = {{{Vec3(-1, -1, -1), Vec3(1, 1, 1)}, 1e-4}};
  EXPECT_THAT(refusal(twoBoxes(), gridOf(24.0, 0.5, 1.0, 4.0), sizing), HasSubstr("finer requested sizes"));
  sizing.boxes.clear();
  sizing.distanceSizes = {{"Detail", 1.0, 1e-4}};
  EXPECT_THAT(refusal(twoBoxes(), gridOf(24.0, 0.5, 1.0, 4.0), sizing), HasSubstr("finer requested sizes"));
}

TEST_F(MemoryLimit, OfNoneThereAreAsManyElementsAsNumbers)
{
  const std::string text = refusal(twoBoxes(), gridOf(24.0, 1e-4, 1e-4, 4.0), {});
  EXPECT_THAT(text, AllOf(HasSubstr("2.1 billion are the most there can be"), HasSubstr("raise SizeMin and SizeMid")));
}

TEST_F(MemoryLimit, OfLessThanAnElementFitsNothing)
{
  SizingOptions sizing;
  sizing.memoryLimit = bytesPerElement - 1;
  EXPECT_NE(refusal(twoBoxes(), gridOf(24.0, 1.0, 1.0, 4.0), sizing), "");
}

TEST_F(MemoryLimit, TheSizeItNamesFitsAndAQuarterOfItDoesNot)
{
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    SizingOptions sizing;
    sizing.memoryLimit = gigabyte / 100 * (3 + seed);
    const std::string text = refusal(randomSoup(seed), gridOf(8.0, 0.002, 0.004, 1.0), sizing);
    const auto at = text.find("Octants of ");
    ASSERT_NE(at, std::string::npos) << text;
    const double size = std::stod(text.substr(at + 11));
    EXPECT_EQ(refusal(randomSoup(seed), gridOf(8.0, size, std::max(size, 0.004), 1.0), sizing), "");
    EXPECT_NE(refusal(randomSoup(seed), gridOf(8.0, size / 4.0, size / 4.0, 1.0), sizing), "");
  }
}

TEST_F(MemoryLimit, NothingThatFitsIsRefused)
{
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const SizingOptions free = seed % 2 ? everything() : SizingOptions{};
    const GridOptions grid = gridOf(8.0, 0.0625, 0.125, 1.0);
    const std::size_t elements = sized(randomSoup(seed), grid, free).elements();
    SizingOptions sizing = free;
    sizing.memoryLimit = elements * bytesPerElement * 11 / 10;
    EXPECT_EQ(refusal(randomSoup(seed), grid, sizing), "");
    sizing.memoryLimit = elements * bytesPerElement / 2;
    EXPECT_NE(refusal(randomSoup(seed), grid, sizing), "");
    sizing.maxElements = elements / 3;
    EXPECT_EQ(refusal(randomSoup(seed), grid, sizing), "") << "MaxElements keeps to the limit";
  }
}

TEST_F(MemoryLimit, ASampleCountsWhatThereIs)
{
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    SCOPED_TRACE(seed);
    SizingOptions sizing;
    sizing.surfaceSizes = {{"S*", 0.02, 0.01}};
    const GridOptions grid = gridOf(8.0, 0.02, 0.04, 1.0);
    const Sized s = sized(randomSoup(seed), grid, sizing);
    const OctantCounts counts = sampleOctants(s.model, s.frame, sizing, context());
    const double share = counts.leaves() / static_cast<double>(s.elements());
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 1.05) << "what balancing adds is not in the sample";
    EXPECT_GT(s.elements(), 300'000u) << "enough for a sample";
  }
}

TEST_F(MemoryLimit, FewOctantsAreCountedExactly)
{
  const Sized s = sized(twoBoxes(), gridOf(24.0, 1.0, 1.0, 1.0), {});
  const OctantCounts counts = sampleOctants(s.model, s.frame, {}, context());
  std::vector<double> octants(counts.refined.size() + 1, 0.0);
  eachLeaf(s.octree, [&](Index leaf) { octants[s.octree.level(leaf)] += 1.0; });
  for (std::size_t l = 0; l < octants.size(); ++l)
  {
    EXPECT_EQ(counts.leavesAt(l), octants[l]) << l;
  }
  EXPECT_EQ(counts.leavesDownTo(1), 8.0);
}

TEST_F(MemoryLimit, AnEstimateTellsAboutHowManyWouldBeRefused)
{
  const GridOptions grid = gridOf(8.0, 0.02, 0.04, 1.0);
  const Sized s = sized(randomSoup(2), grid, {});
  SizingOptions sizing;
  EXPECT_FALSE(estimateElements(s.model, s.frame, sizing, context()).isTooLarge);
  sizing.memoryLimit = 1'000'000;
  const MeshEstimate estimate = estimateElements(s.model, s.frame, sizing, context());
  EXPECT_TRUE(estimate.isTooLarge);
  EXPECT_GT(estimate.elements, s.elements() / 2);
  EXPECT_LT(estimate.elements, s.elements() * 11 / 10);
  EXPECT_EQ(estimate.bytes, estimate.elements * bytesPerElement);
  EXPECT_THAT(estimate.warning, HasSubstr("MemoryLimit"));
}

TEST_F(MemoryLimit, LayersCountToo)
{
  const Sized s = sized(twoBoxes(), gridOf(24.0, 0.25, 0.5, 4.0), {});
  const auto count = [&](const std::vector<LayerRule>& rules, bool hexahedra = false) {
    return countLayerElements(s.octree, s.model, rules, hexahedra, context());
  };
  const std::size_t some = count({{"Detail", {3}}});
  const std::size_t all = count({{"*", {3}}});
  std::size_t leaves = 0, occupied = 0;
  eachLeaf(s.octree, [&](Index leaf) {
    ++leaves;
    occupied += s.octree.items(leaf, ModelItem::triangle).empty() ? 0 : 1;
  });
  EXPECT_EQ(count({}), 0U);
  EXPECT_EQ(all, 3 * occupied);
  EXPECT_GT(some, 0U);
  EXPECT_LT(some, all);
  EXPECT_GT(count({}, true), 2 * occupied) << "one on both sides of walls, and on the domain's sides";
  EXPECT_EQ(count({{"Detail", {3}}}, true), 3 * count({}, true)) << "all walls have as many";
  const auto check = [&](std::size_t bytes) {
    checkLayerBudget(s.octree, s.model, {{"*", {3}}}, false, bytes, context());
  };
  EXPECT_NO_THROW(check((leaves + all) * bytesPerElement));
  EXPECT_NO_THROW(check(0));
  EXPECT_THROW(check((leaves + all - 1) * bytesPerElement), Error);
}

TEST_F(MemoryLimit, NumbersAreWrittenAsPeopleSayThem)
{
  EXPECT_EQ(inWords(23400.4), "23400");
  EXPECT_EQ(inWords(1.234e6), "1.23 million");
  EXPECT_EQ(inWords(5e9), "5 billion");
  EXPECT_EQ(inWords(5e15), "5e+15");
  EXPECT_EQ(inGigabytes(25.27e9), "25.3 GB");
  EXPECT_EQ(inGigabytes(1.5e12), "1500 GB");
}

} // namespace
