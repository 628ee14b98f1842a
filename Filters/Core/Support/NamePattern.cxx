// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/NamePattern.h"

#include <algorithm>

namespace atria {

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

std::string listOfNames(const std::vector<std::string>& names)
{
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
  {
    text += (i > 0 ? ", " : "") + names[i];
  }
  return names.size() > most ? text + ", …" : text;
}

} // namespace atria
