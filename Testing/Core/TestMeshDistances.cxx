// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests distances between a mesh and its model.
#include "Audit/MeshDistances.h"
#include "AuditSetting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Setting;

/// Returns the corners of the loop of a face, then its middle.
std::vector<Vec3> placesOf(const DualMesh& mesh, Index element, std::uint8_t direction)
{
  std::vector<Vec3> places;
  const ReducedFace face = faceOf(mesh.corners[element], direction);
  std::ranges::transform(face.loop(), std::back_inserter(places), [&](Index p) { return mesh.points[p]; });
  places.push_back(std::accumulate(places.begin(), places.end(), Vec3(Vec3::Zero())) / face.count);
  return places;
}

TEST(MeshDistances, OfFacesAreThoseOfTheirFarthestCornerOrMiddle)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-0.4, 0.4);
  for (int round = 0; round < 20; ++round)
  {
    Setting setting;
    setting.addPlane(0, 0.5);
    setting.addRow(5, 0.0, 0.5, 0);
    std::ranges::for_each(setting.mesh.points, [&](Vec3& p) { p[2] += round == 0 ? 0.25 : some(random); });
    double expected = 0.0;
    Vec3 at;
    for (const BoundaryFace& face : setting.mesh.boundaryFaces)
    {
      for (const Vec3& place : placesOf(setting.mesh, face.element, face.direction))
      {
        at = std::abs(place[2] - 0.5) > expected + 1e-9 ? place : at;
        expected = std::max(expected, std::abs(place[2] - 0.5));
      }
    }
    const FarthestPlace found = setting.measure()[0].ofFaces;
    EXPECT_NEAR(found.distance, expected, 1e-6);
    EXPECT_NEAR(found.inElements, expected / 0.25, 1e-5);
    EXPECT_TRUE(round == 0 || (found.at - at).norm() < 1e-9);
    EXPECT_EQ(setting.measure({}, {}, 3)[0].ofFaces.at, found.at);
  }
}

TEST(MeshDistances, OfFacesKnowTheirMiddles)
{
  // Corners on the tips of a roof that is turned over, whose valley is below the middle.
  Setting setting;
  setting.addTriangle(0, {Vec3(0, -1, 0), Vec3(0, 2, 0), Vec3(0.5, 0.5, -0.5)});
  setting.addTriangle(0, {Vec3(1, 2, 0), Vec3(1, -1, 0), Vec3(0.5, 0.5, -0.5)});
  setting.addRow(1, 0.0, 0.0, 0);
  const FarthestPlace found = setting.measure()[0].ofFaces;
  EXPECT_NEAR(found.distance, 0.5 / std::sqrt(2.0), 1e-6);
  EXPECT_LT((found.at - Vec3(0.5, 0.5, 0)).norm(), 1e-12);
}

TEST(MeshDistances, AreLargestInSizesOfElements)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 4.0, 0.0, 0);
  for (Vec3& p : setting.mesh.points)
  {
    p[2] += p[1] > 3.0 ? 0.75 : 0.5;
  }
  setting.mesh.levels[2] = setting.mesh.levels[3] = static_cast<std::uint8_t>(setting.finest - 1);
  const FarthestPlace found = setting.measure()[0].ofFaces;
  EXPECT_NEAR(found.distance, 0.5, 1e-6) << "0.75 are fewer elements of 0.5";
  EXPECT_NEAR(found.inElements, 2.0, 1e-5);
}

TEST(MeshDistances, OfPointsAreInElementsOfTheirFirstFace)
{
  for (const Index coarse : {0U, 1U})
  {
    Setting setting;
    setting.addPlane(0, 0.0);
    setting.addRow(2, 0.0, 0.0, 0);
    setting.mesh.points[setting.numberOf(Vec3(1, 0, 0))][2] = -0.5; // both faces have it
    setting.mesh.levels[coarse] = static_cast<std::uint8_t>(setting.finest - 1);
    const FarthestPlace found = setting.measure()[0].ofFaces;
    EXPECT_NEAR(found.inElements, coarse == 0 ? 1.0 : 2.0, 1e-5);
    EXPECT_NEAR(found.distance, 0.5, 1e-6);
  }
}

TEST(MeshDistances, OfFacesAreFromTheirOwnSurface)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 6.0); // far beyond the other one
  setting.addPlane(2, -0.25);
  setting.model.names.emplace_back("Empty");
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 2.0, 0.0, 1);
  setting.addRow(2, 4.0, 0.0, 3); // of a surface without triangles
  setting.addRow(2, 6.0, 3.0, 4); // of a side of the domain
  const std::vector<SurfaceDistances> found = setting.measure();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].ofFaces.distance, 0.0);
  EXPECT_NEAR(found[1].ofFaces.distance, 6.0, 1e-6);
  EXPECT_NEAR(found[1].ofFaces.inElements, 24.0, 1e-4);
  EXPECT_EQ(found[2].ofFaces.distance, 0.0) << "it has no faces";
  EXPECT_EQ(found[3].ofFaces.distance, 0.0);
}

