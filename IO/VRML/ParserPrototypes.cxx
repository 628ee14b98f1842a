// SPDX-License-Identifier: GPL-3.0-or-later
/// The parser's reading of PROTO and EXTERNPROTO.
#include "NodeTypes.h"
#include "Parser.h"

namespace atria::vrml {

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
    prototype.urls = std::get<std::vector<std::string>>(urls);
    return;
  }
  if (lexer.peek().kind != TokenKind::openBrace)
  {
    return expected("'{' and the body of the prototype");
  }
  const int line = lexer.place().line;
  lexer.next();
  prototype.body = &document.addNode();
  scopes.emplace_back(); // names inside are unknown outside, and the other way round
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
