// SPDX-License-Identifier: GPL-3.0-or-later
/// The example building, 4,188 m2 of sheets with 62 m2 of openings, at 1 to 8 m: what its mesh keeps.
#include "CheckWritten.h"
#include "Domain/Domain.h"
#include "Layer/LayerWalls.h"
#include "Support/DualMeshChecks.h"
#include "Support/FeatureChecks.h"
#include "Support/Shapes.h"
#include "Support/TestPaths.h"
#include "SurfaceInput.h"
#include "VtkSurface.h"

#include <vtkPolyData.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

namespace {

using namespace atria;
using namespace atria::testing;

/// As make_building.py says.
constexpr double sheetArea = 4188.0;
constexpr double openingArea = 62.0;
const Vec3 middle(39.3 / 2.0, 10.0, 0.0);

struct Case
{
  const char* model;
  double turnedBy; ///< degrees, in addition to the model's own
  double sizeMid;
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << c.model << ", turned by " << c.turnedBy << ", SizeMid " << c.sizeMid;
}

/// Turns what is not of the site, as the model's script does.
void turnBuilding(TriangleSurface& surface, double degrees)
{
  std::set<Index> onSite;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.names[surface.surfaceIds[t]] == "Site")
    {
      onSite.insert(surface.triangles[t].begin(), surface.triangles[t].end());
    }
  }
  TriangleSurface all = surface;
  for (Vec3& p : all.points)
  {
    p -= middle;
  }
  turn(all, degrees);
  for (Index i = 0; i < surface.points.size(); ++i)
  {
    surface.points[i] = onSite.count(i) > 0 ? surface.points[i] : Vec3(all.points[i] + middle);
  }
}

void turnOpenings(std::vector<Opening>& openings, double degrees)
{
  for (Opening& opening : openings)
  {
    TriangleSurface outline;
    addSurface(outline, opening.name, opening.outline, {});
    turnBuilding(outline, degrees);
    opening.outline = outline.points;
  }
}

GridOptions gridOf(const TriangleSurface& surface, double sizeMid)
{
  GridOptions grid;
  grid.domain = siteDomain(surface, "Site");
  grid.sizeMin = 1.0;
  grid.sizeMid = sizeMid;
  grid.sizeMax = 8.0;
  return grid;
}

class Building : public ::testing::TestWithParam<Case>
{
protected:
  Building()
  {
    const std::string model = GetParam().model;
    surface = surfaceFromVtk({exampleModel((model + ".wrl").c_str())}).surface;
    openings = readOpenings(dataFolder().parent_path().parent_path() / "Examples/Data" / (model + "_openings.csv"));
    if (GetParam().turnedBy != 0.0)
    {
      turnBuilding(surface, GetParam().turnedBy);
      turnOpenings(openings, GetParam().turnedBy);
    }
    meshed = meshIt(surface, gridOf(surface, GetParam().sizeMid), {}, 2);
  }

  void record(const std::string& key, double value) { RecordProperty(key, std::to_string(value)); }

  TriangleSurface surface;
  std::vector<Opening> openings;
  Meshed meshed;
};

TEST_P(Building, AllRoomsAreOneZoneWithTheOpen) { EXPECT_EQ(meshed.result.keptZones, std::vector<char>{1}); }

TEST_P(Building, SheetsHaveTheirAreaOnBothSides)
{
  double model = 0.0, front = 0.0, back = 0.0;
  for (const SurfaceArea& area : FeatureChecks(meshed).areas())
  {
    if (area.name != "Site")
    {
      model += area.model;
      front += area.front;
      back += area.back;
      EXPECT_NEAR(area.front, area.back, 0.005 * area.model) << area.name;
      EXPECT_NEAR(area.once, area.model, 0.02 * area.model) << area.name;
      record(area.name, area.once);
    }
  }
  record("Model", model);
  record("Front", front);
  record("Back", back);
  ASSERT_NEAR(model, sheetArea, 0.5);
  EXPECT_NEAR(front / sheetArea, 1.0, 0.005);
  EXPECT_NEAR(back / sheetArea, 1.0, 0.005);
}

TEST_P(Building, OpeningsAreOpen)
{
  double area = 0.0, blocked = 0.0;
  for (const OpeningFigures& opening : FeatureChecks(meshed).openings(openings))
  {
    area += opening.area;
    blocked += opening.blocked;
  }
  record("Blocked", blocked);
  ASSERT_NEAR(area, openingArea, 0.1);
  EXPECT_LE(blocked, 0.1);
}

TEST_P(Building, WindowsAreRectangles)
{
  int windows = 0;
  for (const OpeningFigures& opening : FeatureChecks(meshed).openings(openings))
  {
    if (opening.name.find("Window") != std::string::npos)
    {
      ++windows;
      EXPECT_NEAR(opening.area, 3.0, 1e-6) << opening.name;
      EXPECT_LE(opening.corner, 0.05) << opening.name;
      EXPECT_GE(opening.outline, 0.999) << opening.name;
      EXPECT_LE(opening.blocked, 0.01 * opening.area) << opening.name;
    }
  }
  EXPECT_EQ(windows, 14);
}

