// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the values on which the optimizer works: targets, measures, regions of cells, and colors of points.
#include "Optimize/Kernel/BoxCells.h"
#include "Optimize/Kernel/CellMeasure.h"
#include "Optimize/Kernel/Coloring.h"
#include "Optimize/Kernel/Extraction.h"
#include "Optimize/Kernel/MeasuredCells.h"
#include "Optimize/Kernel/QualityTargets.h"
#include "Optimize/Kernel/Region.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/Pieces.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::hexahedra;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::SampleMesh;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Loop = std::vector<Index>;

Loop upTo(std::size_t count)
{
  Loop numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

// Targets.

const std::vector<QualityRange> someRanges{{0.0, 1.0}, {0.1, 0.5}, {3.8, 2.0}, {-1.0, 4.0}, {2.0, -2.0}};

TEST(QualityRange, IsZeroAtTheLimitAndOneAtTheTarget)
{
  for (const QualityRange& range : someRanges)
  {
    EXPECT_EQ(range.of(range.limit), 0.0);
    EXPECT_EQ(range.of(range.target), 1.0);
    EXPECT_EQ(range.at(0.0), range.limit);
    EXPECT_DOUBLE_EQ(range.at(1.0), range.target);
    for (const double share : {-0.5, 0.25, 1.5})
    {
      EXPECT_NEAR(range.of(range.at(share)), share, 1e-12);
    }
  }
  EXPECT_DOUBLE_EQ((QualityRange{1.0, 5.0}).of(2.0), 0.25);
  EXPECT_DOUBLE_EQ((QualityRange{4.0, 2.0}).of(3.5), 0.25);
}

TEST(QualityRange, MovesItsTargetAwayFromTheLimit)
{
  for (const QualityRange& range : someRanges)
  {
    for (const double share : {-1.0, -0.5, 0.0, 0.25})
    {
      EXPECT_EQ(range.beyond(share).limit, range.limit);
      EXPECT_NEAR(range.of(range.beyond(share).target), 1.0 + share, 1e-12);
    }
  }
}

TEST(QualityRange, EasesItsLimitWithAnEasierTarget)
{
  struct Case
  {
    QualityRange before;
    double wanted;
    double limit;
  };
  const std::vector<Case> cases{{{0.1, 0.5}, 0.25, 0.05}, {{0.1, 0.5}, 0.75, 0.1}, {{0.1, 0.5}, 0.5, 0.1},
                                {{0.0, 0.5}, 0.25, 0.0},  {{4.0, 2.0}, 3.0, 6.0},  {{4.0, 2.0}, 1.0, 4.0}};
  for (const Case& one : cases)
  {
    QualityRange range = one.before;
    range.aimAt(one.wanted);
    EXPECT_EQ(range.target, one.wanted);
    EXPECT_DOUBLE_EQ(range.limit, one.limit) << one.wanted;
  }
}

constexpr std::array<QualityRange QualityTargets::*, 9> allRanges{
    &QualityTargets::pyramidCosine, &QualityTargets::convexity,     &QualityTargets::faceCosine,
    &QualityTargets::skewness,      &QualityTargets::weight,        &QualityTargets::volumeRatio,
    &QualityTargets::cornerVolume,  &QualityTargets::boundaryShape, &QualityTargets::determinantRoot};

TEST(QualityTargets, MoveAllOfTheirRanges)
{
  QualityTargets targets;
  targets.scaledJacobian = 0.4;
  targets.jacobianLimit = 0.1;
  for (const double share : {-0.5, 0.0, 0.2})
  {
    const QualityTargets beyond = targets.beyond(share);
    const QualityTargets within = targets.within(1.0 + share);
    for (const auto range : allRanges)
    {
      EXPECT_EQ((beyond.*range).limit, (targets.*range).limit);
      EXPECT_NEAR((targets.*range).of((beyond.*range).target), 1.0 + share, 1e-12);
      EXPECT_NEAR((within.*range).target, (beyond.*range).target, 1e-12);
    }
    EXPECT_DOUBLE_EQ(beyond.scaledJacobian, 0.4 * (1.0 + share));
    EXPECT_EQ(beyond.jacobianLimit, 0.1);
    EXPECT_EQ(beyond.convex, targets.convex);
  }
}

TEST(QualityTargets, HaveLimitsThatAreValidAndTargetsThatAreBetter)
{
  const QualityTargets targets;
  for (const auto range : allRanges)
  {
    const bool isSkewness = range == &QualityTargets::skewness;
    EXPECT_EQ((targets.*range).target < (targets.*range).limit, isSkewness) << "less skewness is better";
  }
  EXPECT_FALSE(targets.looksAtJacobians());
  QualityTargets looking;
  looking.scaledJacobian = 0.01;
  EXPECT_TRUE(looking.looksAtJacobians());
}

// Measures.

class RandomPlaces
{
public:
  explicit RandomPlaces(unsigned seed) : random(seed) {}
  Vec3 place() { return {some(random), some(random), some(random)}; }
  std::vector<Vec3> places(std::size_t count)
  {
    std::vector<Vec3> out(count);
    std::ranges::generate(out, [&] { return place(); });
    return out;
  }

private:
  std::mt19937 random;
  std::uniform_real_distribution<double> some{-2.0, 2.0};
};

auto pointsOf(const std::vector<Vec3>& points)
{
  return [&](std::size_t i) -> const Vec3& { return points.at(i); };
}

TEST(FaceMeasure, IsThatOfPolygons)
{
  RandomPlaces random(3);
  for (std::size_t round = 0; round < 100; ++round)
  {
    const std::size_t size = 3 + round % 5;
    const std::vector<Vec3> points = random.places(size);
    EXPECT_LT((crossOf(points[0], points[1]) - points[0].cross(points[1])).norm(), 1e-14);
    const PolygonMeasure expected = measurePolygon(points, upTo(size));
    for (const FaceMeasure& face : {measureFace(size, pointsOf(points)), measureAnyFace(size, pointsOf(points))})
    {
      EXPECT_LT((face.area - expected.area).norm(), 1e-12);
      EXPECT_LT((face.centroid - expected.centroid).norm(), 1e-12);
      EXPECT_NEAR(face.length, expected.area.norm(), 1e-12);
      EXPECT_LT((face.normal - expected.area.normalized()).norm(), 1e-12);
    }
  }
}

TEST(FaceMeasure, OfAFaceWithoutAreaHasNoNormal)
{
  for (const std::vector<Vec3>& points :
       {std::vector<Vec3>(3, Vec3(1, 2, 3)), std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}},
        std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {1, 2, 3}}})
  {
    const FaceMeasure face = measureFace(points.size(), pointsOf(points));
    EXPECT_EQ(face.length, 0.0);
    EXPECT_EQ(face.normal, Vec3(Vec3::Zero()));
    EXPECT_LT((face.centroid - Vec3(1, 2, 3)).norm(), 1e-14);
  }
}

