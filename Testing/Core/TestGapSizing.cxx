// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sizes of octants across gaps.
#include "Octree/Sizing/GapSizing.h"
#include "SizedOctree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::IsEmpty;

/// A sheet of 2 m x 2 m at a height, a wide one above, and gaps from the lower one.
class TwoSheets
{
public:
  TwoSheets(double width, int across, double slope = 0.0, std::vector<SurfaceSize> rules = {})
  {
    addSheet(surface, "Lower", Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0));
    addSheet(surface, "Upper", Vec3(-6, -6, width - 2 - 6 * slope), Vec3(12, 0, 12 * slope), Vec3(0, 12, 0));
    cellsAcross = across;
    sizing.surfaceSizes = std::move(rules);
  }

  TriangleSurface surface;

  /// Finds the gaps at the triangles of the lower sheet in the part of the domain with x up to `most`.
  void find(double most = 8.0, ModelItem::Kind kind = ModelItem::triangle)
  {
    of = sized(surface, gridOf(16.0, 0.25, 1.0, 4.0), sizing);
    const ModelLevels levels = modelLevels(of.model, of.frame, sizing);
    std::vector<ModelItem> pieces;
    for (Index t = 0; t < of.model.triangles.size(); ++t)
    {
      if (of.model.surfaceIds[t] == 0)
      {
        pieces.push_back({kind, t});
      }
    }
    const LatticeBox box{of.frame.toLattice(Vec3::Constant(-8)), of.frame.toLattice(Vec3(most, 8, 8))};
    lines = {GapLine{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 99}};
    level = GapSizer(of.model, of.frame, levels, cellsAcross).find(box, pieces, lines);
    lines.erase(lines.begin());
  }

  double sizeFound()
  {
    find();
    return lines.empty() ? 0.0 : of.frame.sizeOf(level);
  }
  Vec3 place(const Vec3& lattice) const { return of.frame.toModel(lattice); }

  Sized of;
  std::vector<GapLine> lines;
  int level = 0;

private:
  int cellsAcross = 1;
  SizingOptions sizing;
};

TEST(GapSizer, FitsOctantsAcrossAGapButNoFinerThanFeatures)
{
  EXPECT_EQ(TwoSheets(4.0, 4).sizeFound(), 1.0);
  EXPECT_EQ(TwoSheets(-4.0, 4).sizeFound(), 1.0) << "behind it as well";
  EXPECT_EQ(TwoSheets(3.9, 4).sizeFound(), 0.5);
  EXPECT_EQ(TwoSheets(2.0, 4).sizeFound(), 0.5);
  EXPECT_EQ(TwoSheets(2.0, 1).sizeFound(), 2.0);
  EXPECT_EQ(TwoSheets(2.0, 8).sizeFound(), 0.25);
  EXPECT_EQ(TwoSheets(0.5, 4).sizeFound(), 0.25) << "as fine as features are";
  EXPECT_EQ(TwoSheets(7.9, 2).sizeFound(), 2.0);
  EXPECT_EQ(TwoSheets(8.1, 2).sizeFound(), 0.0) << "octants in the open are fine enough";
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Upper", 0.5, 0.125}}).sizeFound(), 0.125) << "of the finer surface";
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Lower", 0.5, 0.125}}).sizeFound(), 0.125);
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Upper", 2.0, 2.0}}).sizeFound(), 0.25);
}

TEST(GapSizer, LinesLeadAcrossTheGap)
{
  TwoSheets sheets(3.0, 4);
  sheets.find();
  ASSERT_EQ(sheets.lines.size(), 2U) << "one for each triangle, on its one side";
  const double unit = sheets.of.frame.latticeUnit();
  for (const GapLine& line : sheets.lines)
  {
    EXPECT_NEAR((sheets.place(line.from) - Vec3(0, 0, -2 + 3e-3)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((sheets.place(line.to) - Vec3(0, 0, 1 - 3e-3)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((line.half * unit - 0.999 * Vec3(1, 1, 0)).norm(), 0.0, 1e-6);
    EXPECT_EQ(line.level, sheets.level);
  }
}

TEST(GapSizer, LooksFromTheOctantsPartOfATriangle)
{
  TwoSheets sheets(3.0, 4);
  sheets.find(0.0);
  ASSERT_EQ(sheets.lines.size(), 2U);
  // Triangles of (-1, -1), (1, -1), (1, 1) and (-1, -1), (1, 1), (-1, 1), up to x = 0.
  const std::array<Vec2, 2> middles{Vec2(-0.5, -0.5), Vec2(-0.5, 0.0)};
  const std::array<Vec2, 2> halves{Vec2(0.5, 0.5), Vec2(0.5, 1.0)};
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR((sheets.place(sheets.lines[i].from).head<2>() - middles.at(i)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((sheets.lines[i].half.head<2>() * sheets.of.frame.latticeUnit() - 0.999 * halves.at(i)).norm(), 0.0,
                1e-6);
  }
  sheets.find(-1.1);
  EXPECT_THAT(sheets.lines, IsEmpty());
  EXPECT_EQ(sheets.level, 0);
  sheets.find(8.0, ModelItem::featureEdge);
  EXPECT_THAT(sheets.lines, IsEmpty());
}

TEST(GapSizer, TakesTheFirstTriangleIfItFacesTheRay)
{
  EXPECT_GT(TwoSheets(3.0, 4, std::tan(28.0 * std::numbers::pi / 180.0)).sizeFound(), 0.0);
  EXPECT_EQ(TwoSheets(3.0, 4, std::tan(32.0 * std::numbers::pi / 180.0)).sizeFound(), 0.0);
  TwoSheets hidden(6.0, 4);
  EXPECT_GT(hidden.sizeFound(), 0.0);
  addSheet(hidden.surface, "Slanted", Vec3(-3, -3, -3.5), Vec3(6, 0, 6), Vec3(0, 6, 0));
  EXPECT_EQ(hidden.sizeFound(), 0.0);
}

} // namespace
