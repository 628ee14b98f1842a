// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Text.h"

#include <algorithm>

namespace atria {

namespace {

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

std::string joined(const std::vector<std::string>& texts, std::string_view between)
{
  std::string all;
  for (const std::string& text : texts)
  {
    all.append(&text == &texts.front() ? std::string_view() : between).append(text);
  }
  return all;
}

std::string lowered(std::string_view text)
{
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), small);
  return out;
}

bool sameButForCapitals(std::string_view a, std::string_view b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return small(x) == small(y); });
}

} // namespace atria
