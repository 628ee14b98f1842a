// SPDX-License-Identifier: GPL-3.0-or-later
/// What must hold of every mesh holds in turned domains, prisms and grids, whatever the surfaces.
#include "CheckWritten.h"
#include "Domain/PlacedModel.h"
#include "Mesher/MeshModel.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <random>
#include <ranges>
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

/// From this seed on domains are prisms.
constexpr unsigned firstPrism = 62;
constexpr int sideCounts[] = {3, 5, 8, 16, 32};

/// And from this one on prisms on any convex polygon.
constexpr unsigned firstPolygon = 120;

/// On an ellipse that touches the box of `half` its size, at angles of 20 to 100 degrees between them, and at most 160
/// from the last to the first, so that the middle is within; every third one clockwise.
std::vector<atria::Vec2> randomPolygon(unsigned seed, std::mt19937& random, const Vec3& half)
{
  std::uniform_real_distribution<double> gap(20.0, 100.0);
  std::vector<atria::Vec2> corners;
  for (double angle = 0.6 * gap(random); angle < 360.0; angle += gap(random))
  {
    const double radians = angle * std::numbers::pi / 180.0;
    corners.emplace_back(half[0] * std::cos(radians), half[1] * std::sin(radians));
  }
  if (seed % 3 == 0)
  {
    std::ranges::reverse(corners);
  }
  return corners;
}

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
  out.options.domainSides = seed < firstPrism ? 4 : sideCounts[(seed - firstPrism) / 2 % std::size(sideCounts)];
  out.options.domainAngle = 360.0 * unit(random) - 180.0;
  if (seed >= firstPolygon)
  {
    out.options.domainAngle = 0.0;
    out.options.polygon = randomPolygon(seed, random, half);
  }
  out.options.alignment = static_cast<atria::GridAlignment>(seed % 3);
  out.sizes.sizeMin = 0.25 + 0.25 * unit(random);
  out.sizes.sizeMid = 2.0 * out.sizes.sizeMin;
  out.sizes.sizeMax = 4.0 * out.sizes.sizeMin;
  return out;
}

DualMeshResult meshOf(const Case& c, int threads, int layers = 0)
{
  const atria::ThreadExecutor executor(threads);
  atria::MesherOptions options;
  options.site = c.options;
  options.sizes = c.sizes;
  options.mesh.zoneRule = atria::ZoneRule::all;
  options.mesh.layers = {{"*", {layers}}};
  options.mesh.supportElements = false;
  return atria::meshModel(c.surface, options, atria::testing::quietContext(executor));
}

constexpr unsigned usualSeeds = 20;
/// A wall goes round a face of a side there.
constexpr unsigned jogAtSide = 30;

