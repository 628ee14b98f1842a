// SPDX-License-Identifier: GPL-3.0-or-later
/// The content of a VRML file, as read: nodes with their fields, and prototypes, nothing evaluated.
#pragma once

#include "List.h"

#include "Support/Memory.h"
#include "Support/Utf8.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory_resource>
#include <new>
#include <string>
#include <string_view>
#include <variant>

namespace atria::vrml {

struct Document;
struct Node;
struct NodeType;
struct Prototype;

/// A field's value; numbers of every kind of vector, color or rotation are one flat list. A single node is a
/// list of one. `monostate` stands for a field that was not given or not kept.
using Integers = List<int>;
using Numbers = List<double>;
using Strings = List<std::string_view>;
using Nodes = List<Node*>;
/// IS: the field of the surrounding prototype's interface that gives the value.
struct Reference
{
  std::string_view field;
};
using Value = std::variant<std::monostate, bool, Integers, Numbers, Strings, Nodes, Reference>;

enum class FieldType
{
  unknown, ///< read by the look of its value and not kept, except for nodes
  sfBool,
  sfInt32,
  sfFloat,
  sfVec2f,
  sfVec3f,
  sfRotation,
  sfMatrix,
  sfString,
  sfWord, ///< type of VRML 1.0: an enumeration's value, or several of them as (A | B)
  sfNode,
  mfInt32,
  mfFloat,
  mfVec2f,
  mfVec3f,
  mfPoint, ///< as mfVec3f, but invalid numbers are kept as such: they cost the faces around one point
  mfRotation,
  mfString,
  mfNode
};

/// True if two names are the same. Most different names differ in length or in the first letter.
inline bool isSame(std::string_view a, std::string_view b)
{
  return a.size() == b.size() && (a.empty() || (a[0] == b[0] && a == b));
}

struct Field
{
  std::string_view name;
  Value value;
};

struct Node
{
  std::string_view typeName;
  const NodeType* type = nullptr;       ///< null for unknown types
  const Prototype* prototype = nullptr; ///< set where the node is an instance of one
  std::string_view name;                ///< DEF name; empty without one
  const Document* document = nullptr;
  int line = 0;
  std::uint32_t column : 30 = 0;
  bool damaged : 1 = false; ///< a syntax error cost part of it
  bool shared : 1 = false;  ///< mentioned by some USE
  List<Field> fields;

  const Field* find(std::string_view field) const
  {
    for (const Field& f : fields)
    {
      if (isSame(f.name, field))
      {
        return &f;
      }
    }
    return nullptr;
  }
};

/// PROTO or EXTERNPROTO.
struct Prototype
{
  std::string_view name;
  std::map<std::string_view, FieldType> interface;
  Node* defaults = nullptr; ///< its fields are the interface's defaults
  Node* body = nullptr;     ///< its only field lists the nodes of the body; the first one is drawn
  bool external = false;
  Strings urls;                       ///< for an EXTERNPROTO
  const NodeType* standard = nullptr; ///< for an EXTERNPROTO whose URL names a node of the standard
  const Document* document = nullptr;
};

enum class Version
{
  vrml97,
  vrml1,
  x3d,
  missing
};

/// One file. Nodes refer to its texts and to each other, so it stays where it is.
struct Document
{
  explicit Document(std::filesystem::path path) : file(std::move(path)) {}
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  std::filesystem::path file;
  LargePages pages;
  /// Memory for nodes, fields, lists and texts: files have millions of them, which are freed all at once.
  std::pmr::monotonic_buffer_resource memory{&pages};
  Version version = Version::vrml97;
  Node* root = nullptr; ///< its only field lists the file's nodes
  std::deque<Prototype> prototypes;
  std::size_t routes = 0;
  std::size_t points = 0;   ///< in all coordinates
  std::size_t indices = 0;  ///< in all lists of them
  std::size_t names = 0;    ///< names of nodes
  std::size_t surfaces = 0; ///< nodes that make surfaces
  std::string head;         ///< the first characters of the file, where programs name themselves

  /// Adds a node. It is never destroyed, as all that nodes hold is in `memory`.
  Node& addNode()
  {
    Node* const node = new (memory.allocate(sizeof(Node), alignof(Node))) Node;
    node->document = this;
    return *node;
  }
  /// Returns a copy that lives as long as the document.
  std::string_view keep(std::string_view text)
  {
    char* const copy = static_cast<char*>(memory.allocate(text.size(), 1));
    std::copy(text.begin(), text.end(), copy);
    return {copy, text.size()};
  }
  std::string displayName() const { return file.filename().string(); }
};

/// Returns file, line, column, type and name of a node, for messages. `name` is used for a node without a name of its
/// own.
inline std::string placeOf(const Node& node, std::string_view name = {})
{
  const std::string_view shown = node.name.empty() ? name : node.name;
  std::string text = node.document->displayName() + ":" + std::to_string(node.line) + ":" +
                     std::to_string(node.column) + ": " + toUtf8(node.typeName);
  return shown.empty() ? text : text + " '" + toUtf8(shown) + "'";
}

} // namespace atria::vrml
