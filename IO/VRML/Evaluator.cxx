// SPDX-License-Identifier: GPL-3.0-or-later
#include "Evaluator.h"

#include "Input.h"
#include "NodeTypes.h"
#include "Sweeps.h"

#include "Support/Error.h"

namespace atria::vrml {

using scene::Diagnostics;
using scene::Material;
using scene::Scene;
using scene::Shape;

namespace {

/// A few USEs of USEs can stand for more nodes than any machine has memory for.
constexpr std::size_t mostVisits = 5'000'000;
constexpr std::size_t visitsBetweenReports = 1024;
/// Round solids with a smaller radius, as a share of the model's diagonal, have facets that are off by no less than
/// those of a solid with this radius.
constexpr double smallRadius = 0.01;

} // namespace

Evaluator::Evaluator(Library& files, Diagnostics& messages, const ProgressRange& monitor,
                     const Tessellation& tessellation)
    : library(files), diagnostics(messages), progress(monitor), instances(files, messages),
      geometries(instances, messages, tessellation)
{
}

Scene Evaluator::run(const Document& document)
{
  scene.reserve(document);
  openDocument(document, Transform::Identity(), noIndex);
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
    perform(next());
  }
  makeRoundSolids();
  if (library.routes() > 0)
  {
    scene.skip("ROUTE", library.routes());
  }
  return scene.take();
}

/// Takes the next task off the stack, or off the list on top of it.
Evaluator::Visit Evaluator::next()
{
  Visit& top = open.back();
  if (top.task != Task::visitEach)
  {
    Visit at = top;
    open.pop_back();
    return at;
  }
  Visit at{top.list.takeFirst(), top.transform, top.group};
  if (top.list.empty())
  {
    open.pop_back();
  }
  return at;
}

void Evaluator::perform(const Visit& at)
{
  switch (at.task)
  {
    case Task::visitEach:
      return; // next() has made visits of it
    case Task::leave:
      path.erase({at.ref.node, at.ref.context});
      return;
    case Task::restoreState:
      states.pop_back();
      return;
    case Task::restoreTransform:
      states.back().transform = at.transform;
      return;
    case Task::visit:
      if (enter(at))
      {
        visit(at);
      }
      return;
  }
}

/// Returns false for nodes to leave out: none, damaged ones, and ones that contain themselves.
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
  open.push_back({at.ref, Transform::Identity(), noIndex, Task::leave});
  return true;
}

void Evaluator::visit(const Visit& at)
{
  const Node& node = *at.ref.node;
  const bool isVersion1 = node.document->version == Version::vrml1;
  if (node.prototype)
  {
    return visitInstance(at);
  }
  if (!node.type)
  {
    return visitUnknown(at);
  }
  switch (node.type->kind)
  {
    case NodeKind::group:
      return isVersion1 ? visitGroup1(at) : visitGroup(at);
    case NodeKind::shape:
      return addShape(at);
    case NodeKind::surface:
      if (isVersion1)
      {
        return addGeometry1(at);
      }
      warn(node, "stands outside of a Shape; taken as one");
      return addGeometry(at, at.ref, node.name, noIndex);
    case NodeKind::state:
      return changeState(at.ref);
    case NodeKind::drawing:
    case NodeKind::other:
      return scene.skip(std::string(node.type->name));
    case NodeKind::property:
      return;
  }
}

/// Returns the group of the nodes inside a node.
Index Evaluator::groupOf(const Visit& at)
{
  const std::string_view name = at.ref.node->name;
  return name.empty() ? at.group : scene.group(name, at.group);
}