class TurnedDomains : public ::testing::TestWithParam<unsigned>
{
protected:
  void SetUp() override
  {
    const bool isUsual = GetParam() < usualSeeds || GetParam() == jogAtSide ||
                         (GetParam() >= firstPrism && GetParam() < firstPrism + 2 * std::size(sideCounts)) ||
                         (GetParam() >= firstPolygon && GetParam() < firstPolygon + 8);
    if (!isUsual && !atria::testing::isFullCampaign())
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
  EXPECT_TRUE(atria::testing::isValid(result.mesh));
  EXPECT_TRUE(atria::testing::identical(result.mesh, meshOf(c, 3).mesh));
}

double shortestSide(const atria::PlacedPrism& domain)
{
  const auto lengthOf = [](const atria::PrismSide& side) { return (side.end - side.start).norm(); };
  return std::ranges::min(domain.sides() | std::views::transform(lengthOf));
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
  std::set<atria::Index> expected{atria::zMin, atria::zMax};
  std::ranges::transform(plan.domain.sides(), std::inserter(expected, expected.end()), &atria::PrismSide::number);
  EXPECT_TRUE(std::ranges::includes(expected, sides));
  if (shortestSide(plan.domain) > std::numbers::sqrt2 * c.sizes.sizeMax)
  {
    EXPECT_EQ(sides, expected); // narrower ones may lie between elements
  }
  const double slack = 1e-4 * c.sizes.sizeMin;
  for (const Vec3& point : result.mesh.points)
  {
    const Vec3 p = plan.domain.axes.fromModel(point);
    ASSERT_LE(plan.domain.beyond(p.head<2>()), slack) << point.transpose();
    ASSERT_GE(p[2], plan.domain.bounds.min[2] - slack);
    ASSERT_LE(p[2], plan.domain.bounds.max[2] + slack);
  }
}

/// The side of a number; of the bottom and the top none.
const atria::PrismSide* uprightSide(const atria::PlacedPrism& domain, int number)
{
  const auto found = std::ranges::find(domain.sides(), static_cast<atria::Index>(number), &atria::PrismSide::number);
  return found == domain.sides().end() ? nullptr : &*found;
}

/// The nearest point of a side's plane.
Vec3 onSide(const Vec3& point, int number, const atria::PlacedPrism& domain)
{
  Vec3 p = domain.axes.fromModel(point);
  if (const atria::PrismSide* side = uprightSide(domain, number))
  {
    p.head<2>() = side->foot(p.head<2>());
  }
  else
  {
    p[2] = (number == atria::zMax ? domain.bounds.max : domain.bounds.min)[2];
  }
  return domain.axes.toModel(p);
}

/// How far from its side of the domain a point is.
double offSide(const Vec3& point, int number, const atria::PlacedPrism& domain)
{
  return (onSide(point, number, domain) - point).norm();
}

/// Calls visit(point, side) for the points of faces on sides of the domain. What has the name of a side, but is on
/// none, is about an element that is left out.
template <typename Visit> void eachPointOfSides(const atria::DualMesh& mesh, atria::Index names, Visit&& visit)
{
  for (const atria::BoundaryFace& face : mesh.boundaryFaces)
  {
    const int side = static_cast<int>(face.tag) - static_cast<int>(names);
    const atria::ReducedFace reduced = atria::faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count && side >= 0 && face.onDomainSide; ++i)
    {
      visit(reduced.points[i], side);
    }
  }
}

/// By point whether it is one of a wall.
std::vector<char> pointsOfWalls(const atria::DualMesh& mesh, atria::Index names)
{
  std::vector<char> atWall(mesh.points.size(), 0);
  for (const atria::BoundaryFace& face : mesh.boundaryFaces)
  {
    const atria::ReducedFace reduced = atria::faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count && face.tag < names; ++i)
    {
      atWall[reduced.points[i]] = 1;
    }
  }
  return atWall;
}

/// How far points of sides are off them at most.
struct FarthestOff
{
  double atWalls = 0.0; ///< those of walls, too
  double beyond = 0.0;  ///< all others
};

/// Of points that are as far off as none of `told`.
FarthestOff farthestOff(const atria::DualMesh& mesh, const atria::PlacedPrism& domain, atria::Index names,
                        const std::vector<double>& told)
{
  constexpr double rounding = 1e-6;
  const std::vector<char> atWall = pointsOfWalls(mesh, names);
  FarthestOff farthest;
  eachPointOfSides(mesh, names, [&](atria::Index point, int side) {
    const double off = offSide(mesh.points[point], side, domain);
    double& most = atWall[point] ? farthest.atWalls : farthest.beyond;
    const bool isTold = std::ranges::any_of(told, [&](double known) { return std::abs(known - off) < rounding; });
    most = isTold ? most : std::max(most, off);
  });
  return farthest;
}

/// Were the points of sides on these.
double volumeWithinSides(atria::DualMesh mesh, const atria::PlacedPrism& domain, atria::Index names)
{
  eachPointOfSides(mesh, names, [&](atria::Index point, int side) {
    mesh.points[point] = onSide(mesh.points[point], side, domain);
  });
  return atria::testing::totalVolume(mesh);
}

/// Of the vertices that diagnostics list, how far each is from each side.
std::vector<double> distancesOfDetached(const DualMeshResult& result, const atria::PlacedPrism& domain)
{
  std::vector<double> distances;
  for (const atria::Diagnostic& diagnostic : result.diagnostics)
  {
    if (diagnostic.kind != atria::Diagnostic::detachedVertex)
    {
      continue;
    }
    for (const int side : {atria::zMin, atria::zMax})
    {
      distances.push_back(offSide(diagnostic.begin, side, domain));
    }
    for (const atria::PrismSide& side : domain.sides())
    {
      distances.push_back(offSide(diagnostic.begin, static_cast<int>(side.number), domain));
    }
  }
  return distances;
}

