// SPDX-License-Identifier: GPL-3.0-or-later
/// What lies hidden in solids does not show in the mesh of the air around them.
#include "Mesher/MeshModel.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addPrism;
using atria::testing::turn;

constexpr double size = 0.2;

MesherOptions optionsIn(const Box3& domain)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = domain;
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = 2.0 * size;
  options.sizes.sizeMax = 1.6;
  options.mesh.layers = {{"*", {1}}};
  return options;
}

MeshedModel meshed(const TriangleSurface& surface,
                   MesherOptions options = optionsIn({Vec3(-10, -10, 0), Vec3(10, 10, 8)}))
{
  const ThreadExecutor executor(2);
  return meshModel(surface, options, atria::testing::quietContext(executor));
}

/// A box along the slope of a roof: from `low` on its underside it goes by `length` upwards, and by `thickness` square
/// to the roof.
void addSloped(TriangleSurface& model, const std::string& name, const Vec3& low, double width, double length,
               double thickness)
{
  TriangleSurface box;
  addBox(box, name, {Vec3(0, 0, 0), Vec3(width, length, thickness)});
  constexpr double c = 0.86602540378443864676; // 30 degrees
  constexpr double s = 0.5;
  for (Vec3& p : box.points)
  {
    p = low + Vec3(p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]);
  }
  std::vector<std::array<Index, 3>> triangles = box.triangles;
  atria::testing::addSurface(model, name, box.points, triangles);
}

/// Rafters lie in the slab, 4 cm below its skin.
TriangleSurface roofWithRafters(int count)
{
  TriangleSurface model;
  addSloped(model, "Roof", Vec3(-4.0, -3.0, 3.0), 8.0, 6.0, 0.2);
  for (int i = 0; i < count; ++i)
  {
    const Vec3 along(0.0, 0.86602540378443864676, 0.5);
    const Vec3 up(0.0, -0.5, 0.86602540378443864676);
    addSloped(model, "Rafter" + std::to_string(i),
              Vec3(-3.7, -3.0, 3.0) + Vec3(0.6 * i, 0, 0) + 0.04 * along + 0.04 * up, 0.1, 5.92, 0.12);
  }
  return model;
}

/// How far any surface's faces are from it, in elements.
double farthest(const MeshedModel& mesh)
{
  double most = 0.0;
  for (const SurfaceAudit& surface : mesh.audit.surfaces)
  {
    most = std::max({most, surface.distances.ofFaces.inElements, surface.distances.ofSurface.inElements});
  }
  return most;
}

class TurnedParts : public ::testing::TestWithParam<double>
{
};

TEST_P(TurnedParts, RaftersInARoofLeaveItsSkinPlane)
{
  TriangleSurface model = roofWithRafters(12);
  turn(model, GetParam());
  TriangleSurface alone = roofWithRafters(0);
  turn(alone, GetParam());
  const MeshedModel with = meshed(model);
  const MeshedModel without = meshed(alone);
  // Its octants are finer where rafters lie, so that the edges of the slab are not the same.
  EXPECT_LE(farthest(with), std::max(0.2, farthest(without) + 0.01));
  EXPECT_NEAR(with.audit.surfaces[0].meshArea, without.audit.surfaces[0].meshArea,
              0.001 * without.audit.surfaces[0].meshArea);
  EXPECT_NEAR(with.audit.volumes.displaced(), without.audit.volumes.displaced(), 0.01);
  for (std::size_t i = 1; i < with.audit.surfaces.size(); ++i)
  {
    const SurfaceAudit& rafter = with.audit.surfaces[i];
    EXPECT_EQ(rafter.meshArea, 0.0);
    EXPECT_NEAR(rafter.inSolid, rafter.drawnArea, 1e-3);
  }
}

class TurnedLayers : public TurnedParts
{
};

// Along the axes no point of this grid is in the 3 cm between plaster and bricks, and nothing tells what they are.
TEST_P(TurnedLayers, OfAWallDoNotShow)
{
  TriangleSurface model;
  addBox(model, "Plaster", {Vec3(-4, -0.2, 0), Vec3(4, 0.2, 3)});
  addBox(model, "Brick", {Vec3(-3.97, -0.12, 0.03), Vec3(3.97, 0.06, 2.97)});
  addBox(model, "Insulation", {Vec3(-3.97, 0.06, 0.03), Vec3(3.97, 0.17, 2.97)});
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model);
  EXPECT_LE(farthest(mesh), 0.01);
  EXPECT_NEAR(mesh.audit.volumes.displaced(), 9.6, 0.01);
}

TEST_P(TurnedParts, FurnitureBuiltIntoAWallMeetsItInACurve)
{
  const auto wallWithShelf = [](double end) {
    TriangleSurface model;
    addBox(model, "Wall", {Vec3(-4, -0.5, 0), Vec3(4, 0.5, 3)});
    addBox(model, "Shelf", {Vec3(-1, -1.5, 1), Vec3(1, end, 1.6)});
    turn(model, GetParam());
    return meshed(model);
  };
  const MeshedModel mesh = wallWithShelf(0.3);
  EXPECT_LE(farthest(mesh), farthest(wallWithShelf(-0.5)) + 0.01);
  EXPECT_NEAR(mesh.audit.volumes.displaced(), 24.0 + 1.2, 0.005 * 25.2);
  EXPECT_NEAR(mesh.audit.surfaces[1].meshArea, 2.0 * 1.0 * 2.0 + 2.0 * 0.6 * 1.0 + 1.2, 0.005 * 6.4);
}

INSTANTIATE_TEST_SUITE_P(Angles, TurnedParts, ::testing::Values(0.0, 17.0, 30.0, 45.0));
INSTANTIATE_TEST_SUITE_P(Angles, TurnedLayers, ::testing::Values(17.0, 30.0, 45.0));

} // namespace
