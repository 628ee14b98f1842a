// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests single unions of faces.
#include "Quality/Unions/FaceUnion.h"
#include "Quality/Unions/PolygonUnion.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UnionSamples.h"
#include "UpTo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::expectWellFormed;
using atria::testing::Loop;
using atria::testing::loopOf;
using atria::testing::meshOf;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::SampleMesh;
using atria::testing::upTo;

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

} // namespace
