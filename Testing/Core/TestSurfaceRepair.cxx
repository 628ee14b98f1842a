// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Model/SurfaceModel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <set>

namespace {

using atria::CurveKind;
using atria::Index;
using atria::SurfaceModel;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSurface;

const atria::Box3 domain{Vec3::Constant(-10.0), Vec3::Constant(10.0)};

SurfaceModel repaired(const TriangleSurface& surface, const atria::Box3& in = domain, double gapTolerance = 0.05,
                      int threads = 1)
{
  atria::GridOptions grid;
  grid.domain = in;
  atria::Box3 extent;
  for (const Vec3& p : surface.points)
  {
    extent.extend(p);
  }
  const atria::GridFrame frame = makeGridFrame(grid, extent);
  atria::FeatureOptions options;
  options.gapTolerance = gapTolerance;
  const atria::ThreadExecutor executor(threads);
  const atria::RunContext context = atria::testing::quietContext(executor);
  return makeSurfaceModel(surface, frame, options, context);
}

double area(const SurfaceModel& model, Index surface)
{
  double sum = 0.0;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    sum += model.surfaceIds[t] == surface ? 0.5 * model.normal(t).norm() : 0.0;
  }
  return sum * std::pow(std::ldexp(1.0, -30), 2); // finest octant 1, 30 bits below it
}

std::map<std::pair<Index, Index>, int> edgeUses(const SurfaceModel& model)
{
  std::map<std::pair<Index, Index>, int> uses;
  for (const auto& t : model.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++uses[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  return uses;
}

int edgesOfUse(const SurfaceModel& model, int use)
{
  int count = 0;
  for (const auto& [edge, uses] : edgeUses(model))
  {
    count += uses == use ? 1 : 0;
  }
  return count;
}

double lengthOf(const SurfaceModel& model, CurveKind kind)
{
  double length = 0.0;
  for (const atria::FeatureEdge& edge : model.featureEdges)
  {
    if (model.kindOf(edge) == kind)
    {
      length += atria::between(model.points[edge.a], model.points[edge.b]).norm();
    }
  }
  return std::ldexp(length, -30);
}

TEST(SurfaceRepair, CrossingSheetsShareTheirLine)
{
  TriangleSurface surface;
  addSheet(surface, "A", {-2, 0, -2}, {4, 0, 0}, {0, 0, 4});
  addSheet(surface, "B", {0.3, -2, -1}, {0, 4, 0}, {0, 0, 2});
  const SurfaceModel model = repaired(surface);
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 2.0, 1e-8);
  EXPECT_EQ(edgesOfUse(model, 3), 0);
  EXPECT_NEAR(area(model, 0), 16.0, 1.6e-8);
  EXPECT_NEAR(area(model, 1), 8.0, 8e-9);
  EXPECT_GT(model.repair.intersectionEdges, 0u);
  EXPECT_EQ(model.repair.splitTriangles, 4u);
  EXPECT_EQ(model.repair.unresolvedContacts, 0u);
}

TEST(SurfaceRepair, LeavesASoundModelAlone)
{
  TriangleSurface surface;
  addBox(surface, "Box", {{-1, -1, -1}, {1, 1, 1}});
  atria::testing::addSphere(surface, "Sphere", {5, 0, 0}, 2.0, 4);
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.triangles.size(), surface.triangles.size());
  const atria::SurfaceRepairReport& r = model.repair;
  EXPECT_EQ(r.weldedPoints + r.degenerateTriangles + r.duplicateTriangles + r.overlappingTriangles + r.splitTriangles +
                r.intersectionEdges + r.closedGaps + r.flippedTriangles + r.unresolvedContacts,
            0u);
}

TEST(SurfaceRepair, SplitsEdgesAtTJunctions)
{
  TriangleSurface surface;
  addSurface(surface, "A", {{0, 0, 0}, {4, 0, 0}, {4, 0.7, 3}, {2.2, 0, 0}, {0.4, -1, -2}, {3, -1, -2}},
             {{0, 1, 2}, {0, 4, 3}, {3, 4, 5}, {3, 5, 1}});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.triangles.size(), 5u);
  EXPECT_EQ(edgesOfUse(model, 2), 5); // two along the edge, one above, two below
  EXPECT_EQ(model.repair.splitTriangles, 1u);
}

TEST(SurfaceRepair, SplitsFacesAtPointsOnThem)
{
  TriangleSurface surface;
  addSurface(surface, "A", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  addSurface(surface, "B", {{1, 1, 0}, {2, 2, 3}, {0, 1, 3}}, {{0, 1, 2}});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.triangles.size(), 4u);
  EXPECT_NEAR(area(model, 0), 8.0, 1e-8);
}

