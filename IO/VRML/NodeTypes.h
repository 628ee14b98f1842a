// SPDX-License-Identifier: GPL-3.0-or-later
/// The nodes of VRML97 and VRML 1.0 and their meaning for a reader of surfaces.
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
  state,    ///< node of VRML 1.0 that affects the nodes that follow
  drawing,  ///< geometry without a surface: lines, points, text
  property, ///< part of a shape: coordinates, appearance, …
  other     ///< sensors, scripts, lights, viewpoints, interpolators, …
};

struct NodeType
{
  std::string_view name;
  NodeKind kind;
  std::vector<std::pair<std::string_view, FieldType>> fields; ///< fields that are kept
  std::vector<std::string_view> ignored;                      ///< known but of no use here
  bool anyField = false;                                      ///< fields are not checked, since none is used

  std::optional<FieldType> fieldType(std::string_view field) const;
  bool takesChildren() const { return kind == NodeKind::group && fieldType("children"); }
};

/// Returns null for a name the language does not know. All languages but VRML 1.0 are read as VRML97.
const NodeType* findNodeType(std::string_view name, Version version);

/// Returns the type of a name in a prototype's interface, such as MFVec3f; nothing for a name that is none.
std::optional<FieldType> findFieldType(std::string_view name);

} // namespace atria::vrml
