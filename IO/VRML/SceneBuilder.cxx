// SPDX-License-Identifier: GPL-3.0-or-later
#include "SceneBuilder.h"

#include "Input.h"

#include "Support/Error.h"
#include "Support/Memory.h"

namespace atria::vrml {

void SceneBuilder::reserve(const Document& document)
{
  const std::size_t triangles = 2 * document.indices / 5; // quads, of five indices, make most of them
  reserveLarge(scene.points, document.points);
  reserveLarge(scene.triangles, triangles);
  reserveLarge(scene.shapeIds, triangles);
  reserveLarge(scene.faceIds, triangles);
  reserveLarge(scene.shapes, document.surfaces);
  reserveLarge(scene.groups, document.names);
}

Index SceneBuilder::group(std::string_view name, Index parent)
{
  const std::size_t depth = parent == noIndex ? 0 : scene.groups[parent].depth + 1;
  scene.groups.push_back({toUtf8(name), parent, depth});
  return static_cast<Index>(scene.groups.size() - 1);
}

Index SceneBuilder::material(const Material& material)
{
  const auto [found, isNew] = known.try_emplace(material, static_cast<Index>(scene.materials.size()));
  if (isNew)
  {
    scene.materials.push_back(material);
  }
  return found->second;
}

bool SceneBuilder::add(const LocalSurface& surface, const Eigen::Affine3d& transform, const Shape& shape)
{
  const std::size_t first = scene.points.size();
  if (first + surface.points.size() >= noIndex || scene.triangles.size() + surface.triangles.size() >= noIndex)
  {
    throw Error("the model has more points or triangles than can be numbered");
  }
  for (const Vec3& p : surface.points)
  {
    const Vec3 moved = transform * p;
    if (!moved.allFinite())
    {
      scene.points.resize(first);
      return false;
    }
    scene.points.push_back(moved);
  }
  const bool mirrored = transform.linear().determinant() < 0.0;
  const auto base = static_cast<Index>(first);
  const Index firstFace = scene.faceIds.empty() ? 0 : scene.faceIds.back() + 1;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const auto& [a, b, c] = surface.triangles[i];
    scene.triangles.push_back({base + a, base + (mirrored ? c : b), base + (mirrored ? b : c)});
    scene.faceIds.push_back(firstFace + surface.faceIds[i]);
  }
  scene.shapeIds.resize(scene.triangles.size(), static_cast<Index>(scene.shapes.size()));
  scene.shapes.push_back(shape);
  return true;
}

} // namespace atria::vrml