TEST(SurfaceRepair, TheSmallerOfOverlappingSheetsKeepsTheCommonPart)
{
  for (const double angle : {0.0, 17.0, 90.0})
  {
    TriangleSurface surface;
    addSheet(surface, "A", {-2, 0, -2}, {4, 0, 0}, {0, 0, 4});
    addSheet(surface, "B", {1, 0, -1}, {0, 0, 2}, {3, 0, 0});
    atria::testing::turn(surface, angle);
    const SurfaceModel model = repaired(surface);
    EXPECT_NEAR(area(model, 0), 14.0, 1.6e-8) << angle;
    EXPECT_NEAR(area(model, 1), 6.0, 6e-9) << angle;
    EXPECT_GT(model.repair.overlappingTriangles, 0u) << angle;
    EXPECT_EQ(edgesOfUse(model, 3), 0) << angle;
  }
}

TEST(SurfaceRepair, DropsReversedRepetitions)
{
  TriangleSurface surface;
  addSheet(surface, "A", {-2, 0, -2}, {4, 0, 0}, {0, 0, 4});
  addSheet(surface, "B", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  const SurfaceModel model = repaired(surface);
  EXPECT_NEAR(area(model, 0), 16.0, 1e-8);
  EXPECT_EQ(area(model, 1), 0.0);
}

TEST(SurfaceRepair, ThreeSheetsThroughOneLineMeetInIt)
{
  TriangleSurface surface;
  for (int i = 0; i < 3; ++i)
  {
    const double a = 0.3 + i * 1.1;
    const Vec3 u(std::cos(a), std::sin(a), 0.0);
    addSheet(surface, "S" + std::to_string(i), -2.0 * u - Vec3(0, 0, 1.5), 4.0 * u, {0, 0, 3});
  }
  const SurfaceModel model = repaired(surface);
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 3.0, 1e-7);
  for (Index s = 0; s < 3; ++s)
  {
    EXPECT_NEAR(area(model, s), 12.0, 1e-7);
  }
  EXPECT_EQ(model.repair.unresolvedContacts, 0u);
}

TEST(SurfaceRepair, AHalfSunkBoxMeetsTheGroundInItsOutline)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  addBox(surface, "House", {{-2, -1, -1}, {2, 1, 3}});
  const SurfaceModel model = repaired(surface);
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 12.0, 1e-7);
  EXPECT_NEAR(area(model, 0), 324.0, 3.3e-7);
  EXPECT_NEAR(area(model, 1), 64.0, 6.4e-8);
  for (const auto& [edge, uses] : edgeUses(model))
  {
    EXPECT_TRUE(uses == 2 || uses == 4 || uses == 1) << uses;
  }
}

/// A box without a bottom over the ground of the domain.
TriangleSurface hoveringHouse(double gap)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", {-10, -10, -10}, {20, 0, 0}, {0, 20, 0});
  const double z = -10.0 + gap;
  addSheet(surface, "South", {-2, -1, z}, {4, 0, 0}, {0, 0, 3});
  addSheet(surface, "East", {2, -1, z}, {0, 2, 0}, {0, 0, 3});
  addSheet(surface, "North", {2, 1, z}, {-4, 0, 0}, {0, 0, 3});
  addSheet(surface, "West", {-2, 1, z}, {0, -2, 0}, {0, 0, 3});
  return surface;
}

TEST(SurfaceRepair, AHouseJustAboveTheGroundStandsOnIt)
{
  for (const double gap : {0.01, 0.02, 0.04})
  {
    const SurfaceModel model = repaired(hoveringHouse(gap));
    EXPECT_EQ(model.repair.closedGaps, 4u) << gap;
    EXPECT_NEAR(model.repair.largestGap, gap, 1e-6);
    EXPECT_NEAR(lengthOf(model, CurveKind::junction), 12.0, 1e-7) << gap;
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      EXPECT_EQ(model.domainSides[t], model.surfaceIds[t] == 0 ? std::int8_t{atria::zMin} : SurfaceModel::noSide);
    }
    EXPECT_NEAR(area(model, 0), 400.0, 4e-7);
  }
  EXPECT_EQ(repaired(hoveringHouse(0.06)).repair.closedGaps, 0u);
  EXPECT_EQ(repaired(hoveringHouse(0.04), domain, 0.0).repair.closedGaps, 0u);
}

