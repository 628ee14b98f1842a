// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Warning.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

namespace atria {

namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// A text without its names and numbers, and these names.
struct Pattern
{
  std::string text;
  std::vector<std::string> names;
};

Pattern patternOf(const std::string& text)
{
  Pattern out;
  for (std::size_t i = 0; i < text.size();)
  {
    const bool beginsWord = i == 0 || !isWord(text[i - 1]);
    const std::size_t quote = text[i] == '\'' && beginsWord ? text.find('\'', i + 1) : std::string::npos;
    if (quote != std::string::npos)
    {
      out.names.push_back(text.substr(i, quote + 1 - i));
      out.text += "''";
      i = quote + 1;
    }
    else if (isDigit(text[i]) && beginsWord)
    {
      while (i < text.size() && (isWord(text[i]) || (text[i] == '.' && i + 1 < text.size() && isDigit(text[i + 1]))))
      {
        ++i;
      }
      out.text += '0';
    }
    else
    {
      out.text += text[i++];
    }
  }
  return out;
}

/// Returns the names at the first place where texts of one pattern differ in names; empty if they do not differ.
std::vector<std::string> differingNames(const std::vector<Pattern>& alike)
{
  for (std::size_t place = 0; place < alike.front().names.size(); ++place)
  {
    std::vector<std::string> names;
    for (const Pattern& one : alike)
    {
      const std::string& name = one.names[place];
      if (name != alike.front().names[place] && std::ranges::find(names, name) == names.end())
      {
        names.push_back(name);
      }
    }
    if (!names.empty())
    {
      return names;
    }
  }
  return {};
}

std::string countedText(const std::string& first, const std::vector<Pattern>& alike)
{
  constexpr std::size_t mostNames = 3;
  if (alike.size() == 1)
  {
    return first;
  }
  std::string text = first + " (and " + std::to_string(alike.size() - 1) + " more like it";
  const std::vector<std::string> names = differingNames(alike);
  for (std::size_t i = 0; i < std::min(mostNames, names.size()); ++i)
  {
    text += (i == 0 ? ": " : ", ") + names[i];
  }
  return text + (names.size() > mostNames ? ", …)" : ")");
}

} // namespace

std::vector<Warning> byGravity(std::vector<Warning> warnings)
{
  std::ranges::stable_sort(warnings, std::ranges::greater(), &Warning::gravity);
  return warnings;
}

std::vector<Warning> counted(const std::vector<Warning>& warnings)
{
  std::map<std::string, std::size_t> groupOf;
  std::vector<std::vector<Pattern>> groups;
  std::vector<Warning> out;
  for (const Warning& warning : warnings)
  {
    Pattern pattern = patternOf(warning.text);
    const auto [at, isNew] = groupOf.emplace(pattern.text, groups.size());
    if (isNew)
    {
      groups.emplace_back();
      out.push_back(warning);
    }
    else
    {
      out[at->second].count += warning.count;
    }
    groups[at->second].push_back(std::move(pattern));
  }
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    out[i].text = countedText(out[i].text, groups[i]);
  }
  return out;
}

} // namespace atria
