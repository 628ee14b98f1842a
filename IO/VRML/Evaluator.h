// SPDX-License-Identifier: GPL-3.0-or-later
/// Evaluates a VRML scene graph into triangles, shapes, groups and materials.
#pragma once

#include "Geometry.h"
#include "Instances.h"
#include "Library.h"
#include "SceneBuilder.h"

#include <Eigen/Geometry>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace atria::vrml {

using scene::Diagnostics;
using scene::Scene;
using scene::Shape;

/// Walks through a scene and collects its shapes: one for each Shape met, or for each geometry node of VRML 1.0. Files
/// of both languages may contain each other. Does not recurse.
class Evaluator
{
public:
  Evaluator(Library& files, Diagnostics& messages, const ProgressRange& monitor, const Tessellation& tessellation);

  /// Returns the scene. Throws Error if nodes multiply without end, Aborted if the caller stops it.
  Scene run(const Document& document);

private:
  using Transform = Eigen::Affine3d;
  /// The action for a node on the stack.
  enum class Task
  {
    visit,
    visitEach,        ///< visits the nodes of a list, one after the other
    leave,            ///< the end of a visit: the node is no longer on the path
    restoreState,     ///< the end of a Separator of VRML 1.0
    restoreTransform, ///< the end of a TransformSeparator of VRML 1.0
  };
  struct Visit
  {
    NodeRef ref;
    Transform transform; ///< used for VRML97; to restore after a TransformSeparator
    Index group;         ///< the innermost one around
    Task task = Task::visit;
    NodeRefs list{}; ///< nodes for visitEach
  };
  /// State that nodes of VRML 1.0 set for the nodes that follow.
  struct State
  {
    Transform transform;
    const Node* coordinates = nullptr;
    const Node* material = nullptr;
    bool clockwise = false;
  };

  Visit next();
  void perform(const Visit& at);
  bool enter(const Visit& at);
  void visit(const Visit& at);
  void visitGroup(const Visit& at);
  void visitInline(const Visit& at, const char* field);
  void visitInstance(const Visit& at);
  void visitUnknown(const Visit& at);
  void openDocument(const Document& document, const Transform& transform, Index group);
  void pushChildren(const Visit& at, const NodeRefs& children);
  Index groupOf(const Visit& at);
  Transform transformOf(const NodeRef& ref, std::string_view scaleField) const;
  void addShape(const Visit& at);
  void addGeometry(const Visit& at, const NodeRef& geometry, std::string_view name, Index material);
  void add(const NodeRef& geometry, const LocalSurface& surface, const Transform& transform, const Shape& shape);
  Index materialOf(const NodeRef& appearance);
  Index materialOf(const NodeRef& node, std::string_view name);
  const LocalSurface& localSurface(const NodeRef& geometry, const Transform& transform);
  void setStretch(const NodeRef& geometry, const Transform& transform);
  void makeRoundSolids();
  void warn(const Node& node, const std::string& text);

  // VRML 1.0, in StateNodes.cxx
  void visitGroup1(const Visit& at);
  void changeState(const NodeRef& ref);
  void addGeometry1(const Visit& at);

  Library& library;
  Diagnostics& diagnostics;
  ProgressRange progress;
  Instances instances;
  Geometry geometries;
  std::vector<Visit> open;
  std::vector<State> states;
  std::set<std::pair<const Node*, const Context*>> path; ///< shared nodes and files being visited, against cycles
  /// Geometry used more than once, keyed by node and, for round solids, stretch.
  std::map<std::pair<const Node*, double>, LocalSurface> cache;
  double stretch = 1.0;
  /// A round solid as it was met. Its facets are made when the size of the whole model is known.
  struct RoundSolid
  {
    NodeRef geometry;
    Transform transform;
    Index shape;
  };
  std::vector<RoundSolid> roundSolids;
  std::vector<SceneBuilder::Addition> coarseSolids; ///< placeholders of the round solids
  bool isCoarse = true;
  LocalSurface current;
  SceneBuilder scene;
};

} // namespace atria::vrml
