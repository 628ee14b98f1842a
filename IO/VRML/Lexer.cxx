// SPDX-License-Identifier: GPL-3.0-or-later
#include "Lexer.h"

#include "Support/Text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace atria::vrml {

namespace {

/// Returns a text of no characters that says where it is.
std::string_view nothingAt(const char* place)
{
  return {place, 0}; // NOLINT(bugprone-string-constructor)
}

/// Returns a table of white space and these characters.
constexpr std::array<bool, 256> blanksAnd(std::string_view others)
{
  std::array<bool, 256> table{};
  for (int c = 0; c <= 0x20; ++c)
  {
    table[c] = true;
  }
  for (const char c : others)
  {
    table[static_cast<unsigned char>(c)] = true;
  }
  return table;
}
constexpr std::array<bool, 256> delimiters = blanksAnd(",{}[]\"#\x7f");
constexpr std::array<bool, 256> skipped = blanksAnd(",#\x7f");

bool isDelimiter(char c) { return delimiters[static_cast<unsigned char>(c)]; }
/// True for white space, commas and the start of a comment.
bool isSkipped(char c) { return skipped[static_cast<unsigned char>(c)]; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Returns the end of white space, eight characters at a time as far as possible: much of a file is indentation.
const char* spacesEnd(const char* from, const char* end)
{
  // The highest bit of each byte is set if the character is above a space: no sum carries into the next byte.
  constexpr std::uint64_t high = 0x8080808080808080u;
  constexpr std::uint64_t upToHigh = 0x5f5f5f5f5f5f5f5fu; // 0x80 less 0x21
  while (static_cast<std::size_t>(end - from) >= sizeof(std::uint64_t))
  {
    std::uint64_t eight = 0;
    std::memcpy(&eight, from, sizeof eight);
    const std::uint64_t others = (((eight & ~high) + upToHigh) | eight) & high;
    if (others != 0)
    {
      return from +
             (std::endian::native == std::endian::little ? std::countr_zero(others) : std::countl_zero(others)) / 8;
    }
    from += sizeof eight;
  }
  while (from != end && static_cast<unsigned char>(*from) <= 0x20)
  {
    ++from;
  }
  return from;
}

/// True if `#` begins no comment: programs built with old versions of Microsoft's compiler write 1.#QNAN, -1.#IND00,
/// 1.#INF.
bool isNoComment(const char* hash, const char* end)
{
  const std::string_view behind(hash, std::min<std::size_t>(5, static_cast<std::size_t>(end - hash)));
  return hash[-1] == '.' &&
         (behind.substr(0, 4) == "#IND" || behind.substr(0, 4) == "#INF" || behind == "#QNAN" || behind == "#SNAN");
}

/// Returns the end of a word that is not empty.
const char* wordEnd(const char* from, const char* end)
{
  const char* const start = from;
  while (from != end && (!isDelimiter(*from) || (*from == '#' && from != start && isNoComment(from, end))))
  {
    ++from;
  }
  return from;
}

bool startsNumber(std::string_view word)
{
  std::size_t i = word[0] == '+' || word[0] == '-' ? 1 : 0;
  i += i < word.size() && word[i] == '.' ? 1 : 0;
  return i < word.size() && isDigit(word[i]);
}

/// True if from_chars calls a number out of range because it is too small; it counts as zero then.
bool underflows(std::string_view text)
{
  const std::size_t e = text.find_first_of("eE");
  return e == std::string_view::npos
             ? text.find('.') != std::string_view::npos && text.find_first_of("123456789") > text.find('.')
             : e + 1 < text.size() && text[e + 1] == '-';
}

/// Reads digits, perhaps with a point among them, that are few enough for one division to give the nearest number.
/// Returns their end; null for any other text.
const char* readPlain(const char* from, const char* end, double& value)
{
  constexpr std::uint64_t exact = std::uint64_t{1} << 53;
  constexpr std::ptrdiff_t mostDigits = 18; // more might not fit into 64 bits
  static constexpr std::array<double, 19> powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
  const bool negative = from != end && *from == '-';
  const char* const start = from + (negative ? 1 : 0);
  const char* at = start;
  const char* const stop = end - start > mostDigits ? start + mostDigits + 1 : end;
  std::uint64_t digits = 0;
  const auto readDigits = [&] {
    const char* const first = at;
    for (unsigned int digit = 0; at != stop && (digit = static_cast<unsigned int>(*at - '0')) < 10; ++at)
    {
      digits = 10 * digits + digit;
    }
    return at - first;
  };
  if (readDigits() == 0)
  {
    return nullptr;
  }
  std::ptrdiff_t decimals = 0;
  if (at != end && *at == '.')
  {
    ++at;
    decimals = readDigits();
  }
  // `.#` may begin a word for an invalid number, such as 1.#QNAN.
  if (at - start > mostDigits || digits >= exact || (at != end && (!isDelimiter(*at) || *at == '#')))
  {
    return nullptr;
  }
  const double size = static_cast<double>(digits) / powers[static_cast<std::size_t>(decimals)];
  value = negative ? -size : size;
  return at;
}

/// Reads a whole number of so few digits that it fits, as most indices do. Returns its end; null for any other text.
const char* readPlain(const char* from, const char* end, int& value)
{
  constexpr std::ptrdiff_t mostDigits = 9;
  const bool negative = from != end && *from == '-';
  const char* const start = from + (negative ? 1 : 0);
  const char* at = start;
  const char* const stop = end - start > mostDigits ? start + mostDigits : end;
  int digits = 0;
  for (unsigned int digit = 0; at != stop && (digit = static_cast<unsigned int>(*at - '0')) < 10; ++at)
  {
    digits = 10 * digits + static_cast<int>(digit);
  }
  if (at == start || (at != end && !isDelimiter(*at)))
  {
    return nullptr;
  }
  value = negative ? -digits : digits;
  return at;
}

/// Counts a character, in pieces whose counts fit into bytes, of which vector instructions add sixteen or more at once.
int countOf(char wanted, const char* first, const char* last)
{
  constexpr std::ptrdiff_t mostInByte = 255;
  int count = 0;
  while (first != last)
  {
    const char* const stop = first + std::min(last - first, mostInByte);
    std::uint8_t some = 0;
    for (; first != stop; ++first)
    {
      some = static_cast<std::uint8_t>(some + (*first == wanted ? 1 : 0));
    }
    count += some;
  }
  return count;
}

} // namespace

std::optional<double> toNumber(std::string_view text)
{
  if (text.empty() || !startsNumber(text))
  {
    return std::nullopt;
  }
  const char* first = text.data() + (text[0] == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (stop != last)
  {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range)
  {
    return underflows(text) ? std::optional(0.0) : std::nullopt;
  }
  return value;
}

std::string unescaped(std::string_view text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool escape = text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\\');
    out += text[escape ? ++i : i];
  }
  return out;
}

Lexer::Lexer(std::string_view source)
    : begin(source.data()), end(source.data() + source.size()), at(begin), counted(begin), lineStart(begin),
      lineStartOf(begin), earliestLineStart(begin), earliest(begin)
{
}

/// Most often there is one blank or none.
inline void Lexer::skipBlanks()
{
  if (at != end && isSkipped(*at) && *at != '#')
  {
    ++at;
  }
  if (at != end && isSkipped(*at))
  {
    skipManyBlanks();
  }
}

void Lexer::skipManyBlanks()
{
  for (;;)
  {
    at = spacesEnd(at, end);
    if (at == end)
    {
      return;
    }
    if (*at == ',' || *at == '\x7f')
    {
      ++at;
    }
    else if (*at == '#')
    {
      while (at != end && *at != '\n' && *at != '\r')
      {
        ++at;
      }
    }
    else
    {
      return;
    }
  }
}

Token Lexer::readString()
{
  const char* start = ++at;
  while (at != end && *at != '"')
  {
    at += *at == '\\' && at + 1 != end ? 2 : 1;
  }
  if (at == end)
  {
    // The closing quote is missing: it is better to lose the rest of a line than the rest of the file.
    at = start;
    while (at != end && *at != '\n' && *at != '\r')
    {
      ++at;
    }
    return {TokenKind::string, {start, static_cast<std::size_t>(at - start)}};
  }
  const Token token{TokenKind::string, {start, static_cast<std::size_t>(at - start)}};
  ++at;
  return token;
}

void Lexer::look()
{
  const char* const from = at;
  at = looked == 0 ? from : ends[looked - 1];
  skipBlanks();
  tokens[looked] = read();
  ends[looked] = at;
  at = from;
  ++looked;
}

Token Lexer::read()
{
  if (at == end)
  {
    return {TokenKind::end, nothingAt(end)};
  }
  const auto single = [&](TokenKind kind) { return Token{kind, {at++, 1}}; };
  switch (*at)
  {
    case '{':
      return single(TokenKind::openBrace);
    case '}':
      return single(TokenKind::closeBrace);
    case '[':
      return single(TokenKind::openBracket);
    case ']':
      return single(TokenKind::closeBracket);
    case '"':
      return readString();
    default:
      break;
  }
  const char* start = at;
  at = wordEnd(at, end);
  const std::string_view text(start, static_cast<std::size_t>(at - start));
  return {startsNumber(text) ? TokenKind::number : TokenKind::word, text};
}

std::optional<std::string_view> Lexer::nextName()
{
  const Token token = peek();
  if (token.kind != TokenKind::word && token.kind != TokenKind::number)
  {
    return std::nullopt;
  }
  return next().text;
}

std::size_t Lexer::lengthOfList()
{
  skipBlanks();
  const void* bracket = at == end ? nullptr : std::memchr(at, ']', static_cast<std::size_t>(end - at));
  return bracket ? static_cast<std::size_t>(static_cast<const char*>(bracket) - at) : 0;
}

bool Lexer::nextNumber(double& value)
{
  skipBlanks();
  // Most numbers are plain; they are read without searching for their ends first.
  if (const char* stop = readPlain(at, end, value))
  {
    moveTo(stop);
    return true;
  }
  if (at != end && (isDigit(*at) || *at == '-'))
  {
    double plain = 0.0;
    const auto [stop, error] = std::from_chars(at, end, plain);
    const bool isEnd = stop == end || (isDelimiter(*stop) && !(*stop == '#' && isNoComment(stop, end)));
    if (error == std::errc() && isEnd && std::isfinite(plain))
    {
      value = plain;
      moveTo(stop);
      return true;
    }
  }
  const char* stop = wordEnd(at, end);
  const std::optional<double> number = toNumber({at, static_cast<std::size_t>(stop - at)});
  if (!number)
  {
    return false;
  }
  value = *number;
  moveTo(stop);
  return true;
}

bool Lexer::nextNoNumber(double& value)
{
  skipBlanks();
  const char* stop = wordEnd(at, end);
  double ignored = 0.0;
  const char* first = at + (stop != at && *at == '+' ? 1 : 0);
  const auto [last, error] = std::from_chars(first, stop, ignored);
  const bool tooLarge = error == std::errc::result_out_of_range && last == stop;
  std::string text = lowered({at, stop});
  text.erase(0, text.find_first_not_of("+-"));
  const auto begins = [&](std::string_view with) { return text.compare(0, with.size(), with) == 0; };
  if (!tooLarge && !begins("nan") && text != "inf" && text != "infinity" && !begins("1.#ind") && !begins("1.#inf") &&
      !begins("1.#qnan") && !begins("1.#snan"))
  {
    return false;
  }
  value = std::numeric_limits<double>::quiet_NaN();
  moveTo(stop);
  return true;
}

bool Lexer::nextInteger(int& value)
{
  skipBlanks();
  if (const char* stop = readPlain(at, end, value))
  {
    moveTo(stop);
    return true;
  }
  const char* stop = wordEnd(at, end);
  const char* first = at != stop && *at == '+' ? at + 1 : at;
  const auto [last, error] = std::from_chars(first, stop, value);
  if (error == std::errc() && last == stop)
  {
    moveTo(stop);
    return true;
  }
  if (error == std::errc::result_out_of_range && last == stop)
  {
    value = *at == '-' ? std::numeric_limits<int>::min() : std::numeric_limits<int>::max();
    moveTo(stop);
    return true;
  }
  const std::string_view text(at, static_cast<std::size_t>(stop - at));
  unsigned int bits = 0;
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X') &&
      std::from_chars(at + 2, stop, bits, 16).ptr == stop)
  {
    value = static_cast<int>(bits);
    moveTo(stop);
    return true;
  }
  const std::optional<double> number = toNumber(text);
  if (!number || *number != std::floor(*number) || std::abs(*number) > std::numeric_limits<int>::max())
  {
    return false;
  }
  value = static_cast<int>(*number);
  moveTo(stop);
  return true;
}

