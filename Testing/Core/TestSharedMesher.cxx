// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that several ranks make together.
#include "Ranks/RankMesh.h"
#include "Ranks/SharedModel.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/PieceOf.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/ThreadRanks.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <string>
#include <utility>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr std::size_t blockSize = 1000;

GridOptions gridOf(double sizeMin, double sizeMid)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  grid.sizeMin = sizeMin;
  grid.sizeMid = sizeMid;
  grid.sizeMax = 0.8;
  return grid;
}

class SharedMesher : public OnNumbersOfRanks
{
};

/// A mesh as a rank has it; the mesh is the piece's.
struct SharedDual
{
  DualMeshResult found;
  SharedPiece piece;
};

SharedDual makeOnRank(const Meshed& whole, const DualMeshOptions& options, const RankShare& share,
                      const ShareRows& rows, std::atomic<std::size_t>* leaves = nullptr)
{
  RankMesh port(share, share.makeOctree(whole.model, rows, quietContext()), 1);
  if (leaves)
  {
    *leaves += port.octree().leafCount();
  }
  StageClock clock;
  const DrawnModel drawn = whole.drawn(quietContext());
  SharedDual dual;
  dual.found = makeDualMesh(port.octree(), whole.model, options, clock, quietContext(), nullptr, &drawn, port);
  dual.piece = port.takePiece();
  dual.piece.mesh = std::move(dual.found.mesh);
  return dual;
}

void expectLayers(const DualMeshResult& whole, const SharedDual& dual)
{
  ASSERT_EQ(dual.found.layers.counts.size(), whole.layers.counts.empty() ? 0U : dual.piece.mesh.boundaryFaces.size());
  std::size_t wrong = 0;
  for (std::size_t f = 0; f < dual.found.layers.counts.size(); ++f)
  {
    const BoundaryFace& face = dual.piece.mesh.boundaryFaces[f];
    const std::int32_t code = whole.mesh.neighbors[dual.piece.elementNumbers[face.element]][face.direction];
    const Index other = DualMesh::boundaryFaceOf(code);
    wrong += dual.found.layers.counts[f] != whole.layers.counts[other];
    wrong += dual.found.layers.thicknesses[f] != whole.layers.thicknesses[other];
  }
  EXPECT_EQ(wrong, 0U);
  ASSERT_EQ(dual.found.layers.surfaces.size(), whole.layers.surfaces.size());
  for (std::size_t i = 0; i < whole.layers.surfaces.size(); ++i)
  {
    const LayerCoverage& own = dual.found.layers.surfaces[i];
    const LayerCoverage& other = whole.layers.surfaces[i];
    EXPECT_EQ(own.surface, other.surface);
    EXPECT_EQ(own.area, other.area);
    EXPECT_EQ(own.layered, other.layered);
    EXPECT_EQ(own.full, other.full);
    EXPECT_EQ(own.thickness, other.thickness);
    EXPECT_EQ(own.firstHeight, other.firstHeight);
  }
}

void expectZones(const std::vector<ZoneSummary>& whole, const std::vector<ZoneSummary>& shared)
{
  ASSERT_EQ(shared.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    EXPECT_EQ(shared[i].elements, whole[i].elements);
    EXPECT_EQ(shared[i].kept, whole[i].kept);
    EXPECT_EQ(shared[i].sides, whole[i].sides);
    EXPECT_EQ(shared[i].inside, whole[i].inside);
    EXPECT_EQ(shared[i].surfaces, whole[i].surfaces);
    EXPECT_EQ(shared[i].volume, whole[i].volume);
    EXPECT_EQ(shared[i].kind, whole[i].kind);
  }
}

void expectDiagnostics(const std::vector<Diagnostic>& whole, const std::vector<Diagnostic>& shared)
{
  ASSERT_EQ(shared.size(), whole.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    const Diagnostic& own = shared[i];
    const Diagnostic& other = whole[i];
    const bool isSame = own.kind == other.kind && own.begin == other.begin && own.end == other.end &&
                        own.element == other.element && own.width == other.width && own.between == other.between;
    wrong += isSame ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0U);
}

