// SPDX-License-Identifier: GPL-3.0-or-later
/// Words, numbers and lines of text formats.
#pragma once

#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace atria::model {

inline constexpr std::string_view blanks = " \t\v\f";

/// Returns the next word of `text`, which then begins behind it; empty at the end.
inline std::string_view nextWord(std::string_view& text)
{
  const std::size_t start = text.find_first_not_of(blanks);
  if (start == text.npos)
  {
    text = {};
    return {};
  }
  const std::size_t end = text.find_first_of(blanks, start);
  const std::string_view word = text.substr(start, end == text.npos ? end : end - start);
  text.remove_prefix(end == text.npos ? text.size() : end);
  return word;
}

/// Returns the text without blanks around it.
inline std::string_view trimmed(std::string_view text)
{
  const std::size_t start = text.find_first_not_of(blanks);
  return start == text.npos ? std::string_view() : text.substr(start, text.find_last_not_of(blanks) + 1 - start);
}

/// Reads the number that `word` begins with. Returns false if there is none, or if any character but one of `end`
/// follows. A number too small for its type is 0; one too large is none.
template <typename Number> bool parse(std::string_view word, Number& value, std::string_view end = "")
{
  if (!word.empty() && word.front() == '+')
  {
    word.remove_prefix(1);
  }
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = stop == word.data() + word.size() || end.find(*stop) != std::string_view::npos;
  if (std::is_floating_point_v<Number> && error == std::errc::result_out_of_range)
  {
    const std::string_view number = word.substr(0, static_cast<std::size_t>(stop - word.data()));
    const std::size_t exponent = number.find_first_of("eE");
    const std::size_t digit = number.find_first_not_of("+-");
    const bool small =
        exponent == number.npos ? number[digit] == '0' || number[digit] == '.' : number[exponent + 1] == '-';
    value = 0;
    return small && whole;
  }
  return error == std::errc{} && whole;
}

/// Takes the next line off `text` at `at`. Returns it without its end, which may be LF, CR or both.
inline std::string_view nextLine(std::string_view text, std::size_t& at)
{
  const std::size_t stop = text.find_first_of("\r\n", at);
  const std::size_t end = stop == text.npos ? text.size() : stop;
  const std::string_view line = text.substr(at, end - at);
  at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  return line;
}

} // namespace atria::model
