// SPDX-License-Identifier: GPL-3.0-or-later
/// The evaluator keeps what the filters report, whatever way its points came to where they are; the search for a better
/// place keeps its promises.
#include "Optimize/Kernel/MeasuredCells.h"
#include "Optimize/Kernel/PointSearch.h"
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/Metrics.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace atria;
using atria::testing::SampleMesh;

constexpr std::array<int, 3> size{4, 4, 3};

const RunContext context = atria::testing::quietContext();

bool isInside(const Vec3& p)
{
  return (p.array() > 1e-9).all() && (p.array() < Eigen::Array3d(size[0], size[1], size[2]) - 1e-9).all();
}

/// Points inside the box may go anywhere, or anywhere in a plane across z.
class InnerPoints : public VertexConstraints
{
public:
  InnerPoints(const std::vector<Vec3>& start, bool inPlanes) : points(start), isInPlanes(inPlanes) {}
  bool isMovable(Index point) const override { return isInside(points[point]); }
  Vec3 place(Index point, const Vec3& p) const override { return isInPlanes ? Vec3(p[0], p[1], points[point][2]) : p; }

private:
  std::vector<Vec3> points;
  bool isInPlanes;
};

/// A mesh in which all points inside may move, and its evaluator.
struct Evaluated
{
  explicit Evaluated(const SampleMesh& from, bool inPlanes = false)
      : sample(from), mesh(makeFaceMesh(sample.points, sample.view())), cellFaces(makeCellFaces(mesh)),
        cells(sample.view()), source(mesh, cellFaces, cells), constraints(sample.points, inPlanes),
        region(extractRegion(source, marked(), constraints, true, context)), evaluator(region, {}, context)
  {
  }
  Evaluated(const Evaluated&) = delete;
  Evaluated& operator=(const Evaluated&) = delete;

  std::vector<char> marked() const
  {
    std::vector<char> out;
    for (const Vec3& p : sample.points)
    {
      out.push_back(isInside(p) ? 1 : 0);
    }
    return out;
  }

  /// The mesh with the region's points where they are now.
  SampleMesh current() const
  {
    SampleMesh out = sample;
    for (std::size_t i = 0; i < region.points.size(); ++i)
    {
      out.points[region.pointIds[i]] = region.points[i];
    }
    return out;
  }

  double penalty() const
  {
    double sum = 0.0;
    for (Index cell = 0; cell < region.judgedCount(); ++cell)
    {
      sum += evaluator.scoreOfCell(cell).penalty;
    }
    for (Index face = 0; face < region.faceCount(); ++face)
    {
      sum += evaluator.scoreOfFace(face).penalty;
    }
    return sum;
  }

  SampleMesh sample;
  FaceMesh mesh;
  CellFaces cellFaces;
  CellArrays cells;
  FaceMeshSource source;
  InnerPoints constraints;
  Region region;
  QualityEvaluator evaluator;
};

void expectSame(const Score& l, const Score& r)
{
  EXPECT_EQ(l.penalty, r.penalty);
  EXPECT_EQ(l.worst, r.worst);
}

/// What is kept of cells and faces is what an evaluator that begins with the points where they are measures.
void expectMeasuresAsAnew(const Evaluated& kept)
{
  Region region = kept.region;
  const QualityEvaluator anew(region, {}, context);
  for (Index cell = 0; cell < region.judgedCount(); ++cell)
  {
    EXPECT_EQ(kept.evaluator.metricsOfCell(cell).values, anew.metricsOfCell(cell).values);
  }
  for (Index face = 0; face < region.faceCount(); ++face)
  {
    EXPECT_EQ(kept.evaluator.metricsOfFace(face).values, anew.metricsOfFace(face).values);
  }
}

/// The same of scores, for which cells have the sizes that they had at first.
void expectScoresAsAnew(const Evaluated& kept)
{
  Region region = kept.region;
  const QualityEvaluator anew(region, {}, context);
  for (Index cell = 0; cell < region.judgedCount(); ++cell)
  {
    expectSame(kept.evaluator.scoreOfCell(cell), anew.scoreOfCell(cell));
  }
  for (Index face = 0; face < region.faceCount(); ++face)
  {
    expectSame(kept.evaluator.scoreOfFace(face), anew.scoreOfFace(face));
  }
}

class MixedMeshes : public ::testing::TestWithParam<unsigned>
{
protected:
  SampleMesh sample = atria::testing::mixedCells(size, GetParam(), 0.25);
};

