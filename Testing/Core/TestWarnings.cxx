// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings are counted and put in order.
#include "Support/Warning.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using ::testing::Field;

std::vector<Warning> sameOf(const std::vector<std::string>& texts)
{
  std::vector<Warning> out;
  for (const std::string& text : texts)
  {
    out.push_back({text});
  }
  return out;
}

auto hasText(const std::string& text) { return Field(&Warning::text, text); }

TEST(Warnings, AreOrderedByGravity)
{
  const std::vector<Warning> ordered =
      byGravity({{"b", Gravity::detail}, {"c"}, {"a", Gravity::grave}, {"d"}, {"e", Gravity::grave}});
  EXPECT_THAT(ordered, ElementsAre(hasText("a"), hasText("e"), hasText("c"), hasText("d"), hasText("b")));
}

TEST(Warnings, ThatDifferInNamesAndNumbersAreOne)
{
  const std::vector<Warning> found =
      counted(sameOf({"m.wrl:2: 'Post1': 1 face is bent", "the model's unit is unknown",
                      "m.wrl:3: 'Post2': 12 face is bent", "m.wrl:4: 'Post3': 1.5 face is bent"}));
  EXPECT_THAT(found, ElementsAre(hasText("m.wrl:2: 'Post1': 1 face is bent (and 2 more like it: 'Post2', 'Post3')"),
                                 hasText("the model's unit is unknown")));
  EXPECT_EQ(found[0].count, 3U);
  EXPECT_EQ(found[1].count, 1U);
}

TEST(Warnings, NameTheFirstOnly)
{
  std::vector<std::string> texts;
  for (int i = 0; i < 9; ++i)
  {
    texts.push_back("'Wall" + std::to_string(i) + "' meets 'Roof'; delete one");
  }
  EXPECT_THAT(counted(sameOf(texts)),
              ElementsAre(hasText("'Wall0' meets 'Roof'; delete one (and 8 more like it: 'Wall1', 'Wall2', 'Wall3', "
                                  "…)")));
}

TEST(Warnings, ThatAreTheSameAreCounted)
{
  EXPECT_THAT(counted(sameOf({"it's open", "it's open", "it's shut"})),
              ElementsAre(hasText("it's open (and 1 more like it)"), hasText("it's shut")));
}

} // namespace
