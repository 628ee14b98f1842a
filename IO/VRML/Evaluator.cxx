// SPDX-License-Identifier: GPL-3.0-or-later
#include "Evaluator.h"

#include "Input.h"
#include "NodeTypes.h"
#include "Sweeps.h"

#include "Support/Error.h"

#include <limits>

namespace atria::vrml {

namespace {

/// A few USEs of USEs can stand for more nodes than any machine has memory for.
constexpr std::size_t mostVisits = 5'000'000;
constexpr std::size_t visitsBetweenReports = 1024;

Vec3 vectorOr(const std::vector<double>& v, const Vec3& otherwise)
{
  return v.size() < 3 ? otherwise : Vec3(v[0], v[1], v[2]);
}

} // namespace

Evaluator::Evaluator(Library& files, Diagnostics& messages, const ProgressRange& monitor, double tessellationDegrees)
    : library(files), diagnostics(messages), progress(monitor), instances(files, messages),
      geometries(instances, messages, tessellationDegrees)
{
}

Model Evaluator::run(const Document& document)
{
  path.insert({document.root, nullptr});
  pushChildren({{}, Transform::Identity(), {}}, instances.nodes({document.root, nullptr}, "children"));
  for (std::size_t count = 0; !open.empty(); ++count)
  {
    if (count % visitsBetweenReports == 0)
    {
      progress.report(0.0, "Evaluating the scene");
    }
    if (count > mostVisits)
    {
      throw Error("the scene repeats its nodes more than " + std::to_string(mostVisits) +
                  " times; nodes probably USE each other without end");
    }
    const Visit at = open.back();
    open.pop_back();
    if (at.leave)
    {
      path.erase({at.ref.node, at.ref.context});
    }
    else if (enter(at))
    {
      visit(at);
    }
  }
  if (library.routes() > 0)
  {
    model.skipped["ROUTE"] = library.routes();
  }
  return std::move(model);
}

/// False for nodes to leave out: none, damaged ones, and ones that contain themselves.
bool Evaluator::enter(const Visit& at)
{
  const Node* node = at.ref.node;
  if (!node || node->damaged)
  {
    return false;
  }
  if (!node->shared)
  {
    return true;
  }
  if (!path.insert({node, at.ref.context}).second)
  {
    warn(*node, "contains itself; skipped");
    return false;
  }
  open.push_back({at.ref, at.transform, {}, true});
  return true;
}

void Evaluator::visit(const Visit& at)
{
  const Node& node = *at.ref.node;
  if (node.prototype)
  {
    const std::string_view name = node.name.empty() ? at.name : node.name;
    open.push_back({instances.enter(at.ref), at.transform, name});
    return;
  }
  if (!node.type)
  {
    ++model.skipped[toUtf8(node.typeName)];
    return;
  }
  switch (node.type->kind)
  {
    case NodeKind::group:
      return visitGroup(at);
    case NodeKind::shape:
      return addShape(at);
    case NodeKind::surface:
      warn(node, "stands outside of a Shape; taken as one");
      return addGeometry(at, at.ref, node.name.empty() ? at.name : node.name, {});
    case NodeKind::drawing:
    case NodeKind::other:
      ++model.skipped[std::string(node.typeName)];
      return;
    case NodeKind::property:
      return;
  }
}

void Evaluator::visitGroup(const Visit& at)
{
  const std::string_view type = at.ref.node->type->name;
  Visit inner = at;
  inner.name = at.ref.node->name.empty() ? at.name : at.ref.node->name;
  if (type == "Inline")
  {
    return visitInline(inner);
  }
  const bool choice = type == "Switch";
  const bool levels = type == "LOD";
  std::vector<NodeRef> children = instances.nodes(at.ref, choice ? "choice" : levels ? "level" : "children");
  if ((choice || levels) && children.empty())
  {
    children = instances.nodes(at.ref, "children"); // as in X3D
  }
  if (choice || levels)
  {
    const int chosen = choice ? instances.integer(at.ref, "whichChoice", -1) : 0;
    const bool exists = chosen >= 0 && static_cast<std::size_t>(chosen) < children.size();
    children = exists ? std::vector<NodeRef>{children[static_cast<std::size_t>(chosen)]} : std::vector<NodeRef>{};
  }
  if (type == "Transform")
  {
    inner.transform = at.transform * transformOf(at.ref);
  }
  pushChildren(inner, children);
}

void Evaluator::visitInline(const Visit& at)
{
  const auto* urls = instances.get<std::vector<std::string>>(at.ref, "url");
  const Node& node = *at.ref.node;
  const Document* document =
      library.openBeside(*node.document, urls ? *urls : std::vector<std::string>{}, node.line, "Inline");
  if (!document)
  {
    return;
  }
  if (!path.insert({document->root, nullptr}).second)
  {
    warn(node, "the file contains itself; skipped");
    return;
  }
  open.push_back({{document->root, nullptr}, at.transform, {}, true});
  pushChildren(at, instances.nodes({document->root, nullptr}, "children"));
}

/// In reverse, so that they are visited in the order of the file.
void Evaluator::pushChildren(const Visit& at, const std::vector<NodeRef>& children)
{
  for (auto child = children.rbegin(); child != children.rend(); ++child)
  {
    open.push_back({*child, at.transform, at.name});
  }
}

/// T C R SR S -SR -C, whatever the order of the fields.
Evaluator::Transform Evaluator::transformOf(const NodeRef& ref) const
{
  const Vec3 center = vectorOr(instances.numbers(ref, "center", {}), Vec3::Zero());
  const Vec3 translation = vectorOr(instances.numbers(ref, "translation", {}), Vec3::Zero());
  const Vec3 scale = vectorOr(instances.numbers(ref, "scale", {}), Vec3::Ones());
  const auto rotation = [&](std::string_view field) {
    const std::vector<double> r = instances.numbers(ref, field, {});
    return r.size() < 4 ? Eigen::Quaterniond::Identity() : rotationOf(r.data());
  };
  const Eigen::Quaterniond turn = rotation("rotation");
  const Eigen::Quaterniond axes = rotation("scaleOrientation");
  Transform result = Transform::Identity();
  result.translate(translation).translate(center).rotate(turn).rotate(axes);
  result.scale(scale).rotate(axes.conjugate()).translate(-center);
  return result;
}

void Evaluator::addShape(const Visit& at)
{
  const Node& shape = *at.ref.node;
  std::string_view geometryName;
  std::string_view materialName;
  const NodeRef geometry = instances.expand(instances.node(at.ref, "geometry"), &geometryName);
  if (!geometry || geometry.node->damaged)
  {
    return;
  }
  const NodeRef appearance = instances.expand(instances.node(at.ref, "appearance"), &materialName);
  if (appearance)
  {
    std::string_view own;
    instances.expand(instances.node(appearance, "material"), &own);
    materialName = own.empty() ? materialName : own;
  }
  if (!geometry.node->type || geometry.node->type->kind != NodeKind::surface)
  {
    ++model.skipped[toUtf8(geometry.node->typeName)];
    return;
  }
  std::string_view name = !shape.name.empty() ? shape.name : geometryName;
  name = name.empty() ? at.name : name;
  addGeometry(at, geometry, name, toUtf8(materialName));
}

/// Geometry without context is the same wherever it is used.
const LocalSurface& Evaluator::localSurface(const NodeRef& geometry)
{
  if (!geometry.node->shared || geometry.context)
  {
    current = geometries.make(geometry);
    return current;
  }
  const auto found = cache.find(geometry.node);
  return found != cache.end() ? found->second : cache.emplace(geometry.node, geometries.make(geometry)).first->second;
}

void Evaluator::addGeometry(const Visit& at, const NodeRef& geometry, std::string_view name,
                            const std::string& material)
{
  const LocalSurface& local = localSurface(geometry);
  if (local.triangles.empty())
  {
    ++model.skipped[toUtf8(geometry.node->typeName) + " without faces"];
    return;
  }
  const std::size_t first = model.points.size();
  if (first + local.points.size() >= noIndex)
  {
    throw Error("the model has more points than can be numbered");
  }
  for (const Vec3& p : local.points)
  {
    const Vec3 moved = at.transform * p;
    if (!moved.allFinite())
    {
      model.points.resize(first);
      warn(*geometry.node, "its coordinates grow beyond all numbers; skipped");
      return;
    }
    model.points.push_back(moved);
  }
  const bool mirrored = at.transform.linear().determinant() < 0.0;
  const auto id = static_cast<Index>(model.surfaceNames.size());
  const auto base = static_cast<Index>(first);
  for (const auto& [a, b, c] : local.triangles)
  {
    model.triangles.push_back({base + a, base + (mirrored ? c : b), base + (mirrored ? b : c)});
    model.surfaceIds.push_back(id);
  }
  model.surfaceNames.push_back(uniqueName(!name.empty() ? toUtf8(name) : !material.empty() ? material : "Shape"));
  model.materialNames.push_back(material);
}

/// `Name`, then `Name_2`, `Name_3`, …, passing over names the file itself has given to something before.
std::string Evaluator::uniqueName(const std::string& wanted)
{
  if (names.try_emplace(wanted, 1).second)
  {
    return wanted;
  }
  for (;;)
  {
    const std::string numbered = wanted + "_" + std::to_string(++names[wanted]);
    if (names.try_emplace(numbered, 1).second)
    {
      return numbered;
    }
  }
}

void Evaluator::warn(const Node& node, const std::string& text)
{
  diagnostics.warn(node.document->displayName() + ":" + std::to_string(node.line) + ": " + toUtf8(node.typeName) +
                   (node.name.empty() ? "" : " '" + toUtf8(node.name) + "'") + ": " + text);
}

} // namespace atria::vrml
