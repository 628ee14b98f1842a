// SPDX-License-Identifier: GPL-3.0-or-later
/// Joins texts and compares them without case. Letters are those of ASCII.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// Returns the texts one after the other, with `between` between them.
std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ");

/// Returns the text in lower case.
std::string lowered(std::string_view text);

/// True if two texts are equal apart from case.
bool sameButForCapitals(std::string_view a, std::string_view b);

} // namespace atria
