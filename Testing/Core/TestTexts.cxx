// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how the room Support reads, compares and writes texts: name patterns, rules, encodings, warnings.
#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/PatternRule.h"
#include "Support/Text.h"
#include "Support/Utf8.h"
#include "Support/Warning.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using Texts = std::vector<std::string>;

/// All texts of at most `most` of the given letters.
Texts allTexts(const std::string& letters, std::size_t most)
{
  Texts texts{""};
  for (std::size_t i = 0; i < texts.size() && texts[i].size() < most; ++i)
  {
    for (const char letter : letters)
    {
      texts.push_back(texts[i] + letter);
    }
  }
  return texts;
}

bool matchesSlowly(std::string_view pattern, std::string_view name)
{
  if (pattern.empty())
  {
    return name.empty();
  }
  if (pattern[0] == '*')
  {
    return matchesSlowly(pattern.substr(1), name) || (!name.empty() && matchesSlowly(pattern, name.substr(1)));
  }
  return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) &&
         matchesSlowly(pattern.substr(1), name.substr(1));
}

TEST(NamePattern, MatchesAsTheDefinitionSays)
{
  const Texts names = allTexts("ab", 5);
  for (const std::string& pattern : allTexts("ab*?", 4))
  {
    for (const std::string& name : names)
    {
      ASSERT_EQ(matchesPattern(pattern, name), matchesSlowly(pattern, name)) << pattern << " and " << name;
    }
  }
}

TEST(NamePattern, GoesBackToItsLastStarInLongNames)
{
  for (const char* pattern : {"*ab*aab*b", "a*ba?a*", "*aabb", "?*?b*"})
  {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round)
    {
      std::string name(random() % 14, ' ');
      std::ranges::generate(name, [&] { return random() % 2 == 0 ? 'a' : 'b'; });
      EXPECT_EQ(matchesPattern(pattern, name), matchesSlowly(pattern, name)) << pattern << " and " << name;
    }
  }
}

TEST(NamePattern, IsOneOfCapitals) { EXPECT_FALSE(matchesPattern("wall", "Wall")); }

TEST(NamePattern, MarksTheNamesThatMatch)
{
  EXPECT_THAT(matchingNames("W*", {}), IsEmpty());
  EXPECT_THAT(matchingNames("W*", {"Wall", "Roof", "W"}), ElementsAre(1, 0, 1));
  EXPECT_THAT(matchingNames("X", {"Wall", "Roof"}), ElementsAre(0, 0));
}

TEST(NamePattern, OfSurfacesMustMatchOneUnlessItIsAStar)
{
  EXPECT_THAT(matchingSurfaces("*oo*", {"Wall", "Roof", "Door"}, "which is open"), ElementsAre(0, 1, 1));
  EXPECT_THAT(matchingSurfaces("Wall", {"Wall"}, "which is open"), ElementsAre(1));
  EXPECT_THAT(matchingSurfaces("*", {}, "which is open"), IsEmpty());
  for (const Texts& names : {Texts{"Wall", "Roof"}, Texts{}})
  {
    EXPECT_THAT([&] { matchingSurfaces("Rof", names, "which is open"); },
                ThrowsMessage<Error>("no surface matches 'Rof', which is open; " + namesInstead("Rof", names)));
  }
}

TEST(NearestName, IsWhatOneSlipMakesOfIt)
{
  const Texts names{"Ceiling", "WallNorth", "Garden"};
  for (const char* wanted : {"Gardn", "Gardenn", "Garten", "Gadren", "xGarden", "arden", "aGrden", "Gardne", "GARDEM"})
  {
    EXPECT_EQ(nearestName(wanted, names), "Garden") << wanted;
  }
}

TEST(NearestName, IsTheOneWithTheFewestSlips)
{
  EXPECT_EQ(nearestName("abcdefghi", {"abcxyzghi", "abcdefgxx", "abcdxfghi", "abcdxxghi"}), "abcdxfghi");
  EXPECT_EQ(nearestName("abcdefghi", {"abcdefgxx", "xbcdefghi", "abcdefghx"}), "xbcdefghi") << "the first of two";
  EXPECT_EQ(nearestName("abcdefghi", {"bacedfhgi", "badcefghi"}), "badcefghi") << "two swaps are two slips";
}

