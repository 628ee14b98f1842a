// SPDX-License-Identifier: GPL-3.0-or-later
/// Conversion of text of unknown encoding.
#pragma once

#include <string>
#include <string_view>

namespace atria {

/// Returns `text` as UTF-8: unchanged if it is valid UTF-8, else read as Latin-1.
std::string toUtf8(std::string_view text);

} // namespace atria