TEST(FaceMeasure, HasThePerimeterOfAClosedPolygon)
{
  const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
  const std::vector<double> lengths{0.0, 6.0, 12.0, 14.0};
  for (std::size_t size = 1; size <= 4; ++size)
  {
    EXPECT_DOUBLE_EQ(perimeterOf(size, pointsOf(points)), lengths[size - 1]) << size;
  }
}

TEST(CellMeasure, IsThatOfPolygonsInOrder)
{
  RandomPlaces random(5);
  for (std::size_t round = 0; round < 100; ++round)
  {
    std::vector<PolygonMeasure> faces;
    for (std::size_t i = 0; i < round % 7; ++i)
    {
      faces.push_back({random.place(), random.place()});
    }
    const CellMeasureInOrder expected = measureCellInOrder(faces.size(), [&](std::size_t i) { return faces[i]; });
    Vec3 mean = Vec3::Zero();
    const CellMeasure cell = measureCell([&](auto&& visit) {
      mean = Vec3::Zero();
      for (const PolygonMeasure& face : faces)
      {
        mean += face.centroid / static_cast<double>(faces.size());
        visit(face.centroid, face.area);
      }
    });
    EXPECT_NEAR(cell.volume, expected.volume, 1e-12);
    EXPECT_LT((cell.mean - mean).norm(), 1e-12);
    EXPECT_LT((cell.centroid - expected.centroid).norm(), 1e-9 * (1.0 + expected.centroid.norm()));
  }
}

/// A mesh of faces with the arrays that a source needs.
struct Sample
{
  explicit Sample(SampleMesh cells)
      : sample(std::move(cells)), mesh(makeFaceMesh(sample.points, sample.view())), cellFaces(makeCellFaces(mesh)),
        arrays(sample.view()), source(mesh, cellFaces, arrays)
  {
  }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  SampleMesh sample;
  FaceMesh mesh;
  CellFaces cellFaces;
  CellArrays arrays;
  FaceMeshSource source;
};

TEST(CellMeasure, OfASourceHasTheMeanOfAllEdges)
{
  SampleMesh boxes = hexahedra({3, 1, 1});
  for (Vec3& p : boxes.points)
  {
    p = p.cwiseProduct(Vec3(1, 2, 6));
  }
  const Sample row(boxes);
  CellSource::Scratch scratch;
  std::vector<FaceMeasure> faces;
  for (Index cell = 0; cell < 3; ++cell)
  {
    const SizedCell sized = measureCell(row.source, cell, scratch, faces);
    EXPECT_NEAR(sized.measure.volume, 12.0, 1e-12);
    EXPECT_LT((sized.measure.centroid - Vec3(cell + 0.5, 1, 3)).norm(), 1e-12);
    EXPECT_NEAR(sized.size, 3.0, 1e-12);
    EXPECT_EQ(faces.size(), 6U);
  }
}

TEST(CellMeasure, WeighsAFaceByItsDistancesAlongItsNormal)
{
  FaceMeasure face{};
  face.centroid = Vec3(1, 1, 1);
  face.normal = Vec3::UnitX();
  CellMeasure own{};
  CellMeasure other{};
  const std::vector<std::array<double, 3>> cases{{0, 2, 0.5}, {0, 4, 0.25}, {-2, 2, 0.25}, {1, 2, 0.0}, {1, 1, 0.0}};
  for (const auto& [ownX, otherX, weight] : cases)
  {
    own.centroid = Vec3(ownX, 9, -3); // only the distance along the normal counts
    other.centroid = Vec3(otherX, -7, 5);
    EXPECT_DOUBLE_EQ(weightOf(face, own, other), weight);
    EXPECT_DOUBLE_EQ(weightOf(face, other, own), weight);
  }
}

TEST(CellMeasure, ComparesTheSmallerVolumeWithTheLarger)
{
  const std::vector<std::array<double, 3>> cases{{1, 1, 1},    {1, 4, 0.25}, {-1, 4, -0.25}, {-4, 1, -1},
                                                 {-4, -1, -1}, {0, 3, 0},    {0, 0, 0}};
  for (const auto& [a, b, ratio] : cases)
  {
    CellMeasure own{};
    CellMeasure other{};
    own.volume = a;
    other.volume = b;
    EXPECT_DOUBLE_EQ(volumeRatioOf(own, other), ratio) << a << ' ' << b;
    EXPECT_DOUBLE_EQ(volumeRatioOf(other, own), ratio) << a << ' ' << b;
  }
}

// Sources of cells.

