// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests single unions of faces, the shapes of united polygons, and cells cut into pyramids.
#include "Quality/Faces/CellShapes.h"
#include "Quality/Unions/FaceUnion.h"
#include "Quality/Unions/PolygonUnion.h"
#include "Quality/Unions/SplitCells.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <set>
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
using ::testing::UnorderedElementsAre;
using Loop = std::vector<Index>;

Loop upTo(std::size_t count)
{
  Loop numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

FaceMesh meshOf(const SampleMesh& sample) { return makeFaceMesh(sample.points, sample.view()); }

Loop loopOf(const FaceMesh& mesh, std::size_t face) { return {mesh.face(face).begin(), mesh.face(face).end()}; }

/// Returns the face that has these points.
Index faceWith(const FaceMesh& mesh, const std::set<Index>& points)
{
  for (Index f = 0; f < mesh.faceCount(); ++f)
  {
    if (std::set<Index>(mesh.face(f).begin(), mesh.face(f).end()) == points)
    {
      return f;
    }
  }
  return noIndex;
}

/// Checks the order of faces, and that each cell is closed.
void expectWellFormed(const FaceMesh& mesh)
{
  ASSERT_EQ(mesh.faceOffsets.size(), mesh.faceCount() + 1);
  ASSERT_EQ(mesh.faceOffsets.back(), mesh.facePoints.size());
  std::map<std::array<Index, 3>, int> balance;
  std::pair<Index, Index> before{0, 0};
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const bool isInternal = f < mesh.internalFaceCount();
    const std::pair<Index, Index> now{mesh.owner[f], isInternal ? mesh.neighbor[f] : 0};
    EXPECT_TRUE(f == mesh.internalFaceCount() || now >= before) << f;
    EXPECT_TRUE(!isInternal || mesh.owner[f] < mesh.neighbor[f]) << f;
    before = now;
    const Loop loop = loopOf(mesh, f);
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      balance[{mesh.owner[f], a, b}] += loop[i] == a ? 1 : -1;
      balance[{isInternal ? mesh.neighbor[f] : noIndex, a, b}] += !isInternal ? 0 : loop[i] == a ? -1 : 1;
    }
  }
  EXPECT_TRUE(std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; }));
}

/// A cell of height 1 upright on a polygon whose bottom and sides are whole, and whose top is cut into pieces.
/// Point i of the plan has the number i at the top, and plan.size() + i at the bottom.
void addPrism(SampleMesh& sample, const std::vector<Vec3>& plan, std::size_t outline,
              const std::vector<std::vector<std::int64_t>>& pieces)
{
  const auto first = static_cast<std::int64_t>(sample.points.size());
  const auto below = first + static_cast<std::int64_t>(plan.size());
  for (const double z : {1.0, 0.0})
  {
    std::ranges::transform(plan, std::back_inserter(sample.points), [&](const Vec3& p) { return Vec3(p[0], p[1], z); });
  }
  std::vector<std::vector<std::int64_t>> faces = pieces;
  std::ranges::for_each(faces, [&](auto& face) { std::ranges::for_each(face, [&](std::int64_t& p) { p += first; }); });
  const auto count = static_cast<std::int64_t>(outline);
  std::vector<std::int64_t> bottom;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t next = (i + 1) % count;
    faces.push_back({first + i, below + i, below + next, first + next});
    bottom.insert(bottom.begin(), below + i);
  }
  faces.push_back(bottom);
  sample.addPolyhedron(faces);
}

/// A box 2 x 1 whose top is two squares.
SampleMesh boxWithTwoTops()
{
  SampleMesh sample;
  addPrism(sample, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}}, 6, {{0, 1, 4, 5}, {1, 2, 3, 4}});
  return sample;
}

/// A prism over an L of two arms of this length, whose top is cut into two rectangles.
SampleMesh angleOfArms(double length)
{
  SampleMesh sample;
  addPrism(sample, {{0, 0, 0}, {1, 0, 0}, {length, 0, 0}, {length, 1, 0}, {1, 1, 0}, {1, length, 0}, {0, length, 0}}, 7,
           {{0, 1, 4, 5, 6}, {1, 2, 3, 4}});
  return sample;
}

// Unions of faces.

/// A mesh and the unions of its faces.
struct Unions
{
  explicit Unions(const SampleMesh& sample) : mesh(meshOf(sample)), unions(mesh, quietContext()) {}

