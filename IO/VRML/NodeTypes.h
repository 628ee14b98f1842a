// SPDX-License-Identifier: GPL-3.0-or-later
/// The nodes of VRML97 and VRML 1.0 and what they mean to a reader of surfaces.
#pragma once

#include "SceneGraph.h"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace atria::vrml {

enum class NodeKind
{
  group, ///< has children to visit
  shape,
  surface,  ///< geometry that makes triangles
  state,    ///< of VRML 1.0: holds for the nodes that follow
  drawing,  ///< geometry without a surface: lines, points, text
  property, ///< part of a shape: coordinates, appearance, …
  other     ///< sensors, scripts, lights, viewpoints, interpolators, …
};

struct NodeType
{
  std::string_view name;
  NodeKind kind;
  std::vector<std::pair<std::string_view, FieldType>> fields; ///< those that are kept
  std::vector<std::string_view> ignored;                      ///< known but of no use here
  bool anyField = false;                                      ///< fields are not looked at: nothing of it is used

  std::optional<FieldType> fieldType(std::string_view field) const;
  bool takesChildren() const { return kind == NodeKind::group && fieldType("children"); }
};

/// Null for a name the language does not know. All languages but VRML 1.0 are read as VRML97.
const NodeType* findNodeType(std::string_view name, Version version);

/// By its name in a prototype's interface, such as MFVec3f; nothing for a name that is none.
std::optional<FieldType> findFieldType(std::string_view name);

} // namespace atria::vrml
