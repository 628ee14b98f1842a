// SPDX-License-Identifier: GPL-3.0-or-later
#include "SceneBuilder.h"

#include "Input.h"

#include "Support/Error.h"
#include "Support/Memory.h"

namespace atria::vrml {

using scene::Material;
using scene::Scene;
using scene::Shape;

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
  if (!addTriangles(surface, transform, static_cast<Index>(scene.shapes.size())))
  {
    return false;
  }
  scene.shapes.push_back(shape);
  return true;
}

bool SceneBuilder::addTriangles(const LocalSurface& surface, const Eigen::Affine3d& transform, Index shape)
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
  last = {first, scene.points.size(), scene.shapeIds.size(), scene.triangles.size()};
  scene.shapeIds.resize(scene.triangles.size(), shape);
  return true;
}

Box3 SceneBuilder::bounds() const
{
  Box3 box;
  for (const Vec3& p : scene.points)
  {
    box.extend(p);
  }
  return box;
}

void SceneBuilder::replace(const std::vector<Addition>& additions, const std::function<void(std::size_t)>& remake)
{
  Scene old;
  old.points.swap(scene.points);
  old.triangles.swap(scene.triangles);
  old.shapeIds.swap(scene.shapeIds);
  old.faceIds.swap(scene.faceIds);
  Addition between;
  for (std::size_t i = 0; i < additions.size(); ++i)
  {
    between.endPoint = additions[i].firstPoint;
    between.endTriangle = additions[i].firstTriangle;
    copy(old, between);
    remake(i);
    between.firstPoint = additions[i].endPoint;
    between.firstTriangle = additions[i].endTriangle;
  }
  between.endPoint = old.points.size();
  between.endTriangle = old.triangles.size();
  copy(old, between);
}

/// Appends some points and triangles of another scene with the same shapes.
void SceneBuilder::copy(const Scene& from, const Addition& what)
{
  const Index points = static_cast<Index>(scene.points.size()) - static_cast<Index>(what.firstPoint);
  const Index firstFace = scene.faceIds.empty() ? 0 : scene.faceIds.back() + 1;
  const auto at = [](auto& list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  scene.points.insert(scene.points.end(), at(from.points, what.firstPoint), at(from.points, what.endPoint));
  for (std::size_t i = what.firstTriangle; i < what.endTriangle; ++i)
  {
    const auto& [a, b, c] = from.triangles[i];
    scene.triangles.push_back({a + points, b + points, c + points}); // modulo 2^32 where points go down
    scene.shapeIds.push_back(from.shapeIds[i]);
    scene.faceIds.push_back(firstFace + from.faceIds[i] - from.faceIds[what.firstTriangle]);
  }
}

} // namespace atria::vrml
