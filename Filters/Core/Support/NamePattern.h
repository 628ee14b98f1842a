// SPDX-License-Identifier: GPL-3.0-or-later
/// Patterns for names, and suggestions for misspelled names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// True if the whole of `name` matches `pattern`: `*` is any text, `?` any one character.
bool matchesPattern(std::string_view pattern, std::string_view name);

/// Returns the name that `wanted`, a name or a pattern, is probably a misspelling of; empty if there is none. Case is
/// ignored.
std::string nearestName(std::string_view wanted, const std::vector<std::string>& names);

/// Text for messages about a name that does not exist: the nearest name, and the first of the existing ones.
std::string namesInstead(std::string_view wanted, const std::vector<std::string>& names);

} // namespace atria
