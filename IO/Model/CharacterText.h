// SPDX-License-Identifier: GPL-3.0-or-later
/// Characters that formats write by their numbers.
#pragma once

#include <string>

namespace atria::model {

/// Appends a character of 16 bits in UTF-8.
inline void appendUtf8(std::string& to, unsigned code)
{
  if (code < 0x80)
  {
    to += static_cast<char>(code);
  }
  else if (code < 0x800)
  {
    to += static_cast<char>(0xC0 | code >> 6);
    to += static_cast<char>(0x80 | (code & 0x3F));
  }
  else
  {
    to += static_cast<char>(0xE0 | (code >> 12 & 0x0F));
    to += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    to += static_cast<char>(0x80 | (code & 0x3F));
  }
}

} // namespace atria::model
