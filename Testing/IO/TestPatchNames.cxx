// SPDX-License-Identifier: GPL-3.0-or-later
#include "PatchNames.h"

#include <gtest/gtest.h>

namespace {

std::vector<std::string> wordsFor(const std::vector<std::string>& names,
                                  const atria::NameRules& rules = atria::openFOAMNames)
{
  std::vector<std::string> words;
  for (const atria::PatchName& name : atria::makePatchNames(names, rules))
  {
    EXPECT_LE(name.word.size(), rules.longest);
    words.push_back(name.word);
  }
  return words;
}

using Words = std::vector<std::string>;

TEST(PatchNames, ValidNamesStayAsTheyAre)
{
  EXPECT_EQ(wordsFor({"xMin", "roof-2", "a.b_c+d"}), (Words{"xMin", "roof-2", "a.b_c+d"}));
}

TEST(PatchNames, ReplacesWhatAWordMayNotHold)
{
  EXPECT_EQ(wordsFor({"Wall 1", "SketchUp/group_0/ID12", "a;b{c}\"d\"", "(x)", "$v", "tab\tnew\nline"}),
            (Words{"Wall_1", "SketchUp_group_0_ID12", "a_b_c__d_", "_x_", "_v", "tab_new_line"}));
}

TEST(PatchNames, ReplacesACharacterOfSeveralBytesByOneUnderscore)
{
  EXPECT_EQ(wordsFor({"S\xC3\xBC"
                      "d"}),
            Words{"S_d"});
}

TEST(PatchNames, DoesNotBeginLikeANumber)
{
  EXPECT_EQ(wordsFor({"2nd floor", "-x", ".5", "+1"}), (Words{"_2nd_floor", "_-x", "_.5", "_+1"}));
}

TEST(PatchNames, BeginsWithALetterWhereAFormatTakesNoUnderscore)
{
  EXPECT_EQ(wordsFor({"2nd floor", "_x", "x_"}, {.punctuation = "_", .letterStart = true}),
            (Words{"N_2nd_floor", "N__x", "x_"}));
}

TEST(PatchNames, NamesTheNameless) { EXPECT_EQ(wordsFor({"", ""}), (Words{"patch", "patch_2"})); }

TEST(PatchNames, MakesEqualNamesDifferent)
{
  EXPECT_EQ(wordsFor({"a b", "a/b", "a_b", "a_b_2"}), (Words{"a_b", "a_b_2", "a_b_3", "a_b_2_2"}));
}

TEST(PatchNames, SidesOfASheetShareAGroup)
{
  const std::vector<std::string> names{"wall 1_back", "wall 1_front", "lone_front", "roof"};
  const auto made = atria::makePatchNames(names, atria::openFOAMNames);
  EXPECT_EQ(made[0].word, "wall_1_back");
  EXPECT_EQ(made[1].word, "wall_1_front");
  EXPECT_EQ(made[0].group, "wall_1");
  EXPECT_EQ(made[1].group, "wall_1");
  EXPECT_EQ(made[2].word, "lone_front");
  EXPECT_EQ(made[2].group, "");
  EXPECT_EQ(made[3].group, "");
}

TEST(PatchNames, SidesStayTogetherWhereTheirNameWasTaken)
{
  const std::vector<std::string> names{"a_b_front", "a b_front", "a b_back"};
  const auto made = atria::makePatchNames(names, atria::openFOAMNames);
  EXPECT_EQ(made[0].word, "a_b_front");
  EXPECT_EQ(made[1].word, "a_b_2_front");
  EXPECT_EQ(made[2].word, "a_b_2_back");
  EXPECT_EQ(made[1].group, "a_b_2");
}

TEST(PatchNames, APatchOfTheGroupsNameLeavesNoGroup)
{
  const std::vector<std::string> names{"sheet_front", "sheet_back", "sheet"};
  const auto made = atria::makePatchNames(names, atria::openFOAMNames);
  EXPECT_EQ(made[0].group, "");
  EXPECT_EQ(made[2].word, "sheet");
}

TEST(PatchNames, AreNoLongerThanTheFormatTakesAndStillUnique)
{
  const atria::NameRules rules{.punctuation = "_", .longest = 10};
  EXPECT_EQ(wordsFor({"abcdefghijklm", "abcdefghijkl", "sheetWithALongName_front", "sheetWithALongName_back"}, rules),
            (Words{"abcdefghij", "abcdefgh_2", "shee_front", "shee_back"}));
}

TEST(PatchNames, DifferInMoreThanCapitalsWhereTheseDoNotCount)
{
  const std::vector<std::string> names{"Wall", "wall", "WALL"};
  EXPECT_EQ(wordsFor(names, {.punctuation = "", .caseMatters = false}), (Words{"Wall", "wall_2", "WALL_3"}));
  EXPECT_EQ(wordsFor(names, {}), names);
}

TEST(PatchNames, PatternsOfOriginalsFitTheNamesMadeOfThem)
{
  const std::vector<std::string> originals{"Wand S\u00fcd", "2.OG", "Roof", "D\u00e4cher"};
  const std::vector<std::string> patterns{"Wand S\u00fc*", "2.OG", "R?of", "*\u00e4cher"};
  const Words words = wordsFor(originals, atria::openFOAMNames);
  for (std::size_t i = 0; i < originals.size(); ++i)
  {
    for (const std::string& pattern : {originals[i], patterns[i], words[i]})
    {
      EXPECT_TRUE(atria::matchesPatchName(pattern, words[i], atria::openFOAMNames)) << pattern;
    }
  }
  EXPECT_FALSE(atria::matchesPatchName("Wand", words[0], atria::openFOAMNames));
  EXPECT_TRUE(atria::matchesPatchName("my w*", "my wall", atria::openFOAMNames)) << "as other programs may name it";
}

TEST(PatchNames, SidesEndAsTheFormatHasIt)
{
  const atria::NameRules rules{.punctuation = "_-", .sides = {"", "-shadow"}};
  const std::vector<std::string> names{"sheet_back", "sheet_front", "sheet"};
  EXPECT_EQ(wordsFor(names, rules), (Words{"sheet-shadow", "sheet", "sheet_2"}));
  EXPECT_EQ(atria::makePatchNames(names, rules)[0].group, "");
}

} // namespace
