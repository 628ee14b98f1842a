// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads values of fields, seen through prototypes.
#pragma once

#include "Library.h"
#include "SceneGraph.h"

#include "Support/Types.h"

#include <deque>
#include <span>

namespace atria::vrml {

using scene::Diagnostics;

/// One use of a prototype: IS in the body means the fields of `instance`, whose own values belong to `outer`.
/// The body is not copied, so that a thousand instances cost a thousand of these.
struct Context
{
  const Node* instance = nullptr;
  const Prototype* prototype = nullptr;
  const Context* outer = nullptr;
  int depth = 0;
};

/// A node as met on one path through the scene.
struct NodeRef
{
  const Node* node = nullptr;
  const Context* context = nullptr;

  explicit operator bool() const { return node != nullptr; }
  bool operator==(const NodeRef&) const = default;
};

/// The nodes of one field, as met on one path.
struct NodeRefs
{
  std::span<Node* const> nodes;
  const Context* context = nullptr;

  bool empty() const { return nodes.empty(); }
  /// Returns one of them; none if it does not exist.
  NodeRefs only(int i) const
  {
    const bool exists = i >= 0 && static_cast<std::size_t>(i) < nodes.size();
    return {exists ? nodes.subspan(static_cast<std::size_t>(i), 1) : std::span<Node* const>{}, context};
  }
  /// Removes the first node and returns it.
  NodeRef takeFirst()
  {
    const NodeRef first{nodes.front(), context};
    nodes = nodes.subspan(1);
    return first;
  }
};

class Instances
{
public:
  Instances(Library& files, Diagnostics& messages) : library(files), diagnostics(messages) {}

  /// Steps into a prototype's body and returns its first node. Returns nothing, and warns, if there is none.
  NodeRef enter(const NodeRef& instance);

  /// Returns the node itself, or the node that instances of prototypes stand for in the end. `name` receives the first
  /// DEF name met.
  NodeRef expand(NodeRef ref, std::string_view* name = nullptr);

  /// Returns a field's value of the requested type; null if it is not given, or of another type.
  template <class T> const T* get(const NodeRef& ref, std::string_view field) const
  {
    return std::get_if<T>(find(ref, field).first);
  }
  bool flag(const NodeRef& ref, std::string_view field, bool otherwise) const;
  int integer(const NodeRef& ref, std::string_view field, int otherwise) const;
  double number(const NodeRef& ref, std::string_view field, double otherwise) const;
  std::vector<double> numbers(const NodeRef& ref, std::string_view field, std::vector<double> otherwise) const;
  Vec3 vector(const NodeRef& ref, std::string_view field, const Vec3& otherwise) const;
  NodeRefs nodes(const NodeRef& ref, std::string_view field) const;
  /// Returns the single node of an SFNode; empty for NULL.
  NodeRef node(const NodeRef& ref, std::string_view field) const;

private:
  std::pair<const Value*, const Context*> find(NodeRef ref, std::string_view field) const;
  const Prototype* resolve(const Prototype& prototype, const Node& instance);

  Library& library;
  Diagnostics& diagnostics;
  std::deque<Context> contexts;
};

} // namespace atria::vrml
