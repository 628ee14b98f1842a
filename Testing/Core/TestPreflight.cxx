// SPDX-License-Identifier: GPL-3.0-or-later
/// What is told before a mesh is made.
#include "Mesher/Preflight.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using atria::Box3;
using atria::DomainMode;
using atria::Index;
using atria::Preflight;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSurface;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rounding = 1e-6;

/// An upright sheet, 10 x 6, with a hole of the given width and height, whose front looks along -y.
void addWallWithHole(TriangleSurface& to, const std::string& name, double y, double width, double height)
{
  const double x0 = 4.0, z0 = 1.0, x1 = x0 + width, z1 = z0 + height;
  addSurface(to, name,
             {{0, y, 0}, {10, y, 0}, {10, y, 6}, {0, y, 6}, {x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}},
             {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}});
}

Preflight reportOn(const TriangleSurface& surface, const atria::SiteOptions& options, double sizeMin = 0.5)
{
  atria::ModelOptions all;
  all.site = options;
  all.sizes.sizeMin = sizeMin;
  all.sizes.sizeMid = 2.0 * sizeMin;
  all.sizes.sizeMax = 8.0 * sizeMin;
  return atria::preflight(surface, all, atria::testing::quietContext());
}

atria::SiteOptions within(const Box3& box, double angle = 0.0)
{
  atria::SiteOptions options;
  options.mode = DomainMode::bounds;
  options.bounds = box;
  options.domainAngle = angle;
  return options;
}

const Box3 around{Vec3(-10, -10, 0), Vec3(20, 20, 16)};

TEST(Preflight, FindsTheNarrowestOpeningAndGap)
{
  TriangleSurface surface;
  addWallWithHole(surface, "Front", 0.0, 1.6, 2.5);
  addWallWithHole(surface, "Back", 3.0, 2.0, 0.9);
  for (const double angle : {0.0, 25.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface turned = surface;
    atria::testing::turn(turned, angle);
    const Preflight report = reportOn(turned, within(around));
    EXPECT_NEAR(report.narrow.opening.width, 0.9, rounding);
    EXPECT_NEAR(report.octantsAcrossOpening, 1.8, rounding);
    EXPECT_EQ(report.narrow.opening.surfaces[0], 1u);
    EXPECT_NEAR(report.narrow.gap.width, 3.0, rounding);
    EXPECT_NEAR(report.octantsAcrossGap, 6.0, rounding);
    EXPECT_THAT(report.warnings, Contains(HasSubstr("narrowest opening")));
    EXPECT_THAT(report.warnings, Contains(HasSubstr("'Back'")));
    EXPECT_THAT(report.warnings, ::testing::Not(Contains(HasSubstr("narrowest gap"))));
  }
}

TEST(Preflight, ASlotBetweenSheetsIsAnOpeningAndEdgesOfOneSheetAreNone)
{
  TriangleSurface surface;
  addSheet(surface, "Left", Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 0, 5));
  EXPECT_FALSE(reportOn(surface, within(around)).narrow.opening.found());
  EXPECT_FALSE(reportOn(surface, within(around)).narrow.gap.found());
  addSheet(surface, "Right", Vec3(4.3, 0, 0), Vec3(4, 0, 0), Vec3(0, 0, 5));
  const Preflight report = reportOn(surface, within(around));
  EXPECT_NEAR(report.narrow.opening.width, 0.3, rounding);
  EXPECT_NEAR(report.octantsAcrossOpening, 0.6, rounding);
}