void Evaluator::visitInstance(const Visit& at)
{
  const auto isVersion1 = [](const NodeRef& ref) { return ref.node->document->version == Version::vrml1; };
  Visit inner{at.ref, isVersion1(at.ref) ? states.back().transform : at.transform, groupOf(at)};
  const NodeRef body = instances.enter(at.ref);
  const NodeRefs children = body ? NodeRefs{} : instances.nodes(at.ref, "children");
  if (!children.empty())
  {
    // The node is most likely from an EXTERNPROTO whose file is missing.
    warn(*at.ref.node, "has no prototype, but its children are read as those of a Transform");
    inner.transform = inner.transform * transformOf(at.ref, "scale");
    return pushChildren(inner, children);
  }
  if (body && isVersion1(body) && !isVersion1(at.ref))
  {
    states.push_back({inner.transform});
    open.push_back({at.ref, inner.transform, noIndex, Task::restoreState});
  }
  open.push_back({body, inner.transform, inner.group});
}

void Evaluator::visitUnknown(const Visit& at)
{
  const Node& node = *at.ref.node;
  const NodeRefs children = instances.nodes(at.ref, "children");
  if (children.empty())
  {
    return scene.skip(toUtf8(node.typeName));
  }
  warn(node, "is unknown, but its children are read as those of a Group");
  pushChildren({at.ref, at.transform, groupOf(at)}, children);
}

void Evaluator::visitGroup(const Visit& at)
{
  const std::string_view type = at.ref.node->type->name;
  if (type == "Inline" || type == "InlineLoadControl")
  {
    return visitInline(at, "url");
  }
  Visit inner = at;
  inner.group = groupOf(at);
  const bool choice = type == "Switch";
  const bool levels = type == "LOD";
  NodeRefs children = instances.nodes(at.ref, choice ? "choice" : levels ? "level" : "children");
  if ((choice || levels) && children.empty())
  {
    children = instances.nodes(at.ref, "children"); // as in X3D
  }
  if (choice || levels)
  {
    children = children.only(choice ? instances.integer(at.ref, "whichChoice", -1) : 0);
  }
  if (type == "Transform")
  {
    inner.transform = at.transform * transformOf(at.ref, "scale");
  }
  pushChildren(inner, children);
}

void Evaluator::visitInline(const Visit& at, const char* field)
{
  const auto* urls = instances.get<Strings>(at.ref, field);
  const Node& node = *at.ref.node;
  const Document* document = library.openBeside(*node.document, urls ? *urls : Strings{}, node);
  if (!document)
  {
    return;
  }
  if (path.count({document->root, nullptr}) != 0)
  {
    warn(node, "the file contains itself; skipped");
    return;
  }
  // Without a name of its own the node goes by that of the file.
  const std::string name = node.name.empty() ? document->file.stem().string() : std::string(node.name);
  openDocument(*document, at.transform, scene.group(name, at.group));
}

/// Visits a file's nodes. A file of VRML 1.0 begins with a state of its own.
void Evaluator::openDocument(const Document& document, const Transform& transform, Index group)
{
  const Visit root{{document.root, nullptr}, transform, group};
  path.insert({document.root, nullptr});
  open.push_back({root.ref, transform, group, Task::leave});
  if (document.version == Version::vrml1)
  {
    states.push_back({transform});
    open.push_back({root.ref, transform, group, Task::restoreState});
  }
  pushChildren(root, instances.nodes(root.ref, "children"));
}

void Evaluator::pushChildren(const Visit& at, const NodeRefs& children)
{
  if (!children.empty())
  {
    open.push_back({at.ref, at.transform, at.group, Task::visitEach, children});
  }
}