/// The volumes of elements that are left out.
std::vector<double> volumesLeftOut(const DualMeshResult& result)
{
  std::vector<double> out;
  for (const atria::Diagnostic& diagnostic : result.diagnostics)
  {
    if (diagnostic.kind == atria::Diagnostic::leftOutElement)
    {
      out.push_back(std::pow(diagnostic.width, 3));
    }
  }
  return out;
}

TEST_P(TurnedDomains, HaveLayersThatEndOnTheirSides)
{
  const Case c = randomCase(GetParam());
  const DualMeshResult bare = meshOf(c, 1);
  const atria::DualMesh& plain = bare.mesh;
  const DualMeshResult layered = meshOf(c, 1, 2);
  const atria::DualMesh& mesh = layered.mesh;
  const std::vector<double> leftOut = volumesLeftOut(layered);
  const auto names = static_cast<atria::Index>(c.surface.names.size());
  const auto walls = static_cast<std::size_t>(
      std::ranges::count_if(plain.boundaryFaces, [&](const atria::BoundaryFace& face) { return face.tag < names; }));
  if (walls > leftOut.size()) // else all walls may be those of elements that are left out
  {
    EXPECT_GT(mesh.elementCount() + leftOut.size(), plain.elementCount());
  }
  EXPECT_TRUE(atria::testing::isValid(mesh, static_cast<atria::Index>(plain.elementCount() - leftOut.size())));
  EXPECT_TRUE(atria::testing::facesAreUnique(mesh));
  // What of a side is off its plane in the mesh without layers may stay so, points of walls slide along these; vertices
  // that left it are told.
  const atria::PlacedPrism domain = atria::planSite(c.surface, c.options, c.sizes).domain;
  const FarthestOff off = farthestOff(mesh, domain, names, distancesOfDetached(layered, domain));
  const FarthestOff offBefore = farthestOff(plain, domain, names, {});
  EXPECT_LE(off.beyond, std::max(offBefore.beyond, offBefore.atWalls) + 1e-6 * c.sizes.sizeMin);
  EXPECT_LE(off.atWalls, offBefore.atWalls + 0.5 * c.sizes.sizeMin);
  // Points of walls slide along them to make room, also where the mesh cuts a corner of the model. How much that is
  // does not depend on how much of the bounds the domain fills.
  const double filled = domain.volume() / domain.bounds.size().prod();
  const double volume = volumeWithinSides(mesh, domain, names) + std::reduce(leftOut.begin(), leftOut.end());
  const double wanted = volumeWithinSides(plain, domain, names);
  // Volumes of elements that are left out are of their points where these are, not on the sides: they are less, or what
  // is beside them reaches into them, by no more than there is between the mesh and its sides.
  const double offSides = leftOut.empty() ? 0.0 : std::abs(wanted - atria::testing::totalVolume(plain));
  EXPECT_NEAR(volume, wanted, 2e-3 / filled * wanted + offSides);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TurnedDomains, ::testing::Range(0u, 160u));

