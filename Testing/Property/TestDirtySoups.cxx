// SPDX-License-Identifier: GPL-3.0-or-later
/// Dirty models with known spaces: what must hold of their meshes.
#include "CheckWritten.h"
#include "Support/Campaign.h"
#include "Support/DirtySoups.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"
#include "Support/Watchdog.h"
#include "VtkDualMesh.h"

#include <Eigen/Geometry>

#include <vtkAbstractArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <gmock/gmock.h>

#include <array>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr int parts = 20;

/// ATRIA_TEST_SOUPS asks for another number of them in all, ATRIA_TEST_SOUP for a single one in place of each part.
std::vector<unsigned> soupsOfPart(int part)
{
  if (const char* single = std::getenv("ATRIA_TEST_SOUP"))
  {
    return {static_cast<unsigned>(std::atoi(single))};
  }
  const char* number = std::getenv("ATRIA_TEST_SOUPS");
  const int count = number != nullptr ? std::atoi(number) / parts : isFullCampaign() ? 50 : 3;
  std::vector<unsigned> seeds;
  for (int i = 0; i < count; ++i)
  {
    seeds.push_back(static_cast<unsigned>(part + parts * i));
  }
  return seeds;
}

/// The element whose corners' mean is nearest.
Index elementAt(const DualMesh& mesh, const Vec3& p)
{
  Index best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    Vec3 middle = Vec3::Zero();
    for (const Index c : mesh.corners[e])
    {
      middle += mesh.points[c] / 8.0;
    }
    const double distance = (middle - p).squaredNorm();
    if (distance < nearest)
    {
      nearest = distance;
      best = e;
    }
  }
  return best;
}

/// Whether a point lies in the box about an element. Seeds are two octants away from walls, so that none of a space
/// left out does.
bool isNearElement(const DualMesh& mesh, const Vec3& p)
{
  return std::any_of(mesh.corners.begin(), mesh.corners.end(), [&](const std::array<Index, 8>& corners) {
    Box3 box;
    for (const Index c : corners)
    {
      box.extend(mesh.points[c]);
    }
    return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
  });
}

void expectSpaces(const DirtySoup& soup, const DualMesh& mesh)
{
  std::vector<std::int32_t> zones;
  for (const DirtySoup::Seed& seed : soup.seeds)
  {
    zones.push_back(mesh.zones[elementAt(mesh, seed.point)]);
  }
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const bool wanted = soup.seeds[i].space == soup.seeds[j].space;
      EXPECT_EQ(zones[i] == zones[j], wanted)
          << (wanted ? "a way is closed between " : "a leak between ") << soup.seeds[i].point.transpose() << " and "
          << soup.seeds[j].point.transpose();
    }
  }
}

void expectNothingLost(const DirtySoup& soup, const Meshed& meshed)
{
  std::set<Index> tags;
  for (const BoundaryFace& face : meshed.mesh().boundaryFaces)
  {
    tags.insert(face.tag);
  }
  for (const Index large : soup.large)
  {
    EXPECT_TRUE(tags.count(large) > 0) << soup.surface.names[large] << " has no face";
  }
  vtkNew<vtkPolyData> diagnostics;
  diagnosticsToVtk(meshed.result, meshed.model.names, diagnostics);
  auto* without = vtkStringArray::SafeDownCast(diagnostics->GetFieldData()->GetAbstractArray("SurfaceWithoutFaces"));
  ASSERT_NE(without, nullptr);
  std::set<std::string> listed;
  for (vtkIdType i = 0; i < without->GetNumberOfValues(); ++i)
  {
    listed.insert(without->GetValue(i));
  }
  for (Index s = 0; s < soup.surface.names.size(); ++s)
  {
    EXPECT_EQ(listed.count(soup.surface.names[s]) > 0, tags.count(s) == 0) << soup.surface.names[s];
  }
}

