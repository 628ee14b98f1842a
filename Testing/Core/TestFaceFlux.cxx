// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests areas and volumes of the faces of dual meshes, and the sides that faces lie on.
#include "Dual/Mesh/FaceFlux.h"
#include "Dual/Mesh/MetSides.h"
#include "DualBlock.h"
#include "Grid/Prism.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;

FaceFlux sumOfFluxes(const DualMesh& mesh, Index element, const Vec3& origin)
{
  FaceFlux sum;
  for (int direction = 0; direction < 6; ++direction)
  {
    const FaceFlux flux = fluxOf(mesh, element, direction, origin);
    sum.area += flux.area;
    sum.volume += flux.volume;
  }
  return sum;
}

TEST(FaceFlux, OfAllFacesIsTheVolumeFromAnyOrigin)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-1, 1);
  for (int round = 0; round < 50; ++round)
  {
    DualMesh mesh = Block({1, 1, 1}, noSheet).mesh;
    Eigen::Matrix3d turn;
    turn.setZero();
    turn = turn.unaryExpr([&](double) { return some(random); });
    for (Vec3& p : mesh.points)
    {
      p = turn * p + Vec3(3, -2, 1);
    }
    const FaceFlux sum = sumOfFluxes(mesh, 0, Vec3(some(random), some(random), some(random)));
    EXPECT_NEAR(sum.volume, turn.determinant(), 1e-12);
    EXPECT_NEAR(sum.area.norm(), 0.0, 1e-12);
  }
}

TEST(FaceFlux, HasAreasOutwardsAndNoneOfFacesThatAreNone)
{
  DualMesh mesh = Block({1, 1, 1}, noSheet).mesh;
  for (Vec3& p : mesh.points)
  {
    p = p.cwiseProduct(Vec3(2, 3, 5));
  }
  const std::array<double, 3> areas{15, 10, 6};
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto axis = static_cast<std::size_t>(axisOf(direction));
    const Vec3 expected = (isUpper(direction) ? 1 : -1) * areas.at(axis) * Vec3::Unit(axisOf(direction));
    EXPECT_NEAR((fluxOf(mesh, 0, direction, Vec3(7, 8, 9)).area - expected).norm(), 0.0, 1e-12);
  }
  // A wedge: the face at the upper x becomes an edge.
  for (const auto& [gone, kept] : {std::pair(1, 2), {5, 6}})
  {
    mesh.corners[0].at(static_cast<std::size_t>(gone)) = mesh.corners[0].at(static_cast<std::size_t>(kept));
  }
  EXPECT_NEAR(sumOfFluxes(mesh, 0, Vec3(1, 1, 1)).volume, 15.0, 1e-12);
  EXPECT_EQ(fluxOf(mesh, 0, xMax, Vec3::Zero()).area, Vec3(Vec3::Zero()));
  EXPECT_NEAR((fluxOf(mesh, 0, zMax, Vec3::Zero()).area - Vec3(0, 0, 3)).norm(), 0.0, 1e-12);
}

TEST(MetSides, AreThoseThatFacesLieOn)
{
  DualMesh mesh;
  mesh.boundaryFaces = {{0, 0, noIndex, xMin, SheetSide::front, false},
                        {0, 1, 5, xMin, SheetSide::back, false},
                        {0, 2, noIndex, xMin, SheetSide::front, false},
                        {0, 2, 3, xMin, SheetSide::back, false},
                        {0, 4 + zMax, noIndex, xMin, SheetSide::back, true}};
  mesh.zoneFaces = {{0, 3, xMin, SheetSide::front}};
  const auto textOf = [](const MetSides& met) {
    return std::string(met.front ? "f" : "") + (met.back ? "b" : "") + (met.atOnce ? "o" : "") +
           (met.within ? "w" : "");
  };
  const auto textsOf = [&](const std::vector<char>& hasOpposite) {
    std::vector<std::string> texts;
    std::ranges::transform(findMetSides(mesh, 4, hasOpposite), std::back_inserter(texts), textOf);
    EXPECT_EQ(texts.size(), 4U + sideNumbers);
    EXPECT_EQ(std::accumulate(texts.begin() + 4, texts.end(), std::string()), texts[4 + zMax]);
    texts[4] = texts[4 + zMax];
    texts.resize(5);
    return texts;
  };
  EXPECT_THAT(textsOf({}), ElementsAre("f", "bo", "fbo", "w", "b"));
  EXPECT_THAT(textsOf({1, 0, 0, 0, 0}), ElementsAre("fo", "b", "fb", "w", "b")) << "as given";
}

TEST(MetSides, HaveTwoSidesApartOnlyIfSomeFaceHasBothAtOnce)
{
  for (unsigned bits = 0; bits < 16; ++bits)
  {
    const MetSides met{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
    EXPECT_EQ(met.isTwoSided(), (bits & 7) == 7);
    EXPECT_EQ(met.hasBoundary(), (bits & 3) != 0);
    for (unsigned more = 0; more < 16; ++more)
    {
      MetSides sum = met;
      sum.add({(more & 1) != 0, (more & 2) != 0, (more & 4) != 0, (more & 8) != 0});
      const unsigned both = bits | more;
      EXPECT_TRUE(sum.front == ((both & 1) != 0) && sum.back == ((both & 2) != 0));
      EXPECT_TRUE(sum.atOnce == ((both & 4) != 0) && sum.within == ((both & 8) != 0));
    }
  }
}

} // namespace
