// SPDX-License-Identifier: GPL-3.0-or-later
/// The evaluator's part for VRML 1.0, whose nodes change a state for the nodes that follow.
#include "Evaluator.h"
#include "Input.h"
#include "NodeTypes.h"
#include "Sweeps.h"

#include <algorithm>

namespace atria::vrml {

void Evaluator::visitGroup1(const Visit& at)
{
  const std::string_view type = at.ref.node->type->name;
  Visit inner = at;
  inner.transform = states.back().transform;
  if (type == "WWWInline")
  {
    return visitInline(inner, "name");
  }
  inner.group = groupOf(at);
  NodeRefs children = instances.nodes(at.ref, "children");
  if (type == "Separator" || type == "WWWAnchor")
  {
    states.push_back(State(states.back()));
    open.push_back({at.ref, inner.transform, noIndex, Task::restoreState});
  }
  else if (type == "TransformSeparator")
  {
    open.push_back({at.ref, inner.transform, noIndex, Task::restoreTransform});
  }
  else if (type == "Switch" || type == "LOD")
  {
    constexpr int all = -3;
    const int chosen = type == "LOD" ? 0 : instances.integer(at.ref, "whichChild", -1);
    if (chosen != all)
    {
      children = children.only(chosen);
    }
  }
  pushChildren(inner, children);
}

void Evaluator::changeState(const NodeRef& ref)
{
  State& state = states.back();
  const std::string_view type = ref.node->type->name;
  if (type == "Coordinate3")
  {
    state.coordinates = ref.node;
  }
  else if (type == "Material")
  {
    state.material = ref.node;
  }
  else if (type == "ShapeHints")
  {
    const auto* order = instances.get<Strings>(ref, "vertexOrdering");
    state.clockwise = order && !order->empty() && order->front() == "CLOCKWISE";
  }
  else if (type == "MatrixTransform")
  {
    // The matrix is written for row vectors: the last row is the translation.
    const std::vector<double> m = instances.numbers(ref, "matrix", {});
    if (m.size() == 16)
    {
      Transform own = Transform::Identity();
      own.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(m.data()).topRows<3>();
      state.transform = state.transform * own;
    }
  }
  else if (type == "RotationXYZ")
  {
    const auto* axis = instances.get<Strings>(ref, "axis");
    const std::string_view letter = axis && !axis->empty() ? axis->front() : "X";
    const Vec3 direction = Vec3::Unit(letter == "Z" ? 2 : letter == "Y" ? 1 : 0);
    state.transform.rotate(Eigen::AngleAxisd(instances.number(ref, "angle", 0.0), direction));
  }
  else
  {
    state.transform = state.transform * transformOf(ref, "scaleFactor"); // all others have some of its fields
  }
}

void Evaluator::addGeometry1(const Visit& at)
{
  const State& state = states.back();
  Geometry::State local;
  if (state.coordinates)
  {
    local.points = instances.get<Numbers>({state.coordinates, nullptr}, "point");
  }
  local.clockwise = state.clockwise;
  const Index material = state.material ? materialOf({state.material, nullptr}, state.material->name) : noIndex;
  setStretch(at.ref, state.transform);
  geometries.setName(at.ref.node->name.empty() ? scene.groupName(at.group) : at.ref.node->name);
  geometries.recycle(std::move(current));
  current = Geometry::isRound(at.ref) ? geometries.makeCoarse(at.ref) : geometries.make(at.ref, local);
  add(at.ref, current, state.transform, {toUtf8(at.ref.node->name), at.group, material});
}

} // namespace atria::vrml
