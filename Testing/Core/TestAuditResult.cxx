// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the sums of an audit, and how the areas that no air reaches are counted.
#include "Audit/MeshAudit.h"
#include "AuditSetting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Setting;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

SurfaceAudit auditWith(double placed, double drawn)
{
  SurfaceAudit audit;
  audit.placedArea = placed;
  audit.drawnArea = drawn;
  audit.underGround = 1.0;
  audit.inSolid = 2.0;
  audit.inRoom = 4.0;
  audit.shared = 8.0;
  return audit;
}

TEST(SurfaceAudit, SeesThePlacedAreaWithoutWhatIsHidden)
{
  EXPECT_EQ(auditWith(100.0, 50.0).seenArea(), 93.0);
  EXPECT_EQ(SurfaceAudit().seenArea(), 0.0);
}

TEST(SurfaceAudit, CoversTheDrawnAreaThatShouldBeInTheMesh)
{
  SurfaceAudit audit = auditWith(0.0, 35.0); // 20 of it should be there
  const std::vector<std::pair<double, double>> cases{{0.0, 0.0}, {5.0, 0.25}, {20.0, 1.0}, {30.0, 1.0}};
  for (const auto& [meshArea, covered] : cases)
  {
    audit.meshArea = meshArea;
    EXPECT_EQ(audit.coverage(), covered) << meshArea;
  }
  for (const double drawn : {15.0, 10.0})
  {
    audit.drawnArea = drawn; // nothing should be there
    audit.meshArea = 0.0;
    EXPECT_EQ(audit.coverage(), 1.0) << drawn;
  }
}

TEST(VolumeAudit, DisplacesWhatIsNoAir) { EXPECT_EQ((VolumeAudit{10.0, 7.0, 1.0}).displaced(), 3.0); }

TEST(MeshAudit, IsFinishedByWhatIsDrawn)
{
  MeshAudit audit;
  audit.surfaces.assign(4, auditWith(60.0, 0.0));
  for (SurfaceAudit& surface : audit.surfaces)
  {
    surface.shared = 0.0;
    surface.meshArea = 20.0;
  }
  SurfaceRepairReport repair;
  repair.hidden.push_back({1, 5, 7.0, 3, 0.5});
  repair.shared = {{0, 1, 3.0, 0, 0}, {2, 1, 4.0, 0, 0}, {1, 2, 9.0, 0, 0}};
  finishAudit({{50.0, 60.0, 30.0}, {1.0, 2.0, 3.0}, {11.0, 12.0, 13.0}}, repair, audit);
  const auto listOf = [&](double SurfaceAudit::*field) {
    std::vector<double> values;
    std::ranges::transform(audit.surfaces, std::back_inserter(values), field);
    return values;
  };
  EXPECT_THAT(listOf(&SurfaceAudit::drawnArea), ElementsAre(50.0, 60.0, 30.0, 20.0)) << "openings are not drawn";
  EXPECT_THAT(listOf(&SurfaceAudit::outside), ElementsAre(1.0, 2.0, 3.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::extent), ElementsAre(11.0, 12.0, 13.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::leftOut), ElementsAre(0.0, 0.5, 0.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::shared), ElementsAre(0.0, 7.0, 9.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::lost), ElementsAre(50.0 - 20 - 7, 60.0 - 20 - 7 - 7 - 0.5, 0.0, 0.0));
}

TEST(MeshAudit, PutsPlacesAlongTheAxesOfTheModel)
{
  MeshAudit audit;
  audit.surfaces.resize(2);
  audit.surfaces[1].distances.ofFaces.at = Vec3(1, 2, 3);
  audit.surfaces[1].distances.ofSurface.at = Vec3(4, 0, 5);
  placeInModel(audit, Placement(90.0));
  EXPECT_LT((audit.surfaces[1].distances.ofFaces.at - Vec3(-2, 1, 3)).norm(), 1e-12);
  EXPECT_LT((audit.surfaces[1].distances.ofSurface.at - Vec3(0, 4, 5)).norm(), 1e-12);
}

// Parts that no air reaches.

TEST(UnreachedAreas, CountTowardWhatHidesThem)
{
  struct Case
  {
    View front;
    View back;
    View counted;
  };
  const std::vector<Case> cases{{View::solid, View::solid, View::solid},   {View::ground, View::ground, View::ground},
                                {View::solid, View::ground, View::ground}, {View::ground, View::solid, View::ground},
                                {View::room, View::solid, View::room},     {View::solid, View::room, View::room},
                                {View::narrow, View::solid, View::narrow}, {View::ground, View::room, View::room},
                                {View::nothing, View::solid, View::solid}};
  for (const Case& one : cases)
  {
    Setting setting;
    setting.addTriangle(0, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    setting.addTriangle(1, {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 2, 1)});
    setting.addTriangle(1, {Vec3(0, 0, 2), Vec3(9, 0, 2), Vec3(0, 9, 2)});  // is reached
    setting.addTriangle(1, {Vec3(8, 0, 3), Vec3(10, 0, 3), Vec3(8, 2, 3)}); // in part beyond the domain
    const TriangleViews views{one.front, one.back};
    const UnreachedParts parts{{0, 1, 0, 1}, std::vector<TriangleViews>(4, views)};
    const std::vector<ViewAreas> areas = areasOf(parts, setting.model, setting.frame);
    ASSERT_EQ(areas.size(), 2U);
    EXPECT_EQ(areas[0], ViewAreas{});
    ViewAreas expected{};
    expected[static_cast<std::size_t>(one.counted)] = 2.0 + 1.5;
    for (std::size_t view = 0; view < viewCount; ++view)
    {
      EXPECT_NEAR(areas[1][view], expected[view], 1e-5) << view;
    }
  }
  EXPECT_THAT(areasOf({}, Setting().model, Setting().frame), IsEmpty());
}

} // namespace
