// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"
#include "SceneGraph.h"
#include "SurfaceBuilder.h"

#include <Eigen/Geometry>

#include <functional>
#include <map>
#include <string_view>

namespace atria::vrml {

/// Puts a scene together.
class SceneBuilder
{
public:
  /// Makes room for what a document has if it is drawn once.
  void reserve(const Document& document);
  /// A group inside another; `name` as the file has it.
  Index group(std::string_view name, Index parent);
  /// Empty for none.
  std::string_view groupName(Index group) const
  {
    return group == noIndex ? std::string_view{} : std::string_view(scene.groups[group].name);
  }
  Index material(const Material& material);
  void skip(const std::string& what, std::size_t count = 1) { scene.skipped[what] += count; }

  /// False, and nothing is added, where coordinates grow beyond all numbers. Throws Error where there are too many.
  bool add(const LocalSurface& surface, const Eigen::Affine3d& transform, const Shape& shape);

  /// What one call of add() has added.
  struct Addition
  {
    std::size_t firstPoint = 0;
    std::size_t endPoint = 0;
    std::size_t firstTriangle = 0;
    std::size_t endTriangle = 0;
  };
  Addition lastAddition() const { return last; }
  /// Puts other triangles in the place of each of some additions, which are in order: `remake` adds those of the
  /// addition of that number by addTriangles().
  void replace(const std::vector<Addition>& additions, const std::function<void(std::size_t)>& remake);
  /// Adds triangles to a shape that is known. False, and nothing is added, where coordinates grow beyond all numbers.
  bool addTriangles(const LocalSurface& surface, const Eigen::Affine3d& transform, Index shape);

  Index lastShape() const { return static_cast<Index>(scene.shapes.size() - 1); }
  /// Of all points so far.
  Box3 bounds() const;

  Scene take() { return std::move(scene); }

private:
  void copy(const Scene& from, const Addition& what);

  Scene scene;
  Addition last;
  std::map<Material, Index> known;
};

} // namespace atria::vrml
