// SPDX-License-Identifier: GPL-3.0-or-later
/// The parser's part for values of fields, for skipped text, and for messages.
#include "Input.h"
#include "NodeTypes.h"
#include "Parser.h"

#include "Support/Text.h"

#include <algorithm>
#include <type_traits>

namespace atria::vrml {

using scene::Diagnostics;

namespace {

constexpr std::size_t tickInterval = 1 << 16;

/// Returns the count of numbers in one value of a type.
std::size_t arityOf(FieldType type)
{
  switch (type)
  {
    case FieldType::sfVec2f:
    case FieldType::mfVec2f:
      return 2;
    case FieldType::sfVec3f:
    case FieldType::mfVec3f:
    case FieldType::mfPoint:
      return 3;
    case FieldType::sfRotation:
    case FieldType::mfRotation:
      return 4;
    case FieldType::sfMatrix:
      return 16;
    default:
      return 1;
  }
}

std::string expectationOf(FieldType type)
{
  switch (type)
  {
    case FieldType::sfBool:
      return "TRUE or FALSE";
    case FieldType::sfInt32:
      return "a whole number";
    case FieldType::mfInt32:
      return "a whole number or ']'";
    case FieldType::sfString:
    case FieldType::mfString:
      return "a string in quotes";
    case FieldType::sfWord:
      return "a word";
    case FieldType::sfFloat:
      return "a number";
    case FieldType::sfVec2f:
    case FieldType::sfVec3f:
    case FieldType::sfRotation:
    case FieldType::sfMatrix:
      return std::to_string(arityOf(type)) + " numbers";
    default:
      return "a number or ']'";
  }
}

} // namespace

/// Reads the value of `owner`'s field. An error marks the node as damaged and leaves the field empty.
void Parser::readValue(Node& owner, std::size_t field, FieldType type, bool inInterface)
{
  if (type == FieldType::unknown)
  {
    owner.fields[field].value = std::monostate{};
    return readByLook();
  }
  if (type == FieldType::sfNode || type == FieldType::mfNode)
  {
    return readNodes({&owner, field}, type == FieldType::mfNode);
  }
  Value value;
  const bool bracket = lexer.peek().kind == TokenKind::openBracket;
  if (readScalars(value, type))
  {
    const auto* points = type == FieldType::mfPoint ? std::get_if<Numbers>(&value) : nullptr;
    document.points += points ? points->size() / 3 : 0;
    const auto* indices = std::get_if<Integers>(&value);
    document.indices += indices ? indices->size() : 0;
    owner.fields[field].value = value;
    return;
  }
  const std::string consequence = inInterface ? "" : "; this " + toUtf8(owner.typeName) + " is left out";
  expected(expectationOf(type) + " for the field " + toUtf8(owner.fields[field].name), consequence);
  owner.fields[field].value = std::monostate{};
  owner.damaged = owner.damaged || !inInterface;
  resume(inInterface ? nullptr : &owner, bracket);
}

void Parser::readNodes(Slot slot, bool many)
{
  Value& value = slot.node->fields[slot.field].value;
  if (!many)
  {
    std::get<Nodes>(value).truncate(0);
  }
  if (lexer.peek().kind == TokenKind::openBracket)
  {
    const int line = lexer.lineOf(lexer.next().text);
    frames.push_back({Open::list, slot, nullptr, nullptr, line});
  }
  else if (startsNode())
  {
    readNode(slot);
  }
  else
  {
    expected("a node for the field " + std::string(slot.node->fields[slot.field].name));
  }
}

bool Parser::readScalars(Value& value, FieldType type)
{
  switch (type)
  {
    case FieldType::sfBool:
      return readBool(value);
    case FieldType::sfInt32:
    case FieldType::mfInt32:
      return readIntegers(value, type == FieldType::mfInt32);
    case FieldType::sfString:
    case FieldType::mfString:
      return readStrings(value, type == FieldType::mfString);
    case FieldType::sfWord:
      return readWords(value);
    case FieldType::mfFloat:
    case FieldType::mfVec2f:
    case FieldType::mfVec3f:
    case FieldType::mfRotation:
      return readNumbers(value, arityOf(type), true);
    case FieldType::mfPoint:
      return readNumbers(value, arityOf(type), true, true);
    default:
      return readNumbers(value, arityOf(type), false);
  }
}

namespace {

/// Some programs write True, or true.
bool isTruth(const Token& token, std::string_view capitals)
{
  return token.kind == TokenKind::word && sameButForCapitals(token.text, capitals);
}

} // namespace

bool Parser::readBool(Value& value)
{
  const Token token = lexer.peek();
  const bool yes = isTruth(token, "TRUE") || (isVersion1() && token.text == "1");
  if (!yes && !isTruth(token, "FALSE") && !(isVersion1() && token.text == "0"))
  {
    return false;
  }
  lexer.next();
  value = yes;
  return true;
}

/// Reads the values of a list of so many `characters`. They are collected apart, with room for values of the usual
/// length as growing in steps would copy, and touch, twice as much memory; the list itself then has what it needs.
template <class T, class Read>
void Parser::readList(Value& value, std::size_t characters, std::vector<T>& scratch, const Read& readOne)
{
  constexpr std::size_t usualLength = std::is_same_v<T, int> ? 6 : 8;
  scratch.clear();
  scratch.reserve(characters / usualLength);
  T one{};
  while (readOne(one))
  {
    scratch.push_back(one);
    tick();
  }
  value.emplace<List<T>>(std::span<const T>(scratch), document.memory);
}

bool Parser::readIntegers(Value& value, bool many)
{
  if (!many || lexer.peek().kind != TokenKind::openBracket)
  {
    const bool bracket = openNeedlessBracket();
    int number = 0;
    const bool read = lexer.nextInteger(number);
    value.emplace<Integers>(std::span(&number, read ? 1 : 0), document.memory);
    return read && (!bracket || endsList());
  }
  const std::size_t characters = lexer.lengthOfList();
  lexer.next();
  readList(value, characters, integers, [&](int& number) { return lexer.nextInteger(number); });
  return endsList();
}

/// Opens a bracket, which some programs put around single values.
bool Parser::openNeedlessBracket()
{
  if (lexer.peek().kind != TokenKind::openBracket)
  {
    return false;
  }
  warn("expected a single value, found a list; taken as the value");
  lexer.next();
  return true;
}

/// True at the end of a list, which may lack its bracket where its node ends.
bool Parser::endsList()
{
  const TokenKind kind = lexer.peek().kind;
  if (kind == TokenKind::closeBrace)
  {
    expected("']'");
    return true;
  }
  return kind == TokenKind::closeBracket && lexer.next().kind == TokenKind::closeBracket;
}

/// Reads numbers. A list whose length is no multiple of `arity` loses its incomplete end. Entries that are no numbers
/// are allowed only with `gaps`.
bool Parser::readNumbers(Value& value, std::size_t arity, bool many, bool gaps)
{
  if (!many || lexer.peek().kind != TokenKind::openBracket)
  {
    const bool bracket = openNeedlessBracket();
    auto& out = value.emplace<Numbers>();
    out.reserve(arity, document.memory);
    double number = 0.0;
    while (out.size() < arity && lexer.nextNumber(number))
    {
      out.push_back(number, document.memory);
    }
    return out.size() == arity && (!bracket || endsList());
  }
  const std::size_t characters = lexer.lengthOfList();
  lexer.next();
  readList(value, characters, numbers,
           [&](double& number) { return lexer.nextNumber(number) || (gaps && lexer.nextNoNumber(number)); });
  if (lexer.peek().kind != TokenKind::closeBracket && lexer.peek().kind != TokenKind::closeBrace)
  {
    return false;
  }
  auto& out = std::get<Numbers>(value);
  if (out.size() % arity != 0)
  {
    expected("numbers in groups of " + std::to_string(arity));
    out.truncate(out.size() - out.size() % arity);
  }
  return endsList();
}

bool Parser::readStrings(Value& value, bool many)
{
  auto& out = value.emplace<Strings>();
  const bool bracket = many && lexer.peek().kind == TokenKind::openBracket;
  if (bracket)
  {
    lexer.next();
  }
  while (lexer.peek().kind == TokenKind::string && (bracket || out.empty()))
  {
    out.push_back(document.keep(unescaped(lexer.next().text)), document.memory);
  }
  if (isVersion1() && !bracket && out.empty() && lexer.peek().kind == TokenKind::word)
  {
    out.push_back(document.keep(lexer.next().text),
                  document.memory); // VRML 1.0 has no quotes around strings without blanks
  }
  return bracket ? lexer.next().kind == TokenKind::closeBracket : !out.empty();
}

/// Reads `SIDES`, or `(SIDES | TOP)`.
bool Parser::readWords(Value& value)
{
  auto& out = value.emplace<Strings>();
  if (lexer.peek().kind != TokenKind::word)
  {
    return false;
  }
  bool inside = false;
  do
  {
    const std::size_t parenthesis = lexer.peek().text.find(')');
    if (parenthesis != std::string_view::npos)
    {
      lexer.cutNext(parenthesis + 1); // a field may begin right behind it
    }
    const std::string_view text = lexer.next().text;
    inside = (inside || text.front() == '(') && text.back() != ')';
    for (std::size_t start = 0; start < text.size();)
    {
      const std::size_t stop = std::min(text.find_first_of("(|)", start), text.size());
      if (stop > start)
      {
        out.push_back(document.keep(text.substr(start, stop - start)), document.memory);
      }
      start = stop + 1;
    }
  } while (inside && lexer.peek().kind == TokenKind::word);
  return !inside;
}

/// True if the next value, of an unknown type, looks like nodes.
bool Parser::holdsNodes()
{
  if (lexer.peek().kind != TokenKind::openBracket)
  {
    return startsNode();
  }
  const Token second = lexer.peekSecond();
  return second.kind == TokenKind::word && !isTruth(second, "TRUE") && !isTruth(second, "FALSE");
}

/// Reads past a value whose type is not known or of no interest. Nodes in it are still read: a USE may want
/// them.
void Parser::readByLook()
{
  const Token token = lexer.peek();
  if (token.kind == TokenKind::openBracket)
  {
    if (!holdsNodes())
    {
      return skipGroup();
    }
    lexer.next();
    frames.push_back({Open::list, {}, nullptr, nullptr, lexer.lineOf(token.text)});
  }
  else if (startsNode())
  {
    readNode({});
  }
  else if (isTruth(token, "TRUE") || isTruth(token, "FALSE"))
  {
    lexer.next();
  }
  else if (isVersion1() && token.kind == TokenKind::word)
  {
    Value words;
    readWords(words);
  }
  else
  {
    while (lexer.peek().kind == TokenKind::number || lexer.peek().kind == TokenKind::string)
    {
      lexer.next();
      tick();
    }
  }
}

/// Skips from an opening bracket or brace to its counterpart. Arrays that are not needed pass through here, so the
/// brackets of another kind only matter where they enclose it.
void Parser::skipGroup()
{
  std::vector<TokenKind> closing;
  do
  {
    const Token token = lexer.peek();
    tick();
    if (token.kind == TokenKind::end)
    {
      return;
    }
    if (token.kind == TokenKind::openBrace || token.kind == TokenKind::openBracket)
    {
      closing.push_back(token.kind == TokenKind::openBrace ? TokenKind::closeBrace : TokenKind::closeBracket);
    }
    else if (token.kind == closing.back())
    {
      closing.pop_back();
    }
    else if (token.kind == TokenKind::closeBrace)
    {
      expected("']'"); // the list was not closed; the brace is its node's
      return;
    }
    lexer.next();
  } while (!closing.empty());
}

/// Continues after an error in a value, at the possible start of the next field.
void Parser::resume(const Node* owner, bool inBrackets)
{
  for (;;)
  {
    tick();
    const Token token = lexer.peek();
    switch (token.kind)
    {
      case TokenKind::end:
      case TokenKind::closeBrace:
        return;
      case TokenKind::closeBracket:
        if (inBrackets)
        {
          lexer.next();
        }
        return;
      case TokenKind::openBrace:
      case TokenKind::openBracket:
        skipGroup();
        inBrackets = false;
        continue;
      case TokenKind::word:
        if (owner ? fieldType(*owner, token.text).has_value() : isField(token) || isEvent(token))
        {
          return;
        }
        break;
      default:
        break;
    }
    lexer.next();
  }
}

void Parser::expected(std::string_view what, const std::string& consequence)
{
  if (!quiet)
  {
    warn("expected " + std::string(what) + ", found " + tell(lexer.peek()) + consequence);
  }
  quiet = true;
}

void Parser::warn(const std::string& text)
{
  // Finding the column is slow in files of one line, so only for warnings somebody can read.
  diagnostics.warn(diagnostics.count() < Diagnostics::keptAtMost ? textOf(lexer.place()) + ": " + text : text);
}

/// Handles a file that ends while a construct is open: the part that was read is kept.
void Parser::unexpectedEnd()
{
  if (frames.size() > 1)
  {
    const Frame& frame = frames.back();
    const std::string what = frame.node        ? std::string(frame.node->typeName)
                             : frame.prototype ? "PROTO " + std::string(frame.prototype->name)
                                               : "list of nodes";
    warn("the file ends within the " + toUtf8(what) + " that begins in line " + std::to_string(frame.line));
  }
  frames.clear();
}

std::string Parser::textOf(const Place& place) const
{
  return document.displayName() + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

std::string Parser::tell(const Token& token) const
{
  constexpr std::size_t longest = 40;
  switch (token.kind)
  {
    case TokenKind::end:
      return "the end of the file";
    case TokenKind::string:
      return "a string";
    default:
      return std::string("'").append(toUtf8(token.text.substr(0, longest))).append("'");
  }
}

/// Frees the text read so far, every now and then: the nodes made of it take about as much memory again.
void Parser::forget()
{
  constexpr std::size_t interval = std::size_t{8} << 20;
  if (lexer.position() - forgotten >= interval)
  {
    lexer.forget();
    forgotten = lexer.position();
    source.forget(forgotten);
  }
}

/// Lets the caller see progress and stop, every now and then.
void Parser::tick()
{
  if (lexer.position() - reported >= tickInterval)
  {
    reported = lexer.position();
    progress.report(static_cast<double>(reported) / static_cast<double>(length), "Reading the model");
  }
}

} // namespace atria::vrml