/// As far as it is made with the mesh.
void expectAudit(const MeshAudit& whole, const MeshAudit& shared)
{
  EXPECT_EQ(shared.volumes.air, whole.volumes.air);
  EXPECT_EQ(shared.volumes.displacedByModel, whole.volumes.displacedByModel);
  ASSERT_EQ(shared.surfaces.size(), whole.surfaces.size());
  for (std::size_t i = 0; i < whole.surfaces.size(); ++i)
  {
    const SurfaceAudit& one = shared.surfaces[i];
    const SurfaceAudit& other = whole.surfaces[i];
    EXPECT_EQ(one.meshArea, other.meshArea);
    EXPECT_EQ(one.inSolid, other.inSolid);
    EXPECT_EQ(one.meanSize, other.meanSize);
    EXPECT_EQ(one.largestSize, other.largestSize);
    EXPECT_EQ(one.distances.ofFaces.distance, other.distances.ofFaces.distance);
    EXPECT_EQ(one.distances.ofSurface.distance, other.distances.ofSurface.distance);
  }
}

/// Returns how much of the octree a rank has on average.
double expectSameOnRanks(const Meshed& whole, const DualMeshOptions& options, int ranks, const ShareRows& rows = {})
{
  const RefinedSets sets = whole.octree.refinedSets();
  std::atomic<std::size_t> leaves = 0;
  std::atomic<std::size_t> faces = 0;
  std::atomic<std::size_t> elements = 0;
  onRanks(ranks, [&](RankExchange& exchange) {
    const RankShare share(sets, whole.model, whole.frame, blockSize, exchange, quietContext());
    ASSERT_GT(share.blocks().count(), 1U);
    const SharedDual dual = makeOnRank(whole, options, share, rows, &leaves);
    expectPiece(whole.mesh(), dual.piece, exchange.rank());
    expectLayers(whole.result, dual);
    expectZones(whole.result.zones, dual.found.zones);
    expectAudit(whole.result.audit, dual.found.audit);
    expectDiagnostics(exchange.rank() == 0 ? whole.result.diagnostics : std::vector<Diagnostic>(),
                      dual.found.diagnostics);
    faces += dual.piece.mesh.boundaryFaces.size();
    elements += static_cast<std::size_t>(std::ranges::count(dual.piece.elementRanks, exchange.rank()));
  });
  EXPECT_EQ(faces, whole.mesh().boundaryFaces.size());
  EXPECT_EQ(elements, whole.mesh().elementCount());
  return static_cast<double>(leaves) / static_cast<double>(ranks) / static_cast<double>(whole.octree.leafCount());
}

double expectSameOnRanks(const TriangleSurface& surface, const GridOptions& grid, DualMeshOptions options, int ranks)
{
  options.blockSize = blockSize;
  return expectSameOnRanks(meshIt(surface, grid, options), options, ranks);
}

TEST_P(SharedMesher, MeshIsThatOfOneRank)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    const TriangleSurface surface = randomSoup(seed);
    DualMeshOptions options;
    options.zoneRule = seed % 2 == 0 ? ZoneRule::all : ZoneRule::outside;
    expectSameOnRanks(surface, gridOf(0.1, 0.2), options, GetParam());
    for (const WallLayers& layers : {WallLayers{0}, WallLayers{1}, WallLayers{3}, WallLayers{3, 0.01, 1.2}})
    {
      SCOPED_TRACE(::testing::Message() << layers.layers << " from " << layers.firstHeight);
      options.layers = {{"*", layers}};
      expectSameOnRanks(surface, gridOf(0.1, 0.2), options, GetParam());
    }
  }
}

