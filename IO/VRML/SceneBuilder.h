// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects shapes, groups, materials and triangles into a scene.
#pragma once

#include "Scene.h"
#include "SceneGraph.h"
#include "SurfaceBuilder.h"

#include <Eigen/Geometry>

#include <functional>
#include <map>
#include <string_view>

namespace atria::vrml {

using scene::Material;
using scene::Scene;
using scene::Shape;

/// Builds a scene step by step.
class SceneBuilder
{
public:
  /// Makes room for the content of a document that is drawn once.
  void reserve(const Document& document);
  /// Adds a group inside another; `name` as the file has it.
  Index group(std::string_view name, Index parent);
  /// Returns a group's name; empty for none.
  std::string_view groupName(Index group) const
  {
    return group == noIndex ? std::string_view{} : std::string_view(scene.groups[group].name);
  }
  Index material(const Material& material);
  void skip(const std::string& what, std::size_t count = 1) { scene.skipped[what] += count; }

  /// Adds a shape. Returns false, and adds nothing, if coordinates overflow. Throws Error if there are too many.
  bool add(const LocalSurface& surface, const Eigen::Affine3d& transform, const Shape& shape);

  /// Range of points and triangles that one call of add() has added.
  struct Addition
  {
    std::size_t firstPoint = 0;
    std::size_t endPoint = 0;
    std::size_t firstTriangle = 0;
    std::size_t endTriangle = 0;
  };
  Addition lastAddition() const { return last; }
  /// Replaces the triangles of some additions, which are in order. `remake` adds those for the addition of that number
  /// by addTriangles().
  void replace(const std::vector<Addition>& additions, const std::function<void(std::size_t)>& remake);
  /// Adds triangles to a known shape. Returns false, and adds nothing, if coordinates overflow.
  bool addTriangles(const LocalSurface& surface, const Eigen::Affine3d& transform, Index shape);

  Index lastShape() const { return static_cast<Index>(scene.shapes.size() - 1); }
  /// Returns the bounds of all points so far.
  Box3 bounds() const;

  Scene take() { return std::move(scene); }

private:
  void copy(const Scene& from, const Addition& what);

  Scene scene;
  Addition last;
  std::map<Material, Index> known;
};

} // namespace atria::vrml