/// Boxes along the axes as a dual mesh.
DualMesh boxesOf(const std::array<std::vector<double>, 3>& lengths)
{
  DualMesh mesh;
  const std::array<std::size_t, 3> n{lengths[0].size(), lengths[1].size(), lengths[2].size()};
  const auto placeOf = [&](std::size_t axis, std::size_t i) {
    return std::accumulate(lengths[axis].begin(), lengths[axis].begin() + static_cast<std::ptrdiff_t>(i), 0.0);
  };
  const auto eachOf = [](const std::array<std::size_t, 3>& counts, auto&& use) {
    for (std::size_t i = 0; i < counts[0] * counts[1] * counts[2]; ++i)
    {
      use(std::array{i % counts[0], i / counts[0] % counts[1], i / counts[0] / counts[1]});
    }
  };
  const auto pointAt = [&](const std::array<std::size_t, 3>& at) {
    return static_cast<Index>(at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2]));
  };
  eachOf({n[0] + 1, n[1] + 1, n[2] + 1}, [&](const std::array<std::size_t, 3>& at) {
    mesh.points.emplace_back(placeOf(0, at[0]), placeOf(1, at[1]), placeOf(2, at[2]));
  });
  eachOf(n, [&](const std::array<std::size_t, 3>& at) {
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const std::size_t bits = hexahedronCorner[c];
      corners[c] = pointAt({at[0] + (bits & 1U), at[1] + (bits >> 1 & 1U), at[2] + (bits >> 2 & 1U)});
    }
    std::array<std::int32_t, 6> neighbors{};
    const std::array<std::size_t, 3> steps{1, n[0], n[0] * n[1]};
    const auto own = static_cast<std::int32_t>(mesh.corners.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto step = static_cast<std::int32_t>(steps[axis]);
      neighbors[2 * axis] = at[axis] > 0 ? own - step : ~0;
      neighbors[2 * axis + 1] = at[axis] + 1 < n[axis] ? own + step : ~0;
    }
    mesh.corners.push_back(corners);
    mesh.neighbors.push_back(neighbors);
  });
  return mesh;
}

DualMesh cubes(std::array<std::size_t, 3> n)
{
  return boxesOf({std::vector<double>(n[0], 1.0), std::vector<double>(n[1], 1.0), std::vector<double>(n[2], 1.0)});
}

/// A face of a cell: its points outward, the lowest first, and the cell across.
using SeenFace = std::pair<Loop, Index>;

std::vector<SeenFace> facesOf(const CellSource& source, Index cell)
{
  CellSource::Scratch scratch;
  source.facesOf(cell, scratch);
  std::vector<SeenFace> out;
  for (const CellFace& face : scratch.faces)
  {
    out.push_back({{face.points.begin(), face.points.end()}, face.across});
  }
  return out;
}

std::multiset<SeenFace> sortedFacesOf(const CellSource& source, Index cell)
{
  std::multiset<SeenFace> out;
  for (SeenFace face : facesOf(source, cell))
  {
    std::ranges::rotate(face.first, std::ranges::min_element(face.first));
    out.insert(face);
  }
  return out;
}

Loop neighborsOf(const CellSource& source, Index cell)
{
  Loop out;
  source.neighborsOf(cell, out);
  return out;
}

Loop cornersOf(const CellSource& source, Index cell)
{
  Loop out;
  source.cornersOf(cell, out);
  return out;
}

/// The same mesh, given by its faces.
SampleMesh sampleOf(const DualMesh& mesh)
{
  SampleMesh sample;
  sample.points = mesh.points;
  for (const std::array<Index, 8>& corners : mesh.corners)
  {
    sample.addCell(hexahedronCell, {corners.begin(), corners.end()});
  }
  return sample;
}

TEST(CellSource, GivesTheSameCellsOfBothKindsOfMeshes)
{
  const DualMesh mesh = boxesOf({{{1, 2, 1}, {3, 1}, {1, 1, 4}}});
  const DualSource dual(mesh);
  const Sample faces(sampleOf(mesh));
  ASSERT_EQ(dual.cellCount(), faces.source.cellCount());
  std::mt19937 random(3);
  std::vector<char> marked(mesh.points.size());
  std::ranges::generate(marked, [&] { return static_cast<char>(random() % 9 == 0 ? 1 : 0); });
  for (Index cell = 0; cell < dual.cellCount(); ++cell)
  {
    EXPECT_EQ(sortedFacesOf(dual, cell), sortedFacesOf(faces.source, cell)) << cell;
    EXPECT_EQ(dual.nativeOf(cell).type, hexahedronCell);
    EXPECT_EQ(dual.nativeOf(cell).corners, faces.source.nativeOf(cell).corners);
    EXPECT_EQ(dual.hasMarked(cell, marked), faces.source.hasMarked(cell, marked));
    const bool expected = std::ranges::any_of(mesh.corners[cell], [&](Index p) { return marked[p] != 0; });
    EXPECT_EQ(dual.hasMarked(cell, marked), expected) << cell;
  }
}

TEST(CellSource, ListsNeighborsInTheOrderOfFaces)
{
  const DualMesh mesh = cubes({3, 2, 3});
  const DualSource dual(mesh);
  const Sample mixed(mixedCells({3, 3, 3}, 2));
  for (const CellSource* source :
       {static_cast<const CellSource*>(&dual), static_cast<const CellSource*>(&mixed.source)})
  {
    for (Index cell = 0; cell < source->cellCount(); ++cell)
    {
      Loop across;
      std::set<Index> corners;
      for (const auto& [loop, other] : facesOf(*source, cell))
      {
        across.insert(across.end(), other != noIndex ? 1 : 0, other);
        corners.insert(loop.begin(), loop.end());
      }
      EXPECT_EQ(neighborsOf(*source, cell), across) << cell;
      const Loop listed = cornersOf(*source, cell);
      EXPECT_EQ(std::set<Index>(listed.begin(), listed.end()), corners) << cell;
    }
  }
}