/// Surfaces in a row, with names of their own.
TriangleSurface rowOf(const std::vector<TriangleSurface>& surfaces, double distance)
{
  TriangleSurface row;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    const Vec3 offset(static_cast<double>(i) * distance, 0.0, 0.0);
    const auto firstPoint = static_cast<Index>(row.points.size());
    const auto firstName = static_cast<Index>(row.names.size());
    std::ranges::transform(surfaces[i].points, std::back_inserter(row.points),
                           [&](const Vec3& p) { return Vec3(p + offset); });
    for (const auto& [a, b, c] : surfaces[i].triangles)
    {
      row.triangles.push_back({a + firstPoint, b + firstPoint, c + firstPoint});
    }
    std::ranges::transform(surfaces[i].surfaceIds, std::back_inserter(row.surfaceIds),
                           [&](Index id) { return id + firstName; });
    std::ranges::transform(surfaces[i].names, std::back_inserter(row.names),
                           [&](const std::string& name) { return name + "_" + std::to_string(i); });
  }
  return row;
}

TriangleSurface rowOfSoups(unsigned seed, unsigned count, double distance)
{
  std::vector<TriangleSurface> soups;
  for (unsigned i = 0; i < count; ++i)
  {
    soups.push_back(randomSoup(100 * seed + i));
  }
  return rowOf(soups, distance);
}

/// In the scenes above ranks need all of the octree; here they have parts of it.
TEST(SharedSite, RanksThatHavePartsOfTheOctreeMakeTheSameMesh)
{
  constexpr unsigned scenes = 7;
  constexpr double distance = 8.0;
  for (unsigned seed = 1; seed <= 2; ++seed)
  {
    SCOPED_TRACE(seed);
    GridOptions grid = gridOf(0.25, 0.25);
    grid.sizeMax = seed % 2 == 0 ? 0.5 : 0.25;
    grid.domain.max[0] += (scenes - 1) * distance;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    options.layers = {{"*", {.layers = seed % 2 == 0 ? 3 : 1}}};
    options.blockSize = blockSize;
    const Meshed whole = meshIt(rowOfSoups(seed, scenes, distance), grid, options);
    EXPECT_LT(expectSameOnRanks(whole, options, 4), 0.75);
    // Among these are vertices that left the model, and that belong to a rank without an element there.
    expectSameOnRanks(whole, options, 5);
  }
}