TEST_P(MixedMeshes, AreMeasuredAsFiltersReportThem)
{
  const Evaluated all(sample);
  const MeasuredMesh measured = measureMesh(all.mesh, context);
  const QualityMetrics metrics = computeQuality(measured, all.cells, context);
  const std::vector<double> determinants = measure(measured, CheckQuantity::Determinant, context);
  ASSERT_GT(all.region.judgedCount(), all.mesh.cellCount * 9 / 10) << "most cells have a point inside";
  constexpr double rounding = 1e-12;
  for (Index local = 0; local < all.region.judgedCount(); ++local)
  {
    const Index cell = all.region.cellIds[local];
    LeastMetrics found = all.evaluator.metricsOfCell(local);
    for (const Index face : all.region.facesOf(local))
    {
      found.take(all.evaluator.metricsOfFace(face));
    }
    const auto expectValue = [&](LeastMetrics::Metric metric, double value) {
      EXPECT_NEAR(found.values[metric], value, rounding) << "metric " << metric << " of cell " << cell;
    };
    expectValue(LeastMetrics::pyramidCosine, 1.0 - metrics.cellSquish[cell]);
    expectValue(LeastMetrics::faceCosine, 1.0 - metrics.faceSquish[cell]);
    expectValue(LeastMetrics::skewness, -metrics.skewness[cell]);
    expectValue(LeastMetrics::inverseAspectRatio, metrics.inverseAspectRatio[cell]);
    expectValue(LeastMetrics::facePyramid, metrics.facePyramids[cell]);
    expectValue(LeastMetrics::volume, metrics.volume[cell]);
    expectValue(LeastMetrics::determinant, determinants[cell]);
    if (!std::isnan(metrics.scaledJacobian[cell]))
    {
      expectValue(LeastMetrics::scaledJacobian, metrics.scaledJacobian[cell]);
    }
  }
}

TEST_P(MixedMeshes, AreAsTheyWereAfterALookThatIsTakenBack)
{
  Evaluated all(sample);
  const Region before = all.region;
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> shift(-0.6, 0.6);
  VertexStar star;
  for (Index movable = 0; movable < before.movable.size(); ++movable)
  {
    all.evaluator.enter(movable, star);
    const LeastMetrics metrics = all.evaluator.metricsOf(star);
    all.evaluator.prepare(star);
    all.evaluator.look(star, star.origin + Vec3(shift(random), shift(random), shift(random)));
    all.evaluator.restore(star);
    EXPECT_EQ(all.evaluator.metricsOf(star).values, metrics.values);
  }
  EXPECT_EQ(all.region.points, before.points);
  expectScoresAsAnew(all);
}

TEST_P(MixedMeshes, KeepTheScoresOfPlacesThatAreAccepted)
{
  Evaluated all(sample);
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  VertexStar star;
  for (Index movable = 0; movable < all.region.movable.size(); ++movable)
  {
    all.evaluator.enter(movable, star);
    all.evaluator.prepare(star);
    const Score seen = all.evaluator.look(star, star.origin + Vec3(shift(random), shift(random), shift(random)));
    all.evaluator.accept(star);
    const Score kept = all.evaluator.scoreOf(star);
    EXPECT_EQ(kept.worst, seen.worst);
    EXPECT_NEAR(kept.penalty, seen.penalty, 1e-9 * (1.0 + seen.penalty));
  }
  expectMeasuresAsAnew(all);
}

