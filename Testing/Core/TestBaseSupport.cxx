// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests what supports the base of a body, and the height of the ground below.
#include "Domain/BaseSupport.h"
#include "Domain/PlumbLines.h"
#include "Support/Shapes.h"
#include "TerrainSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double rounding = 1e-9;

TEST(GroundBelow, IsTheHigherOneOfSurfaceAndFloor)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", Vec3(0, 0, 0), Vec3(4, 0, 4), Vec3(0, 4, 0));
  const Ground slope(surface, {1}, 0.0);
  const auto heightAt = [&](double x, std::optional<double> floor, bool useSurface) {
    return GroundBelow{slope, floor, false, useSurface}.heightAt(Vec3(x, 1, 77));
  };
  EXPECT_NEAR(heightAt(3, 2.0, true), 3.0, rounding);
  EXPECT_NEAR(heightAt(1, 2.0, true), 2.0, rounding);
  EXPECT_NEAR(heightAt(1, std::nullopt, true), 1.0, rounding);
  EXPECT_EQ(heightAt(3, 2.0, false), 2.0);
  EXPECT_EQ(heightAt(3, std::nullopt, false), -std::numeric_limits<double>::infinity());
}

/// A model, and the support of the bases of its first body.
class Supports
{
public:
  static constexpr double reach = 0.1;
  static constexpr double tolerance = 0.01;

  explicit Supports(TriangleSurface model)
      : surface(std::move(model)), bodies(findBodies(surface, SurfaceFlags(surface.names.size(), 0))),
        lines(surface, allTriangles(surface)), bases(findBases(surface, bodies, lines, 0.0, tolerance)),
        search(surface, bodies, lines, bases.bases, reach, tolerance)
  {
  }

  BaseSupport at(double height, double ground) const
  {
    for (Index base = 0; base < bases.bases.size(); ++base)
    {
      if (bases.bases[base].body == 0 && std::abs(bases.bases[base].low - height) < rounding)
      {
        return search.find(base, ground);
      }
    }
    ADD_FAILURE() << "no base at " << height;
    return BaseSupport::none;
  }
  bool isBeside(double low, double ground) const { return search.isBesideOther(0, low, ground); }

private:
  TriangleSurface surface;
  ModelBodies bodies;
  PlumbLines lines;
  BodyBases bases;
  SupportSearch search;
};

/// Another body near a block [0, 2] x [0, 2] x [2, 4].
struct Neighbor
{
  const char* what;
  Box3 box;
  double ground;
  BaseSupport expected;
};

void expectSupport(const Neighbor& neighbor)
{
  TriangleSurface surface;
  addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
  addBox(surface, "Other", neighbor.box);
  EXPECT_EQ(Supports(surface).at(2.0, neighbor.ground), neighbor.expected) << neighbor.what;
}

TEST(BaseSupport, IsABodyBelowOrAround)
{
  for (const Neighbor& neighbor :
       {Neighbor{"far", {Vec3(9, 9, 0), Vec3(11, 11, 8)}, 0.0, BaseSupport::none},
        {"under it", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 0.0, BaseSupport::below},
        {"a cellar", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 1.0, BaseSupport::none},
        {"just higher than the ground", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 0.98, BaseSupport::below},
        {"a thin column", {Vec3(0.95, 0.95, 0), Vec3(1.05, 1.05, 1)}, 0.0, BaseSupport::below},
        {"under the border alone", {Vec3(-2, 0.5, 0), Vec3(0.09, 1.5, 1)}, 0.0, BaseSupport::none},
        {"under the border at the lower y", {Vec3(0.5, -2, 0), Vec3(1.5, 0.09, 1)}, 0.0, BaseSupport::none},
        {"under the border at the upper x", {Vec3(1.91, 0.5, 0), Vec3(4, 1.5, 1)}, 0.0, BaseSupport::none},
        {"under the border at the upper y", {Vec3(0.5, 1.91, 0), Vec3(1.5, 4, 1)}, 0.0, BaseSupport::none},
        {"under the border and farther", {Vec3(-2, 0.5, 0), Vec3(0.11, 1.5, 1)}, 0.0, BaseSupport::below},
        {"under two thirds", {Vec3(-2, -2, 0), Vec3(4, 1.3, 1)}, 0.0, BaseSupport::below},
        {"above it", {Vec3(0.5, 0.5, 5), Vec3(1.5, 1.5, 6)}, 0.0, BaseSupport::none},
        {"as low", {Vec3(0.5, 0.5, 1.995), Vec3(1.5, 1.5, 3)}, 0.0, BaseSupport::beside},
        {"around it", {Vec3(-1, -1, 0), Vec3(3, 3, 6)}, 0.0, BaseSupport::below}})
  {
    expectSupport(neighbor);
  }
}