  /// Returns a union of faces with this outline, with its centroids.
  FaceUnion change(const Loop& group, const Loop& loop) const
  {
    FaceUnion out{group, {{group.front(), loop}}, {}};
    unions.findCentroids(out);
    return out;
  }

  FaceMesh mesh;
  FaceUnions unions;
};

/// The two tops of a cell, and their union.
struct TwoTops : Unions
{
  explicit TwoTops(const SampleMesh& sample, const std::set<Index>& a, const std::set<Index>& b) : Unions(sample)
  {
    group = {faceWith(mesh, a), faceWith(mesh, b)};
    std::ranges::sort(group);
    loop = unite(mesh.face(group[0]), mesh.face(group[1])).value_or(Loop());
  }
  FaceUnion merged() const { return change(group, loop); }

  Loop group;
  Loop loop;
};

/// Checks a union's view of a mesh against the outlines of its faces; empty for those that are part of another one.
void expectState(const FaceMesh& mesh, const FaceUnions& unions, const std::vector<Loop>& loops)
{
  std::vector<Index> uses(mesh.points.size(), 0);
  std::map<Index, std::set<Index>> facesOfCell;
  for (Index f = 0; f < loops.size(); ++f)
  {
    EXPECT_EQ(unions.isLeft(f), !loops[f].empty()) << f;
    const bool isInternal = f < mesh.internalFaceCount();
    EXPECT_EQ(unions.cellsOf(f), isInternal ? (Loop{mesh.owner[f], mesh.neighbor[f]}) : (Loop{mesh.owner[f]}));
    if (!loops[f].empty())
    {
      EXPECT_TRUE(std::ranges::equal(unions.loopOf(f), loops[f])) << f;
      std::ranges::for_each(loops[f], [&](Index point) { ++uses[point]; });
      std::ranges::for_each(unions.cellsOf(f), [&](Index cell) { facesOfCell[cell].insert(f); });
    }
  }
  for (Index point = 0; point < uses.size(); ++point)
  {
    EXPECT_EQ(unions.usesOf(point), uses[point]) << point;
  }
  for (Index cell = 0; cell < mesh.cellCount; ++cell)
  {
    const Loop faces = unions.facesOf(cell);
    EXPECT_EQ(std::set<Index>(faces.begin(), faces.end()), facesOfCell[cell]) << cell;
  }
}

std::vector<Loop> loopsOf(const FaceMesh& mesh)
{
  std::vector<Loop> loops;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    loops.push_back(loopOf(mesh, f));
  }
  return loops;
}

TEST(FaceUnions, KnowTheFacesOfTheMesh)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    Unions of(mixedCells({3, 3, 3}, seed));
    expectState(of.mesh, of.unions, loopsOf(of.mesh));
  }
}

/// Returns pairs of faces of one cell, or of the same two cells, that share one run of edges.
std::vector<std::pair<Index, Index>> pairsOf(const FaceMesh& mesh)
{
  const auto sides = [&](Index f) {
    return std::pair(mesh.owner[f], f < mesh.internalFaceCount() ? mesh.neighbor[f] : noIndex);
  };
  std::vector<std::pair<Index, Index>> pairs;
  for (Index a = 0; a < mesh.faceCount(); ++a)
  {
    for (Index b = a + 1; b < mesh.faceCount(); ++b)
    {
      if (sides(a) == sides(b) && unite(mesh.face(a), mesh.face(b)))
      {
        pairs.emplace_back(a, b);
      }
    }
  }
  return pairs;
}

/// Applies unions of two faces, those of other unions too, and keeps the outlines that result.
std::vector<Loop> applySome(const FaceMesh& mesh, FaceUnions& unions, unsigned oneIn, std::vector<Index>& into)
{
  std::vector<Loop> loops = loopsOf(mesh);
  into = upTo(loops.size());
  for (const auto& [a, b] : pairsOf(mesh))
  {
    if ((a + b) % oneIn == 0 && !loops[a].empty() && !loops[b].empty())
    {
      if (const std::optional<Loop> loop = unite(loops[a], loops[b]))
      {
        unions.apply({{a, b}, {{a, *loop}}, {}});
        std::ranges::replace(into, b, a);
        loops[a] = *loop;
        loops[b].clear();
      }
    }
  }
  return loops;
}