TEST(CellSource, KnowsBoxesUpToRounding)
{
  const DualMesh whole = boxesOf({{{1, 2, 1}, {3, 1}, {1, 5}}});
  CellBox box;
  ASSERT_TRUE(DualSource(whole).boxOf(1, box));
  EXPECT_EQ(box.lengths, Vec3(2, 3, 1));
  EXPECT_THAT(box.across, ElementsAre(0, 2, noIndex, 4, noIndex, 7));
  for (const double offset : {0.99e-7, 1.01e-7, -1.01e-7, -1.5})
  {
    for (std::size_t corner = 1; corner < 8; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        DualMesh mesh = whole;
        mesh.points[mesh.corners[1][hexahedronCorner[corner]]][axis] += offset;
        EXPECT_EQ(DualSource(mesh).boxOf(1, box), offset == 0.99e-7) << corner << ' ' << axis;
      }
    }
  }
  DualMesh noFace = whole;
  noFace.neighbors[1][zMin] = DualMesh::noFace;
  EXPECT_FALSE(DualSource(noFace).boxOf(1, box));
}

TEST(CellSource, HasNoHexahedronWithCoincidingCorners)
{
  DualMesh mesh = cubes({2, 1, 1});
  mesh.corners[0][6] = mesh.corners[0][7];
  mesh.neighbors[0][yMax] = ~0;
  EXPECT_EQ(DualSource(mesh).nativeOf(0).type, 0);
  EXPECT_EQ(DualSource(mesh).nativeOf(1).type, hexahedronCell);
}

TEST(CellSource, FindsMarkedCellsAndTheirNeighbors)
{
  const Sample mixed(mixedCells({4, 3, 3}, 3));
  const CellSource& source = mixed.source;
  std::mt19937 random(7);
  for (const int threads : {1, 3})
  {
    const ThreadExecutor executor(threads);
    std::vector<char> marked(source.points().size());
    std::ranges::generate(marked, [&] { return static_cast<char>(random() % 20 == 0 ? 1 : 0); });
    Loop points;
    Loop cells;
    std::set<Index> around;
    for (Index p = 0; p < marked.size(); ++p)
    {
      points.insert(points.end(), marked[p] != 0 ? 1 : 0, p);
    }
    for (Index cell = 0; cell < source.cellCount(); ++cell)
    {
      if (std::ranges::any_of(cornersOf(source, cell), [&](Index p) { return marked[p] != 0; }))
      {
        cells.push_back(cell);
        around.insert(cell);
        std::ranges::for_each(neighborsOf(source, cell), [&](Index other) { around.insert(other); });
      }
    }
    EXPECT_EQ(numbersOf(marked, executor), points);
    EXPECT_EQ(cellsWithMarked(source, marked, quietContext(executor)), cells);
    EXPECT_EQ(withNeighbors(source, cells, quietContext(executor)), Loop(around.begin(), around.end()));
  }
}

/// Cells of which each has one neighbor, half of all cells away.
class PairedCells : public CellSource
{
public:
  explicit PairedCells(Index halfOfCells) : half(halfOfCells) {}
  std::size_t cellCount() const override { return 2 * std::size_t{half}; }
  const std::vector<Vec3>& points() const override { return none; }
  void neighborsOf(Index cell, Loop& out) const override { out = {cell < half ? cell + half : cell - half}; }
  void cornersOf(Index, Loop& out) const override { out.clear(); }
  using CellSource::facesOf;
  void facesOf(Index, std::span<const Index>, Scratch&) const override {}
  bool hasMarked(Index, const std::vector<char>&) const override { return false; }

private:
  Index half;
  std::vector<Vec3> none;
};

TEST(CellSource, DividesCellsIntoPiecesWithTheirFarNeighbors)
{
  const PairedCells source(9000);
  Loop cells = upTo(source.cellCount());
  std::erase(cells, Index{9100});
  const std::vector<Loop> pieces = inPieces(source, cells);
  Loop all;
  std::map<Index, std::size_t> pieceOf;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    EXPECT_TRUE(i + 1 == pieces.size() || pieces[i].size() >= Pieces::length);
    EXPECT_LE(pieces[i].size(), Pieces::length + 1);
    all.insert(all.end(), pieces[i].begin(), pieces[i].end());
    std::ranges::for_each(pieces[i], [&](Index cell) { pieceOf[cell] = i; });
  }
  std::ranges::sort(all);
  EXPECT_EQ(all, cells);
  for (Index cell = 0; cell < 9000; ++cell)
  {
    EXPECT_TRUE(cell == 100 || pieceOf.at(cell) == pieceOf.at(cell + 9000)) << cell;
  }
  EXPECT_THAT(inPieces(source, {}), IsEmpty());
}

// Regions.

/// Checks the faces of a region. Returns the cell of the mesh behind each ghost.
Loop expectFaces(const Region& region, const CellSource& source)
{
  Loop ghosts(region.ghosts.size(), noIndex);
  std::size_t f = 0;
  for (Index local = 0; local < region.cellIds.size(); ++local)
  {
    for (const auto& [loop, across] : facesOf(source, region.cellIds[local]))
    {
      const auto found = std::ranges::lower_bound(region.cellIds, across);
      const bool isJudged = found != region.cellIds.end() && *found == across;
      const auto judged = static_cast<Index>(found - region.cellIds.begin());
      if (isJudged && judged < local)
      {
        continue;
      }
      Loop named;
      std::ranges::transform(region.face(f), std::back_inserter(named), [&](Index p) { return region.pointIds.at(p); });
      EXPECT_EQ(named, loop) << f;
      EXPECT_EQ(region.owner[f], local);
      const Index neighbor = region.neighbor[f++];
      if (across == noIndex || isJudged)
      {
        EXPECT_EQ(neighbor, across == noIndex ? noIndex : judged);
        continue;
      }
      Index& ghost = ghosts.at(neighbor - region.judgedCount());
      EXPECT_TRUE(ghost == noIndex || ghost == across);
      ghost = across;
    }
  }
  EXPECT_EQ(region.faceCount(), f);
  EXPECT_EQ(region.faceOffsets.size(), f + 1);
  EXPECT_EQ(region.faceOffsets.back(), region.facePoints.size());
  return ghosts;
}

