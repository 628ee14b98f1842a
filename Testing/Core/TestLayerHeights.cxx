// SPDX-License-Identifier: GPL-3.0-or-later
/// Layers whose first height is given have that height, cover all walls, and make cells that checkMesh accepts.
#include "Mesher/Improvement/PartialMesh.h"
#include "Mesher/MeshModel.h"
#include "Quality/Unions/JudgedUnions.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <numeric>
#include <tuple>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::isValid;
using atria::testing::quietContext;
using atria::testing::turn;

/// A building with a sheet beside it and one on top, on the bottom of the domain.
TriangleSurface building(double degrees)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-2.0, -1.5, 0.0), Vec3(2.0, 1.5, 2.5)});
  addSheet(surface, "Fence", Vec3(2.7, -1.5, 0.0), Vec3(0, 3.0, 0), Vec3(0, 0, 1.2));
  addSheet(surface, "Sign", Vec3(-1.0, 0.1, 2.5), Vec3(2.0, 0, 0), Vec3(0, 0, 1.0));
  turn(surface, degrees);
  return surface;
}

MeshedModel meshed(double degrees, const std::vector<LayerRule>& rules, double size)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3(-6, -6, 0), Vec3(6, 6, 6)};
  options.sizes.sizeMin = options.sizes.sizeMid = size;
  options.sizes.sizeMax = 4.0 * size;
  options.mesh.layers = rules;
  const ThreadExecutor executor(2);
  return meshModel(building(degrees), options, quietContext(executor));
}

/// Returns the height of an element above one of its faces, on average, and the area of this face.
std::pair<double, double> heightAndArea(const DualMesh& mesh, const BoundaryFace& face)
{
  const std::array<Index, 4> corners = cornersOf(mesh, face);
  Vec3 middle = Vec3::Zero();
  std::ranges::for_each(corners, [&](Index p) { middle += 0.25 * mesh.points[p]; });
  const Vec3 across =
      (mesh.points[corners[2]] - mesh.points[corners[0]]).cross(mesh.points[corners[3]] - mesh.points[corners[1]]);
  double height = 0.0;
  int count = 0;
  for (const Index p : mesh.corners[face.element])
  {
    if (std::ranges::find(corners, p) == corners.end())
    {
      height += std::abs(across.normalized().dot(mesh.points[p] - middle));
      ++count;
    }
  }
  return {count > 0 ? height / count : 0.0, 0.5 * across.norm()};
}

/// Returns the part of the area of the house on which the first layer has a height, to a tenth.
double partOfHeight(const MeshedModel& model, double height)
{
  const auto house = std::ranges::find(model.names, "House") - model.names.begin();
  double area = 0.0;
  double exact = 0.0;
  for (const BoundaryFace& face : model.mesh.boundaryFaces)
  {
    if (static_cast<std::ptrdiff_t>(face.tag) == house)
    {
      const auto [first, ofFace] = heightAndArea(model.mesh, face);
      area += ofFace;
      exact += std::abs(first - height) <= 0.1 * height ? ofFace : 0.0;
    }
  }
  return exact / area;
}

const LayerCoverage& coverageOf(const MeshedModel& model, const std::string& surface)
{
  return *std::ranges::find(model.layers.surfaces, surface, &LayerCoverage::surface);
}

/// Returns what fails of the mesh as it is written.
std::vector<std::string> failuresOf(const DualMesh& mesh)
{
  std::vector<Index> all(mesh.elementCount());
  std::iota(all.begin(), all.end(), Index{0});
  const PartialMesh whole = makePartialMesh(mesh, all);
  return uniteAndJudge([&] { return whole.mesh; }, whole.patchOf, {}, quietContext()).failures;
}

class LayerHeights : public ::testing::TestWithParam<std::tuple<double, WallLayers>>
{
};

TEST_P(LayerHeights, AreThoseAskedForOnValidMeshes)
{
  const auto& [degrees, layers] = GetParam();
  const MeshedModel model = meshed(degrees, {{"*", layers}}, 0.25);
  EXPECT_TRUE(isValid(model.mesh, 0));
  EXPECT_THAT(failuresOf(model.mesh), ::testing::IsEmpty());
  const LayerCoverage& house = coverageOf(model, "House");
  EXPECT_GE(house.full, 0.98 * house.area);
  EXPECT_NEAR(house.thickness, 1.0, 0.1);
  EXPECT_GE(partOfHeight(model, layers.firstHeight), 0.75) << "edges are near on so small a house";
}

INSTANTIATE_TEST_SUITE_P(Rules, LayerHeights,
                         ::testing::Combine(::testing::Values(0.0, 17.0, 30.0, 45.0),
                                            ::testing::Values(WallLayers{1, 0.06, 1.0}, WallLayers{4, 0.025, 1.2},
                                                              WallLayers{6, 0.01, 1.3})),
                         [](const auto& one) {
                           return "TurnedBy" + std::to_string(static_cast<int>(std::get<0>(one.param))) + "Of" +
                                  std::to_string(std::get<1>(one.param).layers);
                         });

/// Elements below layers as thin as these have weights that are not valid on any wall. Layers stay thin all the same,
/// though most are a little higher than asked for, as elements would not be sound near edges.
TEST(LayerHeights, AreSmallWhereLayersAreThin)
{
  const MeshedModel model = meshed(17.0, {{"*", {3, 0.002, 1.2}}}, 0.25);
  EXPECT_TRUE(isValid(model.mesh, 0));
  const LayerCoverage& house = coverageOf(model, "House");
  EXPECT_GE(house.full, 0.98 * house.area);
  EXPECT_LE(house.thickness, 3.0);
}

/// Where layers at the fence are taken away, those of the house stay beside the ground, which has one.
TEST(LayerHeights, StayWhereManyLayersMeetAWallWithOne)
{
  const MeshedModel model = meshed(17.0, {{"*", {12, 0.012, 1.0}}, {"zMin", {1}}}, 0.25);
  EXPECT_TRUE(isValid(model.mesh, 0));
  const LayerCoverage& house = coverageOf(model, "House");
  const LayerCoverage& fence = coverageOf(model, "Fence");
  EXPECT_LT(fence.full, 0.98 * fence.area) << "else nothing is taken away";
  EXPECT_GE(house.full, 0.9 * house.area) << "it is 93 %, and 87 % if a step of more than four is never left";
}

TEST(LayerHeights, AreRefusedBeyondTheDomain)
{
  try
  {
    meshed(0.0, {{"*", {1}}, {"Fence", {2, 12.5, 1.0}}}, 0.5);
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'Fence': the first height of 12.5 m exceeds the domain"));
  }
}

} // namespace