TEST(Preflight, MeasuresAgainstTheRules)
{
  TriangleSurface surface;
  addBox(surface, "Tower", {Vec3(0, 0, 0), Vec3(4, 5, 8)});
  const Preflight report = reportOn(surface, within(around));
  EXPECT_EQ(report.buildingHeight, 8.0);
  EXPECT_NEAR(report.blockages[atria::xMin], 5.0 * 8.0 / (30.0 * 16.0), rounding);
  EXPECT_NEAR(report.distances[atria::xMin], 10.0 / 8.0, rounding);
  EXPECT_NEAR(report.distances[atria::xMax], 16.0 / 8.0, rounding);
  EXPECT_NEAR(report.distances[atria::zMax], 8.0 / 8.0, rounding);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("block")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("xMax")));
  // Seen along a turned domain the tower is broader.
  EXPECT_NEAR(reportOn(surface, within(around, 90.0)).blockages[atria::xMin], 4.0 * 8.0 / (30.0 * 16.0), rounding);
  atria::SiteOptions automatic;
  automatic.mode = DomainMode::automatic;
  const Preflight good = reportOn(surface, automatic, 1.0);
  EXPECT_THAT(good.warnings, IsEmpty());
  EXPECT_NEAR(good.distances[atria::xMax], 15.0, rounding);
  EXPECT_EQ(good.widened, 1.0);
}

/// A slab that looks along y, in the corner of an octagon.
TEST(Preflight, MeasuresAPrismByItsOwnSides)
{
  TriangleSurface surface;
  const Box3 slab{Vec3(2, 1, 0), Vec3(8, 4, 4)};
  addBox(surface, "Slab", slab);
  atria::SiteOptions options = within({Vec3(-20, -20, 0), Vec3(20, 20, 16)});
  options.domainSides = 8;
  const Preflight report = reportOn(surface, options);
  ASSERT_EQ(report.domain.sides().size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
  {
    const Index side = atria::firstPrismSide + static_cast<Index>(i);
    SCOPED_TRACE(atria::sideName(side));
    // Its normal: the first looks along -x, others follow counterclockwise.
    const double angle = (180.0 + 45.0 * static_cast<double>(i)) * std::numbers::pi / 180.0;
    const atria::Vec2 normal(std::cos(angle), std::sin(angle));
    double farthest = -1e9;
    double least = 1e9, most = -1e9;
    for (const double x : {2.0, 8.0})
    {
      for (const double y : {1.0, 4.0})
      {
        farthest = std::max(farthest, normal.dot(atria::Vec2(x, y)));
        least = std::min(least, normal[0] * y - normal[1] * x);
        most = std::max(most, normal[0] * y - normal[1] * x);
      }
    }
    EXPECT_NEAR(report.distances[side], (20.0 - farthest) / 4.0, rounding);
    EXPECT_NEAR(report.blockages[side], (most - least) * 4.0 / (40.0 * 16.0), 1e-3 * report.blockages[side]);
  }
  EXPECT_NEAR(report.distances[atria::zMax], 3.0, rounding);
  // Nearest is the side that looks along x and y; the slab is the broadest for wind across its diagonal.
  EXPECT_THAT(report.warnings,
              Contains(HasSubstr("the side domainSide6 is 2.879 building heights away, less than 15, as are 7 "
                                 "others; any side may be the outlet")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("for wind into domainSide2")));
  EXPECT_GE(report.blockages[report.mostBlocked], *std::ranges::max_element(report.blockages));
  options.mode = DomainMode::automatic;
  EXPECT_THAT(reportOn(surface, options, 1.0).warnings, IsEmpty());
}

TEST(Preflight, EstimatesElements)
{
  const Preflight report = reportOn({}, within({Vec3(0, 0, 0), Vec3(32, 32, 32)}), 1.0);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("no buildings")));
  // Octants of 2 m at least, for the start level, and of 8 m at most.
  EXPECT_GE(report.estimatedElements, 4u * 4u * 4u);
  EXPECT_LE(report.estimatedElements, 17u * 17u * 17u);
}

TEST(Preflight, AsksAboutUnits)
{
  TriangleSurface surface;
  addBox(surface, "Tower", {Vec3(0, 0, 0), Vec3(400, 500, 3000)});
  const Preflight report = reportOn(surface, within({Vec3(-9000, -9000, 0), Vec3(9000, 9000, 9000)}), 100.0);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("inches")));
}

} // namespace
