// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/SceneParts.h"

#include "Support/Cities.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace atria::testing {

namespace {

/// Octants at edges of houses, and indoors, in meters.
constexpr double outdoorSize = 0.125;
constexpr double indoorSize = 0.15;

} // namespace

TriangleSurface SceneDraw::shuffled(const TriangleSurface& surface)
{
  std::vector<Index> order(surface.names.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random_);
  return inOrder(surface, order);
}

double wallsOf(const Vec3& size) { return 2.0 * (size[0] + size[1]) * size[2]; }
double floorOf(const Vec3& size) { return size[0] * size[1]; }

Box3 standing(double x, double y, const Vec3& size, double base)
{
  const Vec3 low(x - 0.5 * size[0], y - 0.5 * size[1], base);
  return {low, low + size};
}

Scene outdoors()
{
  Scene scene;
  MesherOptions& options = scene.options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = openAir;
  options.sizes.sizeMin = outdoorSize;
  options.sizes.sizeMid = 2.0 * outdoorSize;
  options.sizes.sizeMax = 2.0;
  options.mesh.layers = {{"*", {1}}};
  return scene;
}

Scene indoors()
{
  Scene scene = outdoors();
  MesherOptions& options = scene.options;
  options.site.mode = DomainMode::surfaces;
  options.sizes.sizeMin = options.sizes.sizeMid = indoorSize;
  options.sizes.sizeMax = 2.0 * indoorSize;
  scene.isIndoors = true;
  return scene;
}

void flipLast(TriangleSurface& surface)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.surfaceIds[t] + 1 == surface.names.size())
    {
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    }
  }
}

void addStanding(Scene& scene, const std::string& name, const Box3& box, double ground)
{
  addBox(scene.surface, name, box);
  Vec3 size = box.size();
  size[2] = box.max[2] - ground;
  scene.areas[name] = wallsOf(size) + floorOf(size);
  scene.displaced += size.prod();
  scene.footprint += floorOf(size);
}

void addPane(Scene& scene, SceneDraw& draw, const std::string& name, const std::string& wall, const Vec3& corner,
             const Vec3& u, const Vec3& v)
{
  addSheet(scene.surface, name, corner, u, v);
  if (draw.chance())
  {
    flipLast(scene.surface);
  }
  scene.areas[name] = u.cross(v).norm();
  scene.areas[wall] -= scene.areas[name];
}

void addRing(TriangleSurface& surface, const std::string& name, const Box3& outer, const Box3& inner)
{
  std::vector<Vec3> points;
  for (const double z : {outer.min[2], outer.max[2]})
  {
    for (const Box3& box : {outer, inner})
    {
      points.insert(points.end(), {Vec3(box.min[0], box.min[1], z), Vec3(box.max[0], box.min[1], z),
                                   Vec3(box.max[0], box.max[1], z), Vec3(box.min[0], box.max[1], z)});
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
  };
  for (Index i = 0; i < 4; ++i)
  {
    const Index j = (i + 1) % 4;
    quad(i, i + 4, j + 4, j);           // bottom
    quad(i + 8, j + 8, j + 12, i + 12); // top
    quad(i, j, j + 8, i + 8);           // outside
    quad(i + 4, i + 12, j + 12, j + 4); // court
  }
  addSurface(surface, name, points, triangles);
}

} // namespace atria::testing
