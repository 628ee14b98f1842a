// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules for named surfaces as users write them: a pattern and numbers.
#pragma once

#include <string>
#include <vector>

namespace atria {

struct PatternRule
{
  /// In double quotes where it holds blanks; see matchesPattern.
  std::string pattern;
  std::vector<double> numbers;
};

/// Throws Error where the text is no pattern with `least` to `most` numbers behind it. `kind` and `form` are for its
/// text: "size", "PATTERN SIZE [FEATURESIZE]".
PatternRule patternRuleFrom(const std::string& text, std::size_t least, std::size_t most, const char* kind,
                            const char* form);

/// The text from which the very same rule is read.
std::string textOf(const PatternRule& rule);

} // namespace atria