/// Returns T C R SR S -SR -C, whatever the order of the fields.
Evaluator::Transform Evaluator::transformOf(const NodeRef& ref, std::string_view scaleField) const
{
  const Vec3 center = instances.vector(ref, "center", Vec3::Zero());
  const Vec3 translation = instances.vector(ref, "translation", Vec3::Zero());
  const Vec3 scale = instances.vector(ref, scaleField, Vec3::Ones());
  const auto rotation = [&](std::string_view field) {
    const auto* r = instances.get<Numbers>(ref, field);
    return !r || r->size() < 4 ? Eigen::Quaterniond::Identity() : rotationOf(r->data());
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
  const NodeRef geometry = instances.expand(instances.node(at.ref, "geometry"), &geometryName);
  if (!geometry || geometry.node->damaged)
  {
    return;
  }
  if (!geometry.node->type || geometry.node->type->kind != NodeKind::surface)
  {
    return scene.skip(toUtf8(geometry.node->typeName));
  }
  addGeometry(at, geometry, !shape.name.empty() ? shape.name : geometryName,
              materialOf(instances.node(at.ref, "appearance")));
}

Index Evaluator::materialOf(const NodeRef& ref)
{
  std::string_view name;
  const NodeRef appearance = instances.expand(ref, &name);
  if (!appearance)
  {
    return noIndex;
  }
  std::string_view own;
  const NodeRef node = instances.expand(instances.node(appearance, "material"), &own);
  name = own.empty() ? name : own;
  return node || !name.empty() ? materialOf(node, name) : noIndex;
}

/// Returns the material of a Material node of either language, or the default one without a node.
Index Evaluator::materialOf(const NodeRef& node, std::string_view name)
{
  Material material;
  material.name = toUtf8(name);
  if (node)
  {
    material.diffuse = instances.vector(node, "diffuseColor", material.diffuse);
    material.transparency = instances.number(node, "transparency", material.transparency);
  }
  return scene.material(material);
}

/// Sets the factor by which the transform stretches the next surface, for round solids.
void Evaluator::setStretch(const NodeRef& geometry, const Transform& transform)
{
  stretch = 1.0;
  if (Geometry::isRound(geometry))
  {
    const double longest = transform.linear().jacobiSvd().singularValues().x();
    stretch = std::isfinite(longest) && longest > 0.0 ? longest : 1.0;
  }
  geometries.setStretch(stretch);
}

/// Returns the surface of a geometry. Geometry without context is the same wherever it is used, except for its facets.
const LocalSurface& Evaluator::localSurface(const NodeRef& geometry, const Transform& transform)
{
  setStretch(geometry, transform);
  const auto make = [&] {
    return isCoarse && Geometry::isRound(geometry) ? geometries.makeCoarse(geometry) : geometries.make(geometry);
  };
  if (!geometry.node->shared || geometry.context)
  {
    geometries.recycle(std::move(current));
    current = make();
    return current;
  }
  const std::pair key(geometry.node, stretch);
  const auto found = cache.find(key);
  return found != cache.end() ? found->second : cache.emplace(key, make()).first->second;
}

/// Replaces the coarse solids by round ones.
void Evaluator::makeRoundSolids()
{
  if (roundSolids.empty())
  {
    return;
  }
  isCoarse = false;
  cache.clear();
  geometries.setSmall(smallRadius * scene.bounds().size().norm());
  scene.replace(coarseSolids, [&](std::size_t i) {
    const RoundSolid& solid = roundSolids[i];
    scene.addTriangles(localSurface(solid.geometry, solid.transform), solid.transform, solid.shape);
  });
}

void Evaluator::addGeometry(const Visit& at, const NodeRef& geometry, std::string_view name, Index material)
{
  geometries.setName(name.empty() ? scene.groupName(at.group) : name);
  add(geometry, localSurface(geometry, at.transform), at.transform, {toUtf8(name), at.group, material});
}

void Evaluator::add(const NodeRef& geometry, const LocalSurface& surface, const Transform& transform,
                    const Shape& shape)
{
  if (surface.triangles.empty())
  {
    return scene.skip(toUtf8(geometry.node->typeName) + " without faces");
  }
  if (!scene.add(surface, transform, shape))
  {
    warn(*geometry.node, "its coordinates grow beyond all numbers; skipped");
  }
  else if (Geometry::isRound(geometry))
  {
    roundSolids.push_back({geometry, transform, scene.lastShape()});
    coarseSolids.push_back(scene.lastAddition());
  }
}

void Evaluator::warn(const Node& node, const std::string& text) { diagnostics.warn(placeOf(node) + ": " + text); }

} // namespace atria::vrml
