// SPDX-License-Identifier: GPL-3.0-or-later
/// Characters to tokens. The lexical rules are those of VRML 1.0 and VRML97 alike, but for names, which are
/// taken more generously: exporters write dots, slashes and leading digits.
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
  string, ///< `text` is what stands between the quotes, escapes untouched
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

/// Reads tokens off a text that must outlive it. White space, commas and comments separate tokens; a line
/// ends with LF, CR or both.
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
  /// The token after the next one.
  const Token& peekSecond()
  {
    peek();
    if (looked == 1)
    {
      look();
    }
    return tokens[1];
  }
  /// Makes two tokens of the next one, the first of so many characters.
  void cutNext(std::size_t characters)
  {
    peek();
    tokens[0].text = tokens[0].text.substr(0, characters);
    ends[0] = tokens[0].text.data() + characters;
    looked = 1;
  }
  /// Reads a name after DEF, USE and the like, where something that looks like a number is a name too.
  std::optional<std::string_view> nextName();
  /// Characters up to the next closing bracket, zero without one: how much a list may hold.
  std::size_t lengthOfList();
  /// Reads a finite number, or leaves the text where it is and says false.
  bool nextNumber(double& value);
  /// Reads what stands for a number that is none, such as nan, -inf, 1.#QNAN, or is too large, as not a number. Else
  /// leaves the text where it is and says false.
  bool nextNoNumber(double& value);
  /// Reads a whole number in the range of int, also in hexadecimal or written like 3.0.
  bool nextInteger(int& value);

  /// Where the next token starts.
  Place place();
  Place placeOf(std::string_view token);
  /// The line alone: cheap also where a whole file is one line.
  int lineOf(std::string_view token);
  /// Nothing before the next token is asked for again. What is needed to tell places after it is kept.
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
  // Tokens read ahead, as most are looked at before they are taken, and where they end.
  std::array<Token, 2> tokens;
  std::array<const char*, 2> ends{};
  std::size_t looked = 0;
  // Lines are counted only when somebody asks, from where they were counted last.
  const char* counted;
  int countedLine = 1;
  const char* lineStart;   ///< of the line that holds
  const char* lineStartOf; ///< this
  // The same for the place before which the text is forgotten.
  const char* earliestLineStart;
  const char* earliest;
};

/// The value of a number's text; nothing where it is none, or too large.
std::optional<double> toNumber(std::string_view text);
/// The text of a string token with its escapes resolved.
std::string unescaped(std::string_view text);

} // namespace atria::vrml
