// SPDX-License-Identifier: GPL-3.0-or-later
#include "Parser.h"

#include "Input.h"
#include "NodeTypes.h"

#include <algorithm>

namespace atria::vrml {

using scene::Diagnostics;

Parser::Parser(Document& target, FileText file, Diagnostics& messages, const ProgressRange& monitor)
    : document(target), source(std::move(file)), lexer(source.text()), length(source.text().size()),
      diagnostics(messages), progress(monitor)
{
}

void Parser::run()
{
  document.root = &document.addNode();
  scopes.emplace_back();
  frames.push_back({Open::file, slotOf(*document.root, "children")});
  while (!frames.empty())
  {
    step();
  }
}

void Parser::step()
{
  tick();
  forget();
  switch (frames.back().what)
  {
    case Open::node:
      return stepNode();
    case Open::interface:
      return stepInterface();
    default:
      return stepList();
  }
}

void Parser::stepList()
{
  const Open what = frames.back().what;
  const Token token = lexer.peek();
  if (token.kind == TokenKind::end)
  {
    return unexpectedEnd();
  }
  if (token.kind == TokenKind::closeBracket || token.kind == TokenKind::closeBrace)
  {
    return closeList();
  }
  if (readStatement())
  {
    return;
  }
  if (startsNode())
  {
    return readNode(frames.back().slot);
  }
  const Node* owner = frames.back().slot.node;
  if (what == Open::list && owner && token.kind == TokenKind::word && fieldType(*owner, token.text))
  {
    expected("a node or ']'"); // the list was not closed before the next field
    frames.pop_back();
    return;
  }
  expected(what == Open::file ? "a node, PROTO or ROUTE" : what == Open::list ? "a node or ']'" : "a node or '}'");
  if (token.kind == TokenKind::openBrace || token.kind == TokenKind::openBracket)
  {
    return skipGroup();
  }
  lexer.next();
}

/// Handles a closing bracket or brace among nodes.
void Parser::closeList()
{
  const Open what = frames.back().what;
  const bool bracket = lexer.peek().kind == TokenKind::closeBracket;
  if (what == Open::body && !bracket)
  {
    return closeBody();
  }
  if (what == Open::list)
  {
    if (bracket)
    {
      lexer.next();
    }
    else
    {
      expected("a node or ']'");
    }
    frames.pop_back();
    return;
  }
  expected(what == Open::file ? "a node, PROTO or ROUTE" : "a node or '}'");
  lexer.next();
}

void Parser::stepNode()
{
  const Token token = lexer.peek();
  Node& node = *frames.back().node;
  switch (token.kind)
  {
    case TokenKind::end:
      return unexpectedEnd();
    case TokenKind::closeBrace:
      lexer.next();
      frames.pop_back();
      return;
    case TokenKind::closeBracket:
      expected("a field or '}'");
      if (frames[frames.size() - 2].what == Open::list)
      {
        frames.pop_back(); // the brace is missing: the bracket belongs to the list around
        return;
      }
      lexer.next();
      return;
    case TokenKind::openBracket:
      if (node.type && node.type->takesChildren())
      {
        warn("expected a field of " + std::string(node.typeName) + ", found a list of nodes; taken as its children");
        return readNodes(slotOf(node, "children"), true);
      }
      expected("a field or '}'");
      return skipGroup();
    case TokenKind::openBrace:
      expected("a field or '}'");
      return skipGroup();
    case TokenKind::word:
      break;
    default:
      expected("a field or '}'");
      lexer.next();
      return;
  }
  if (readStatement())
  {
    return;
  }
  startsNode() ? readNodeWithoutField() : readField();
}

bool Parser::startsNode()
{
  const Token token = lexer.peek();
  return token.is("DEF") || token.is("USE") || token.is("NULL") ||
         (token.kind == TokenKind::word && lexer.peekSecond().kind == TokenKind::openBrace);
}

void Parser::readNode(Slot slot)
{
  const Token token = lexer.peek();
  if (token.is("NULL"))
  {
    lexer.next();
    return put(slot, nullptr); // keeps its place among the choices of a Switch
  }
  if (token.is("USE"))
  {
    return readUse(slot);
  }
  std::vector<std::string_view> names;
  readNames(names);
  if (lexer.peek().is("USE"))
  {
    expected("a node type after DEF");
    return readUse(slot);
  }
  if (lexer.peek().kind != TokenKind::word || lexer.peekSecond().kind != TokenKind::openBrace)
  {
    expected("a node type and '{'");
    return;
  }
  openNode(slot, names);
}

/// Reads DEF and its name, which some exporters write twice.
void Parser::readNames(std::vector<std::string_view>& names)
{
  while (lexer.peek().is("DEF"))
  {
    if (!names.empty())
    {
      warn("expected a node type, found a second DEF; both names are kept");
    }
    lexer.next();
    // `DEF Transform {` lacks the name.
    if (lexer.peek().kind == TokenKind::word && lexer.peekSecond().kind == TokenKind::openBrace)
    {
      expected("a name after DEF");
      return;
    }
    if (const auto name = lexer.nextName())
    {
      names.push_back(document.keep(*name));
    }
  }
}

void Parser::openNode(Slot slot, const std::vector<std::string_view>& names)
{
  const Token type = lexer.next();
  lexer.next();
  Node& node = document.addNode();
  const Place place = lexer.placeOf(type.text);
  node.line = place.line;
  node.column = static_cast<std::uint32_t>(std::min(place.column, (1 << 30) - 1));
  node.prototype = findPrototype(type.text);
  if (node.prototype && node.prototype->standard)
  {
    node.type = node.prototype->standard;
    node.prototype = nullptr;
  }
  else if (!node.prototype)
  {
    node.type = findNodeType(type.text, document.version);
  }
  if (isVersion1() && !node.type)
  {
    node.type = declaredBase();
  }
  const bool isOwn = node.type && node.type->name == type.text;
  node.typeName = isOwn ? node.type->name : node.prototype ? node.prototype->name : document.keep(type.text);
  quiet = quiet && !node.prototype && !node.type;
  document.names += names.size();
  document.surfaces += node.type && node.type->kind == NodeKind::surface ? 1 : 0;
  for (const std::string_view name : names)
  {
    node.name = name;
    scopes.back().nodes.add(name, node);
  }
  put(slot, &node);
  const Frame& around = frames.back();
  const bool inUnknown = around.node && !around.node->type && !around.node->prototype;
  if (!node.type && !node.prototype && !inUnknown)
  {
    diagnostics.warn(textOf(place) + ": unknown node '" + toUtf8(type.text) + "' is skipped");
  }
  frames.push_back({Open::node, {}, &node, nullptr, node.line});
}

/// Returns the known type that an unknown node of VRML 1.0 declares: `fields [ … ] isA [ "Separator" ]`, ahead of
/// everything else.
const NodeType* Parser::declaredBase()
{
  const Lexer start = lexer;
  if (lexer.peek().is("fields") && lexer.peekSecond().kind == TokenKind::openBracket)
  {
    lexer.next();
    skipGroup();
  }
  const NodeType* base = nullptr;
  Value names;
  if (lexer.peek().is("isA"))
  {
    lexer.next();
    readStrings(names, true);
    for (const std::string_view name : std::get<Strings>(names))
    {
      base = base ? base : findNodeType(name, Version::vrml1);
    }
  }
  lexer = start;
  return base;
}

void Parser::readUse(Slot slot)
{
  lexer.next();
  const auto name = lexer.nextName();
  if (!name)
  {
    return expected("a name after USE");
  }
  Node* const found = scopes.back().nodes.find(*name);
  if (!found)
  {
    warn("USE of '" + toUtf8(*name) + "', which no DEF before it defines");
    return put(slot, nullptr);
  }
  found->shared = true;
  put(slot, found);
}

Node* Parser::Names::find(std::string_view name)
{
  for (const auto& [recentName, node] : recent)
  {
    known[recentName] = node;
  }
  recent.clear();
  const auto found = known.find(name);
  return found == known.end() ? nullptr : found->second;
}

void Parser::put(Slot slot, Node* node)
{
  if (slot.node)
  {
    std::get<Nodes>(slot.node->fields[slot.field].value).push_back(node, document.memory);
  }
}

/// Reads a node in the place of a field: children without the word, or a part whose field follows from its type.
void Parser::readNodeWithoutField()
{
  Node& node = *frames.back().node;
  const Token token = lexer.peek();
  if (isVersion1() && (!node.type || node.type->takesChildren()))
  {
    return readNode(slotOf(node, "children"));
  }
  if (node.type && node.type->takesChildren())
  {
    warn("expected a field of " + std::string(node.typeName) + ", found " + tell(token) + "; taken as its child");
    return readNode(slotOf(node, "children"));
  }
  const NodeType* type = findNodeType(token.text, document.version);
  if (node.type && node.type->kind == NodeKind::shape && type)
  {
    warn("expected a field of Shape, found " + tell(token) + "; taken as its " +
         (type->kind == NodeKind::property ? "appearance" : "geometry"));
    return readNode(slotOf(node, type->kind == NodeKind::property ? "appearance" : "geometry"));
  }
  expected("a field or '}'");
  readNode({});
}

void Parser::readField()
{
  Node& node = *frames.back().node;
  if (isVersion1())
  {
    // The text may be `parts(SIDES | TOP)`, though names may hold parentheses.
    const std::string_view text = lexer.peek().text;
    const std::size_t parenthesis = text.find('(');
    if (parenthesis != text.npos && parenthesis > 0 && fieldType(node, text.substr(0, parenthesis)))
    {
      lexer.cutNext(parenthesis);
    }
  }
  const Token token = lexer.peek();
  const auto type = fieldType(node, token.text);
  if (isVersion1() && (token.is("fields") || token.is("isA")))
  {
    lexer.next();
    return lexer.peek().kind == TokenKind::openBracket ? skipGroup() : void(lexer.next());
  }
  if ((isField(token) || isEvent(token)) && !(type && *type != FieldType::unknown))
  {
    return readDeclaration();
  }
  const bool is = lexer.peekSecond().is("IS");
  const bool known = node.prototype || (node.type && node.type->name == node.typeName);
  if (!type && !is && known && !node.damaged)
  {
    const bool adopts = node.type && node.type->takesChildren();
    const Lexer start = lexer; // for the place in the warning
    lexer.next();
    const bool adopted = adopts && holdsNodes();
    lexer = start;
    warn(std::string(node.typeName) + " has no field '" + toUtf8(token.text) + "'" +
         (adopted ? "; the nodes in it are taken as children" : ""));
    lexer.next();
    return adopted ? readNodes(slotOf(node, "children"), true) : readByLook();
  }
  lexer.next();
  if (is)
  {
    lexer.next();
    const Slot slot = slotOf(node, document.keep(token.text));
    node.fields[slot.field].value = Reference{document.keep(lexer.nextName().value_or(""))};
    return;
  }
  if (!type || *type == FieldType::unknown)
  {
    return readByLook();
  }
  const Slot slot = slotOf(node, fieldName(node, token.text));
  readValue(node, slot.field, *type, false);
}

/// Reads `field SFNode name value` in a Script and in unknown node types.
void Parser::readDeclaration()
{
  const Token keyword = lexer.next();
  lexer.nextName();
  lexer.nextName();
  if (lexer.peek().is("IS"))
  {
    lexer.next();
    lexer.nextName();
  }
  else if (isField(keyword))
  {
    readByLook();
  }
}

Parser::Slot Parser::slotOf(Node& node, std::string_view field)
{
  const auto found =
      std::find_if(node.fields.begin(), node.fields.end(), [&](const Field& f) { return isSame(f.name, field); });
  const auto index = static_cast<std::size_t>(found - node.fields.begin());
  if (found == node.fields.end())
  {
    constexpr std::size_t usual = 2; // room for a second field is wasted if the type has one only
    const std::size_t first = node.type && node.type->fields.size() == 1 ? 1 : usual;
    node.fields.reserve(first, document.memory);
    node.fields.push_back({field, {}}, document.memory);
  }
  Value& value = node.fields[index].value;
  if (!std::holds_alternative<Nodes>(value))
  {
    value = Nodes(); // other values replace this when they are read
  }
  return {&node, index};
}

std::optional<FieldType> Parser::fieldType(const Node& node, std::string_view field) const
{
  if (node.prototype)
  {
    const auto found = node.prototype->interface.find(field);
    return found == node.prototype->interface.end() ? std::nullopt : std::optional(found->second);
  }
  if (!node.type)
  {
    return field == "children" ? std::optional(FieldType::mfNode) : std::nullopt;
  }
  return node.type->fieldType(field);
}

/// Returns the name of a field in a copy that stays: that of the type, as files have millions of them.
std::string_view Parser::fieldName(const Node& node, std::string_view field)
{
  if (node.type)
  {
    for (const auto& [known, type] : node.type->fields)
    {
      if (isSame(known, field))
      {
        return known;
      }
    }
  }
  return document.keep(field);
}

const Prototype* Parser::findPrototype(std::string_view name) const
{
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope)
  {
    const auto found = scope->prototypes.find(name);
    if (found != scope->prototypes.end())
    {
      return found->second;
    }
  }
  return nullptr;
}

} // namespace atria::vrml
