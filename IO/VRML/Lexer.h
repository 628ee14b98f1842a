// SPDX-License-Identifier: GPL-3.0-or-later
/// Splits text into tokens. The lexical rules are those of VRML 1.0 and VRML97 alike, except for names, which are read
/// more generously: exporters write dots, slashes and leading digits.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace atria::vrml {

enum class TokenKind
{
  end,
  word,   ///< a name or keyword
  number, ///< a word that starts like a number, not checked further
  string, ///< `text` is the part between the quotes, escapes untouched
  openBrace,
  closeBrace,
  openBracket,
  closeBracket
};

struct Token
{
  TokenKind kind = TokenKind::end;
  std::string_view text;

  bool is(std::string_view word) const
  {
    return kind == TokenKind::word && text.size() == word.size() && text[0] == word[0] && text == word;
  }
};

/// Line and column, both counted from 1.
struct Place
{
  int line = 1;
  int column = 1;
};

/// Reads tokens off a text that must outlive it. White space, commas and comments separate tokens; a line ends with LF,
/// CR or both.
class Lexer
{
public:
  explicit Lexer(std::string_view source);

  Token next()
  {
    const Token token = peek();
    at = ends[0];
    tokens[0] = tokens[1];
    ends[0] = ends[1];
    --looked;
    return token;
  }
  const Token& peek()
  {
    if (looked == 0)
    {
      look();
    }
    return tokens[0];
  }
  /// Returns the token after the next one.
  const Token& peekSecond()
  {
    peek();
    if (looked == 1)
    {
      look();
    }
    return tokens[1];
  }
  /// Splits the next token in two, the first of so many characters.
  void cutNext(std::size_t characters)
  {
    peek();
    tokens[0].text = tokens[0].text.substr(0, characters);
    ends[0] = tokens[0].text.data() + characters;
    looked = 1;
  }
  /// Reads a name after DEF, USE and the like, where a word that looks like a number is a name too.
  std::optional<std::string_view> nextName();
  /// Returns the number of characters up to the next closing bracket, zero without one: a bound for the length of a
  /// list.
  std::size_t lengthOfList();
  /// Reads a finite number and returns true, or leaves the text and returns false.
  bool nextNumber(double& value);
  /// Reads a word such as nan, -inf, 1.#QNAN, or a number that is too large, as not a number. Returns false, and leaves
  /// the text, for any other.
  bool nextNoNumber(double& value);
  /// Reads a whole number in the range of int, also in hexadecimal or written like 3.0.
  bool nextInteger(int& value);

  /// Returns the place of the start of the next token.
  Place place();
  Place placeOf(std::string_view token);
  /// Returns the line alone, which is cheap also if a whole file is one line.
  int lineOf(std::string_view token);
  /// Declares that text before the next token is not needed any more. Keeps the data for places after it.
  void forget();
  std::size_t position() const { return static_cast<std::size_t>(at - begin); }

private:
  void skipBlanks();
  void skipManyBlanks();
  /// Reads one more token ahead.
  void look();
  void moveTo(const char* place)
  {
    at = place;
    looked = 0;
  }
  /// Reads the token that begins here.
  Token read();
  Token readString();
  int countLineEnds(const char* first, const char* last) const;

  const char* begin;
  const char* end;
  const char* at;
  // Tokens read ahead, since most are inspected before they are taken, and their ends.
  std::array<Token, 2> tokens;
  std::array<const char*, 2> ends{};
  std::size_t looked = 0;
  // Lines are counted only on request, from the last counted place.
  const char* counted;
  int countedLine = 1;
  const char* lineStart;   ///< start of the line that contains
  const char* lineStartOf; ///< this
  // The same for the place before which the text is forgotten.
  const char* earliestLineStart;
  const char* earliest;
};

/// Returns the value of a number's text; nothing if it is none, or too large.
std::optional<double> toNumber(std::string_view text);
/// Returns the text of a string token with its escapes resolved.
std::string unescaped(std::string_view text);

} // namespace atria::vrml
