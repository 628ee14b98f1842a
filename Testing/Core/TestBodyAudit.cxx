// SPDX-License-Identifier: GPL-3.0-or-later
/// Volumes of boxes that overlap, within a domain that cuts them.
#include "Audit/BodyAudit.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::turn;

const Box3 domain{Vec3(-5, -5, 0), Vec3(5, 5, 10)};
/// Of samples on boxes across the model's axes.
constexpr double sampled = 0.03;

/// Audits boxes in a domain. Both are turned by the same angle.
BodyAudit audited(const std::vector<Box3>& boxes, double degrees = 0.0)
{
  TriangleSurface model;
  for (const Box3& box : boxes)
  {
    addBox(model, "Box" + std::to_string(model.names.size()), box);
  }
  turn(model, degrees);
  const DrawnModel drawn{model, std::vector<char>(model.names.size(), 0),
                         ClosedBodies(
                             model, [](Index) { return true; }, 1e-6, atria::testing::quietContext())};
  return auditBodies(drawn, PlacedPrism(PlacedBox{Placement(degrees), domain}), {}, 0.1);
}

class BodyVolumes : public ::testing::TestWithParam<double>
{
protected:
  void expectVolumes(const std::vector<Box3>& boxes, double ofUnion, double overlap)
  {
    const BodyAudit audit = audited(boxes, GetParam());
    const double error = GetParam() == 0.0 ? 1e-4 : sampled;
    EXPECT_NEAR(audit.volume, ofUnion, error * ofUnion);
    EXPECT_NEAR(audit.overlap, overlap, error * ofUnion);
  }
};

TEST_P(BodyVolumes, CountTheOverlapOfTwoBoxesOnce)
{
  expectVolumes({{Vec3(-3, -2, 0), Vec3(3, 2, 4)}, {Vec3(2, -1, 0), Vec3(4, 1, 3)}}, 96 + 6, 6);
}

TEST_P(BodyVolumes, LeaveOutTheOverlapBesideTheDomain)
{
  expectVolumes({{Vec3(2, -2, 0), Vec3(8, 2, 4)}, {Vec3(4, -1, 0), Vec3(10, 1, 6)}}, 48 + 12 - 8, 8);
}

TEST_P(BodyVolumes, LeaveOutTheOverlapBelowTheDomain)
{
  expectVolumes({{Vec3(-3, -2, -4), Vec3(3, 2, 4)}, {Vec3(2, -1, -4), Vec3(4, 1, 3)}}, 96 + 6, 6);
}

TEST_P(BodyVolumes, LeaveOutWhatIsAboveTheDomain)
{
  expectVolumes({{Vec3(-3, -2, 0), Vec3(3, 2, 14)}, {Vec3(2, -1, 5), Vec3(4, 1, 16)}}, 240 + 10, 10);
}

TEST_P(BodyVolumes, LeaveOutOverlapsOutsideOfTheDomainAlone)
{
  // Within the domain the boxes are side by side.
  expectVolumes({{Vec3(0, 0, -4), Vec3(2, 2, 4)}, {Vec3(2, 0, -2), Vec3(4, 2, 4)}, {Vec3(0, 0, -4), Vec3(4, 2, -1)}},
                16 + 16, 0);
}

TEST_P(BodyVolumes, CountWhatThreeBoxesShareOnce)
{
  // Each pair shares 8 m³, all of them 4 m³.
  expectVolumes({{Vec3(-2, -2, 0), Vec3(2, 2, 4)}, {Vec3(1, -1, 0), Vec3(4, 1, 4)}, {Vec3(1, 0, 0), Vec3(3, 3, 4)}},
                64 + 24 + 24 - 8 - 8 - 8 + 4, 8 + 8 + 8 - 4);
}

TEST_P(BodyVolumes, CountBoxesInBoxesOnce)
{
  expectVolumes({{Vec3(-4, -4, 0), Vec3(4, 4, 8)}, {Vec3(-2, -2, 2), Vec3(2, 2, 6)}, {Vec3(-1, -1, 3), Vec3(1, 1, 5)}},
                512, 64 + 8);
}

TEST_P(BodyVolumes, CountABoxInABoxThatAThirdCrossesOnce)
{
  expectVolumes(
      {{Vec3(-4, -4, 0), Vec3(4, 4, 8)}, {Vec3(-1, -1, 2), Vec3(1, 1, 4)}, {Vec3(0, -0.5, 3), Vec3(5, 0.5, 4)}},
      512 + 1, 8 + 4);
}

TEST_P(BodyVolumes, HaveNoneOutsideOfTheDomain)
{
  const BodyAudit audit = audited({{Vec3(6, -2, 0), Vec3(8, 2, 4)}, {Vec3(7, -2, 0), Vec3(9, 2, 4)}}, GetParam());
  EXPECT_EQ(audit.closed, 0U);
  EXPECT_EQ(audit.volume, 0.0);
  EXPECT_EQ(audit.overlap, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Angles, BodyVolumes, ::testing::Values(0.0, 20.0, 45.0));

} // namespace
