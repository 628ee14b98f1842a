// SPDX-License-Identifier: GPL-3.0-or-later
/// Layers are conformal on every mesh, whatever points they leave out.
#include "Layer/BoundaryLayers.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <random>

namespace {

using namespace atria;
using namespace atria::testing;

Meshed meshSoup(const TriangleSurface& surface, unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.0), Vec3::Constant(4.0)};
  grid.sizeMin = seed % 2 == 0 ? 0.25 : 0.21;
  grid.sizeMid = 2.0 * grid.sizeMin;
  grid.sizeMax = 4.0 * grid.sizeMin;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  return meshIt(surface, grid, options);
}

LayerOptions layersEverywhere(const Meshed& meshed, int layers)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules({{"*", {layers}}}, meshed.model.names);
  return options;
}

/// Area vector and area of each tag and side.
std::map<std::pair<Index, SheetSide>, double> wallAreas(const DualMesh& mesh, Index surfaceCount)
{
  std::map<std::pair<Index, SheetSide>, double> areas;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 1; i + 1 < reduced.count && face.tag < surfaceCount; ++i)
    {
      const Vec3& p = mesh.points[reduced.points[0]];
      areas[{face.tag, face.side}] +=
          0.5 * (mesh.points[reduced.points[i]] - p).cross(mesh.points[reduced.points[i + 1]] - p).norm();
    }
  }
  return areas;
}

void expectLayersOn(const LayerMesh& layer, const DualMesh& plain, Index surfaceCount)
{
  const DualMesh& mesh = layer.mesh;
  EXPECT_TRUE(isSound(mesh, layer.plainElements));
  EXPECT_TRUE(facesAreUnique(mesh));
  EXPECT_EQ(wallAreas(mesh, surfaceCount), wallAreas(plain, surfaceCount));
  for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    ASSERT_EQ(mesh.neighbors[face.element][face.direction], ~static_cast<std::int32_t>(f));
    if (face.opposite != noIndex)
    {
      const Index behind = faceBehind(mesh, face);
      ASSERT_NE(behind, noIndex);
      ASSERT_EQ(mesh.boundaryFaces[behind].opposite, face.element);
    }
  }
}

void expectSame(const LayerMesh& a, const LayerMesh& b)
{
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.corners, b.mesh.corners);
  EXPECT_EQ(a.mesh.neighbors, b.mesh.neighbors);
  EXPECT_EQ(a.mesh.levels, b.mesh.levels);
  EXPECT_EQ(a.mesh.zones, b.mesh.zones);
  EXPECT_EQ(a.mesh.rooms, b.mesh.rooms);
  EXPECT_EQ(a.mesh.cellZones, b.mesh.cellZones);
  EXPECT_EQ(a.mesh.zoneFaces.size(), b.mesh.zoneFaces.size());
  EXPECT_TRUE(std::ranges::equal(a.mesh.boundaryFaces, b.mesh.boundaryFaces, {}, &BoundaryFace::element,
                                 &BoundaryFace::element));
  EXPECT_EQ(a.copies, b.copies);
  EXPECT_EQ(a.wallPoints, b.wallPoints);
  EXPECT_EQ(a.wallFaces, b.wallFaces);
}

TEST(LayerTopology, IsConformalOnRandomSoupsForAnyCounts)
{
  std::size_t prisms = 0;
  for (unsigned seed = 0; seed < campaign(30, 1000); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Meshed meshed = meshSoup(randomSoup(seed), seed);
    const DualMesh& plain = meshed.mesh();
    const auto surfaceCount = static_cast<Index>(meshed.model.names.size());
    const LayerWalls walls = findLayerWalls(plain, layersEverywhere(meshed, 3), quietContext());
    std::mt19937 random(seed);
    for (const unsigned share : {0u, 1u, 2u, 8u})
    {
      std::vector<Index> counts = walls.counts;
      for (Index& count : counts)
      {
        // All full, all of one layer, and ever fewer of up to three.
        count = share == 0              ? count
                : share == 1            ? std::min<Index>(count, 1)
                : random() % share == 0 ? random() % (count + 1)
                                        : 0;
      }
      LayerMesh layer = buildLayer(plain, walls, counts);
      expectLayersOn(layer, plain, surfaceCount);
      DualMesh given = plain;
      expectSame(takeLayer(given, walls, counts), layer);
      EXPECT_EQ(given.neighbors, plain.neighbors);
      EXPECT_EQ(given.boundaryFaces.size(), plain.boundaryFaces.size());
      prisms += layer.wallFaces.size();
      std::uniform_real_distribution<double> shift(-0.05, 0.05);
      for (std::size_t i = layer.plainPoints; i < layer.mesh.points.size(); ++i)
      {
        const Vec3 p = layer.mesh.points[i];
        const bool inside = p.cwiseAbs().maxCoeff() < 3.99;
        layer.mesh.points[i] += inside ? Vec3(shift(random), shift(random), shift(random)) : Vec3(Vec3::Zero());
      }
      EXPECT_NEAR(totalVolume(layer.mesh) / totalVolume(plain), 1.0, 1e-9);
    }
  }
  EXPECT_GT(prisms, 10000u);
}

TEST(LayerTopology, GrownLayersAreSoundOnRandomSoups)
{
  for (unsigned seed = 0; seed < campaign(20, 500); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Meshed meshed = meshSoup(randomSoup(seed), seed);
    const DualMesh& plain = meshed.mesh();
    const LayerOptions options = layersEverywhere(meshed, 3);
    const LayerWalls walls = findLayerWalls(plain, options, quietContext());
    std::mt19937 random(seed);
    std::vector<char> excluded(plain.points.size());
    std::generate(excluded.begin(), excluded.end(), [&] { return random() % (2 + seed) == 0; });
    const LayerMesh one = LayerGrower(walls, options).grow(plain, excluded, quietContext());
    const LayerMesh divided = divideLayer(plain, walls, one, options, layersWanted(walls, one));
    for (const LayerMesh* layer : {&one, &divided})
    {
      expectLayersOn(*layer, plain, static_cast<Index>(meshed.model.names.size()));
      EXPECT_NEAR(totalVolume(layer->mesh) / totalVolume(plain), 1.0, 1e-9);
      for (std::size_t p = 0; p < excluded.size(); ++p)
      {
        ASSERT_TRUE(!excluded[p] || layer->copies[p] == noIndex);
      }
    }
  }
}

} // namespace
