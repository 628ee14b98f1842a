// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// Whether `name` as a whole matches `pattern`: `*` any text, `?` any one character.
bool matchesPattern(std::string_view pattern, std::string_view name);

/// That of the names which `wanted`, a name or a pattern, is likely to be a slip of; empty without one. Capitals count
/// for nothing.
std::string nearestName(std::string_view wanted, const std::vector<std::string>& names);

/// For messages about a name that is not there: the nearest one, and the first of those there are.
std::string namesInstead(std::string_view wanted, const std::vector<std::string>& names);

} // namespace atria
