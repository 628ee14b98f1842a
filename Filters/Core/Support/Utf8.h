// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace atria {

/// `text` as UTF-8: unchanged where it is, else read as Latin-1.
std::string toUtf8(std::string_view text);

} // namespace atria