/// A mesh whose cells have a boundary face in pieces at least, and some of them several.
SampleMesh cellsWithPieces()
{
  SampleMesh sample = boxWithTwoTops();
  addPrism(sample, {{4, 0, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}, {4, 1, 0}}, 6, {{0, 1, 4, 5}, {1, 2, 3, 4}});
  addPrism(sample, {{0, 4, 0}, {2, 4, 0}, {2, 6, 0}, {0, 6, 0}, {1, 5, 0}}, 4,
           {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  return sample;
}

TEST(FaceUnions, FollowTheUnionsThatAreApplied)
{
  for (const unsigned oneIn : {1U, 2U, 3U})
  {
    SCOPED_TRACE(oneIn);
    for (const SampleMesh& sample : {cellsWithPieces(), mixedCells({3, 2, 3}, oneIn)})
    {
      Unions of(sample);
      std::vector<Index> into;
      const std::vector<Loop> loops = applySome(of.mesh, of.unions, oneIn, into);
      expectState(of.mesh, of.unions, loops);
    }
  }
}

TEST(FaceUnions, WriteTheFacesThatAreLeftInOrder)
{
  for (const unsigned oneIn : {1U, 2U, 3U, 1000U})
  {
    SCOPED_TRACE(oneIn);
    for (const SampleMesh& sample : {cellsWithPieces(), mixedCells({3, 2, 3}, oneIn)})
    {
      Unions of(sample);
      const FaceMesh before = of.mesh;
      std::vector<Index> into;
      const std::vector<Loop> loops = applySome(of.mesh, of.unions, oneIn, into);
      const MergedFaces merged = of.unions.writeFaces();
      const auto gone = static_cast<std::size_t>(std::ranges::count_if(loops, &Loop::empty));
      EXPECT_EQ(merged.count, gone);
      ASSERT_EQ(of.mesh.faceCount(), before.faceCount() - gone);
      ASSERT_EQ(merged.faceOf.size(), before.faceCount());
      Index now = 0;
      for (Index f = 0; f < loops.size(); ++f)
      {
        EXPECT_EQ(merged.nowOf(f), merged.faceOf[into[f]]);
        if (!loops[f].empty())
        {
          EXPECT_EQ(merged.faceOf[f], now);
          EXPECT_EQ(loopOf(of.mesh, now), loops[f]);
          EXPECT_EQ(of.mesh.owner[now], before.owner[f]);
          const bool isInternal = f < before.internalFaceCount();
          EXPECT_EQ(now < of.mesh.internalFaceCount(), isInternal);
          EXPECT_TRUE(!isInternal || of.mesh.neighbor[now] == before.neighbor[f]);
          ++now;
        }
      }
      expectWellFormed(of.mesh);
    }
  }
}

TEST(FaceUnions, ChangeOutlinesOfFacesThatAreNoPartOfTheUnion)
{
  // A point in the middle of the front's upper edge goes out of the front and of both tops.
  Unions of(boxWithTwoTops());
  const Index left = faceWith(of.mesh, {0, 1, 4, 5});
  const Index right = faceWith(of.mesh, {1, 2, 3, 4});
  const Index front = faceWith(of.mesh, {0, 1, 6, 7});
  std::vector<Loop> loops = loopsOf(of.mesh);
  loops[left] = {0, 2, 3, 4, 5};
  loops[right].clear();
  loops[front] = {0, 6, 7};
  of.unions.apply({{left, right}, {{left, loops[left]}, {front, loops[front]}}, {}});
  expectState(of.mesh, of.unions, loops);
  loops[front] = {0, 6, 7, 2};
  of.unions.apply({{left}, {{left, loops[left]}, {front, loops[front]}}, {}});
  expectState(of.mesh, of.unions, loops);
  EXPECT_EQ(of.unions.writeFaces().count, 1U);
  EXPECT_EQ(loopOf(of.mesh, std::min(front, right) == right ? front - 1 : front), loops[front]);
}

TEST(FaceUnions, FindTheCentroidsThatCellsWillHave)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh sample = mixedCells({3, 3, 3}, seed, 0.2);
    const FaceMesh mesh = meshOf(sample);
    const std::vector<std::pair<Index, Index>> pairs = pairsOf(mesh);
    ASSERT_FALSE(pairs.empty());
    const auto [a, b] = pairs[seed % pairs.size()];
    Unions of(sample);
    FaceUnion change = of.change({a, b}, *unite(mesh.face(a), mesh.face(b)));
    const Loop cells = of.unions.cellsOf(a);
    EXPECT_EQ(change.centroids.size(), cells.size());
    const std::map<Index, Vec3> centroids = change.centroids;
    of.unions.apply(std::move(change));
    of.unions.writeFaces();
    const MeasuredMesh measured = measureMesh(of.mesh, quietContext());
    for (const Index cell : cells)
    {
      EXPECT_LT((centroids.at(cell) - measured.geometry.cellCentroids[cell]).norm(), 1e-12) << cell;
    }
  }
}