/// A house within, away from the sides; ground that reaches over them where `hasGround`.
Case calmCase(int sideCount, bool hasGround)
{
  Case out;
  atria::testing::addBox(out.surface, "House", {Vec3(-1.3, -0.9, 0.0), Vec3(1.2, 1.1, 2.0)});
  if (hasGround)
  {
    const std::vector<Vec3> corners{{-20, -20, -1.5}, {20, -20, 0.5}, {20, 20, 1.0}, {-20, 20, -0.5}, {0.1, 0.2, -0.2}};
    atria::testing::addSurface(out.surface, "Site", corners, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  }
  out.options.mode = atria::DomainMode::bounds;
  out.options.bounds = {Vec3(-8.0, -6.5, -2.0), Vec3(7.0, 7.5, 5.0)};
  out.options.domainSides = sideCount;
  out.options.domainAngle = 17.0 + sideCount;
  out.sizes.sizeMin = 0.25;
  out.sizes.sizeMid = 0.5;
  out.sizes.sizeMax = 1.0;
  return out;
}

void expectExactSides(const Case& c, std::size_t sideCount, bool hasGround)
{
  const DualMeshResult result = meshOf(c, 2);
  const auto names = static_cast<atria::Index>(c.surface.names.size());
  const atria::PlacedPrism domain = atria::planSite(c.surface, c.options, c.sizes).domain;
  ASSERT_EQ(domain.sides().size(), sideCount);
  EXPECT_TRUE(atria::testing::isConformal(result.mesh));
  EXPECT_TRUE(atria::testing::boundaryIsWatertight(result.mesh));
  EXPECT_GT(std::ranges::min(atria::testing::volumes(result.mesh)), 0.0);
  // Where the ground meets an upright edge, elements may cut it off.
  EXPECT_NEAR(atria::testing::totalVolume(result.mesh) / domain.volume(), 1.0, hasGround ? 1e-3 : 1e-6);
  std::vector<double> areas(atria::sideNumbers, 0.0);
  for (const atria::BoundaryFace& face : result.mesh.boundaryFaces)
  {
    const auto at = [&](int i) { return result.mesh.points[atria::cornerOf(result.mesh, face, i)]; };
    if (face.tag >= names)
    {
      areas[face.tag - names] += 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
    }
  }
  for (const atria::PrismSide& side : domain.sides())
  {
    const double exact = (side.end - side.start).norm() * domain.bounds.size()[2];
    const double face = c.sizes.sizeMid * c.sizes.sizeMid;
    EXPECT_NEAR(areas[side.number], exact, hasGround ? 0.5 * face : 1e-5 * exact) << atria::sideName(side.number);
  }
}

class Prisms : public ::testing::TestWithParam<std::tuple<int, bool>>
{
};

TEST_P(Prisms, HaveTheAreaOfEachSideAndTheVolumeOfTheExactOne)
{
  const auto& [sideCount, hasGround] = GetParam();
  expectExactSides(calmCase(sideCount, hasGround), static_cast<std::size_t>(sideCount), hasGround);
}

INSTANTIATE_TEST_SUITE_P(SideCounts, Prisms,
                         ::testing::Combine(::testing::Values(3, 4, 5, 8, 16, 32), ::testing::Bool()));

class Polygons : public ::testing::TestWithParam<bool>
{
};

TEST_P(Polygons, HaveTheAreaOfEachSideAndTheVolumeOfTheExactOne)
{
  for (const std::vector<atria::Vec2>& polygon : {std::vector<atria::Vec2>{{-8, -6}, {9, -4}, {1, 9}},
                                                  {{-7, -6}, {-9, 5}, {6, 8}, {8, -3}}, // clockwise
                                                  {{-8, -2}, {-4, -6}, {5, -6.5}, {9, 0}, {8, 5}, {0, 7.5}, {-6, 4}}})
  {
    SCOPED_TRACE(polygon.size());
    Case c = calmCase(4, GetParam());
    c.options.domainAngle = 0.0;
    c.options.polygon = polygon;
    expectExactSides(c, polygon.size(), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Grounds, Polygons, ::testing::Bool());

class TurnedHouses : public ::testing::TestWithParam<std::tuple<int, bool, int>>
{
};

/// Sides that cut the grid have elements as good as those at walls.
TEST_P(TurnedHouses, HaveNothingToObjectTo)
{
  const auto& [sideCount, hasGround, layers] = GetParam();
  Case c = calmCase(sideCount, hasGround);
  for (const double angle : {0.0, 5.0, 14.0, 28.0, 43.0})
  {
    SCOPED_TRACE(angle);
    c.options.domainAngle = angle;
    atria::MesherOptions options;
    options.site = c.options;
    options.sizes = c.sizes;
    options.mesh.layers = {{"*", {layers}}};
    const atria::ThreadExecutor executor(2);
    const atria::MeshedModel result = atria::meshModel(c.surface, options, atria::testing::quietContext(executor));
    EXPECT_TRUE(atria::testing::elementsAreClosed(result.mesh));
    EXPECT_TRUE(atria::testing::boundaryIsWatertight(result.mesh));
    for (const atria::LayerCoverage& surface : result.layers.surfaces)
    {
      EXPECT_GE(surface.layered, (surface.layers > 0 ? 0.99 : 0.0) * surface.area) << surface.surface;
    }
    if (atria::testing::haveCheckMesh())
    {
      atria::testing::Meshed meshed;
      meshed.model.names = result.names;
      meshed.model.kinds = result.kinds;
      meshed.result = result;
      EXPECT_THAT(atria::testing::checkAsWritten(meshed).failures, ::testing::IsEmpty());
    }
  }
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
}

INSTANTIATE_TEST_SUITE_P(SideCounts, TurnedHouses,
                         ::testing::Combine(::testing::Values(3, 4, 5, 16), ::testing::Bool(),
                                            ::testing::Values(0, 1, 5)));

} // namespace
