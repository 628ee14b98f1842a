// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests rules for layers, and what is requested by them.
#include "Layer/LayerRules.h"
#include "LayerBlock.h"
#include "Support/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

TEST(LayerRules, TakeNumbersUpToTheirLimits)
{
  const WallLayers otherwise{9, 0.5, 1.5};
  for (const char* good : {"a 0", "a 100", "a 1 0", "a 1 1e9", "a 1 1 0.5", "a 1 1 5", "* 3", "\"a b\" 2 0.1 2"})
  {
    EXPECT_NO_THROW(layerRuleFrom(good, otherwise)) << good;
  }
  for (const char* wrong : {"a -1", "a 101", "a 1e7", "a 0.5", "a 1 -1e-9", "a 1 inf", "a 1 nan", "a 1 1 0.499",
                            "a 1 1 5.001", "a 1 1 1 1", "a", "", "a b 2"})
  {
    EXPECT_THROW(layerRuleFrom(wrong, otherwise), Error) << wrong;
  }
  EXPECT_EQ(layerRuleFrom("a 3", otherwise).layers, (WallLayers{3, 0.5, 1.5}));
  EXPECT_EQ(layerRuleFrom("a 3 0.25", otherwise).layers, (WallLayers{3, 0.25, 1.5}));
  EXPECT_EQ(layerRuleFrom("a 3 0.25 2", otherwise).layers, (WallLayers{3, 0.25, 2.0}));
  EXPECT_EQ(layerRuleFrom("\"a b\" 3", otherwise).pattern, "a b");
}

TEST(LayerRules, AreCheckedWhereTheyAreResolved)
{
  const double nan = std::nan("");
  for (const WallLayers& wrong :
       {WallLayers{-1}, {101}, {1, -0.1}, {1, nan}, {1, 0.1, 0.49}, {1, 0.1, 5.1}, {1, 0, nan}})
  {
    EXPECT_THROW(resolveLayerRules({{"*", wrong}}, {"Wall"}), Error);
  }
  EXPECT_THROW(resolveLayerRules({{"Roof", {1}}}, {"Wall"}), Error);
  EXPECT_THROW(resolveLayerRules({{"*Min", {1}}}, {"Wall"}), Error) << "patterns do not mean bare sides";
  EXPECT_NO_THROW(resolveLayerRules({{"*", {1}}}, {}));
}

TEST(LayerRules, ApplyToSurfacesAndThenToSidesByName)
{
  for (Index side = 0; side < sideNumbers; ++side)
  {
    const std::vector<WallLayers> ofTag = resolveLayerRules({{sideName(side), {4}}, {"B", {2}}}, {"A", "B"});
    ASSERT_EQ(ofTag.size(), 2U + sideNumbers);
    for (Index tag = 0; tag < ofTag.size(); ++tag)
    {
      EXPECT_EQ(ofTag[tag].layers, tag == 2 + side ? 4 : tag == 1 ? 2 : 0) << tag;
    }
  }
  const std::vector<WallLayers> last = resolveLayerRules({{"B", {2}}, {"*", {3}}, {"A", {5}}}, {"A", "B"});
  EXPECT_EQ(last[0].layers, 5);
  EXPECT_EQ(last[1].layers, 3);
}

TEST(LayerOptions, KnowWhatIsAskedAnywhere)
{
  const LayerOptions none = optionsFor({});
  EXPECT_FALSE(none.isAsked() || none.isDivided() || none.hasHeights());
  EXPECT_EQ(none.surfaceCount(), 1U);
  const LayerOptions one = optionsFor({{"zMax", {1}}});
  EXPECT_TRUE(one.isAsked());
  EXPECT_FALSE(one.isDivided() || one.hasHeights());
  EXPECT_TRUE(optionsFor({{"Wall", {2}}}).isDivided());
  EXPECT_TRUE(optionsFor({{"Wall", {1, 0.1}}}).hasHeights());
}

} // namespace