TEST(FaceUnions, FitIfTheyAreStarShaped)
{
  const TwoTops box(boxWithTwoTops(), {0, 1, 4, 5}, {1, 2, 3, 4});
  EXPECT_TRUE(box.unions.fits(box.merged()));
  const TwoTops thick(angleOfArms(2.0), {0, 1, 4, 5, 6}, {1, 2, 3, 4});
  EXPECT_TRUE(thick.unions.fits(thick.merged()));
  const TwoTops slim(angleOfArms(5.0), {0, 1, 4, 5, 6}, {1, 2, 3, 4});
  EXPECT_FALSE(slim.unions.fits(slim.merged())) << "its centroid lies outside of it";
}

TEST(FaceUnions, FitIfCellsKeepFourFaces)
{
  // A tetrahedron with one of its faces in two, and one of them in three.
  for (const bool keepsFour : {true, false})
  {
    SampleMesh sample;
    sample.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}};
    sample.addPolyhedron({{0, 1, 3}, {1, 4, 2, 3}, {2, 0, 3}, {0, 2, 4}, {0, 4, 1}});
    TwoTops of(sample, {0, 2, 4}, {0, 4, 1});
    ASSERT_EQ(of.loop.size(), 4U);
    if (!keepsFour)
    {
      of.group.push_back(faceWith(of.mesh, {2, 0, 3}));
      of.loop = {0, 2, 4, 1};
    }
    EXPECT_EQ(of.unions.fits(of.merged()), keepsFour);
  }
}

/// A box 2 x 1 whose top is two quadrilaterals that jut out over the front. Below them the front has a notch.
SampleMesh boxWithNotch()
{
  SampleMesh sample;
  sample.points = {{0, 0, 1}, {1, -0.5, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1},  {0, 1, 1},
                   {0, 0, 0}, {2, 0, 0},    {2, 1, 0}, {0, 1, 0}, {1, 0, 0.5}};
  sample.addPolyhedron({{0, 1, 4, 5},
                        {1, 2, 3, 4},
                        {0, 6, 7, 2, 10},
                        {0, 10, 1},
                        {10, 2, 1},
                        {7, 8, 3, 2},
                        {8, 9, 5, 4, 3},
                        {9, 6, 0, 5},
                        {6, 9, 8, 7}});
  return sample;
}

TEST(FaceUnions, FitIfTheirOutlineFitsOtherFaces)
{
  const TwoTops of(boxWithNotch(), {0, 1, 4, 5}, {1, 2, 3, 4});
  ASSERT_EQ(of.loop.size(), 6U);
  EXPECT_FALSE(of.unions.fits(of.merged())) << "the front would meet it at 0 and 2, but not at 1 between them";
}

TEST(FaceUnions, FitIfNoFaceIsInverted)
{
  const TwoTops of(boxWithTwoTops(), {0, 1, 4, 5}, {1, 2, 3, 4});
  const Index front = faceWith(of.mesh, {0, 1, 6, 7});
  for (const bool isInverted : {false, true})
  {
    FaceUnion change = of.merged();
    Loop loop = loopOf(of.mesh, front);
    if (isInverted)
    {
      std::ranges::reverse(loop);
    }
    change.loops[front] = loop;
    EXPECT_EQ(of.unions.fits(change), !isInverted);
  }
}

TEST(FaceUnions, DoNotFitFlatCells)
{
  for (const double height : {1e-3, 2e-12})
  {
    SampleMesh flat = boxWithTwoTops();
    std::ranges::for_each(flat.points, [&](Vec3& p) { p[2] *= height; });
    const TwoTops of(flat, {0, 1, 4, 5}, {1, 2, 3, 4});
    EXPECT_EQ(of.unions.fits(of.merged()), height == 1e-3);
  }
}

