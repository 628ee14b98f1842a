// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// What a format takes as a name.
struct NameRules
{
  std::string_view punctuation; ///< characters it takes besides ASCII letters and digits
  bool anyStart = false;        ///< a name may begin like a number, too
  bool caseMatters = true;      ///< names that differ in capitals only are two
  std::size_t longest = std::string::npos;
  std::array<std::string_view, 2> sides{"_front", "_back"}; ///< how the sides of a sheet end there
};

/// OpenFOAM's own rule is wider, but what is special in a regular expression or in a number is better avoided.
inline constexpr NameRules openFOAMNames{.punctuation = "_.-+"};

/// A patch's name as a format takes it.
struct PatchName
{
  std::string word;  ///< unique
  std::string group; ///< the name that both sides of a sheet share, else empty
};

/// Makes names valid: another character becomes an underscore. Two that begin alike and end in _front and _back are the
/// sides of one sheet: they keep a common stem, which is their group unless a patch has that very name.
std::vector<PatchName> makePatchNames(std::span<const std::string> names, const NameRules& rules);

/// Whether a name as a format takes it matches a pattern (see matchesPattern) that may be for what it was made of.
bool matchesPatchName(std::string_view pattern, std::string_view word, const NameRules& rules);

} // namespace atria