TEST(NearestName, IsOneThatDiffersInCaseAlone) { EXPECT_EQ(nearestName("wall", {"WallNorth", "Wall"}), "Wall"); }

TEST(NearestName, CountsEachKindOfSlipAsOneWhereverItIs)
{
  for (const char* one : {"bacdefghi", "abcedfghi", "abcdefgih", // two letters swapped
                          "bcdefghi", "abcdfghi", "abcdefgh",    // one left out
                          "abcdexfghi", "abxcdefghi",            // one too many
                          "xbcdefghi", "abcdxfghi", "abcdefghx"})
  {
    for (const char* two : {"abxxefghi", "cdefghi", "abcdefg", "aabbcdefghi", "bacdefgih", "bxcdefghi", "xacdefghi"})
    {
      EXPECT_EQ(nearestName("abcdefghi", {two, one}), one) << "rather than " << two;
    }
  }
}

TEST(NearestName, CountsSlipsAtTheEndsOfUnequalTexts)
{
  EXPECT_EQ(nearestName("abcdef", {"abcd", "abcdexy"}), "abcd") << "both differ by two, and the first is taken";
  EXPECT_EQ(nearestName("abcdef", {"abcdefghi", "abcdxf"}), "abcdefghi") << "of which it is a part";
  EXPECT_EQ(nearestName("abcdef", {"cdef", "bcdef"}), "bcdef");
}

TEST(NearestName, IsNoneOfOtherWords)
{
  EXPECT_EQ(nearestName("Roof", {"Wall", "Floor7", ""}), "");
  EXPECT_EQ(nearestName("a", {"b", "c", "ab"}), "") << "one letter says too little";
  EXPECT_EQ(nearestName("ab", {"xy"}), "");
  EXPECT_EQ(nearestName("ab", {"xy", "ax"}), "ax");
  EXPECT_EQ(nearestName("abcdefghi", {"abcdxxxxx", "xxxxxfghi"}), "");
}

TEST(NearestName, IgnoresCaseAndTheSignsOfPatterns)
{
  EXPECT_EQ(nearestName("GARDEN", {"Roof", "garden"}), "garden");
  EXPECT_EQ(nearestName("*?Gardens?*", {"Roof", "Garden"}), "Garden");
  EXPECT_EQ(nearestName("Garden", {"Roof", "G*arde?n"}), "G*arde?n");
  EXPECT_EQ(nearestName("?*", {"Roof"}), "");
  EXPECT_EQ(nearestName("?a?b?", {"ab"}), "ab");
  EXPECT_EQ(nearestName("*a*b*", {"ab"}), "ab");
}

TEST(NamesInstead, AreTheNearestAndAllOfThem)
{
  EXPECT_EQ(namesInstead("Chimney", {"Wall", "Roof"}), "there are: Wall, Roof");
  EXPECT_EQ(namesInstead("Rof", {"Wall", "Roof"}), "did you mean 'Roof'? There are: Wall, Roof");
}

TEST(NamesInstead, EndAfterTwenty)
{
  const Texts twenty(20, "Wall");
  Texts more = twenty;
  more.emplace_back("Last");
  EXPECT_EQ(namesInstead("Chimney", twenty), "there are: " + joined(twenty));
  EXPECT_EQ(namesInstead("Chimney", more), "there are: " + joined(twenty) + ", …");
  EXPECT_THAT(namesInstead("Lasst", more), StartsWith("did you mean 'Last'?")) << "which the list leaves out";
}

TEST(Text, IsJoinedWithSomethingBetween)
{
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b"}), "a, b");
  EXPECT_EQ(joined({"a", "a", ""}, "--"), "a--a--");
  EXPECT_EQ(joined({"", "a"}, ";"), ";a");
}

TEST(Text, HasCapitalsFromAToZ)
{
  EXPECT_EQ(lowered("@AZ[`az{09"), "@az[`az{09");
  EXPECT_EQ(lowered("\xc3\x84"), "\xc3\x84") << "no letter of ASCII";
  EXPECT_EQ(lowered(""), "");
}

