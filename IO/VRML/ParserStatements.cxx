// SPDX-License-Identifier: GPL-3.0-or-later
/// The parser's part for statements that are no nodes: ROUTE, PROTO and EXTERNPROTO, and the statements of X3D.
#include "NodeTypes.h"
#include "Parser.h"

namespace atria::vrml {

namespace {

/// Returns the node of the standard that a URL such as urn:web3d:vrml97:node:Transform means; null for other URLs.
const NodeType* standardNode(std::string_view url)
{
  constexpr std::string_view marker = ":node:";
  const std::size_t found = url.rfind(marker);
  return url.substr(0, 4) == "urn:" && found != url.npos
             ? findNodeType(url.substr(found + marker.size()), Version::vrml97)
             : nullptr;
}

} // namespace

/// Reads PROTO, EXTERNPROTO or ROUTE, which may stand wherever a node or a field may.
bool Parser::readStatement()
{
  const Token token = lexer.peek();
  if (token.is("ROUTE"))
  {
    readRoute();
    return true;
  }
  if (token.is("PROTO") || token.is("EXTERNPROTO"))
  {
    readPrototype(token.text == "EXTERNPROTO");
    return true;
  }
  return document.version == Version::x3d && readStatementOfX3D();
}

/// Reads a statement that X3D has between its header and its nodes.
bool Parser::readStatementOfX3D()
{
  const Token token = lexer.peek();
  if (token.is("UNIT"))
  {
    lexer.next();
    const std::string category(lexer.nextName().value_or(""));
    lexer.nextName();
    const std::string text(lexer.peek().text);
    double factor = 1.0;
    if (lexer.nextNumber(factor) && category == "length" && factor != 1.0)
    {
      warn("lengths are stated to be in units of " + text + " m, which is not applied; set Scale");
    }
    return true;
  }
  const bool exchange = token.is("IMPORT") || token.is("EXPORT");
  if (!exchange && !token.is("PROFILE") && !token.is("COMPONENT") && !token.is("META"))
  {
    return false;
  }
  lexer.next();
  for (int i = 0; i < 2 && lexer.peek().kind == TokenKind::string; ++i) // strings of META
  {
    lexer.next();
  }
  if (!token.is("META"))
  {
    lexer.nextName();
  }
  if (exchange && lexer.peek().is("AS"))
  {
    lexer.next();
    lexer.nextName();
  }
  return true;
}

/// Reads `ROUTE a.b TO c.d`, where blanks may surround the dots.
void Parser::readRoute()
{
  ++document.routes;
  lexer.next();
  for (const bool untilTo : {true, false})
  {
    bool goOn = true;
    while (goOn)
    {
      const auto word = lexer.nextName();
      const Token next = lexer.peek();
      if (!word)
      {
        return expected("names and TO after ROUTE");
      }
      const bool dots = word->back() == '.' || (next.kind == TokenKind::word && next.text.front() == '.');
      goOn = untilTo ? *word != "TO" : dots;
    }
  }
}

void Parser::readPrototype(bool external)
{
  const int line = lexer.place().line;
  lexer.next();
  const auto name = lexer.nextName();
  if (!name || lexer.peek().kind != TokenKind::openBracket)
  {
    return expected("the name of a prototype and '['");
  }
  lexer.next();
  Prototype& prototype = document.prototypes.emplace_back();
  prototype.name = document.keep(*name);
  prototype.external = external;
  prototype.document = &document;
  prototype.defaults = &document.addNode();
  prototype.defaults->typeName = prototype.name;
  frames.push_back({Open::interface, {}, nullptr, &prototype, line});
}

void Parser::stepInterface()
{
  Prototype& prototype = *frames.back().prototype;
  const Token token = lexer.peek();
  if (token.kind == TokenKind::end)
  {
    return unexpectedEnd();
  }
  if (token.kind == TokenKind::closeBracket)
  {
    lexer.next();
    frames.pop_back();
    return openBody(prototype);
  }
  const bool event = isEvent(token);
  if (!event && !isField(token))
  {
    expected("field, exposedField, eventIn, eventOut or ']'");
    token.kind == TokenKind::openBrace || token.kind == TokenKind::openBracket ? skipGroup() : void(lexer.next());
    return;
  }
  lexer.next();
  const auto type = findFieldType(lexer.peek().text);
  if (!type)
  {
    expected("the type of a field");
  }
  lexer.next();
  const auto name = lexer.nextName();
  if (!name)
  {
    return expected("the name of a field");
  }
  if (!event)
  {
    const std::string_view kept = document.keep(*name);
    prototype.interface[kept] = type.value_or(FieldType::unknown);
    if (!prototype.external)
    {
      const Slot slot = slotOf(*prototype.defaults, kept);
      readValue(*slot.node, slot.field, type.value_or(FieldType::unknown), true);
    }
  }
}

void Parser::openBody(Prototype& prototype)
{
  if (prototype.external)
  {
    scopes.back().prototypes[prototype.name] = &prototype;
    Value urls;
    if (!readStrings(urls, true))
    {
      return expected("the URL of the prototype");
    }
    prototype.urls = std::get<Strings>(urls);
    for (const std::string_view url : prototype.urls)
    {
      prototype.standard = prototype.standard ? prototype.standard : standardNode(url);
    }
    return;
  }
  if (lexer.peek().kind != TokenKind::openBrace)
  {
    return expected("'{' and the body of the prototype");
  }
  const int line = lexer.place().line;
  lexer.next();
  prototype.body = &document.addNode();
  scopes.emplace_back(); // names inside are unknown outside, and the other way around
  frames.push_back({Open::body, slotOf(*prototype.body, "children"), nullptr, &prototype, line});
}

void Parser::closeBody()
{
  lexer.next();
  const Prototype* prototype = frames.back().prototype;
  frames.pop_back();
  scopes.pop_back();
  scopes.back().prototypes[prototype->name] = prototype;
}

} // namespace atria::vrml