Place Lexer::place()
{
  skipBlanks();
  return placeOf(nothingAt(at));
}

int Lexer::lineOf(std::string_view token)
{
  const char* target = token.data();
  countedLine += counted < target ? countLineEnds(counted, target) : -countLineEnds(target, counted);
  counted = target;
  return countedLine;
}

/// Counts the line ends from `first` to before `last`. Written so that compilers make vector instructions of it: all of
/// the text of files with many nodes comes through here.
int Lexer::countLineEnds(const char* first, const char* last) const
{
  if (first == last || !std::memchr(first, '\r', static_cast<std::size_t>(last - first)))
  {
    return countOf('\n', first, last);
  }
  const bool toEnd = last == end && first != last;
  const char* stop = toEnd ? last - 1 : last;
  int count = toEnd && (*stop == '\n' || *stop == '\r') ? 1 : 0;
  for (const char* c = first; c < stop; ++c)
  {
    count += static_cast<int>(*c == '\n') | (static_cast<int>(*c == '\r') & static_cast<int>(c[1] != '\n'));
  }
  return count;
}

Place Lexer::placeOf(std::string_view token)
{
  const char* target = token.data();
  // Goes back no further than to the place requested last, as all of a file may be one line.
  const bool further = lineStartOf <= target;
  const char* known = further ? lineStartOf : earliest;
  const char* start = target;
  while (start != known && start[-1] != '\n' && start[-1] != '\r')
  {
    --start;
  }
  lineStart = start != known ? start : further ? lineStart : earliestLineStart;
  lineStartOf = target;
  return {lineOf(token), static_cast<int>(target - lineStart) + 1};
}

void Lexer::forget()
{
  placeOf(nothingAt(at));
  earliest = at;
  earliestLineStart = lineStart;
}

} // namespace atria::vrml
