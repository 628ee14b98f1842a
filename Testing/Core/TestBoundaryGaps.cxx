// SPDX-License-Identifier: GPL-3.0-or-later
/// The nearest thing ahead, of a place of a boundary edge and of a model's.
#include "FoundZones.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace atria;
using atria::testing::addSheet;
using atria::testing::FoundZones;
using atria::testing::uniformGrid;

const Box3 domain{Vec3(-4, -4, 0), Vec3(4, 4, 6)};
constexpr double size = 0.5;

TEST(TriangleTree, FindsTheNearestPlaceThatARuleTakes)
{
  const FoundZones found(atria::testing::randomSoup(3), uniformGrid({Vec3::Constant(-4.3), Vec3::Constant(4.1)}, 0.5));
  const TriangleTree& tree = found.tree.get();
  struct Upward : TriangleTree::AnyPlace
  {
    Vec3 from;
    explicit Upward(const Vec3& p) : from(p) {}
    bool reaches(const Box3& box) const { return reachesAhead(Vec3::UnitZ(), from, box); }
    bool wants(Index t) const { return t % 3 != 0; }
    bool takes(const TriangleTree::Place& place) const { return isAhead(Vec3::UnitZ(), place.at - from); }
  };
  std::mt19937 random(7);
  const double extent = static_cast<double>(found.octree.frame().domainHigh[0]);
  std::uniform_real_distribution<double> inside(0.0, extent);
  int none = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 p(inside(random), inside(random), inside(random));
    const Upward rule(p);
    const double farthest = 0.2 * extent;
    TriangleTree::Place wanted{farthest * farthest, noIndex, p};
    for (Index t = 0; t < found.model.triangles.size(); ++t)
    {
      const Vec3 q = tree.nearestOn(t, p);
      const TriangleTree::Place place{(q - p).squaredNorm(), t, q};
      if (rule.wants(t) && rule.takes(place) && place.isNearerThan(wanted))
      {
        wanted = place;
      }
    }
    const auto place = tree.nearest(p, farthest, rule);
    ASSERT_EQ(place ? place->triangle : noIndex, wanted.triangle);
    none += place ? 0 : 1;
  }
  EXPECT_GT(none, 0);
  EXPECT_LT(none, 200);
}

/// A wall's edge at z = 2 below a slab, leaning by `degrees` about the edge, that is `width` ahead of the edge.
std::vector<BoundaryStation> belowLeaningSlab(double degrees, double width)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", Vec3(0.13, -1.6, 1.1), Vec3(0, 3.2, 0), Vec3(0, 0, 0.9));
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vec3 along(std::cos(angle), 0.0, std::sin(angle));
  addSheet(surface, "Slab", Vec3(0.13, -1.6, 2.0 + width) - 2.0 * along, Vec3(0, 3.2, 0), 4.0 * along);
  FoundZones found(surface, uniformGrid(domain, size));
  const BoundaryGaps gaps = findBoundaryGaps(found.context());
  const LatticePoint top = found.octree.frame().toLattice(Vec3(0.13, 0.0, 2.0));
  for (std::size_t e = 0; e < gaps.stations.size(); ++e)
  {
    const BoundaryEdge& edge = gaps.boundary.edges()[e];
    if (found.model.points[edge.a][2] == top[2] && found.model.points[edge.b][2] == top[2])
    {
      return gaps.stations[e];
    }
  }
  return {};
}

TEST(BoundaryGaps, LeadToTheNearestPlaceWithin45DegreesAndAnOctant)
{
  for (const double degrees : {0.0, 20.0, 44.0, 46.0, 70.0})
  {
    for (const double part : {0.1, 0.5, 0.95, 1.5})
    {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, " + std::to_string(part) + " octants ahead");
      const double nearest = part * size * std::cos(degrees * std::numbers::pi / 180.0);
      const auto stations = belowLeaningSlab(degrees, part * size);
      if (degrees > 45.0 || nearest > size)
      {
        EXPECT_TRUE(stations.empty());
        continue;
      }
      ASSERT_GE(stations.size(), 3.2 / (0.25 * size));
      for (const BoundaryStation& station : stations)
      {
        ASSERT_TRUE(station.across);
        EXPECT_NEAR(station.across->norm() / station.octantSize, nearest / size, 1e-3);
        EXPECT_TRUE(station.isBridged(nearest / size + 0.01));
        EXPECT_FALSE(station.isBridged(nearest / size - 0.01));
      }
    }
  }
}

TEST(BoundaryGaps, AreNoneAtCornersOfOneSheetAndWhereSheetsMeet)
{
  TriangleSurface surface;
  atria::testing::addPierced(surface, "Wall", Vec3(0.13, -3, 1), Vec3(0, 6, 0), Vec3(0, 0, 4), {0.4, 0.5}, {0.4, 0.5});
  addSheet(surface, "Partition", Vec3(0.13, -2.0, 1.5), Vec3(2, 0, 0), Vec3(0, 0, 1)); // ends on the wall's face
  FoundZones found(surface, uniformGrid(domain, 0.25));
  const BoundaryGaps gaps = findBoundaryGaps(found.context());
  EXPECT_GT(gaps.boundary.edges().size(), 10u);
  for (const auto& stations : gaps.stations)
  {
    EXPECT_TRUE(stations.empty());
  }
}

TEST(BoundaryGaps, AreBridgedByTrianglesWoundLikeTheSheet)
{
  TriangleSurface surface;
  addSheet(surface, "South", Vec3(0.13, -2, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  addSheet(surface, "North", Vec3(0.13, 0.2, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  FoundZones found(surface, uniformGrid(domain, size));
  const BoundaryGaps gaps = findBoundaryGaps(found.context());
  double area = 0.0;
  for (Index e = 0; e < gaps.stations.size(); ++e)
  {
    const Vec3 normal = found.model.normal(gaps.boundary.edges()[e].triangle).normalized();
    for (std::size_t step = 0; step + 1 < gaps.stations[e].size(); ++step)
    {
      EXPECT_TRUE(gaps.bridge(e, step, 0.39).empty());
      for (const BridgeTriangle& t : gaps.bridge(e, step, 0.41))
      {
        const Vec3 twice = between(t[0], t[1]).cross(between(t[0], t[2]));
        EXPECT_GT(twice.dot(normal), 0.0);
        area += 0.5 * twice.norm() * std::pow(found.octree.frame().latticeUnit(), 2);
      }
    }
  }
  EXPECT_NEAR(area, 2.0 * 0.2 * 2.0, 1e-4); // once from either side
}

} // namespace