TEST(Text, IsComparedWithoutCase)
{
  EXPECT_TRUE(sameButForCapitals("", ""));
  EXPECT_TRUE(sameButForCapitals("WallNORTHz", "wAllnorthZ"));
  for (const char* other : {"wal", "walls", "walk", "xall", ""})
  {
    EXPECT_FALSE(sameButForCapitals("Wall", other)) << other;
    EXPECT_FALSE(sameButForCapitals(other, "Wall")) << other;
  }
  EXPECT_FALSE(sameButForCapitals("@", "`"));
  EXPECT_FALSE(sameButForCapitals("[", "{"));
}

/// Encodes a character as RFC 3629 says.
std::string encoded(std::uint32_t code)
{
  const auto tail = [&](unsigned shift) { return static_cast<char>(0x80u | (code >> shift & 0x3fu)); };
  if (code < 0x80)
  {
    return {static_cast<char>(code)};
  }
  if (code < 0x800)
  {
    return {static_cast<char>(0xc0u | code >> 6), tail(0)};
  }
  if (code < 0x10000)
  {
    return {static_cast<char>(0xe0u | code >> 12), tail(6), tail(0)};
  }
  return {static_cast<char>(0xf0u | code >> 18), tail(12), tail(6), tail(0)};
}

std::string latin1AsUtf8(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    out += encoded(static_cast<unsigned char>(c));
  }
  return out;
}

/// The first and last characters of each length and around the surrogates, and some between.
std::vector<std::uint32_t> someCharacters()
{
  std::vector<std::uint32_t> codes{1,      0x7f,   0x80,    0x7ff,   0x800,   0xd7ff,
                                   0xe000, 0xffff, 0x10000, 0x3ffff, 0x40000, 0x10ffff};
  for (std::uint32_t code = 1; code <= 0x10ffff; code += 1 + code / 40)
  {
    if (code < 0xd800 || code > 0xdfff)
    {
      codes.push_back(code);
    }
  }
  return codes;
}

TEST(Utf8, IsLeftAsItIs)
{
  std::string all;
  for (const std::uint32_t code : someCharacters())
  {
    const std::string text = "a" + encoded(code) + encoded(code);
    EXPECT_EQ(toUtf8(text), text) << code;
    all += text;
  }
  EXPECT_EQ(toUtf8(all), all);
  EXPECT_EQ(toUtf8(""), "");
  EXPECT_EQ(toUtf8(std::string("a\0b", 3)), std::string("a\0b", 3));
}

TEST(Utf8, IsMadeOfLatin1)
{
  for (unsigned code = 0x80; code < 0x100; ++code)
  {
    const std::string letter{static_cast<char>(code)};
    EXPECT_EQ(toUtf8(letter), encoded(code)) << code;
    EXPECT_EQ(toUtf8("stra" + letter + "e"), "stra" + encoded(code) + "e") << code;
  }
}

