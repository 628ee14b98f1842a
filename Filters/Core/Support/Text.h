// SPDX-License-Identifier: GPL-3.0-or-later
/// What is asked of texts at many places. Letters are those of ASCII.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// The texts one after the other.
std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ");

/// With small letters.
std::string lowered(std::string_view text);

/// Whether two texts differ in capitals at most.
bool sameButForCapitals(std::string_view a, std::string_view b);

} // namespace atria
