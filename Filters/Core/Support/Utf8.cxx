// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Utf8.h"

#include <array>

namespace atria {

namespace {

/// Returns the range of the second byte after a first one: not all make characters (RFC 3629, section 4).
std::array<unsigned char, 2> secondBytes(unsigned char first)
{
  switch (first)
  {
    case 0xe0:
      return {0xa0, 0xbf}; // shorter forms exist
    case 0xed:
      return {0x80, 0x9f}; // no surrogates
    case 0xf0:
      return {0x90, 0xbf};
    case 0xf4:
      return {0x80, 0x8f}; // up to U+10FFFF
    default:
      return {0x80, 0xbf};
  }
}

/// Returns the length of the UTF-8 character at `i` in bytes; 0 if there is none.
std::size_t utf8Length(std::string_view text, std::size_t i)
{
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || i + length > text.size())
  {
    return 0;
  }
  const auto [low, high] = secondBytes(first);
  if (length > 1 && (byte(i + 1) < low || byte(i + 1) > high))
  {
    return 0;
  }
  for (std::size_t k = 1; k < length; ++k)
  {
    if ((byte(i + k) & 0xc0) != 0x80)
    {
      return 0;
    }
  }
  return length;
}

} // namespace

std::string toUtf8(std::string_view text)
{
  bool valid = true;
  for (std::size_t i = 0, length = 0; valid && i < text.size(); i += length)
  {
    length = utf8Length(text, i);
    valid = length != 0;
  }
  if (valid)
  {
    return std::string(text);
  }
  std::string out;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
    {
      out += c;
    }
    else
    {
      out += static_cast<char>(0xc0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return out;
}

} // namespace atria