TEST(SharedSite, RanksWithTooFewRowsMakeTheSameMeshOrTell)
{
  constexpr unsigned scenes = 7;
  constexpr double distance = 8.0;
  int told = 0;
  int made = 0;
  // How far elements of the first are from walls is not seen by ranks that have few rows.
  for (const unsigned seed : {8U, 9U, 13U})
  {
    SCOPED_TRACE(seed);
    GridOptions grid = gridOf(0.25, 0.25);
    grid.sizeMax = 0.5;
    grid.domain.max[0] += (scenes - 1) * distance;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    options.layers = {{"*", {.layers = 3}}};
    options.blockSize = blockSize;
    const Meshed whole = meshIt(rowOfSoups(seed, scenes, distance), grid, options);
    for (const ShareRows& few : {ShareRows{1, 1}, ShareRows{2, 1}, ShareRows{2, 2}})
    {
      SCOPED_TRACE(few.atWalls);
      try
      {
        expectSameOnRanks(whole, options, 7, few);
        ++made;
      }
      catch (const RanksDisagree&)
      {
        ++told;
      }
    }
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(made, 0);
}

TEST(SharedSite, RanksTakeMoreRowsUntilTheyAgree)
{
  constexpr ShareRows few{1, 1};
  constexpr double distance = 8.0;
  GridOptions grid = gridOf(0.25, 0.25);
  grid.sizeMax = 0.25;
  grid.domain.max[0] += 6.0 * distance;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.layers = {{"*", {.layers = 1}}};
  options.blockSize = blockSize;
  const TriangleSurface surface = rowOfSoups(1, 7, distance);
  const Meshed whole = meshIt(surface, grid, options);
  const RefinedSets sets = whole.octree.refinedSets();
  const auto makeWithFew = [&](RankExchange& exchange) {
    const RankShare share(sets, whole.model, whole.frame, blockSize, exchange, quietContext());
    makeOnRank(whole, options, share, few);
  };
  EXPECT_THROW(onRanks(4, makeWithFew), RanksDisagree);
  onRanks(4, [&](RankExchange& exchange) {
    const auto made = meshSharedModel(surface, optionsIn(grid, options), 1, exchange, quietContext(), few);
    expectPiece(whole.mesh(), made.value().piece, exchange.rank());
  });
}

TEST(SharedSite, RanksMakeWhatIsSealedTogether)
{
  TriangleSurface room;
  addBox(room, "Room", {Vec3(-2.1, -3.0, -1.4), Vec3(2.2, 3.1, 1.6)});
  const GridOptions grid = gridOf(0.1, 0.2);
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.blockSize = blockSize;
  options.sealedSeeds = {Vec3(0.0, 2.0, 0.0), Vec3(0.0, -2.0, 0.0)};
  const Meshed whole = meshIt(room, grid, options);
  ASSERT_TRUE(whole.result.leaks.empty());
  const auto makeOnRanks = [&](RankExchange& exchange, const TriangleSurface& surface) {
    return meshSharedModel(surface, optionsIn(grid, options), 1, exchange, quietContext());
  };
  onRanks(3, [&](RankExchange& exchange) {
    expectPiece(whole.mesh(), makeOnRanks(exchange, room).value().piece, exchange.rank());
  });
  TriangleSurface open = room;
  open.triangles.pop_back();
  open.surfaceIds.pop_back();
  ASSERT_EQ(meshIt(open, grid, options).result.leaks.size(), options.sealedSeeds.size());
  onRanks(3, [&](RankExchange& exchange) { EXPECT_FALSE(makeOnRanks(exchange, open).has_value()); });
  options.sealedSeeds = {Vec3(0.0, 0.0, 9.0)};
  onRanks(3, [&](RankExchange& exchange) { EXPECT_THROW(makeOnRanks(exchange, room), Error); });
}

/// Of the mesh, in order. Ranks do not know what is far from their shares.
std::vector<Vec3> pointsBefore(double x, const DualMesh& mesh)
{
  std::vector<Vec3> points;
  std::ranges::copy_if(mesh.points, std::back_inserter(points), [x](const Vec3& p) { return p[0] < x; });
  return points;
}

TEST(SharedSite, WhatIsFarAwayChangesNothing)
{
  constexpr double distance = 20.0;
  // Of the first two, moves of grid points about the one were made only while there were some about the other.
  std::vector<std::pair<unsigned, unsigned>> pairs{{21014, 21004}, {21014, 21012}};
  for (unsigned seed = 1; seed <= 30; ++seed)
  {
    pairs.emplace_back(seed, seed + 1);
  }
  for (const auto& [near, far] : pairs)
  {
    SCOPED_TRACE(near);
    GridOptions grid = gridOf(near % 2 == 0 ? 0.1 : 0.15, near % 2 == 0 ? 0.2 : 0.3);
    grid.domain.max[0] += distance;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    // The lattice depends on how far a model reaches, so both have the same box about what is far.
    TriangleSurface frame;
    addBox(frame, "Frame", {Vec3(distance - 9.0, -9.0, -9.0), Vec3(distance + 9.0, 9.0, 9.0)});
    const Meshed alone = meshIt(rowOf({randomSoup(near), frame}, 0.0), grid, options);
    const TriangleSurface pair = rowOf({randomSoup(near), randomSoup(far)}, distance);
    const Meshed both = meshIt(rowOf({pair, frame}, 0.0), grid, options);
    EXPECT_EQ(pointsBefore(0.5 * distance, both.mesh()), pointsBefore(0.5 * distance, alone.mesh()));
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedMesher, ::testing::Values(1, 2, 3, 5),
                         [](const auto& one) { return std::to_string(one.param); });

} // namespace
