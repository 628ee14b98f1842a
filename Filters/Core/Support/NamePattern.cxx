// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/NamePattern.h"

#include "Support/Error.h"
#include "Support/Text.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

std::string plain(std::string_view name)
{
  std::string text = lowered(name);
  std::erase_if(text, [](char c) { return c == '*' || c == '?'; });
  return text;
}

/// Returns how many letters must be inserted, removed or changed (Levenshtein 1966), or swapped with their neighbor, to
/// turn one text into the other.
std::size_t slipsBetween(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> twoAgo, before(b.size() + 1), now(b.size() + 1);
  std::iota(before.begin(), before.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      now[j] = std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        now[j] = std::min(now[j], twoAgo[j - 2] + 1);
      }
    }
    twoAgo = before;
    std::swap(before, now);
  }
  return before.back();
}

} // namespace

bool matchesPattern(std::string_view pattern, std::string_view name)
{
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (n < name.size())
  {
    if (p < pattern.size() && pattern[p] == '*')
    {
      star = p++;
      resume = n;
    }
    else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]))
    {
      ++p;
      ++n;
    }
    else if (star != std::string_view::npos)
    {
      p = star + 1; // let the last star take one character more
      n = ++resume;
    }
    else
    {
      return false;
    }
  }
  return std::all_of(pattern.begin() + static_cast<std::ptrdiff_t>(p), pattern.end(), [](char c) { return c == '*'; });
}

std::vector<char> matchingNames(std::string_view pattern, const std::vector<std::string>& names)
{
  std::vector<char> matching(names.size());
  std::ranges::transform(names, matching.begin(),
                         [&](const std::string& name) { return matchesPattern(pattern, name) ? 1 : 0; });
  return matching;
}

std::vector<char> matchingSurfaces(std::string_view pattern, const std::vector<std::string>& names,
                                   std::string_view purpose)
{
  std::vector<char> matching = matchingNames(pattern, names);
  if (pattern != "*" && std::ranges::find(matching, 1) == matching.end())
  {
    throw Error("no surface matches '" + std::string(pattern) + "', " + std::string(purpose) + "; " +
                namesInstead(pattern, names));
  }
  return matching;
}

std::string nearestName(std::string_view wanted, const std::vector<std::string>& names)
{
  const std::string asked = plain(wanted);
  std::string best;
  std::size_t fewest = asked.size() / 3 + 1; // more slips than in every third letter make another word
  for (const std::string& name : names)
  {
    const std::string other = plain(name);
    const bool isPart = asked.size() > 1 && other != asked && other.find(asked) != std::string::npos;
    const std::size_t slips = isPart ? 1 : slipsBetween(asked, other);
    if (slips < fewest || (best.empty() && slips == fewest && slips < asked.size()))
    {
      best = name;
      fewest = slips;
    }
  }
  return best;
}

std::string namesInstead(std::string_view wanted, const std::vector<std::string>& names)
{
  constexpr std::size_t most = 20;
  const std::string nearest = nearestName(wanted, names);
  const std::string start = nearest.empty() ? "there are: " : "did you mean '" + nearest + "'? There are: ";
  const auto last = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most));
  return start + joined({names.begin(), last}) + (names.size() > most ? ", …" : "");
}

} // namespace atria