/// A room of 2 m, one of whose walls is there twice, cut along one diagonal and along the other. Its neighbors are cut
/// elsewhere, so that along its sides both copies meet each other alone, as the two halves of a fold do.
TEST(DoubledWall, KeepsItsRoomClosed)
{
  TriangleSurface room;
  addSheet(room, "Wall", {2, 0, 0}, {0, 2, 0}, {0, 0, 2});
  addSurface(room, "Again", {{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}}, {{0, 1, 3}, {1, 2, 3}});
  for (const auto& [a, u] : {std::pair(0.0, 0.7), std::pair(0.7, 1.3)})
  {
    for (const auto& [b, v] : {std::pair(0.0, 0.9), std::pair(0.9, 1.1)})
    {
      addSheet(room, "Opposite", {0, a, b}, {0, u, 0}, {0, 0, v});
      for (const double at : {0.0, 2.0})
      {
        addSheet(room, "Side", {a, at, b}, {u, 0, 0}, {0, 0, v});
        addSheet(room, "Floor", {a, b, at}, {u, 0, 0}, {0, v, 0});
      }
    }
  }
  for (int i = 0; i < 20; ++i)
  {
    SCOPED_TRACE(i);
    const Eigen::AngleAxisd turn(0.37 * i, Vec3(0.3 + 0.01 * i, 0.5, 0.7).normalized());
    TriangleSurface turned = room;
    for (Vec3& p : turned.points)
    {
      p = turn * (p - Vec3::Ones());
    }
    GridOptions grid;
    grid.domain = {Vec3::Constant(-4.0), Vec3::Constant(4.0)};
    grid.sizeMin = grid.sizeMid = grid.sizeMax = 0.25;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    EXPECT_GE(meshIt(turned, grid, options).result.keptZones.size(), 2u) << "the room is open";
  }
}

/// Of these soups an element each has two faces in one plane that cannot be made one: their common edge is a waist.
TEST(WaistsOfFaces, LeaveNoConcaveElement)
{
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
  for (const unsigned seed : {8140u, 6786u})
  {
    SCOPED_TRACE(seed);
    const DirtySoup soup = dirtySoup(seed);
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    options.layers = {{"*", {1}}};
    EXPECT_THAT(checkAsWritten(meshIt(soup.surface, soup.grid, options)).failures, ::testing::IsEmpty());
  }
}

class DirtySoups : public ::testing::TestWithParam<int>
{
};

TEST_P(DirtySoups, AreMeshedSoundlyAndKeepTheirSpaces)
{
  for (const unsigned seed : soupsOfPart(GetParam()))
  {
    const DirtySoup soup = dirtySoup(seed);
    const std::string what = "soup " + std::to_string(seed) + ": " + soup.description;
    SCOPED_TRACE(what);
    const Watchdog watchdog(what, std::chrono::seconds(120));
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    const Meshed meshed = meshIt(soup.surface, soup.grid, options);
    EXPECT_TRUE(isSound(meshed.mesh()));
    EXPECT_NEAR(totalVolume(meshed.mesh()) / soup.grid.domain.size().prod(), 1.0, 1e-6);
    expectSpaces(soup, meshed.mesh());
    expectNothingLost(soup, meshed);
  }
}

double leftOut(const DualMeshResult& result)
{
  double volume = 0.0;
  for (const Diagnostic& diagnostic : result.diagnostics)
  {
    volume += diagnostic.kind == Diagnostic::leftOutElement ? std::pow(diagnostic.width, 3) : 0.0;
  }
  return volume;
}

TEST_P(DirtySoups, HaveALayerAndNothingToObjectTo)
{
  for (const unsigned seed : soupsOfPart(GetParam()))
  {
    const DirtySoup soup = dirtySoup(seed);
    const std::string what = "soup " + std::to_string(seed) + ": " + soup.description;
    SCOPED_TRACE(what);
    const Watchdog watchdog(what, std::chrono::seconds(120));
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    options.layers = {{"*", {1}}};
    const Meshed meshed = meshIt(soup.surface, soup.grid, options);
    EXPECT_TRUE(elementsAreClosed(meshed.mesh()));
    EXPECT_TRUE(boundaryIsWatertight(meshed.mesh()));
    const double filled = totalVolume(meshed.mesh()) + leftOut(meshed.result);
    EXPECT_NEAR(filled / soup.grid.domain.size().prod(), 1.0, 1e-6);
    if (haveCheckMesh())
    {
      EXPECT_THAT(checkAsWritten(meshed).failures, ::testing::IsEmpty());
    }
  }
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
}

TEST_P(DirtySoups, LeaveOutSealedRoomsWhereTheOpenIsMeshed)
{
  const auto seed = static_cast<unsigned>(GetParam());
  const DirtySoup soup = dirtySoup(seed);
  const std::string what = "soup " + std::to_string(seed) + ": " + soup.description;
  SCOPED_TRACE(what);
  const Watchdog watchdog(what, std::chrono::seconds(120));
  const Meshed meshed = meshIt(soup.surface, soup.grid);
  const DualMesh& mesh = meshed.mesh();
  EXPECT_TRUE(isSound(mesh));
  for (const DirtySoup::Seed& place : soup.seeds)
  {
    EXPECT_EQ(isNearElement(mesh, place.point), place.space == 0) << place.point.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Part, DirtySoups, ::testing::Range(0, parts));

} // namespace
