// SPDX-License-Identifier: GPL-3.0-or-later
/// Parses VRML text into a scene graph.
#pragma once

#include "Diagnostics.h"
#include "Input.h"
#include "Lexer.h"
#include "SceneGraph.h"

#include "Support/Progress.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace atria::vrml {

using scene::Diagnostics;

/// Reads a text in VRML97, or in VRML 1.0 if the document says so, into `document`. Does not recurse: open brackets and
/// braces are kept on a stack of its own, so that models nested many thousand levels deep are read.
///
/// A syntax error is a warning that gives the place and what was expected. The node it is in is marked damaged, and
/// reading goes on with the next field. Common slips are understood: nodes without the word `children`, a doubled DEF,
/// closing brackets that are missing or too many.
class Parser
{
public:
  Parser(Document& target, FileText file, Diagnostics& messages, const ProgressRange& monitor);
  /// Reads the whole text. Throws Aborted only.
  void run();

private:
  /// The place for a node that has been read: a field of a node, or none.
  struct Slot
  {
    Node* node = nullptr;
    std::size_t field = 0;
  };
  enum class Open
  {
    file,
    list,      ///< nodes between brackets
    node,      ///< fields between braces
    interface, ///< declarations of a prototype
    body       ///< nodes of a prototype
  };
  struct Frame
  {
    Open what;
    Slot slot;                      ///< for file, list and body
    Node* node = nullptr;           ///< for node
    Prototype* prototype = nullptr; ///< for interface and body
    int line = 0;
  };
  /// Nodes by DEF name, sorted when the first of them is requested: most files define far more than they use.
  class Names
  {
  public:
    void add(std::string_view name, Node& node) { recent.emplace_back(name, &node); }
    /// Returns the node defined last; null if there is none.
    Node* find(std::string_view name);

  private:
    std::vector<std::pair<std::string_view, Node*>> recent;
    std::unordered_map<std::string_view, Node*> known;
  };
  struct Scope
  {
    Names nodes;
    std::unordered_map<std::string_view, const Prototype*> prototypes;
  };

  // Steps, one for each kind of open construct. Each step reads something or closes a frame.
  void step();
  void stepList();
  void stepNode();
  void stepInterface(); // in ParserStatements.cxx
  void closeList();

  // Nodes and their fields
  bool startsNode();
  void readNode(Slot slot);
  void readNames(std::vector<std::string_view>& names);
  void openNode(Slot slot, const std::vector<std::string_view>& names);
  void readUse(Slot slot);
  void put(Slot slot, Node* node);
  void readNodeWithoutField();
  void readField();
  void readDeclaration();
  const NodeType* declaredBase();
  bool isVersion1() const { return document.version == Version::vrml1; }

  // Statements, in ParserStatements.cxx
  bool readStatement();
  bool readStatementOfX3D();
  void readRoute();
  void readPrototype(bool external);
  void openBody(Prototype& prototype);
  void closeBody();

  // Values, in ParserValues.cxx
  void readValue(Node& owner, std::size_t field, FieldType type, bool inInterface);
  void readNodes(Slot slot, bool many);
  bool readScalars(Value& value, FieldType type);
  bool readBool(Value& value);
  template <class T, class Read>
  void readList(Value& value, std::size_t characters, std::vector<T>& scratch, const Read& readOne);
  bool readIntegers(Value& value, bool many);
  bool readNumbers(Value& value, std::size_t arity, bool many, bool gaps = false);
  bool openNeedlessBracket();
  bool endsList();
  bool readStrings(Value& value, bool many);
  bool readWords(Value& value);
  bool holdsNodes();
  void readByLook();
  void skipGroup();
  void resume(const Node* owner, bool inBrackets);

  // Messages
  void expected(std::string_view what, const std::string& consequence = {});
  void warn(const std::string& text);
  void unexpectedEnd();
  std::string textOf(const Place& place) const;
  std::string tell(const Token& token) const;
  void tick();
  void forget();

  Slot slotOf(Node& node, std::string_view field);
  std::optional<FieldType> fieldType(const Node& node, std::string_view field) const;
  std::string_view fieldName(const Node& node, std::string_view field);
  const Prototype* findPrototype(std::string_view name) const;
  /// True for declarations of fields and events, in the words of VRML97 or of X3D.
  static bool isField(const Token& token)
  {
    return token.is("field") || token.is("exposedField") || token.is("initializeOnly") || token.is("inputOutput");
  }
  static bool isEvent(const Token& token)
  {
    return token.is("eventIn") || token.is("eventOut") || token.is("inputOnly") || token.is("outputOnly");
  }

  Document& document;
  FileText source; ///< its memory is freed as it is read
  Lexer lexer;
  std::size_t length;
  Diagnostics& diagnostics;
  ProgressRange progress;
  std::size_t reported = 0;
  std::size_t forgotten = 0;
  bool quiet = false; ///< set after an error, until a node was recognized: one slip is one warning
  std::vector<Frame> frames;
  std::vector<Scope> scopes;
  // Lists being read.
  std::vector<int> integers;
  std::vector<double> numbers;
};

} // namespace atria::vrml