/// Checks that each judged cell has its faces, in rising order.
void expectCellFaces(const Region& region)
{
  ASSERT_EQ(region.judgedCount(), region.cellIds.size());
  for (Index cell = 0; cell < region.judgedCount(); ++cell)
  {
    Loop expected;
    for (Index f = 0; f < region.faceCount(); ++f)
    {
      expected.insert(expected.end(), region.owner[f] == cell || region.neighbor[f] == cell ? 1 : 0, f);
    }
    EXPECT_TRUE(std::ranges::equal(region.facesOf(cell), expected)) << cell;
  }
}

/// Checks the ghosts, which are these cells, and the points and native cells.
void expectMeasures(const Region& region, const CellSource& source, const Loop& ghosts, bool withNatives)
{
  CellSource::Scratch scratch;
  std::vector<FaceMeasure> faces;
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    ASSERT_NE(ghosts[g], noIndex);
    const SizedCell expected = measureCell(source, ghosts[g], scratch, faces);
    EXPECT_EQ(region.ghosts[g].measure.centroid, expected.measure.centroid);
    EXPECT_EQ(region.ghosts[g].measure.volume, expected.measure.volume);
    EXPECT_EQ(region.ghosts[g].size, expected.size);
  }
  ASSERT_EQ(region.points.size(), region.pointIds.size());
  for (std::size_t p = 0; p < region.points.size(); ++p)
  {
    EXPECT_EQ(region.points[p], source.points()[region.pointIds[p]]);
  }
  ASSERT_EQ(region.natives.size(), withNatives ? region.cellIds.size() : 0);
  for (std::size_t cell = 0; cell < region.natives.size(); ++cell)
  {
    const NativeCell expected = source.nativeOf(region.cellIds[cell]);
    EXPECT_EQ(region.natives[cell].type, expected.type);
    for (std::size_t i = 0; i < shapeOf(expected.type).corners; ++i)
    {
      EXPECT_EQ(region.pointIds.at(region.natives[cell].corners[i]), expected.corners[i]);
    }
  }
}

/// Returns numbers in the order in which they are first met.
Loop firstMet(const std::vector<Loop>& lists, const Loop& without = {})
{
  Loop out;
  for (const Loop& list : lists)
  {
    for (const Index number : list)
    {
      if (std::ranges::count(out, number) == 0 && std::ranges::count(without, number) == 0)
      {
        out.push_back(number);
      }
    }
  }
  return out;
}

Loop someOf(std::size_t count, std::mt19937& random, unsigned oneIn)
{
  Loop numbers = upTo(count);
  std::erase_if(numbers, [&](Index) { return random() % oneIn != 0; });
  return numbers;
}

void expectRegion(const Region& region, const CellSource& source, const Loop& cells, bool withNatives, bool isInOrder)
{
  ASSERT_EQ(region.cellIds, cells);
  const Loop ghosts = expectFaces(region, source);
  expectCellFaces(region);
  expectMeasures(region, source, ghosts, withNatives);
  EXPECT_EQ(region.cellCount(), cells.size() + ghosts.size());
  std::vector<Loop> corners;
  std::vector<Loop> neighbors;
  for (const Index cell : cells)
  {
    corners.push_back(cornersOf(source, cell));
    neighbors.push_back(neighborsOf(source, cell));
  }
  Loop points = firstMet(corners);
  Loop around = firstMet(neighbors, cells);
  if (isInOrder)
  {
    std::ranges::sort(points);
    std::ranges::sort(around);
  }
  EXPECT_EQ(region.pointIds, points);
  EXPECT_EQ(ghosts, around);
}

TEST(Region, HasTheFacesOfItsCellsAndGhostsBeyondThem)
{
  std::mt19937 random(3);
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const Sample mixed(mixedCells({3, 3, 3}, seed, 0.1));
    const DualMesh boxes = cubes({4, 3, 3});
    const DualSource dual(boxes);
    const bool withNatives = seed % 2 == 0;
    for (const CellSource* source :
         {static_cast<const CellSource*>(&dual), static_cast<const CellSource*>(&mixed.source)})
    {
      const Loop cells = someOf(source->cellCount(), random, 1 + seed % 3);
      expectRegion(extractCells(*source, cells, withNatives, quietContext()), *source, cells, withNatives, false);
      Extraction inOrder(*source, cells, withNatives, Extraction::Order::ofMesh);
      expectRegion(inOrder.run(quietContext()), *source, cells, withNatives, true);
    }
  }
}

TEST(Region, OfNoCellsIsEmpty)
{
  const DualMesh mesh = cubes({2, 2, 2});
  const DualSource source(mesh);
  expectRegion(extractCells(source, {}, true, quietContext()), source, {}, true, false);
  expectRegion(Extraction(source, {}, true, Extraction::Order::ofMesh).run(quietContext()), source, {}, true, true);
}

TEST(Region, OfSeveralPartsIsTheSameOnSeveralThreads)
{
  const DualMesh mesh = cubes({14, 12, 15});
  const DualSource source(mesh);
  Loop cells = upTo(source.cellCount()); // more than two parts
  std::erase_if(cells, [](Index cell) { return cell % 200 == 7; });
  const auto extract = [&](int threads) {
    const ThreadExecutor executor(threads);
    return Extraction(source, cells, true, Extraction::Order::ofMesh).run(quietContext(executor));
  };
  const Region one = extract(1);
  const Region three = extract(3);
  EXPECT_EQ(one.pointIds, upTo(mesh.points.size()));
  const Loop ghosts = expectFaces(one, source);
  EXPECT_TRUE(std::ranges::is_sorted(ghosts));
  expectMeasures(one, source, ghosts, true);
  EXPECT_EQ(one.facePoints, three.facePoints);
  EXPECT_EQ(one.faceOffsets, three.faceOffsets);
  EXPECT_EQ(one.owner, three.owner);
  EXPECT_EQ(one.neighbor, three.neighbor);
  EXPECT_EQ(one.cellFaces, three.cellFaces);
  EXPECT_EQ(one.cellOffsets, three.cellOffsets);
}

