// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMNames.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace atria {

namespace {

constexpr std::array<std::string_view, 2> sideSuffixes{"_front", "_back"};

bool isLetterOrDigit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

/// OpenFOAM's own rule is wider, but what is special in a regular expression or in a number is better
/// avoided.
std::string makeWord(std::string_view name)
{
  std::string word;
  for (const char c : name)
  {
    const bool kept = isLetterOrDigit(c) || c == '_' || c == '.' || c == '-' || c == '+';
    // Bytes that continue a UTF-8 character are passed over, so that a character becomes one underscore.
    if (kept || (static_cast<unsigned char>(c) & 0xC0U) != 0x80U)
    {
      word += kept ? c : '_';
    }
  }
  if (word.empty())
  {
    return "patch";
  }
  const char first = word.front();
  const bool startsLikeNumber = !(isLetterOrDigit(first) || first == '_') || (first >= '0' && first <= '9');
  return startsLikeNumber ? "_" + word : word;
}

/// 0 or 1 for the index of the suffix that the name has after a stem, else -1.
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
  explicit NameMaker(std::span<const std::string> originals) : names(originals), out(originals.size()) {}

  std::vector<OpenFOAMName> run()
  {
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (out[i].word.empty())
      {
        name(i);
      }
    }
    for (OpenFOAMName& made : out)
    {
      if (used.count(made.group) != 0)
      {
        made.group.clear();
      }
    }
    return std::move(out);
  }

private:
  void name(std::size_t i)
  {
    const std::size_t partner = partnerOf(i);
    if (partner == names.size())
    {
      out[i].word = unique(makeWord(names[i]), {""});
      used.insert(out[i].word);
      return;
    }
    const int side = sideOf(names[i]);
    const std::string stem = unique(makeWord(stemOf(names[i], side)), sideSuffixes);
    for (const auto& [patch, itsSide] : {std::pair(i, side), std::pair(partner, 1 - side)})
    {
      out[patch] = {stem + std::string(sideSuffixes[itsSide]), stem};
      used.insert(out[patch].word);
    }
  }

  /// The first unnamed patch that is the other side of this one, or names.size().
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

  template <typename Suffixes> std::string unique(const std::string& word, const Suffixes& suffixes) const
  {
    std::string candidate = word;
    const auto taken = [&](std::string_view suffix) { return used.count(candidate + std::string(suffix)) != 0; };
    for (int n = 2; std::any_of(suffixes.begin(), suffixes.end(), taken); ++n)
    {
      candidate = word + '_' + std::to_string(n);
    }
    return candidate;
  }

  std::string unique(const std::string& word, std::initializer_list<std::string_view> suffixes) const
  {
    return unique<std::initializer_list<std::string_view>>(word, suffixes);
  }

  std::span<const std::string> names;
  std::vector<OpenFOAMName> out;
  std::set<std::string, std::less<>> used;
};

} // namespace

std::vector<OpenFOAMName> makeOpenFOAMNames(std::span<const std::string> names) { return NameMaker(names).run(); }

} // namespace atria
