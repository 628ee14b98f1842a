// SPDX-License-Identifier: GPL-3.0-or-later
#include "SceneChanges.h"

#include "Support/Error.h"
#include "Surface/Triangles/CoincidentFaces.h"

#include <cmath>

namespace atria::vrml {

namespace {

/// DEF name of a shape, else of what is around it.
std::string nameOf(const Scene& scene, const Shape& shape)
{
  return !shape.name.empty() ? shape.name : shape.group != noIndex ? scene.groups[shape.group].name : "Shape";
}

/// Tells which shapes have lost their last face, and to which.
void noteGone(const Scene& scene, const std::vector<Index>& kept, Diagnostics& diagnostics)
{
  std::vector<Index> owner(scene.shapes.size(), noIndex);
  std::vector<char> left(scene.shapes.size(), 0);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    const Index shape = scene.shapeIds[i];
    left[shape] |= kept[i] == i ? 1 : 0;
    owner[shape] = kept[i] == i ? owner[shape] : scene.shapeIds[kept[i]];
  }
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    if (!left[i])
    {
      diagnostics.note("all faces of '" + nameOf(scene, scene.shapes[i]) +
                       "' coincide with others, first with those of '" + nameOf(scene, scene.shapes[owner[i]]) +
                       "', and are left out");
    }
  }
}

} // namespace

std::size_t mergeDuplicateFaces(Scene& scene, Diagnostics& diagnostics)
{
  const CoincidentFaces found = findCoincidentFaces(scene.points, scene.triangles, scene.faceIds);
  if (found.faces == 0)
  {
    return 0;
  }
  diagnostics.note(std::to_string(found.faces) + " faces coincide with earlier ones and were merged with them, " +
                   std::to_string(found.opposite) + " of them facing the other way");
  noteGone(scene, found.kept, diagnostics);
  std::size_t next = 0;
  for (std::size_t i = 0; i < found.kept.size(); ++i)
  {
    if (found.kept[i] == i)
    {
      scene.triangles[next] = scene.triangles[i];
      scene.shapeIds[next] = scene.shapeIds[i];
      scene.faceIds[next] = scene.faceIds[i];
      ++next;
    }
  }
  scene.triangles.resize(next);
  scene.shapeIds.resize(next);
  scene.faceIds.resize(next);
  return found.faces;
}

Vec3 place(Scene& scene, const Placement& placement)
{
  Box3 box;
  for (Vec3& p : scene.points)
  {
    if (placement.upAxis == 1)
    {
      p = Vec3(p.x(), -p.z(), p.y());
    }
    p *= placement.scale;
    box.extend(p);
  }
  if (!box.empty() && !(box.min.allFinite() && box.max.allFinite()))
  {
    throw Error("coordinates grow beyond all numbers when they are scaled; check Scale");
  }
  Vec3 offset = Vec3::Zero();
  if (placement.recenter && !box.empty())
  {
    constexpr double grain = 100.0;
    const double length = box.size().norm();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double center = box.center()[axis];
      offset[axis] = std::abs(center) > length ? grain * std::round(center / grain) : 0.0;
    }
    for (Vec3& p : scene.points)
    {
      p -= offset;
    }
  }
  return offset;
}

} // namespace atria::vrml