TEST(FaceUnions, AreLessConcaveWithoutCoplanarFaces)
{
  const TwoTops of(boxWithTwoTops(), {0, 1, 4, 5}, {1, 2, 3, 4});
  EXPECT_TRUE(of.unions.isLessConcave(of.merged()));
  const Index left = faceWith(of.mesh, {0, 1, 4, 5});
  EXPECT_FALSE(of.unions.isLessConcave(of.change({left}, loopOf(of.mesh, left)))) << "nothing changes";
}

TEST(FaceUnions, AreNotLessConcaveIfACellBecomesMoreSo)
{
  SampleMesh sample;
  addPrism(sample, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}}, 4,
           {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  addPrism(sample, {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}}, 4, {{0, 1, 2, 3}});
  Unions of(sample);
  Loop group{faceWith(of.mesh, {0, 1, 4}), faceWith(of.mesh, {1, 2, 4}), faceWith(of.mesh, {2, 3, 4}),
             faceWith(of.mesh, {3, 0, 4})};
  std::ranges::sort(group);
  FaceUnion change = of.change(group, {0, 1, 2, 3});
  EXPECT_TRUE(of.unions.isLessConcave(change));
  EXPECT_TRUE(of.unions.fits(change));
  const Index top = faceWith(of.mesh, {10, 11, 12, 13});
  change.loops[top] = {13, 12, 11, 10}; // sees five other faces from behind, where twelve pairs are gone
  change.centroids.clear();
  of.unions.findCentroids(change);
  EXPECT_FALSE(of.unions.isLessConcave(change));
}

// Shapes of polygons.

const std::vector<Vec3> unitSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(PolygonUnion, FindsEdgesThatRunBothWays)
{
  EXPECT_TRUE(shareAnEdge(Loop{0, 1, 2}, Loop{1, 0, 3}));
  EXPECT_TRUE(shareAnEdge(Loop{0, 1, 2}, Loop{0, 2, 3}));
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2}, Loop{0, 1, 3})) << "in the same direction";
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2, 3}, Loop{0, 4, 2})) << "the points are no neighbors";
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2}, Loop{}));
  EXPECT_TRUE(atria::contains(Loop{3, 5}, 5));
  EXPECT_FALSE(atria::contains(Loop{3, 5}, 4));
  EXPECT_FALSE(atria::contains(Loop{}, 0));
}

TEST(PolygonUnion, GoesAroundBothFromAnyStart)
{
  // A hexagon and a pentagon that share one, two or three edges in a row.
  for (std::size_t shared = 1; shared <= 3; ++shared)
  {
    Loop a = upTo(6);
    Loop b(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shared) + 1);
    std::ranges::reverse(b);
    b.insert(b.end(), {10, 11});
    Loop expected(a.begin() + static_cast<std::ptrdiff_t>(shared), a.end());
    expected.insert(expected.end(), {0, 10, 11});
    const auto fromLowest = [](Loop loop) {
      std::ranges::rotate(loop, std::ranges::min_element(loop));
      return loop;
    };
    for (std::size_t start = 0; start < 30; ++start)
    {
      std::ranges::rotate(a, a.begin() + 1);
      std::ranges::rotate(b, b.begin() + (start % 6 == 0 ? 1 : 0));
      EXPECT_EQ(fromLowest(unite(a, b).value()), fromLowest(expected));
      EXPECT_EQ(fromLowest(unite(b, a).value()), fromLowest(expected));
      EXPECT_TRUE(shareOneRun(a, b));
    }
  }
}

TEST(PolygonUnion, IsNoneWithoutOneRunOfEdges)
{
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{4, 5, 6}), std::nullopt) << "nothing is shared";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 4, 5}), std::nullopt) << "a point is";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 5, 3, 2, 4}), std::nullopt) << "two runs are";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 4, 3}), std::nullopt) << "a point would be there twice";
  EXPECT_EQ(unite(Loop{0, 1, 2}, Loop{2, 1, 0}), std::nullopt) << "all edges are shared";
}

