// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpeningNames.h"

#include "Support/Text.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace atria {

namespace {

constexpr std::array<std::string_view, 4> inletWords{"inlet", "inflow", "supply", "diffuser"};
constexpr std::array<std::string_view, 5> outletWords{"outlet", "outflow", "exhaust", "extract", "return"};
/// Words for parts of an opening, or for things with similar names, that let no air through.
constexpr std::array<std::string_view, 13> solidWords{"wall", "duct",     "pipe",      "channel", "frame",
                                                      "hood", "housing",  "casing",    "power",   "socket",
                                                      "plug", "electric", "electrical"};

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool isLower(char c) { return c >= 'a' && c <= 'z'; }

/// Returns the words in small letters. A run of capitals is one word, except its last before small letters: HVAC,
/// Supply.
std::vector<std::string> wordsOf(std::string_view name)
{
  std::vector<std::string> words;
  bool goesOn = false;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    if (!isUpper(name[i]) && !isLower(name[i]))
    {
      goesOn = false;
      continue;
    }
    const bool afterSmall = i > 0 && isLower(name[i - 1]);
    const bool beforeSmall = i + 1 < name.size() && isLower(name[i + 1]);
    if (!goesOn || (isUpper(name[i]) && (afterSmall || beforeSmall)))
    {
      words.emplace_back();
    }
    words.back() += name[i];
    goesOn = true;
  }
  std::ranges::transform(words, words.begin(), [](const std::string& word) { return lowered(word); });
  return words;
}

bool hasWord(const std::vector<std::string>& words, std::string_view wanted)
{
  return std::ranges::any_of(words, [&](const std::string& word) {
    return word == wanted || (word.size() == wanted.size() + 1 && word.starts_with(wanted) && word.back() == 's');
  });
}

} // namespace

std::optional<VentilationOpening> ventilationOpeningOf(std::string_view patchName)
{
  const std::vector<std::string> words = wordsOf(patchName);
  const auto hasAnyOf = [&](const auto& wanted) {
    return std::ranges::any_of(wanted, [&](std::string_view word) { return hasWord(words, word); });
  };
  const bool isInlet = hasAnyOf(inletWords);
  const bool isOutlet = hasAnyOf(outletWords);
  if (isInlet == isOutlet || hasAnyOf(solidWords))
  {
    return std::nullopt;
  }
  return isInlet ? VentilationOpening::Inlet : VentilationOpening::Outlet;
}

} // namespace atria