TEST(MeshDistances, AreThoseOfZoneFacesAndOfOwnElements)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(3, 0.0, 0.0, 0);
  setting.mesh.points[setting.numberOf(Vec3(3, 1, 0))][2] = 0.5;
  setting.mesh.boundaryFaces.pop_back();
  EXPECT_EQ(setting.measure()[0].ofFaces.distance, 0.0);
  setting.mesh.zoneFaces.push_back({2, 0, zMin, SheetSide::front});
  EXPECT_NEAR(setting.measure()[0].ofFaces.distance, 0.5, 1e-6);
  for (const Index owned : {1U, 2U})
  {
    const OwnElements part{[&](Index element) { return element == owned; }};
    EXPECT_NEAR(setting.measure({}, part)[0].ofFaces.distance, owned == 2 ? 0.5 : 0.0, 1e-6);
  }
}

TEST(MeshDistances, OfSamplesAreThoseFromTheNearestFace)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 4.0, 2.0, 1);
  const std::vector<std::pair<Vec3, double>> cases{{Vec3(0.3, 0.2, 0), 0.0},                   // on a face
                                                   {Vec3(1, 1, 0), 0.0},                       // on a point
                                                   {Vec3(1.5, 0.5, -2), 2.0},                  // below a face
                                                   {Vec3(2.75, 0.5, 0), 0.75},                 // beside an edge
                                                   {Vec3(5, 5, 0), 5.0},                       // off a corner
                                                   {Vec3(0.5, 4.5, 2), std::hypot(3.5, 2.0)}}; // on one of another
  for (const auto& [at, distance] : cases)
  {
    const std::vector<SurfaceDistances> found = setting.measure({{at, 0, 0.5F}});
    EXPECT_NEAR(found[0].ofSurface.distance, distance, 1e-6) << at.transpose();
    EXPECT_NEAR(found[0].ofSurface.inElements, 2.0 * distance, 1e-5);
    EXPECT_EQ(found[0].ofSurface.at, distance > 0.0 ? at : Vec3(Vec3::Zero()));
    EXPECT_EQ(found[1].ofSurface.distance, 0.0) << "it has no samples";
  }
}

TEST(MeshDistances, OfSamplesDoNotTakeTheFacesOfTheSampleBefore)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(1, 0.0, 0.0, 0);
  setting.addRow(1, 0.0, 2.0, 1);
  const Vec3 at(0.5, 0.4, 0.0); // on the face of surface 0
  const std::vector<SurfaceDistances> found = setting.measure({{at, 0, 0.5F}, {at, 1, 0.5F}, {at, 0, 0.5F}});
  EXPECT_EQ(found[0].ofSurface.distance, 0.0);
  EXPECT_NEAR(found[1].ofSurface.distance, 2.0, 1e-6);
}

TEST(MeshDistances, OfSamplesCountFromATenthOfAnElementOn)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  for (const double factor : {0.99, 1.01})
  {
    const double distance = factor * 0.1 * 0.5;
    const FarthestPlace found = setting.measure({{Vec3(0.5, 0.5, -distance), 0, 0.5F}})[0].ofSurface;
    EXPECT_NEAR(found.distance, factor < 1.0 ? 0.0 : distance, 1e-6);
  }
  EXPECT_EQ(setting.measure({{Vec3(0.5, 0.5, -3), 1, 0.5F}})[1].ofSurface.distance, 0.0) << "it has no faces";
}

TEST(MeshDistances, OfManySamplesAreLargestInSizesOfTheirEdges)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(4, 0.0, 0.0, 0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(0.0, 1.0);
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < 2500; ++i) // more than two pieces
  {
    samples.push_back({Vec3(4 * some(random), some(random), -4 * some(random)), 0, i % 3 == 0 ? 0.25F : 0.5F});
  }
  const auto inElements = [](const SurfaceSample& sample) { return -sample.at[2] / static_cast<double>(sample.size); };
  const SurfaceSample& farthest = *std::ranges::max_element(samples, {}, inElements);
  for (const int threads : {1, 3})
  {
    const FarthestPlace found = setting.measure(samples, {}, threads)[0].ofSurface;
    EXPECT_EQ(found.at, farthest.at);
    EXPECT_NEAR(found.inElements, inElements(farthest), 1e-5);
    EXPECT_NEAR(found.distance, -farthest.at[2], 1e-6);
  }
}

} // namespace