TEST_P(Building, CurvesOfTheModelAreEdgesOfTheMesh)
{
  const CurveCoverage curves = FeatureChecks(meshed).curves();
  record("Curves", curves.total.featureRatio());
  record("CurvesAnyEdge", curves.total.anyRatio());
  EXPECT_GT(curves.total.length, 1000.0);
  EXPECT_GE(curves.total.featureRatio(), 0.99);
  for (std::size_t kind = 0; kind < curves.ofKind.size(); ++kind)
  {
    record(curveKindNames[kind], curves.ofKind[kind].featureRatio());
    EXPECT_GE(curves.ofKind[kind].featureRatio(), 0.99) << curveKindNames[kind];
  }
  for (std::size_t i = 0; HasFailure() && i < std::min<std::size_t>(curves.misses.size(), 10); ++i)
  {
    const CurveMiss& miss = curves.misses[i];
    ADD_FAILURE() << miss.missed << " m of " << miss.length << " m at " << miss.middle.transpose() << ", "
                  << curveKindNames[static_cast<int>(miss.kind)] << " of " << miss.names;
  }
}

TEST_P(Building, WallsAreCoveredByFacesOfTheirName)
{
  double worst = 1.0;
  for (const NameCoverage& name : FeatureChecks(meshed).names())
  {
    if (name.name != "Site")
    {
      worst = std::min({worst, name.front, name.back});
      EXPECT_GE(name.front, 0.995) << name.name;
      EXPECT_GE(name.back, 0.995) << name.name;
    }
  }
  record("Worst", worst);
}

INSTANTIATE_TEST_SUITE_P(AlignedAndTurned, Building,
                         ::testing::Values(Case{"building", 0.0, 2.0}, Case{"building", 0.0, 1.0},
                                           Case{"building_turned17", 0.0, 2.0}, Case{"building_turned17", 0.0, 1.0},
                                           Case{"building", 30.0, 2.0}, Case{"building", 45.0, 2.0}),
                         [](const auto& test) {
                           const int more = static_cast<int>(test.param.turnedBy);
                           return std::string(test.param.model) + (more ? "_turned" + std::to_string(more) : "") +
                                  "_SizeMid" + std::to_string(static_cast<int>(test.param.sizeMid));
                         });

/// Degrees and the number of layers.
/// Share of the area of the building's walls on which elements of all layers stand; they may taper off to an edge.
double shareWithAll(const Meshed& meshed, int layers)
{
  const DualMesh& mesh = meshed.mesh();
  double all = 0.0, area = 0.0;
  for (std::size_t f = 0; f < meshed.result.layers.counts.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    if (face.tag < meshed.model.names.size() && meshed.model.names[face.tag] != "Site")
    {
      const double own = wallNormal(mesh, face).norm();
      area += own;
      all += meshed.result.layers.counts[f] == layers ? own : 0.0;
    }
  }
  return all / area;
}

class LayeredBuilding : public ::testing::TestWithParam<std::tuple<double, int>>
{
};

TEST_P(LayeredBuilding, PassesAllOfCheckMesh)
{
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
  const auto [degrees, layers] = GetParam();
  TriangleSurface surface = surfaceFromVtk({exampleModel("building.wrl")}).surface;
  turnBuilding(surface, degrees);
  DualMeshOptions options;
  options.layers = {{"*", {layers}}};
  const Meshed meshed = meshIt(surface, gridOf(surface, 2.0), options, 2);
  double covered = 0.0, area = 0.0;
  for (const LayerCoverage& report : meshed.result.layers.surfaces)
  {
    covered += report.layered;
    area += report.area;
  }
  EXPECT_GE(covered / area, 0.98);
  EXPECT_GE(shareWithAll(meshed, layers), 0.98);
  // The two sides of sheets stay together.
  EXPECT_NEAR(totalVolume(meshed.mesh()) / siteDomain(surface, "Site").size().prod(), 1.0, 1e-9);
  const CheckMeshReport report = checkAsWritten(meshed);
  EXPECT_THAT(report.failures, ::testing::IsEmpty());
  EXPECT_EQ(report.failedChecks, 0);
  // 60 degrees are a face squish of 0.5. Thin layers that bend about edges have more.
  EXPECT_LE(report.maxNonOrthogonality, layers == 1 ? 60.0 : 75.0);
}

INSTANTIATE_TEST_SUITE_P(OneAndFive, LayeredBuilding,
                         ::testing::Combine(::testing::Values(0.0, 17.0, 30.0, 45.0), ::testing::Values(1, 5)),
                         [](const auto& test) {
                           return "Turned" + std::to_string(static_cast<int>(std::get<0>(test.param))) + "_Layers" +
                                  std::to_string(std::get<1>(test.param));
                         });

} // namespace