TEST(PolygonUnion, PointsInOneRunFollowEachOtherInBoth)
{
  const auto share = [](const Loop& a, const Loop& b) { return shareOneRun(a, b); };
  EXPECT_TRUE(share({0, 1, 2, 3}, {4, 5, 6}));
  EXPECT_TRUE(share({0, 1, 2, 3}, {1, 5, 6}));
  EXPECT_TRUE(share({0, 1, 2, 3}, {3, 0, 6}));
  EXPECT_FALSE(share({0, 1, 2, 3}, {0, 2, 6})) << "not in the first";
  EXPECT_FALSE(share({0, 1, 6}, {0, 4, 1, 5})) << "not in the second";
  EXPECT_FALSE(share({0, 1, 2}, {2, 1, 0})) << "neither has other points";
  EXPECT_FALSE(share({0, 1, 2, 3}, {2, 1, 0})) << "the second has no other points";
}

TEST(PolygonShapes, AreCoplanarUpToAnAngle)
{
  constexpr double sine = 0.01;
  for (const double factor : {0.0, 0.99, 1.01})
  {
    const double tilt = std::asin(factor * sine);
    std::vector<Vec3> points = unitSquare;
    points.insert(points.end(),
                  {Vec3(1 + std::cos(tilt), 0, std::sin(tilt)), Vec3(1 + std::cos(tilt), 1, std::sin(tilt))});
    EXPECT_EQ(coplanar(points, Loop{0, 1, 2, 3}, Loop{1, 4, 5, 2}, sine), factor < 1.0) << factor;
    EXPECT_FALSE(coplanar(points, Loop{0, 1, 2, 3}, Loop{2, 5, 4, 1}, sine)) << "they face each other";
  }
}

TEST(PolygonShapes, AreCoplanarUpToADistance)
{
  constexpr double sine = 0.01;
  for (const double factor : {0.99, 1.01})
  {
    // Both are half of their distance away from the plane between them; the longest edge is 3.
    const double step = factor * 2.0 * 3.0 * sine;
    std::vector<Vec3> points = unitSquare;
    points.insert(points.end(), {Vec3(1, 0, step), Vec3(4, 0, step), Vec3(4, 1, step), Vec3(1, 1, step)});
    EXPECT_EQ(coplanar(points, Loop{0, 1, 2, 3}, Loop{4, 5, 6, 7}, sine), factor < 1.0) << factor;
    EXPECT_EQ(coplanar(points, Loop{4, 5, 6, 7}, Loop{0, 1, 2, 3}, sine), factor < 1.0) << factor;
  }
}

TEST(PolygonShapes, AreStarShapedFromFarEnoughBehind)
{
  constexpr double sine = 0.1;
  std::vector<Vec3> square = unitSquare;
  std::ranges::for_each(square, [](Vec3& p) { p *= 2.0; }); // the root of its area is 2
  const auto isStar = [&](double z) { return isStarShaped(square, upTo(4), Vec3(0.5, 1.5, z), sine); };
  EXPECT_TRUE(isStar(-0.201));
  EXPECT_FALSE(isStar(-0.199));
  EXPECT_FALSE(isStar(0.0));
  EXPECT_FALSE(isStar(0.3)) << "seen from its front";
}

TEST(PolygonShapes, AreStarShapedIfTheCentroidAndAPointSeeAllEdges)
{
  struct Case
  {
    std::vector<Vec3> points;
    bool isStar;
    const char* why;
  };
  const std::vector<Case> cases{
      {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, true, "the inner corner sees all of an L"},
      {{{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {1, 1, 0}, {1, 9, 0}, {0, 9, 0}}, false, "the centroid lies outside"},
      {{{3, -1, 0},
        {3, 1, 0},
        {1, 1, 0},
        {1, 3, 0},
        {-1, 3, 0},
        {-1, 1, 0},
        {-3, 1, 0},
        {-3, -1, 0},
        {-1, -1, 0},
        {-1, -3, 0},
        {1, -3, 0},
        {1, -1, 0}},
       false,
       "no corner of a cross sees the sides of all its arms"},
      {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {3.9, 2, 0}}, false, "a dent hides edges from the centroid"}};
  for (const Case& one : cases)
  {
    for (std::size_t start = 0; start < one.points.size(); ++start)
    {
      Loop loop = upTo(one.points.size());
      std::ranges::rotate(loop, loop.begin() + static_cast<std::ptrdiff_t>(start));
      EXPECT_EQ(isStarShaped(one.points, loop, Vec3(0.5, 0.5, -3), 1e-6), one.isStar) << one.why;
    }
  }
}