TEST(Extraction, ListsTheCornersOfEachCell)
{
  const DualMesh mesh = cubes({12, 10, 10});
  const DualSource source(mesh);
  const Loop cells = upTo(source.cellCount());
  Extraction extraction(source, cells, false, Extraction::Order::ofMesh);
  const ThreadExecutor executor(2);
  extraction.run(quietContext(executor));
  std::vector<Loop> found(cells.size());
  extraction.forCells(quietContext(executor), [&](Index cell, std::span<const Index> corners) {
    found.at(cell).insert(found.at(cell).end(), corners.begin(), corners.end());
  });
  for (const Index cell : cells)
  {
    EXPECT_EQ(found[cell], cornersOf(source, cell)) << cell; // all points keep their numbers
  }
}

/// Points of which some follow others, by a share of their way.
class Followers : public VertexConstraints
{
public:
  bool isMovable(Index) const override { return true; }
  Index leaderOf(Index point) const override
  {
    const auto found = leaders.find(point);
    return found == leaders.end() ? point : found->second;
  }
  double shareOf(Index point) const override { return leaders.contains(point) ? 1.0 / (2.0 + point) : 1.0; }
  Vec3 place(Index, const Vec3& p) const override { return p; }

  std::map<Index, Index> leaders;
};

/// Marks some points, and lets some of them follow another.
std::vector<char> markSome(std::size_t points, std::mt19937& random, Followers& followers)
{
  Loop some = someOf(points, random, 12);
  std::ranges::shuffle(some, random);
  std::vector<char> marked(points, 0);
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    marked[some[i]] = 1;
    if (i % 3 != 0)
    {
      followers.leaders[some[i]] = some[i - i % 3];
    }
  }
  return marked;
}

TEST(Region, HasSetsOfPointsThatMoveTogether)
{
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round)
  {
    SCOPED_TRACE(round);
    const Sample mixed(mixedCells({4, 3, 3}, static_cast<unsigned>(round)));
    Followers followers;
    const std::vector<char> marked = markSome(mixed.mesh.points.size(), random, followers);
    const ThreadExecutor executor(round % 2 == 0 ? 1 : 3);
    const Region region = extractRegion(mixed.source, marked, followers, false, quietContext(executor));
    expectRegion(region, mixed.source, cellsWithMarked(mixed.source, marked, quietContext()), false, true);
    std::map<Index, Loop> sets;
    for (const Index point : numbersOf(marked, SerialExecutor()))
    {
      sets[followers.leaderOf(point)].push_back(point);
    }
    ASSERT_EQ(region.movable.size(), sets.size());
    std::size_t m = 0;
    for (const auto& [leader, members] : sets)
    {
      EXPECT_EQ(region.pointIds[region.movable[m]], leader);
      Loop found;
      std::ranges::for_each(region.membersOf(m), [&](Index p) { found.push_back(region.pointIds[p]); });
      EXPECT_EQ(found, members);
      std::vector<double> shares;
      std::ranges::for_each(members, [&](Index p) { shares.push_back(followers.shareOf(p)); });
      EXPECT_TRUE(std::ranges::equal(region.sharesOf(m), shares));
      Loop around;
      for (Index cell = 0; cell < region.judgedCount(); ++cell)
      {
        const Loop corners = cornersOf(mixed.source, region.cellIds[cell]);
        const bool has = std::ranges::find_first_of(corners, members) != corners.end();
        around.insert(around.end(), has ? 1 : 0, cell);
      }
      EXPECT_TRUE(std::ranges::equal(region.cellsAbout(m), around));
      ++m;
    }
  }
}

// Ways of points.

/// Positions on a plane, a line, a point, or anywhere, through the point (1, 2, 3).
class Flat : public VertexConstraints
{
public:
  explicit Flat(std::vector<Vec3> directions) : along(std::move(directions)) {}
  bool isMovable(Index) const override { return true; }
  Vec3 place(Index, const Vec3& p) const override
  {
    Vec3 out(1, 2, 3);
    const Vec3 way = p - out;
    std::ranges::for_each(along, [&](const Vec3& one) { out += one.dot(way) * one; });
    return out;
  }
  const std::vector<Vec3> along;
};

TEST(VertexConstraints, GiveOrthogonalWaysWithinAllowedPositions)
{
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const std::vector<Vec3> all{axes.col(0), axes.col(1), axes.col(2)};
  for (std::size_t count = 0; count <= 3; ++count)
  {
    const Flat flat({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)});
    const Ways ways = flat.waysFrom(0, Vec3(1, 2, 3), 0.01);
    ASSERT_EQ(ways.count, static_cast<int>(count));
    for (std::size_t i = 0; i < count; ++i)
    {
      EXPECT_NEAR(ways.along[i].norm(), 1.0, 1e-9);
      EXPECT_LT((flat.place(0, Vec3(1, 2, 3) + ways.along[i]) - Vec3(1, 2, 3) - ways.along[i]).norm(), 1e-9);
      for (std::size_t j = 0; j < i; ++j)
      {
        EXPECT_NEAR(ways.along[i].dot(ways.along[j]), 0.0, 1e-9);
      }
    }
  }
}

// Colors.

/// True if one of two points writes a cell that the other reads.
bool depend(const Region& region, std::size_t a, std::size_t b)
{
  const auto readBy = [&](std::size_t m) {
    std::set<Index> cells(region.cellsAbout(m).begin(), region.cellsAbout(m).end());
    for (const Index cell : region.cellsAbout(m))
    {
      for (const Index f : region.facesOf(cell))
      {
        cells.insert({region.owner[f], region.neighbor[f]});
      }
    }
    return cells;
  };
  const std::set<Index> read = readBy(a);
  return std::ranges::any_of(region.cellsAbout(b), [&](Index cell) { return read.contains(cell); });
}

