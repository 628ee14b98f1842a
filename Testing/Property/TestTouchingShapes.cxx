// SPDX-License-Identifier: GPL-3.0-or-later
/// Round things that touch floors, planes of the grid and each other, as people draw them.
#include "CheckWritten.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/Shapes.h"
#include "Support/Watchdog.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double floorHeight = 1.0;

/// Puts shapes on a floor. What they are named by says which is which.
class Touching
{
public:
  explicit Touching(unsigned seed) : random_(seed) {}

  TriangleSurface make()
  {
    if (random_() % 3 != 0)
    {
      addSheet(model_, "Floor", {-6, -6, floorHeight}, {12, 0, 0}, {0, 12, 0});
    }
    const unsigned count = 1 + random_() % 4;
    for (unsigned i = 0; i < count; ++i)
    {
      at_ = {place(), place(), floorHeight + oneOf({0.0, 0.0, 0.0, 0.5, 1.0, between(0.0, 2.0)})};
      name_ = std::to_string(i);
      switch (random_() % 5)
      {
        case 0:
          addBoard();
          break;
        case 1:
          addPipes();
          break;
        case 2:
          addVault();
          break;
        case 3:
          addCorrugated();
          break;
        default:
          addBall();
      }
    }
    turn(model_, oneOf({0.0, 0.0, 17.0, 45.0}));
    return std::move(model_);
  }

private:
  double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double oneOf(const std::vector<double>& values) { return values[random_() % values.size()]; }
  double place() { return oneOf({between(-4.0, 2.0), std::round(between(-4.0, 2.0)), 0.5}); }

  void addBoard()
  {
    const double thickness = oneOf({0.2, 0.4, 0.5, 0.7});
    const double radius = 0.5 * thickness;
    const Vec3 x(between(1.0, 4.0), 0.0, 0.0);
    const Vec3 y(0.0, between(0.6, 3.0), 0.0);
    const Vec3 rod = at_ + Vec3(0.0, 0.0, radius);
    addSheet(model_, "Bottom" + name_, at_, y, x);
    addSheet(model_, "Top" + name_, at_ + Vec3(0.0, 0.0, thickness), x, y);
    addTube(model_, "Front" + name_, rod, rod + x, radius, 36);
    addTube(model_, "Back" + name_, rod + y, rod + x + y, radius, 36);
    addTube(model_, "Left" + name_, rod, rod + y, radius, 36);
    addTube(model_, "Right" + name_, rod + x, rod + x + y, radius, 36);
  }

  void addPipes()
  {
    const double radius = oneOf({0.1, 0.25, 0.5});
    const Vec3 along(0.0, between(1.0, 4.0), 0.0);
    const unsigned count = 1 + random_() % 4;
    for (unsigned i = 0; i < count; ++i)
    {
      const Vec3 begin = at_ + Vec3(2.0 * radius * i, 0.0, radius);
      addTube(model_, "Pipe" + name_ + "_" + std::to_string(i), begin, begin + along, radius, 24);
    }
  }

  void addVault()
  {
    const double radius = between(0.5, 2.0);
    const Vec3 along(0.0, between(1.0, 4.0), 0.0);
    addStrips("Vault", along, 17, [&](double part) {
      const double angle = std::numbers::pi * part;
      return Vec3(radius - radius * std::cos(angle), 0.0, radius * std::sin(angle));
    });
  }

  void addCorrugated()
  {
    const double height = oneOf({0.1, 0.3, 0.6});
    addStrips("Corrugated", {0.0, between(1.0, 4.0), 0.0}, 48, [&](double part) {
      return Vec3(4.0 * part, 0.0, 0.5 * height * (1.0 - std::cos(8.0 * std::numbers::pi * part)));
    });
  }

  void addBall()
  {
    const double radius = oneOf({0.3, 0.5, 1.0});
    addSphere(model_, "Ball" + name_, at_ + Vec3(0.0, 0.0, radius), radius, 3);
  }

  /// A sheet along the profile that `pointAt` says for 0 to 1.
  template <typename PointAt> void addStrips(const char* name, const Vec3& along, Index count, const PointAt& pointAt)
  {
    std::vector<Vec3> points;
    std::vector<std::array<Index, 3>> triangles;
    for (Index i = 0; i <= count; ++i)
    {
      const Vec3 p = at_ + pointAt(static_cast<double>(i) / count);
      points.insert(points.end(), {p, p + along});
      if (i > 0)
      {
        triangles.insert(triangles.end(), {{2 * i - 2, 2 * i, 2 * i + 1}, {2 * i - 2, 2 * i + 1, 2 * i - 1}});
      }
    }
    addSurface(model_, name + name_, points, triangles);
  }

  std::mt19937 random_;
  TriangleSurface model_;
  Vec3 at_;
  std::string name_;
};

constexpr unsigned usualScenes = 16;
constexpr unsigned allScenes = 300;

class TouchingShapes : public ::testing::TestWithParam<unsigned>
{
};

TEST_P(TouchingShapes, AreMeshedSoundly)
{
  const unsigned seed = GetParam();
  if (seed >= usualScenes && !isFullCampaign())
  {
    GTEST_SKIP() << "set ATRIA_TEST_FULL for more scenes";
  }
  const Watchdog watchdog("scene " + std::to_string(seed), std::chrono::seconds(300));
  GridOptions grid;
  grid.domain = {Vec3(-10, -10, seed % 4 == 0 ? floorHeight : -2.0), Vec3(10, 10, 8)};
  grid.sizeMax = grid.sizeMid = 1.0;
  grid.sizeMin = seed % 2 == 0 ? 1.0 : 0.5;
  DualMeshOptions options;
  options.zoneRule = seed % 3 == 0 ? ZoneRule::all : ZoneRule::outside;
  options.layers = {{"*", {static_cast<int>(seed % 4)}}};
  const Meshed meshed = meshIt(Touching(seed).make(), grid, options, 2);
  EXPECT_TRUE(isSound(meshed.mesh(), 0)); // elements of crease sheets and layers have any directions
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
  EXPECT_THAT(checkAsWritten(meshed).failures, ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, TouchingShapes, ::testing::Range(0u, allScenes));

} // namespace
