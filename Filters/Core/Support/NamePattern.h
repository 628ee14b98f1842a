// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// Whether `name` as a whole matches `pattern`: `*` any text, `?` any one character.
bool matchesPattern(std::string_view pattern, std::string_view name);

/// The first of the names, for messages.
std::string listOfNames(const std::vector<std::string>& names);

} // namespace atria