TEST(SurfaceRepair, ClosedBoxesStandOnTheGroundToo)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", {-10, -10, -10}, {20, 0, 0}, {0, 20, 0});
  addBox(surface, "House", {{-2, -1, -9.97}, {2, 1, -7}});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.closedGaps, 4u);
  EXPECT_NEAR(area(model, 0), 400.0 - 8.0, 4e-7) << "the smaller base keeps its faces";
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 12.0, 1e-7);
}

TEST(SurfaceRepair, ClosesGapsAlongTheGroundToWallsThatAreNotQuiteUpright)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", {-10, -10, -10}, {20, 0, 0}, {0, 20, 0});
  addSheet(surface, "Wall", {-5, 0, -10}, {10, 0, 0}, {0, 0.001, 5});
  addSheet(surface, "Partition", {0, 0.02, -10}, {0, 4, 0}, {0, 0, 3});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.closedGaps, 2u);
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 10.0 + 4.02 + 3.0, 1e-3);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    EXPECT_EQ(model.domainSides[t] == atria::zMin, model.surfaceIds[t] == 0);
  }
}

TEST(SurfaceRepair, CountsNoGapWhereACornerOfTheDomainCannotMove)
{
  TriangleSurface surface;
  addSurface(surface, "Across", {{-4, -13, -12.95}, {-13, -4, -12.95}, {-13, -12.95, -4}}, {{0, 1, 2}});
  addSurface(surface, "Beyond", {{-10, -10, -10}, {-14, -9, -11}, {-14, -11, -9}}, {{0, 1, 2}});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.closedGaps, 0u);
  EXPECT_EQ(model.repair.largestGap, 0.0);
}

TEST(SurfaceRepair, ClosesGapsBetweenWallsOnSlopes)
{
  TriangleSurface surface;
  addSheet(surface, "Slope", {-8, -8, -1.7}, {16, 0, 3.1}, {0, 16, 1.3});
  // The same plane, 3 cm up.
  const Vec3 u = Vec3(16, 0, 3.1).normalized();
  const Vec3 n = Vec3(16, 0, 3.1).cross(Vec3(0, 16, 1.3)).normalized();
  const Vec3 at = Vec3(-8, -8, -1.7) + 5.0 * u + Vec3(0, 16, 1.3) * 0.4 + 0.03 * n;
  addSheet(surface, "Wall", at, 4.0 * u, {0, 0, 3});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.closedGaps, 2u);
  EXPECT_NEAR(lengthOf(model, CurveKind::junction), 4.0, 1e-3);
  EXPECT_EQ(model.repair.unresolvedContacts, 0u);
}

/// Two walls at a right angle; one is cut into two where the other is whole, and beside that cut, nearer than the
/// tolerance, the other has a point.
TEST(SurfaceRepair, ClosingGapsLosesNoContact)
{
  TriangleSurface surface;
  addSheet(surface, "Low", {0, 0, 0}, {4, 0, 0}, {0, 0, 1.5});
  addSheet(surface, "High", {0, 0, 1.5}, {4, 0, 0}, {0, 0, 1.5});
  addSheet(surface, "SideLow", {0, 0, 0}, {0, 4, 0}, {0, 0, 1.53});
  addSheet(surface, "SideHigh", {0, 0, 1.53}, {0, 4, 0}, {0, 0, 1.47});
  for (const double degrees : {0.0, 17.0})
  {
    atria::testing::turn(surface, degrees);
    const SurfaceModel model = repaired(surface);
    EXPECT_NEAR(lengthOf(model, CurveKind::boundary), 2.0 * (4.0 + 4.0 + 3.0), 0.1) << degrees; // the outline alone
    EXPECT_EQ(model.repair.unresolvedContacts, 0u);
  }
}