TEST(PolygonShapes, HaveTheSmallestTetrahedronOfAFan)
{
  // Of a square the triangles around the centroid are half as large as those of a corner.
  const Vec3 below(0.2, 0.7, -3.0);
  for (const double side : {1.0, 2.0})
  {
    std::vector<Vec3> square = unitSquare;
    std::ranges::for_each(square, [&](Vec3& p) { p *= side; });
    const auto least = [&](const Vec3* beyond) { return leastTetrahedron(square, upTo(4), below, beyond); };
    const double expected = 3.0 / 12.0 / side; // of the cube of the root of the area
    EXPECT_NEAR(least(nullptr), expected, 1e-12);
    for (const double height : {2.0, 4.0, -1.0})
    {
      const Vec3 above(0.1, 0.1, height);
      EXPECT_NEAR(least(&above), std::min(expected, height / (height > 0.0 ? 12.0 : 6.0) / side), 1e-12) << height;
    }
  }
}

/// Twice the area of a triangle in the plane z = 0, positive if it is counterclockwise.
double twiceArea(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a)[2]; }

TEST(PolygonShapes, TakeTheBestCornerForTheSmallestTetrahedron)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(0.0, 0.9);
  for (std::size_t round = 0; round < 100; ++round)
  {
    const std::size_t size = 3 + round % 6;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < size; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + some(random)) / static_cast<double>(size);
      points.emplace_back(2.0 * std::cos(angle), std::sin(angle), 0.0);
    }
    const PolygonMeasure face = measurePolygon(points, upTo(size));
    double best = -1.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size; ++i)
    {
      least = std::min(least, twiceArea(points[i], points[(i + 1) % size], face.centroid));
      double ofCorner = std::numeric_limits<double>::infinity();
      for (std::size_t k = 1; k + 1 < size; ++k)
      {
        ofCorner = std::min(ofCorner, twiceArea(points[i], points[(i + k) % size], points[(i + k + 1) % size]));
      }
      best = std::max(best, ofCorner);
    }
    const double expected = std::min(best, least) / 6.0 / std::pow(face.area[2], 1.5);
    EXPECT_NEAR(leastTetrahedron(points, upTo(size), Vec3(0.1, 0.2, -1), nullptr), expected, 1e-12) << round;
    const Vec3 above(0.3, 0.1, 0.5);
    EXPECT_NEAR(leastTetrahedron(points, upTo(size), Vec3(0.1, 0.2, -1), &above), 0.5 * expected, 1e-12) << round;
  }
}

// Pyramids.

std::vector<Index> someCells(std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<Index> cells = upTo(count);
  std::ranges::shuffle(cells, random);
  cells.resize(count / 3);
  return cells;
}

/// Returns the number of edges of a cell.
std::size_t edgesOf(const FaceMesh& mesh, const CellFaces& faces, Index cell)
{
  std::set<std::pair<Index, Index>> edges;
  for (const Index f : faces.of(cell))
  {
    const Loop loop = loopOf(mesh, f);
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      edges.insert(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return edges.size();
}

TEST(SplitCells, AreOnePyramidPerFace)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, seed, 0.1));
    const FaceMesh before = mesh;
    const CellFaces facesBefore = makeCellFaces(before);
    const std::vector<Index> cells = someCells(mesh.cellCount, seed);
    const SplitCells split = splitIntoPyramids(mesh, cells);
    std::size_t triangles = 0;
    std::vector<Index> cellOf;
    for (const Index cell : cells)
    {
      triangles += edgesOf(before, facesBefore, cell);
      cellOf.insert(cellOf.end(), facesBefore.of(cell).size() - 1, cell);
    }
    EXPECT_EQ(split.cellOf, cellOf);
    EXPECT_EQ(mesh.cellCount, before.cellCount + cellOf.size());
    EXPECT_EQ(mesh.points.size(), before.points.size() + cells.size());
    EXPECT_EQ(mesh.faceCount(), before.faceCount() + triangles);
    EXPECT_EQ(mesh.internalFaceCount(), before.internalFaceCount() + triangles);
    expectWellFormed(mesh);
  }
}

