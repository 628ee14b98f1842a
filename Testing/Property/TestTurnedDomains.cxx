// SPDX-License-Identifier: GPL-3.0-or-later
/// What must hold of every mesh holds in turned domains and grids, whatever the surfaces.
#include "Domain/PlacedModel.h"
#include "Mesher/MeshModel.h"
#include "Support/DualMeshChecks.h"
#include "Support/Shapes.h"

#include <algorithm>
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
  EXPECT_GT(std::ranges::min(atria::testing::volumes(result.mesh)), 0.0);
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

/// How far inside its side of the domain a point is. Planes are along the domain's axes.
double offSide(const Vec3& point, int side, const atria::PlacedBox& domain)
{
  const Box3& box = domain.bounds;
  const int axis = atria::axisOf(side);
  return std::abs(domain.axes.fromModel(point)[axis] - (atria::isUpper(side) ? box.max : box.min)[axis]);
}

/// Calls visit(point, side) for the points of faces named after sides of the domain.
template <typename Visit> void eachPointOfSides(const atria::DualMesh& mesh, atria::Index names, Visit&& visit)
{
  for (const atria::BoundaryFace& face : mesh.boundaryFaces)
  {
    const int side = static_cast<int>(face.tag) - static_cast<int>(names);
    const atria::ReducedFace reduced = atria::faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count && side >= 0; ++i)
    {
      visit(reduced.points[i], side);
    }
  }
}

/// Of the points of sides that are as far off as none of `told` the one that is farthest.
double farthestOff(const atria::DualMesh& mesh, const atria::PlacedBox& domain, atria::Index names,
                   const std::vector<double>& told)
{
  constexpr double rounding = 1e-6;
  double farthest = 0.0;
  eachPointOfSides(mesh, names, [&](atria::Index point, int side) {
    const double off = offSide(mesh.points[point], side, domain);
    const bool isTold = std::ranges::any_of(told, [&](double known) { return std::abs(known - off) < rounding; });
    farthest = isTold ? farthest : std::max(farthest, off);
  });
  return farthest;
}

/// Were the points of sides on these.
double volumeWithinSides(atria::DualMesh mesh, const atria::PlacedBox& domain, atria::Index names)
{
  eachPointOfSides(mesh, names, [&](atria::Index point, int side) {
    Vec3 p = domain.axes.fromModel(mesh.points[point]);
    const int axis = atria::axisOf(side);
    p[axis] = (atria::isUpper(side) ? domain.bounds.max : domain.bounds.min)[axis];
    mesh.points[point] = domain.axes.toModel(p);
  });
  return atria::testing::totalVolume(mesh);
}

/// Of the vertices that diagnostics list, how far each is from each side.
std::vector<double> distancesOfDetached(const DualMeshResult& result, const atria::PlacedBox& domain)
{
  std::vector<double> distances;
  for (const atria::Diagnostic& diagnostic : result.diagnostics)
  {
    for (int side = 0; side < 6 && diagnostic.kind == atria::Diagnostic::detachedVertex; ++side)
    {
      distances.push_back(offSide(diagnostic.begin, side, domain));
    }
  }
  return distances;
}

TEST_P(TurnedDomains, HaveLayersThatEndOnTheirSides)
{
  const Case c = randomCase(GetParam());
  const DualMeshResult bare = meshOf(c, 1);
  const atria::DualMesh& plain = bare.mesh;
  const DualMeshResult layered = meshOf(c, 1, 2);
  const atria::DualMesh& mesh = layered.mesh;
  EXPECT_GT(mesh.elementCount(), plain.elementCount());
  EXPECT_TRUE(atria::testing::isConformal(mesh, static_cast<atria::Index>(plain.elementCount())));
  EXPECT_TRUE(atria::testing::facesAreUnique(mesh));
  EXPECT_TRUE(atria::testing::elementsAreClosed(mesh));
  EXPECT_TRUE(atria::testing::boundaryIsWatertight(mesh));
  EXPECT_GT(std::ranges::min(atria::testing::volumes(mesh)), 0.0);
  // What of a side is off its plane in the mesh without layers may stay so; vertices that left it are told.
  const auto names = static_cast<atria::Index>(c.surface.names.size());
  const atria::PlacedBox domain = atria::planSite(c.surface, c.options, c.sizes).domain;
  EXPECT_LE(farthestOff(mesh, domain, names, distancesOfDetached(layered, domain)),
            farthestOff(plain, domain, names, {}) + 1e-6 * c.sizes.sizeMin);
  // Points of walls slide along them to make room, also where the mesh cuts a corner of the model.
  EXPECT_NEAR(volumeWithinSides(mesh, domain, names) / volumeWithinSides(plain, domain, names), 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TurnedDomains, ::testing::Range(0u, 60u));

} // namespace
