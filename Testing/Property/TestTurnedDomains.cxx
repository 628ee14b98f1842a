// SPDX-License-Identifier: GPL-3.0-or-later
/// What must hold of every mesh holds in turned domains and grids, whatever the surfaces.
#include "Domain/PlacedModel.h"
#include "Mesher/MeshModel.h"
#include "Support/DualMeshChecks.h"
#include "Support/Shapes.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

namespace {

using atria::Box3;
using atria::DualMeshResult;
using atria::TriangleSurface;
using atria::Vec3;

struct Case
{
  atria::SiteOptions options;
  atria::GridOptions sizes;
  TriangleSurface surface;
};

/// A soup, on ground that is bumpy in every second case, in a domain at any angle to walls and axes.
Case randomCase(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Case out;
  out.surface = atria::testing::randomSoup(seed);
  if (seed % 2 == 0)
  {
    std::vector<Vec3> points;
    std::vector<std::array<atria::Index, 3>> triangles;
    constexpr atria::Index side = 6;
    for (atria::Index i = 0; i < side * side; ++i)
    {
      points.emplace_back(2.0 * (i % side) - 5.0 + unit(random), 2.0 * (i / side) - 5.0 + unit(random),
                          -3.0 + 1.5 * unit(random));
      if (i % side + 1 < side && i + side < side * side)
      {
        triangles.push_back({i, i + 1, i + side + 1});
        triangles.push_back({i, i + side + 1, i + side});
      }
    }
    atria::testing::addSurface(out.surface, "Site", points, triangles);
  }
  const Vec3 half(3.0 + 3.0 * unit(random), 3.0 + 3.0 * unit(random), 3.0);
  out.options.mode = atria::DomainMode::bounds;
  out.options.bounds = {-half, half};
  out.options.domainAngle = 360.0 * unit(random) - 180.0;
  out.options.alignment = static_cast<atria::GridAlignment>(seed % 3);
  out.sizes.sizeMin = 0.25 + 0.25 * unit(random);
  out.sizes.sizeMid = 2.0 * out.sizes.sizeMin;
  out.sizes.sizeMax = 4.0 * out.sizes.sizeMin;
  return out;
}

DualMeshResult meshOf(const Case& c, int threads, int layers = 0)
{
  const atria::ThreadExecutor executor(threads);
  atria::SilentMonitor silent;
  atria::MesherOptions options;
  options.site = c.options;
  options.sizes = c.sizes;
  options.mesh.zoneRule = atria::ZoneRule::all;
  options.mesh.layers = {{"*", {layers}}};
  return atria::meshModel(c.surface, options, {executor, atria::ProgressRange(silent)});
}

constexpr unsigned usualSeeds = 20;
/// A wall goes round a face of a side there.
constexpr unsigned jogAtSide = 30;

class TurnedDomains : public ::testing::TestWithParam<unsigned>
{
protected:
  void SetUp() override
  {
    if (GetParam() >= usualSeeds && GetParam() != jogAtSide && !std::getenv("ATRIA_TEST_FULL"))
    {
      GTEST_SKIP() << "set ATRIA_TEST_FULL for more seeds";
    }
  }
};

TEST_P(TurnedDomains, AreConformalAndWatertightAndTheSameForAnyThreads)
{
  const Case c = randomCase(GetParam());
  const DualMeshResult result = meshOf(c, 1);
  ASSERT_GT(result.mesh.elementCount(), 0u);
  EXPECT_TRUE(atria::testing::isConformal(result.mesh));
  EXPECT_TRUE(atria::testing::elementsAreClosed(result.mesh));
  EXPECT_TRUE(atria::testing::boundaryIsWatertight(result.mesh));
  EXPECT_TRUE(atria::testing::identical(result.mesh, meshOf(c, 3).mesh));
}

TEST_P(TurnedDomains, EndAtTheirSidesOnly)
{
  const Case c = randomCase(GetParam());
  const DualMeshResult result = meshOf(c, 1);
  const auto names = static_cast<atria::Index>(c.surface.names.size());
  const atria::SitePlan plan = atria::planSite(c.surface, c.options, c.sizes);
  std::set<atria::Index> sides;
  for (const atria::BoundaryFace& face : result.mesh.boundaryFaces)
  {
    if (face.tag >= names)
    {
      sides.insert(face.tag - names);
      EXPECT_TRUE(face.onDomainSide);
      EXPECT_EQ(face.opposite, atria::noIndex);
    }
  }
  EXPECT_EQ(sides, (std::set<atria::Index>{0, 1, 2, 3, 4, 5}));
  const double slack = 1e-4 * c.sizes.sizeMin;
  Box3 along;
  for (const Vec3& p : result.mesh.points)
  {
    along.extend(plan.domain.axes.fromModel(p));
  }
  EXPECT_TRUE((along.min.array() >= plan.domain.bounds.min.array() - slack).all())
      << (along.min - plan.domain.bounds.min).transpose();
  EXPECT_TRUE((along.max.array() <= plan.domain.bounds.max.array() + slack).all())
      << (along.max - plan.domain.bounds.max).transpose();
}

TEST_P(TurnedDomains, HaveLayersThatEndOnTheirSides)
{
  const Case c = randomCase(GetParam());
  const atria::DualMesh plain = meshOf(c, 1).mesh;
  const atria::DualMesh mesh = meshOf(c, 1, 2).mesh;
  EXPECT_GT(mesh.elementCount(), plain.elementCount());
  EXPECT_TRUE(atria::testing::isConformal(mesh, static_cast<atria::Index>(plain.elementCount())));
  EXPECT_TRUE(atria::testing::facesAreUnique(mesh));
  EXPECT_TRUE(atria::testing::elementsAreClosed(mesh));
  EXPECT_TRUE(atria::testing::boundaryIsWatertight(mesh));
  // Points of walls slide along them to make room, also where the mesh cuts a corner of the model.
  EXPECT_NEAR(atria::testing::totalVolume(mesh) / atria::testing::totalVolume(plain), 1.0, 2e-3);
  const auto names = static_cast<atria::Index>(c.surface.names.size());
  const atria::SitePlan plan = atria::planSite(c.surface, c.options, c.sizes);
  // What of a side is off its plane in the plain mesh may stay so.
  std::array<double, 2> off{0.0, 0.0};
  for (const atria::DualMesh* of : {&plain, &mesh})
  {
    for (const atria::BoundaryFace& face : of->boundaryFaces)
    {
      const int side = static_cast<int>(face.tag) - static_cast<int>(names);
      for (const std::uint8_t corner : atria::hexahedronFace[face.direction])
      {
        const Vec3 p = plan.domain.axes.fromModel(of->points[of->corners[face.element][corner]]);
        const Box3& box = plan.domain.bounds;
        const double plane = side < 0 ? 0.0 : (atria::isUpper(side) ? box.max : box.min)[atria::axisOf(side)];
        double& most = off[of == &mesh ? 1 : 0];
        most = side < 0 ? most : std::max(most, std::abs(p[atria::axisOf(side)] - plane));
      }
    }
  }
  EXPECT_LE(off[1], off[0] + 1e-6 * c.sizes.sizeMin);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TurnedDomains, ::testing::Range(0u, 60u));

} // namespace
