// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/PatternRule.h"

#include "Support/Error.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace atria {

PatternRule patternRuleFrom(const std::string& text, std::size_t least, std::size_t most, const char* kind,
                            const char* form, bool allowsAuto)
{
  std::istringstream in(text);
  PatternRule rule;
  in >> std::quoted(rule.pattern);
  bool areNumbers = true;
  for (std::string word; in >> word;)
  {
    if (allowsAuto && word == "auto")
    {
      rule.numbers.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    std::istringstream number(word);
    areNumbers = areNumbers && number >> rule.numbers.emplace_back() && number.eof();
  }
  if (rule.pattern.empty() || !areNumbers || rule.numbers.size() < least || rule.numbers.size() > most)
  {
    throw Error("the " + std::string(kind) + " rule '" + text + "' is not of the form " + form);
  }
  return rule;
}

std::string textOf(const PatternRule& rule)
{
  std::ostringstream out;
  out << std::setprecision(17) << std::quoted(rule.pattern);
  for (const double number : rule.numbers)
  {
    out << ' ';
    std::isnan(number) ? out << "auto" : out << number;
  }
  return out.str();
}

} // namespace atria
