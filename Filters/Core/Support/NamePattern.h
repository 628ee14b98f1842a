// SPDX-License-Identifier: GPL-3.0-or-later
/// Patterns for names, and suggestions for misspelled names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// True if the whole of `name` matches `pattern`: `*` is any text, `?` any one character.
bool matchesPattern(std::string_view pattern, std::string_view name);

/// Returns one entry per name: 1 where it matches the pattern, else 0.
std::vector<char> matchingNames(std::string_view pattern, const std::vector<std::string>& names);

/// Returns one entry per surface: 1 where its name matches the pattern, else 0. Throws Error if none does, unless the
/// pattern is `*`. `purpose` is for the error's text: "which is to be a face zone".
std::vector<char> matchingSurfaces(std::string_view pattern, const std::vector<std::string>& names,
                                   std::string_view purpose);

/// Returns the name that `wanted`, a name or a pattern, is probably a misspelling of; empty if there is none. Case is
/// ignored.
std::string nearestName(std::string_view wanted, const std::vector<std::string>& names);

/// Text for messages about a name that does not exist: the nearest name, and the first of the existing ones.
std::string namesInstead(std::string_view wanted, const std::vector<std::string>& names);

} // namespace atria