/// Gives each point the lowest color that no point before has that depends on it.
std::vector<Loop> naiveColors(const Region& region)
{
  std::vector<Loop> colors;
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    const auto isFree = [&](const Loop& color) {
      return std::ranges::none_of(color,
                                  [&](Index other) { return depend(region, m, other) || depend(region, other, m); });
    };
    const auto found = std::ranges::find_if(colors, isFree);
    (found == colors.end() ? colors.emplace_back() : *found).push_back(m);
  }
  return colors;
}

TEST(Coloring, IsGreedy)
{
  std::mt19937 random(7);
  for (int round = 0; round < 8; ++round)
  {
    SCOPED_TRACE(round);
    const Sample mixed(mixedCells({6, 4, 4}, static_cast<unsigned>(round)));
    Followers followers;
    const std::vector<char> marked = markSome(mixed.mesh.points.size(), random, followers);
    const Region region = extractRegion(mixed.source, marked, followers, false, quietContext());
    const Colors colors = colorPoints(region);
    const std::vector<Loop> expected = naiveColors(region);
    ASSERT_EQ(colors.offsets.size(), expected.size() + 1);
    EXPECT_FALSE(colors.lastIsSerial);
    Loop order;
    for (std::size_t color = 0; color < expected.size(); ++color)
    {
      EXPECT_EQ(colors.offsets[color], order.size());
      order.insert(order.end(), expected[color].begin(), expected[color].end());
      EXPECT_TRUE(colors.isParallel(color));
    }
    EXPECT_EQ(colors.order, order);
    EXPECT_EQ(colors.offsets.back(), order.size());
  }
}

/// Points that all have the same single cell.
Region pointsOfOneCell(std::size_t points)
{
  Region region;
  region.cellOffsets = {0, 0};
  region.movable = upTo(points);
  region.aboutOffsets = upTo(points + 1);
  region.about.assign(points, 0);
  return region;
}

TEST(Coloring, PutsPointsWithoutAFreeColorInASerialOne)
{
  constexpr std::size_t most = 192;
  for (const std::size_t points : {std::size_t{0}, std::size_t{1}, most - 1, most, most + 1, most + 9})
  {
    SCOPED_TRACE(points);
    const Colors colors = colorPoints(pointsOfOneCell(points));
    EXPECT_EQ(colors.order, upTo(points));
    EXPECT_EQ(colors.lastIsSerial, points > most);
    ASSERT_EQ(colors.offsets.size(), std::min(points, most + 1) + 1);
    EXPECT_EQ(colors.offsets.back(), points);
    for (std::size_t color = 0; color + 1 < colors.offsets.size(); ++color)
    {
      EXPECT_EQ(colors.offsets[color], color);
      EXPECT_EQ(colors.isParallel(color), color < most) << color;
    }
  }
}

// Boxes.

/// Targets that all boxes reach.
QualityTargets noTargets()
{
  QualityTargets targets;
  for (const auto range : allRanges)
  {
    targets.*range = {range == &QualityTargets::skewness ? 9.0 : -1.0, range == &QualityTargets::skewness ? 8.0 : 0.0};
  }
  return targets;
}

/// Measures of a box, of which more is better: those that are exact, and what bounds its corner volumes from below.
struct BoxMeasures
{
  double convexity = 0.0;
  double determinantRoot = 0.0;
  double weight = 0.5;
  double volumeRatio = 1.0;
  double cornerVolume = 0.0;
  double leastCornerVolume = 0.0;
};

BoxMeasures measureBox(const DualMesh& mesh, Index cell)
{
  const DualSource source(mesh);
  CellBox own;
  source.boxOf(cell, own);
  BoxMeasures out;
  const double shortest = own.lengths.minCoeff();
  out.convexity = shortest / std::hypot(shortest, own.lengths.maxCoeff());
  double volume = own.lengths.prod();
  double cube = std::pow(own.lengths.mean(), 3);
  out.cornerVolume = volume / cube;
  double areas = 0.0;
  double count = 0.0;
  Vec3 squares = Vec3::Zero();
  for (int direction = 0; direction < 6; ++direction)
  {
    CellBox beside;
    if (own.across[direction] == noIndex || !source.boxOf(own.across[direction], beside))
    {
      continue;
    }
    const int axis = axisOf(direction);
    const double area = own.lengths.prod() / own.lengths[axis];
    areas += area;
    count += 1.0;
    squares[axis] += area * area;
    const auto [less, more] = std::minmax({own.lengths[axis], beside.lengths[axis]});
    out.weight = std::min(out.weight, less / (less + more));
    out.volumeRatio = std::min(out.volumeRatio, less / more);
    volume = std::min(volume, beside.lengths.prod());
    cube = std::max(cube, std::pow(beside.lengths.mean(), 3));
  }
  out.determinantRoot = std::pow(squares.prod() / std::pow(areas / count, 6) / 8.0, 0.25);
  out.leastCornerVolume = volume / cube;
  return out;
}

/// Lengths between 1 and `most`.
std::vector<double> someLengths(std::size_t count, double most, std::mt19937& random)
{
  std::uniform_real_distribution<double> some(0.0, std::log(most));
  std::vector<double> lengths(count);
  std::ranges::generate(lengths, [&] { return std::exp(some(random)); });
  return lengths;
}

DualMesh someBoxes(std::mt19937& random)
{
  const double most = 1.2 + static_cast<double>(random() % 10);
  return boxesOf({{someLengths(2 + random() % 3, most, random), someLengths(1 + random() % 4, most, random),
                   someLengths(1 + random() % 4, most, random)}});
}

