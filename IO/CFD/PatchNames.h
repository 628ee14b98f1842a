// SPDX-License-Identifier: GPL-3.0-or-later
/// Turns names of patches into names that a file format accepts.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// Rules of a file format for names.
struct NameRules
{
  std::string_view punctuation; ///< characters allowed besides ASCII letters and digits
  bool anyStart = false;        ///< a name may also begin like a number
  bool letterStart = false;     ///< a name must begin with a letter, not with an underscore
  bool caseMatters = true;      ///< names that differ in capitals only are different
  std::size_t longest = std::string::npos;
  std::array<std::string_view, 2> sides{"_front", "_back"}; ///< suffixes for the two sides of a sheet
};

/// OpenFOAM's own rule is wider, but characters special in regular expressions or numbers are better avoided.
inline constexpr NameRules openFOAMNames{.punctuation = "_.-+"};

/// A patch's name in a file format.
struct PatchName
{
  std::string word;  ///< unique
  std::string group; ///< the name that both sides of a sheet share, else empty
};

/// Makes names valid and unique: other characters become underscores. Two names that begin alike and end in _front and
/// _back are the sides of one sheet. They keep a common stem, which is their group unless a patch has that very name.
std::vector<PatchName> makePatchNames(std::span<const std::string> names, const NameRules& rules);

/// Returns the name for a comment: control characters, such as the end of a line, become blanks.
std::string inOneLine(std::string name);

/// True if a name in a file format matches a pattern for it or for the original name (see matchesPattern).
bool matchesPatchName(std::string_view pattern, std::string_view word, const NameRules& rules);

} // namespace atria