TEST(SplitCells, KeepTheFacesThatWereThere)
{
  FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, 5, 0.1));
  const FaceMesh before = mesh;
  const SplitCells split = splitIntoPyramids(mesh, someCells(mesh.cellCount, 5));
  const auto cellBefore = [&](Index cell) {
    return cell < before.cellCount ? cell : split.cellOf[cell - before.cellCount];
  };
  ASSERT_EQ(split.faceOf.size(), before.faceCount());
  EXPECT_EQ(std::set<Index>(split.faceOf.begin(), split.faceOf.end()).size(), before.faceCount());
  for (std::size_t f = 0; f < before.faceCount(); ++f)
  {
    const Index now = split.faceOf[f];
    Loop loop = loopOf(mesh, now);
    const bool isTurned = cellBefore(mesh.owner[now]) != before.owner[f];
    if (isTurned)
    {
      std::ranges::reverse(loop);
    }
    EXPECT_EQ(loop, loopOf(before, f));
    ASSERT_EQ(now < mesh.internalFaceCount(), f < before.internalFaceCount());
    if (f < before.internalFaceCount())
    {
      const std::pair<Index, Index> sides{cellBefore(mesh.owner[now]), cellBefore(mesh.neighbor[now])};
      EXPECT_EQ(isTurned ? sides.first : sides.second, before.neighbor[f]);
      EXPECT_EQ(isTurned ? sides.second : sides.first, before.owner[f]);
    }
  }
}

TEST(SplitCells, FillTheCellFromItsCentroid)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, seed, 0.1));
    const FaceMesh before = mesh;
    const MeshGeometry old = measureMesh(before, quietContext()).geometry;
    const std::vector<Index> cells = someCells(mesh.cellCount, seed);
    const SplitCells split = splitIntoPyramids(mesh, cells);
    const MeasuredMesh measured = measureMesh(mesh, quietContext());
    std::vector<double> volumes(measured.geometry.cellVolumes.begin(), measured.geometry.cellVolumes.end());
    for (std::size_t i = 0; i < split.cellOf.size(); ++i)
    {
      volumes[split.cellOf[i]] += volumes[before.cellCount + i];
    }
    for (Index cell = 0; cell < mesh.cellCount; ++cell)
    {
      EXPECT_GT(measured.geometry.cellVolumes[cell], 0.0);
      EXPECT_TRUE(cell >= before.cellCount || std::abs(volumes[cell] - old.cellVolumes[cell]) < 1e-10) << cell;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      EXPECT_LT((mesh.points[before.points.size() + i] - old.cellCentroids[cells[i]]).norm(), 1e-10);
    }
  }
}

TEST(SplitCells, OfNoneChangeNothing)
{
  FaceMesh mesh = meshOf(mixedCells({2, 3, 2}, 1));
  const FaceMesh before = mesh;
  const SplitCells split = splitIntoPyramids(mesh, {});
  EXPECT_EQ(split.faceOf, upTo(before.faceCount()));
  EXPECT_THAT(split.cellOf, IsEmpty());
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.owner, before.owner);
  EXPECT_EQ(mesh.neighbor, before.neighbor);
  EXPECT_EQ(mesh.facePoints, before.facePoints);
  EXPECT_EQ(mesh.cellCount, before.cellCount);
}

TEST(SplitCells, OfACubeAreSixPyramids)
{
  FaceMesh mesh = meshOf(hexahedra({1, 1, 1}));
  const SplitCells split = splitIntoPyramids(mesh, Loop{0});
  EXPECT_THAT(split.cellOf, ElementsAre(0, 0, 0, 0, 0));
  EXPECT_EQ(mesh.internalFaceCount(), 12U);
  EXPECT_EQ(mesh.points.back(), Vec3(0.5, 0.5, 0.5));
  const MeasuredMesh measured = measureMesh(mesh, quietContext());
  for (const double volume : measured.geometry.cellVolumes)
  {
    EXPECT_NEAR(volume, 1.0 / 6.0, 1e-14);
  }
  for (Index cell = 0; cell < 6; ++cell)
  {
    std::vector<std::size_t> sizes;
    std::ranges::for_each(measured.cellFaces.of(cell), [&](Index f) { sizes.push_back(mesh.face(f).size()); });
    EXPECT_THAT(sizes, UnorderedElementsAre(3U, 3U, 3U, 3U, 4U));
  }
}

} // namespace