TEST(BoxCells, AreEvaluatedUnlessTheyAreBetterThanTheTargets)
{
  using Pick = std::pair<QualityRange QualityTargets::*, double BoxMeasures::*>;
  const std::vector<Pick> picks{{&QualityTargets::convexity, &BoxMeasures::convexity},
                                {&QualityTargets::determinantRoot, &BoxMeasures::determinantRoot},
                                {&QualityTargets::weight, &BoxMeasures::weight},
                                {&QualityTargets::volumeRatio, &BoxMeasures::volumeRatio},
                                {&QualityTargets::cornerVolume, &BoxMeasures::cornerVolume}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> some(0.0, 1.0);
  for (const auto& [range, measure] : picks)
  {
    std::array<int, 2> decided{};
    for (int round = 0; round < 40; ++round)
    {
      const DualMesh mesh = someBoxes(random);
      QualityTargets targets = noTargets();
      (targets.*range).target = some(random) * (range == &QualityTargets::weight ? 0.5 : 1.0);
      const Loop kept = cellsToEvaluate(DualSource(mesh), upTo(mesh.elementCount()), targets, quietContext());
      for (Index cell = 0; cell < mesh.elementCount(); ++cell)
      {
        const BoxMeasures box = measureBox(mesh, cell);
        const double surely = measure == &BoxMeasures::cornerVolume ? box.leastCornerVolume : box.*measure;
        const bool isKept = std::ranges::binary_search(kept, cell);
        decided[0] += box.*measure < (targets.*range).target ? 1 : 0;
        decided[1] += surely > 1.03 * (targets.*range).target ? 1 : 0;
        EXPECT_TRUE(isKept || box.*measure >= (targets.*range).target) << round << ' ' << cell;
        EXPECT_TRUE(!isKept || surely <= 1.03 * (targets.*range).target) << round << ' ' << cell;
      }
    }
    EXPECT_GT(std::min(decided[0], decided[1]), 50);
  }
}

TEST(BoxCells, ThatAreNotEvaluatedAreGood)
{
  std::mt19937 random(13);
  std::size_t good = 0;
  std::size_t bad = 0;
  for (int round = 0; round < 40; ++round)
  {
    const DualMesh mesh = someBoxes(random);
    const DualSource source(mesh);
    QualityTargets targets;
    targets.scaledJacobian = round % 2 == 0 ? 0.0 : 0.9;
    targets.determinantRoot.target = round % 3 == 0 ? 0.0 : targets.determinantRoot.target;
    targets.determinantRoot.limit = round % 3 == 0 ? -1.0 : targets.determinantRoot.limit;
    const Loop all = upTo(mesh.elementCount());
    const Loop kept = cellsToEvaluate(source, all, targets, quietContext());
    Region region = extractCells(source, all, true, quietContext());
    for (const ShortCell& cell : shortCellsOf(QualityEvaluator(region, targets, quietContext()), 0.0, quietContext()))
    {
      EXPECT_TRUE(std::ranges::binary_search(kept, cell.cell)) << round << ' ' << cell.cell;
      ++bad;
    }
    good += all.size() - kept.size();
  }
  EXPECT_GT(good, 100U);
  EXPECT_GT(bad, 100U);
}

TEST(BoxCells, WithoutAnyNeighborIsEvaluated)
{
  QualityTargets targets = noTargets();
  targets.determinantRoot.target = 0.3;
  EXPECT_EQ(cellsToEvaluate(DualSource(cubes({1, 1, 1})), {0}, targets, quietContext()), Loop{0});
}

TEST(BoxCells, AreAllEvaluatedIfBoxesMayNotDo)
{
  const DualMesh mesh = cubes({3, 3, 3});
  const Loop all = upTo(27);
  const auto keptWith = [&](auto&& change) {
    QualityTargets targets = noTargets();
    change(targets);
    return cellsToEvaluate(DualSource(mesh), all, targets, quietContext());
  };
  for (const double target : {0.97, 0.999})
  {
    const auto matches = target < 0.98 ? ::testing::Matcher<Loop>(IsEmpty()) : ::testing::Matcher<Loop>(all);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.pyramidCosine.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.faceCosine.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.boundaryShape.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.scaledJacobian = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.skewness.target = 1.0 - target; }), matches);
  }
}

TEST(BoxCells, AreEvaluatedBesideCellsThatAreNone)
{
  DualMesh mesh = cubes({5, 5, 5});
  const std::size_t moved = 2 + 6 * (3 + 6 * 2);
  mesh.points[moved] += Vec3(0.01, 0.02, 0.03);
  const DualSource source(mesh);
  std::set<Index> expected;
  std::set<Index> bent;
  for (Index cell = 0; cell < mesh.elementCount(); ++cell)
  {
    if (std::ranges::count(mesh.corners[cell], moved) > 0)
    {
      bent.insert(cell);
      expected.insert(cell);
      std::ranges::for_each(neighborsOf(source, cell), [&](Index other) { expected.insert(other); });
    }
  }
  EXPECT_EQ(bent.size(), 8U);
  Loop cells = upTo(mesh.elementCount());
  std::ranges::reverse(cells);
  const QualityTargets targets = noTargets();
  for (const int threads : {1, 3})
  {
    const ThreadExecutor executor(threads);
    EXPECT_EQ(cellsToEvaluate(source, cells, targets, quietContext(executor)), Loop(expected.rbegin(), expected.rend()))
        << "in the same order";
  }
  std::erase_if(cells, [&](Index cell) { return bent.contains(cell); });
  Loop beside(expected.rbegin(), expected.rend());
  std::erase_if(beside, [&](Index cell) { return bent.contains(cell); });
  EXPECT_EQ(cellsToEvaluate(source, cells, targets, quietContext()), beside) << "bent cells need not be listed";
}

TEST(BoxCells, AreOnlyThoseOfDualMeshes)
{
  const Sample grid(hexahedra({3, 3, 3}));
  EXPECT_EQ(cellsToEvaluate(grid.source, upTo(27), noTargets(), quietContext()), upTo(27));
  EXPECT_THAT(cellsToEvaluate(grid.source, {}, noTargets(), quietContext()), IsEmpty());
}

} // namespace