TEST(Utf8, OfNoCharacterIsReadAsLatin1)
{
  // Longer than needed, a surrogate, and beyond U+10FFFF.
  for (const std::string text : {"\xe0\x80\x80", "\xf0\x80\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
  {
    EXPECT_EQ(toUtf8(text), latin1AsUtf8(text));
  }
}

TEST(Utf8, ThatEndsOrBreaksOffIsReadAsLatin1)
{
  for (const std::uint32_t code : someCharacters())
  {
    const std::string whole = encoded(code);
    for (std::size_t i = 1; i < whole.size(); ++i)
    {
      std::string broken = whole.substr(0, i);
      EXPECT_EQ(toUtf8(broken), latin1AsUtf8(broken)) << code << " without its end";
      broken = "a" + whole;
      for (const char wrong : {'\x7f', '\xc0'})
      {
        broken[1 + i] = wrong;
        EXPECT_EQ(toUtf8(broken), latin1AsUtf8(broken)) << code << " with another byte at " << i;
      }
    }
  }
}

TEST(Utf8, HasNoCharactersThatBeginWithOtherBytes)
{
  for (unsigned first = 0x80; first < 0x100; ++first)
  {
    if (first < 0xc2 || first > 0xf4)
    {
      for (const char* tail : {"\x80", "\xbf\xbf", "\x80\x80\x80", "\x80\x80\x80\x80"})
      {
        const std::string text = static_cast<char>(first) + std::string(tail);
        EXPECT_EQ(toUtf8(text), latin1AsUtf8(text)) << first;
      }
    }
  }
}

PatternRule sizeRule(const std::string& text) { return patternRuleFrom(text, 1, 2, "size", "PATTERN SIZE [FINE]"); }

TEST(PatternRule, IsAPatternAndNumbers)
{
  struct Case
  {
    std::string text;
    std::string pattern;
    std::vector<double> numbers;
  };
  const std::vector<Case> cases{{"Wall 2", "Wall", {2}},
                                {"Wall 2 0.5", "Wall", {2, 0.5}},
                                {"  W*?  -1e-3\t7 \n", "W*?", {-1e-3, 7}},
                                {"\"Wall north\" 4", "Wall north", {4}},
                                {"\"a \\\"b\\\" \\\\c\"4", "a \"b\" \\c", {4}},
                                {"3 4", "3", {4}}};
  for (const Case& one : cases)
  {
    const PatternRule rule = sizeRule(one.text);
    EXPECT_EQ(rule.pattern, one.pattern) << one.text;
    EXPECT_EQ(rule.numbers, one.numbers) << one.text;
  }
}

TEST(PatternRule, HasAsManyNumbersAsAllowed)
{
  for (std::size_t count = 0; count < 6; ++count)
  {
    std::string text = "Wall";
    for (std::size_t i = 0; i < count; ++i)
    {
      text += " 1";
    }
    const auto read = [&] { return patternRuleFrom(text, 2, 4, "layer", "FORM").numbers.size(); };
    if (count < 2 || count > 4)
    {
      EXPECT_THROW(read(), Error) << text;
    }
    else
    {
      EXPECT_EQ(read(), count);
    }
  }
  EXPECT_EQ(patternRuleFrom("Wall", 0, 0, "layer", "FORM").pattern, "Wall");
  EXPECT_THROW(patternRuleFrom("Wall auto", 1, 1, "layer", "FORM"), Error);
  const PatternRule fitting = patternRuleFrom("auto auto 0.5", 2, 2, "layer", "FORM", true);
  EXPECT_EQ(fitting.pattern, "auto");
  EXPECT_TRUE(std::isnan(fitting.numbers[0]));
  EXPECT_EQ(textOf(fitting), "\"auto\" auto 0.5");
}

TEST(PatternRuleError, SaysWhatRuleIsNotOfWhatForm)
{
  for (const std::string text :
       {"", "  ", "Wall", "\"Wall 1", "\"\" 1", "Wall 1 2 3", "Wall one", "Wall 1 fine", "Wall 1m", "Wall 1,5",
        "Wall north 1", "Wall nan", "Wall 1 2e", "Wall 1 -", "Wall 1 .", "Wall 1 1e400", "Wall 1 1e+"})
  {
    EXPECT_THAT([&] { sizeRule(text); },
                ThrowsMessage<Error>("the size rule '" + text + "' is not of the form PATTERN SIZE [FINE]"));
  }
}

TEST(PatternRule, IsReadBackFromItsText)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  for (const char* pattern : {"Wall", "Wall north", "a\"b", "\\", "\\\" *?", "…"})
  {
    for (std::size_t count = 0; count < 5; ++count)
    {
      PatternRule rule{pattern, std::vector<double>(count)};
      std::ranges::generate(rule.numbers, [&] { return -std::pow(10.0, exponent(random)) / 3.0; });
      const PatternRule read = patternRuleFrom(textOf(rule), count, count, "size", "FORM");
      EXPECT_EQ(read.pattern, rule.pattern);
      EXPECT_EQ(read.numbers, rule.numbers) << "to the bit";
    }
  }
  EXPECT_EQ(textOf({"Wall", {2, 0.5}}), "\"Wall\" 2 0.5");
}

Texts countedTexts(const Texts& texts)
{
  std::vector<Warning> warnings;
  for (const std::string& text : texts)
  {
    warnings.push_back({text});
  }
  Texts out;
  for (const Warning& warning : counted(warnings))
  {
    out.push_back(warning.text);
  }
  return out;
}

TEST(CountedWarnings, AreAlikeIfOnlyNamesAndNumbersDiffer)
{
  for (const Texts& alike : {Texts{"1 face", "22 face"},
                             {"of 1.5 m", "of 2 m"},
                             {"of 1.5", "of 22.75"},
                             {"x (3)", "x (4)"},
                             {"in 'a': bad", "in 'b c': bad"},
                             {"'a'7", "'8'9"},
                             {"'a-' meets 'b'", "'c-' meets 'd'"},
                             {"it's 'a'", "it's 'b'"}})
  {
    EXPECT_EQ(countedTexts(alike).size(), 1u) << alike[0];
  }
}

TEST(CountedWarnings, AreNotAlikeIfWordsDiffer)
{
  for (const Texts& unlike : {Texts{"1 face", "1 faces"},
                              {"Wall1 is bent", "Wall2 is bent"},
                              {"it's a 'b'", "its a 'b'"},
                              {"of 1.", "of 1"},
                              {"of 1. 5", "of 1.5"},
                              {"'a' and 'b'", "'a' and b"},
                              {"don't 'a'", "don't \"a\""},
                              {"a 'b", "a 'c"},
                              {"Wall_1 is bent", "Wall_2 is bent"},
                              {"of 1. It", "of 1 It"},
                              {"'a-' meets 'b'", "'a-' and 'b'"},
                              {"x", ""}})
  {
    EXPECT_EQ(countedTexts(unlike), unlike);
  }
}

TEST(CountedWarnings, NameWhatDiffersFirst)
{
  EXPECT_THAT(countedTexts({"'a' meets 'b'", "'a' meets 'c'", "'d' meets 'c'"}),
              ElementsAre("'a' meets 'b' (and 2 more like it: 'd')"));
  EXPECT_THAT(countedTexts({"'a' meets 'b'", "'a' meets 'c'", "'a' meets 'c'"}),
              ElementsAre("'a' meets 'b' (and 2 more like it: 'c')"));
  EXPECT_THAT(countedTexts({"'a'", "'b'", "'c'", "'d'"}), ElementsAre("'a' (and 3 more like it: 'b', 'c', 'd')"));
  EXPECT_THAT(countedTexts({"'a'", "'b'", "'c'", "'d'", "'e'"}),
              ElementsAre("'a' (and 4 more like it: 'b', 'c', 'd', …)"));
}

TEST(CountedWarnings, KeepTheOrderOfTheFirstOnes)
{
  EXPECT_THAT(countedTexts({"b 1", "a", "b 2", "c", "a", "b 3"}),
              ElementsAre("b 1 (and 2 more like it)", "a (and 1 more like it)", "c"));
  EXPECT_THAT(countedTexts({}), IsEmpty());
}

TEST(CountedWarnings, AddUpWhatTheyStandFor)
{
  const std::vector<Warning> found =
      counted({{"a 1", Gravity::grave, 2}, {"b", Gravity::detail, 4}, {"a 2", Gravity::grave, 3}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].count, 5u);
  EXPECT_EQ(found[0].gravity, Gravity::grave);
  EXPECT_EQ(found[1].count, 4u);
  EXPECT_EQ(found[1].gravity, Gravity::detail);
}

TEST(WarningsByGravity, KeepTheirOrderIfTheyAreEquallyGrave)
{
  std::vector<Warning> warnings;
  for (int i = 0; i < 60; ++i)
  {
    warnings.push_back({std::to_string(i), static_cast<Gravity>(i * 7 % 3)});
  }
  const std::vector<Warning> sorted = byGravity(warnings);
  ASSERT_EQ(sorted.size(), warnings.size());
  for (std::size_t i = 1; i < sorted.size(); ++i)
  {
    const Warning& before = sorted[i - 1];
    EXPECT_TRUE(before.gravity > sorted[i].gravity ||
                (before.gravity == sorted[i].gravity && std::stoi(before.text) < std::stoi(sorted[i].text)));
  }
  EXPECT_THAT(byGravity({}), IsEmpty());
}

} // namespace