TEST_P(MixedMeshes, LoseAsMuchPenaltyAsTheSearchTakes)
{
  for (const bool inPlanes : {false, true})
  {
    Evaluated all(sample, inPlanes);
    const std::vector<Vec3> start = all.region.points;
    PointSearch search(all.evaluator, all.constraints, {.leastPenalty = 0.0, .leastGain = 0.0});
    double penalty = all.penalty();
    ASSERT_GT(penalty, 0.0);
    VertexStar star;
    int moves = 0;
    for (int sweep = 0; sweep < 3; ++sweep)
    {
      for (Index movable = 0; movable < all.region.movable.size(); ++movable)
      {
        all.evaluator.enter(movable, star);
        const double worst = all.evaluator.scoreOf(star).worst;
        const Vec3 from = all.region.points[star.point];
        SearchState state{0.1};
        const bool moved = search.improve(movable, state);
        const double now = all.penalty();
        moves += moved ? 1 : 0;
        EXPECT_EQ(moved, all.region.points[star.point] != from);
        EXPECT_EQ(state.stuckAt > 0.0, !moved && all.evaluator.scoreOf(star).penalty > 0.0);
        EXPECT_LE(now, penalty * (1.0 + 1e-12));
        EXPECT_TRUE(!moved || now < penalty);
        EXPECT_GE(all.evaluator.scoreOf(star).worst, std::min(worst - 1e-6, 0.3)) << "what was good got bad";
        penalty = now;
      }
    }
    EXPECT_GT(moves, 0);
    for (std::size_t i = 0; inPlanes && i < start.size(); ++i)
    {
      EXPECT_EQ(all.region.points[i][2], start[i][2]);
    }
    expectMeasuresAsAnew(all);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MixedMeshes, ::testing::Values(1u, 2u, 3u));

/// Cubes with one point inside moved.
Evaluated cubesWith(const Vec3& from, const Vec3& to)
{
  SampleMesh sample = atria::testing::hexahedra(size);
  for (Vec3& p : sample.points)
  {
    p = p == from ? to : p;
  }
  return Evaluated(sample);
}

TEST(PointSearch, LeavesCubesAlone)
{
  Evaluated all(atria::testing::hexahedra(size));
  PointSearch search(all.evaluator, all.constraints);
  EXPECT_EQ(all.penalty(), 0.0);
  for (Index movable = 0; movable < all.region.movable.size(); ++movable)
  {
    SearchState state{0.1};
    EXPECT_FALSE(search.improve(movable, state));
  }
}

TEST(PointSearch, BringsAPointFromBeyondItsCellsBackAmongThem)
{
  const Vec3 home(2, 2, 1);
  for (const Vec3& to : {Vec3(3.2, 2.3, 1.1), Vec3(2.1, 0.7, 1.4)})
  {
    Evaluated all = cubesWith(home, to);
    PointSearch search(all.evaluator, all.constraints);
    const auto at = std::ranges::find_if(all.region.movable, [&](Index p) { return all.region.points[p] == to; });
    ASSERT_NE(at, all.region.movable.end());
    const auto movable = static_cast<Index>(at - all.region.movable.begin());
    SearchState state{0.1};
    for (int i = 0; i < 100 && search.improve(movable, state); ++i)
    {
    }
    EXPECT_LT((all.region.points[*at] - home).cwiseAbs().maxCoeff(), 1.0) << "from " << to.transpose();
    EXPECT_EQ(
        computeQuality(makeFaceMesh(all.current().points, all.sample.view()), all.sample.view(), context).invalidCells,
        0u);
  }
}

TEST(PointSearch, ApproachesAPlaceAsFarAsCellsStayAboveTheLeast)
{
  for (const double least : {0.0, 0.5})
  {
    Evaluated all(atria::testing::hexahedra(size));
    PointSearch search(all.evaluator, all.constraints);
    VertexStar star;
    all.evaluator.enter(0, star);
    const Vec3 origin = all.region.points[star.point];
    const Vec3 near = origin + Vec3(0.05, 0.0, 0.0);
    search.approach(0, near, least);
    EXPECT_EQ(all.region.points[star.point], near);
    const Vec3 far = origin + Vec3(1.3, 0.0, 0.0); // beyond the cells across
    search.approach(0, far, least);
    EXPECT_GE(all.evaluator.scoreOf(star).worst, least);
    EXPECT_LT((all.region.points[star.point] - origin).norm(), 1.0);
    expectMeasuresAsAnew(all);
  }
}

/// A hexahedron of which the second of two boundary faces goes on where the first ends, their centroids in each other's
/// plane, twisted by so much.
std::vector<ShortCell> concaveTwisted(double twist)
{
  const SampleMesh sample = atria::testing::singleCell(
      12, {{1, 0, 0}, {1, 1, 0}, {1 - twist, 2, 0}, {0, 0.5, 0}, {1, 0, 1}, {1, 1, 1}, {1 + twist, 2, 1}, {0, 0.5, 1}});
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const CellFaces cellFaces = makeCellFaces(mesh);
  const CellArrays cells = sample.view();
  constexpr QualityRange anything{0.0, 0.0};
  QualityTargets targets;
  targets.pyramidCosine = targets.cornerVolume = targets.boundaryShape = anything;
  targets.decomposed = false;
  return findShortCells(FaceMeshSource(mesh, cellFaces, cells), std::vector<char>(sample.points.size(), 1), targets,
                        context);
}

/// In one plane they are written as one face. Twisted they are not, and checkMesh takes the cell for concave.
TEST(Convexity, IsAskedOfBoundaryFacesThatAreNotInOnePlane)
{
  EXPECT_TRUE(concaveTwisted(0.0).empty());
  for (const double twist : {0.001, 0.01, 0.1})
  {
    const std::vector<ShortCell> cells = concaveTwisted(twist);
    ASSERT_EQ(cells.size(), 1u) << twist;
    EXPECT_LT(cells.front().worst, 0.0F) << twist;
  }
}

} // namespace
