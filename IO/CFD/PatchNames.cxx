// SPDX-License-Identifier: GPL-3.0-or-later
#include "PatchNames.h"

#include "Support/NamePattern.h"
#include "Support/Text.h"

#include <algorithm>
#include <set>

namespace atria {

namespace {

/// The mesher's suffixes.
constexpr std::array<std::string_view, 2> sideSuffixes{"_front", "_back"};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string makeWord(std::string_view name, const NameRules& rules)
{
  std::string word;
  for (const char c : name)
  {
    const bool kept = isLetter(c) || isDigit(c) || rules.punctuation.find(c) != std::string_view::npos;
    // Bytes that continue a UTF-8 character are skipped, so that a character becomes one underscore.
    if (kept || (static_cast<unsigned char>(c) & 0xC0U) != 0x80U)
    {
      word += kept ? c : '_';
    }
  }
  if (word.empty())
  {
    return "patch";
  }
  const bool startsLikeName = rules.anyStart || isLetter(word.front()) || (word.front() == '_' && !rules.letterStart);
  return startsLikeName ? word : (rules.letterStart ? "N_" : "_") + word;
}

/// Returns 0 or 1, the index of the suffix that the name has after a stem, else -1.
int sideOf(std::string_view name)
{
  for (int side = 0; side < 2; ++side)
  {
    const std::string_view suffix = sideSuffixes[side];
    if (name.size() > suffix.size() && name.ends_with(suffix))
    {
      return side;
    }
  }
  return -1;
}

std::string_view stemOf(std::string_view name, int side)
{
  return name.substr(0, name.size() - sideSuffixes[side].size());
}

class NameMaker
{
public:
  NameMaker(std::span<const std::string> originals, const NameRules& nameRules)
      : names(originals), rules(nameRules), out(originals.size())
  {
  }

  std::vector<PatchName> run()
  {
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (out[i].word.empty())
      {
        name(i);
      }
    }
    for (PatchName& made : out)
    {
      if (isUsed(made.group))
      {
        made.group.clear();
      }
    }
    return std::move(out);
  }

private:
  void name(std::size_t i)
  {
    constexpr std::array<std::string_view, 1> none{""};
    const std::size_t partner = partnerOf(i);
    if (partner == names.size())
    {
      out[i].word = unique(makeWord(names[i], rules), none);
      use(out[i].word);
      return;
    }
    const int side = sideOf(names[i]);
    const std::string stem = unique(makeWord(stemOf(names[i], side), rules), rules.sides);
    for (const auto& [patch, itsSide] : {std::pair(i, side), std::pair(partner, 1 - side)})
    {
      out[patch] = {stem + std::string(rules.sides[itsSide]), stem};
      use(out[patch].word);
    }
  }

  /// Returns the first unnamed patch that is the other side of this one, or names.size().
  std::size_t partnerOf(std::size_t i)
  {
    const int side = sideOf(names[i]);
    if (side < 0)
    {
      return names.size();
    }
    const std::string wanted = std::string(stemOf(names[i], side)) + std::string(sideSuffixes[1 - side]);
    std::size_t partner = i + 1;
    while (partner < names.size() && (names[partner] != wanted || !out[partner].word.empty()))
    {
      ++partner;
    }
    return partner;
  }

  /// Returns a word that is free with each of the suffixes, shortened and numbered if necessary.
  std::string unique(const std::string& word, std::span<const std::string_view> suffixes) const
  {
    const auto longer = [](std::string_view a, std::string_view b) { return a.size() < b.size(); };
    const std::size_t room = rules.longest - std::ranges::max_element(suffixes, longer)->size();
    std::string candidate = word.substr(0, room);
    const auto taken = [&](std::string_view suffix) { return isUsed(candidate + std::string(suffix)); };
    for (int n = 2; std::ranges::any_of(suffixes, taken); ++n)
    {
      const std::string number = '_' + std::to_string(n);
      candidate = word.substr(0, room - number.size()) + number;
    }
    return candidate;
  }

  std::string keyOf(const std::string& word) const { return rules.caseMatters ? word : lowered(word); }
  bool isUsed(const std::string& word) const { return used.contains(keyOf(word)); }
  void use(const std::string& word) { used.insert(keyOf(word)); }

  std::span<const std::string> names;
  const NameRules& rules;
  std::vector<PatchName> out;
  std::set<std::string> used;
};

} // namespace

std::vector<PatchName> makePatchNames(std::span<const std::string> names, const NameRules& rules)
{
  return NameMaker(names, rules).run();
}

std::string inOneLine(std::string name)
{
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return name;
}

bool matchesPatchName(std::string_view pattern, std::string_view word, const NameRules& rules)
{
  constexpr std::string_view wildcards = "*?";
  const std::string punctuation = std::string(rules.punctuation) + std::string(wildcards);
  NameRules wide = rules;
  wide.punctuation = punctuation;
  wide.anyStart = rules.anyStart || pattern.find_first_of(wildcards) == 0;
  return matchesPattern(pattern, word) || (!pattern.empty() && matchesPattern(makeWord(pattern, wide), word));
}

} // namespace atria