TEST(SurfaceRepair, ClosesGapsBetweenPartsThatHangTogetherAtTheGapsEnds)
{
  // A room whose east wall, welded to floor and roof, stops short of the north wall.
  TriangleSurface surface;
  addSheet(surface, "Floor", {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  addSheet(surface, "Roof", {0, 0, 3}, {3, 0, 0}, {0, 3, 0});
  addSheet(surface, "South", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "North", {0, 3, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "West", {0, 0, 0}, {0, 3, 0}, {0, 0, 3});
  addSheet(surface, "East", {3, 0, 0}, {0, 2.97, 0}, {0, 0, 3});
  for (const double degrees : {0.0, 23.0})
  {
    atria::testing::turn(surface, degrees);
    const SurfaceModel model = repaired(surface);
    EXPECT_EQ(edgesOfUse(model, 1), 0) << degrees;
    EXPECT_EQ(lengthOf(model, CurveKind::boundary), 0.0) << degrees;
  }
}

TEST(SurfaceRepair, WallsDrawnTwiceALittleApartBecomeOne)
{
  for (const double apart : {1e-4, 1e-3, 0.01, 0.03})
  {
    for (const double degrees : {0.0, 31.0})
    {
      TriangleSurface surface;
      addBox(surface, "Box", {{-2, -2, -2}, {2, 2, 2}});
      addSheet(surface, "AgainLow", {-2, 2 + apart, -2}, {4, 0, 0}, {0, 0, 1.3});
      addSheet(surface, "AgainHigh", {-2, 2 + apart, -0.7}, {4, 0, 0}, {0, 0, 2.7});
      addSheet(surface, "Side", {2 + apart, -2, -2}, {0, 4, 0}, {0, 0, 4});
      atria::testing::turn(surface, degrees);
      const SurfaceModel model = repaired(surface);
      EXPECT_EQ(model.repair.unresolvedContacts, 0u) << apart << " at " << degrees;
      EXPECT_EQ(lengthOf(model, CurveKind::boundary), 0.0) << apart << " at " << degrees;
    }
  }
}

TEST(SurfaceRepair, KeepsDetailsSmallerThanTheTolerance)
{
  TriangleSurface surface;
  addSheet(surface, "Strip", {0, 0, 0}, {4, 0, 0}, {0, 0, 0.03});
  addBox(surface, "Pane", {{-2, 3, 0}, {2, 3.02, 2}});
  atria::testing::addSphere(surface, "Bead", {-5, 0, 0}, 0.04, 2);
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.closedGaps, 0u);
  EXPECT_EQ(model.triangles.size(), surface.triangles.size());
}

TEST(SurfaceRepair, TurnsReversedTriangles)
{
  TriangleSurface surface;
  addBox(surface, "Box", {{-1, -1, -1}, {1, 1, 1}});
  std::swap(surface.triangles[3][1], surface.triangles[3][2]);
  std::swap(surface.triangles[8][1], surface.triangles[8][2]);
  EXPECT_EQ(repaired(surface).repair.flippedTriangles, 2u);
  for (auto& t : surface.triangles)
  {
    std::swap(t[1], t[2]);
  }
  const SurfaceModel inward = repaired(surface);
  EXPECT_EQ(inward.repair.flippedTriangles, 10u);
  double volume = 0.0;
  for (Index t = 0; t < inward.triangles.size(); ++t)
  {
    volume += inward.normal(t).dot(atria::between(inward.corner(0, 0), inward.corner(t, 0)));
  }
  EXPECT_GT(volume, 0.0);
}

TEST(SurfaceRepair, OpenSheetsKeepTheWindingOfTheGreaterPart)
{
  TriangleSurface surface;
  addSurface(surface, "A", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {4, 0, 0}, {4, 1, 0}},
             {{0, 2, 1}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
  const SurfaceModel model = repaired(surface);
  EXPECT_EQ(model.repair.flippedTriangles, 1u);
  EXPECT_GT(model.normal(0).z(), 0.0);
}

TEST(SurfaceRepair, FarFromTheOriginNothingChanges)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  addBox(surface, "House", {{-2, -1, -1}, {2, 1, 3}});
  const SurfaceModel near = repaired(surface);
  const Vec3 shift(3.5e6, 5.8e6, 128.0);
  for (Vec3& p : surface.points)
  {
    p += shift;
  }
  const SurfaceModel far = repaired(surface, {domain.min + shift, domain.max + shift});
  EXPECT_EQ(far.triangles, near.triangles);
  EXPECT_EQ(far.points, near.points);
}

TEST(SurfaceRepair, TheSameForOneTwoAndSevenThreads)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const TriangleSurface soup = atria::testing::randomSoup(seed);
    const SurfaceModel wanted = repaired(soup);
    for (const int threads : {2, 7})
    {
      const SurfaceModel model = repaired(soup, domain, 0.05, threads);
      EXPECT_EQ(model.points, wanted.points);
      EXPECT_EQ(model.triangles, wanted.triangles);
    }
  }
}

TEST(SurfaceRepair, StopsOnDemand)
{
  struct : atria::SilentMonitor
  {
    bool aborted() const override { return true; }
  } stopped;
  const atria::SerialExecutor executor;
  const atria::RunContext context{executor, atria::ProgressRange(stopped)};
  atria::GridOptions grid;
  grid.domain = domain;
  EXPECT_THROW(makeSurfaceModel(atria::testing::randomSoup(1), makeGridFrame(grid, domain), {}, context),
               atria::Aborted);
}

} // namespace
