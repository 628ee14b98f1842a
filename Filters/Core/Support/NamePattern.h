// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace atria {

/// Whether `name` as a whole matches `pattern`: `*` any text, `?` any one character.
bool matchesPattern(std::string_view pattern, std::string_view name);

} // namespace atria
