// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules for named surfaces as users write them: a pattern and numbers.
#pragma once

#include <string>
#include <vector>

namespace atria {

struct PatternRule
{
  /// In double quotes in the text if it holds blanks; see matchesPattern.
  std::string pattern;
  std::vector<double> numbers; ///< not a number for `auto`
};

/// Reads a rule from text. Throws Error if the text is not a pattern followed by `least` to `most` numbers, or `auto`
/// in place of numbers if `allowsAuto`. `kind` and `form` are for the error's text: "size", "PATTERN SIZE
/// [FEATURESIZE]".
PatternRule patternRuleFrom(const std::string& text, std::size_t least, std::size_t most, const char* kind,
                            const char* form, bool allowsAuto = false);

/// Returns the text from which patternRuleFrom reads the same rule.
std::string textOf(const PatternRule& rule);

} // namespace atria