TEST(BaseSupport, OfWallsWithoutABottomIsSoughtWithinTheirOutline)
{
  for (const Neighbor& neighbor :
       {Neighbor{"in the middle", {Vec3(0.95, 0.95, 0), Vec3(1.05, 1.05, 1)}, 0.0, BaseSupport::below},
        {"in a corner", {Vec3(0.2, 0.2, 0), Vec3(0.4, 0.4, 1)}, 0.0, BaseSupport::below},
        {"a cellar", {Vec3(0.2, 0.2, 0), Vec3(0.4, 0.4, 1)}, 1.0, BaseSupport::none},
        {"under the border alone", {Vec3(-2, 0.5, 0), Vec3(0.09, 0.8, 1)}, 0.0, BaseSupport::none},
        {"under the border and farther", {Vec3(-2, 0.5, 0), Vec3(0.11, 0.8, 1)}, 0.0, BaseSupport::below},
        {"above", {Vec3(0.2, 0.2, 5), Vec3(0.4, 0.4, 6)}, 0.0, BaseSupport::none}})
  {
    TriangleSurface surface;
    addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
    std::erase_if(surface.triangles, [&](const std::array<Index, 3>& t) {
      return std::ranges::all_of(t, [&](Index p) { return surface.points[p][2] == 2.0; });
    });
    surface.surfaceIds.resize(surface.triangles.size());
    addBox(surface, "Other", neighbor.box);
    EXPECT_EQ(Supports(surface).at(2.0, neighbor.ground), neighbor.expected) << neighbor.what;
  }
}

TEST(BaseSupport, IsABodyBesideThatReachesAsLow)
{
  for (const Neighbor& neighbor :
       {Neighbor{"next to it", {Vec3(2.09, 0, 0), Vec3(3, 2, 6)}, 0.0, BaseSupport::beside},
        {"too far", {Vec3(2.11, 0, 0), Vec3(3, 2, 6)}, 0.0, BaseSupport::none},
        {"too far in y", {Vec3(0, -1, 0), Vec3(2, -0.11, 6)}, 0.0, BaseSupport::none},
        {"touching from below", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.91)}, 0.0, BaseSupport::beside},
        {"too low to touch", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.89)}, 0.0, BaseSupport::none},
        {"as low", {Vec3(2.05, 0, 2.009), Vec3(3, 2, 6)}, 0.0, BaseSupport::beside},
        {"not as low", {Vec3(2.05, 0, 2.011), Vec3(3, 2, 6)}, 0.0, BaseSupport::none},
        {"in the ground", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.95)}, 1.95, BaseSupport::none}})
  {
    expectSupport(neighbor);
  }
}

TEST(BaseSupport, IsTheBodyItselfWhereItReachesLower)
{
  TriangleSurface surface; // a bridge on two legs
  addCells(surface, "Bridge", 3, Vec3(1, 1, 1), [](int i, int j, int k) { return j == 0 && (k > 0 || i != 1); });
  const Supports supports(surface);
  EXPECT_EQ(supports.at(1.0, -2.0), BaseSupport::beside);
  EXPECT_EQ(supports.at(0.0, -2.0), BaseSupport::none);
}

TEST(BaseSupport, OfOtherBodiesCountsTouchDepthAndRise)
{
  TriangleSurface surface;
  addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
  EXPECT_FALSE(Supports(surface).isBeside(2.0, 0.0)) << "it is not beside itself";
  addBox(surface, "Other", {Vec3(2, 0, 1), Vec3(3, 2, 3)});
  const Supports supports(surface);
  EXPECT_TRUE(supports.isBeside(2.0, 0.0));
  EXPECT_TRUE(supports.isBeside(0.995, 0.0)) << "within the tolerance";
  EXPECT_FALSE(supports.isBeside(0.98, 0.0));
  EXPECT_TRUE(supports.isBeside(2.0, 2.98));
  EXPECT_FALSE(supports.isBeside(2.0, 2.995));
}

} // namespace
