// SPDX-License-Identifier: GPL-3.0-or-later
/// Decodes base64, as JSON and other text formats embed it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace atria::model {

/// Returns the bytes that base64 stands for, up to the padding or to the first character of another alphabet.
inline std::string fromBase64(std::string_view text)
{
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text)
  {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+' || c == '-' ? 62
                      : c == '/' || c == '_' ? 63
                                             : -1;
    if (value < 0)
    {
      break;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      out.push_back(static_cast<char>(bits >> count & 0xff));
    }
  }
  return out;
}

} // namespace atria::model
