// SPDX-License-Identifier: GPL-3.0-or-later
/// The measures of features tell meshes that keep them from those that do not.
#include "Support/FeatureChecks.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace atria;
using namespace atria::testing;

/// A plate of 6 x 6 with a hole of 2 x 2 in the middle, on octant centers of the mesh.
class PlateWithHole : public ::testing::Test
{
protected:
  PlateWithHole()
  {
    TriangleSurface surface;
    const auto addSquare = [&](double x, double y) {
      const auto base = static_cast<Index>(surface.points.size());
      surface.points.insert(surface.points.end(),
                            {{x, y, 0.0}, {x + 2.0, y, 0.0}, {x + 2.0, y + 2.0, 0.0}, {x, y + 2.0, 0.0}});
      surface.triangles.insert(surface.triangles.end(), {{base, base + 1, base + 2}, {base, base + 2, base + 3}});
      surface.surfaceIds.insert(surface.surfaceIds.end(), {0, 0});
    };
    surface.names = {"Plate"};
    for (const double x : {-3.0, -1.0, 1.0})
    {
      for (const double y : {-3.0, -1.0, 1.0})
      {
        if (x != -1.0 || y != -1.0)
        {
          addSquare(x, y);
        }
      }
    }
    GridOptions grid;
    grid.domain = {Vec3::Constant(-8.0), Vec3::Constant(8.0)};
    grid.sizeMin = grid.sizeMid = grid.sizeMax = 1.0;
    meshed = meshIt(surface, grid);
  }

  OpeningFigures hole() const
  {
    return FeatureChecks(meshed).openings({{"Hole", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}}).front();
  }

  Meshed meshed;
};

TEST_F(PlateWithHole, ThatIsKeptHasFullMarks)
{
  const FeatureChecks checks(meshed);
  const SurfaceArea area = checks.areas().front();
  EXPECT_NEAR(area.model, 32.0, 1e-9);
  EXPECT_NEAR(area.front, 32.0, 1e-6);
  EXPECT_NEAR(area.back, 32.0, 1e-6);
  EXPECT_NEAR(area.once, 32.0, 1e-6);
  const CurveCoverage curves = checks.curves();
  EXPECT_NEAR(curves.ofKind[static_cast<int>(CurveKind::boundary)].length, 32.0, 1e-6);
  EXPECT_NEAR(curves.total.length, 32.0, 1e-6);
  EXPECT_EQ(curves.total.featureRatio(), 1.0);
  EXPECT_TRUE(curves.misses.empty());
  const NameCoverage name = checks.names().front();
  EXPECT_NEAR(name.front, 1.0, 1e-12);
  EXPECT_NEAR(name.back, 1.0, 1e-12);
  EXPECT_NEAR(hole().area, 4.0, 1e-12);
  EXPECT_NEAR(hole().blocked, 0.0, 0.002);
  EXPECT_EQ(hole().outline, 1.0);
  EXPECT_NEAR(hole().corner, 0.0, 1e-6);
}

TEST_F(PlateWithHole, WhoseCornerIsCutIsBlockedThereAndMissesItsCurves)
{
  for (Vec3& p : meshed.result.mesh.points)
  {
    if ((p - Vec3(1.0, 1.0, 0.0)).norm() < 1e-6)
    {
      p -= Vec3(0.3, 0.3, 0.0);
    }
  }
  // Two triangles of 1 x 0.3 / 2 lie in the hole.
  EXPECT_NEAR(hole().blocked, 0.3, 0.005);
  EXPECT_NEAR(hole().corner, 0.3 * std::sqrt(2.0), 0.1);
  EXPECT_LT(hole().outline, 0.9);
  const CurveCoverage curves = FeatureChecks(meshed).curves();
  // Along the two edges that leave the corner the deviation grows to 0.3; the last meter of each is off by more than
  // 0.05 but for its first sixth.
  EXPECT_NEAR(curves.total.length - curves.total.onFeature, 2.0 * (1.0 - 0.05 / 0.3), 0.1);
  ASSERT_EQ(curves.misses.size(), 2u);
  EXPECT_EQ(curves.misses.front().kind, CurveKind::boundary);
  EXPECT_EQ(curves.misses.front().names, "Plate");
}

TEST_F(PlateWithHole, WithAFaceOfAnotherNameIsNotCoveredThere)
{
  meshed.model.names.push_back("Other");
  for (BoundaryFace& face : meshed.result.mesh.boundaryFaces)
  {
    face.tag += face.onDomainSide ? 1 : 0; // bare sides come after the surfaces
    const ReducedFace corners = faceOf(meshed.mesh().corners[face.element], face.direction);
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < corners.count; ++i)
    {
      middle += meshed.mesh().points[corners.points[i]] / corners.count;
    }
    if (face.side == SheetSide::front && (middle - Vec3(2.5, 2.5, 0.0)).norm() < 0.1)
    {
      face.tag = 1;
    }
  }
  const FeatureChecks checks(meshed);
  EXPECT_NEAR(checks.names()[0].front, 31.0 / 32.0, 0.005);
  EXPECT_NEAR(checks.names()[0].back, 1.0, 1e-12);
  EXPECT_NEAR(checks.areas()[0].front, 31.0, 1e-6);
  EXPECT_NEAR(checks.areas()[1].front, 1.0, 1e-6);
}

TEST(FeatureEdges, AreNotInsideASmoothSheet)
{
  TriangleSurface surface;
  addSheet(surface, "Plate", {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
  GridOptions grid;
  grid.domain = {Vec3::Constant(-8.0), Vec3::Constant(8.0)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = 1.0;
  Meshed meshed = meshIt(surface, grid);
  // A curve of the model where the mesh runs smoothly: mesh edges are there, feature edges are not.
  const auto at = [&](double x, double y) {
    meshed.model.points.push_back(meshed.frame.toLattice({x, y, 0.0}));
    return static_cast<Index>(meshed.model.points.size() - 1);
  };
  meshed.model.curves = {{CurveKind::crease, {0, 0}, {}}};
  meshed.model.featureEdges = {{at(-2.0, 0.0), at(2.0, 0.0), 0}};
  const CurveCoverage curves = FeatureChecks(meshed).curves();
  EXPECT_EQ(curves.total.anyRatio(), 1.0);
  EXPECT_EQ(curves.total.featureRatio(), 0.0);
}

} // namespace
