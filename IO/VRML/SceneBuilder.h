// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"
#include "SceneGraph.h"
#include "SurfaceBuilder.h"

#include <Eigen/Geometry>

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

  Scene take() { return std::move(scene); }

private:
  Scene scene;
  std::map<Material, Index> known;
};

} // namespace atria::vrml
