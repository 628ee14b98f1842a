// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/MergeFaces.h"
#include "Quality/Unions/PolygonUnion.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace {

using namespace atria;
using atria::testing::SampleMesh;
using Loop = std::vector<Index>;

MergedFaces merge(FaceMesh& mesh, std::span<const Index> patchOf = {}, int threads = 1)
{
  const ThreadExecutor executor(threads);
  return mergeCoplanarFaces(mesh, patchOf, atria::testing::quietContext(executor));
}

FaceMesh facesOf(const SampleMesh& sample) { return makeFaceMesh(sample.points, sample.view()); }

/// A prism of height 1 over a polygon of the given points, whose top is cut into the given pieces; points from
/// `outline` on are inside of the top or on pieces' edges. All of it is turned away from the axes.
SampleMesh prism(std::size_t outline, std::vector<Vec3> plan, const std::vector<std::vector<std::int64_t>>& pieces)
{
  SampleMesh sample;
  const Eigen::AngleAxisd turned(0.7, Vec3(1, 2, 3).normalized());
  const auto n = static_cast<std::int64_t>(plan.size());
  for (const double z : {1.0, 0.0})
  {
    for (Vec3 p : plan)
    {
      p[2] = z;
      sample.points.push_back(turned * p);
    }
  }
  std::vector<std::vector<std::int64_t>> faces = pieces;
  std::vector<std::int64_t> bottom;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(outline); ++i)
  {
    const std::int64_t next = (i + 1) % static_cast<std::int64_t>(outline);
    faces.push_back({i, i + n, next + n, next});
    bottom.insert(bottom.begin(), i + n);
  }
  faces.push_back(bottom);
  sample.addPolyhedron(faces);
  return sample;
}

/// A box 2 x 1 whose top is two squares.
SampleMesh boxWithTwoTops()
{
  return prism(6, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 4, 5}, {1, 2, 3, 4}});
}

bool hasFaceOf(const FaceMesh& mesh, const std::set<Index>& points)
{
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const auto face = mesh.face(f);
    if (std::set<Index>(face.begin(), face.end()) == points)
    {
      return true;
    }
  }
  return false;
}

/// Area of each patch as checkMesh and solvers take it.
std::map<Index, double> areas(const FaceMesh& mesh, std::span<const Index> patchOf)
{
  std::map<Index, double> sums;
  for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
  {
    sums[patchOf.empty() ? 0 : patchOf[f - mesh.internalFaceCount()]] +=
        measurePolygon(mesh.points, mesh.face(f)).area.norm();
  }
  return sums;
}

/// For each cell, every edge is run through as often one way as the other.
void expectClosedCells(const FaceMesh& mesh)
{
  std::map<std::array<Index, 3>, int> balance;
  const auto add = [&](std::size_t f, Index cell, int sign) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const Index a = face[i];
      const Index b = face[(i + 1) % face.size()];
      balance[{cell, std::min(a, b), std::max(a, b)}] += a < b ? sign : -sign;
    }
  };
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    add(f, mesh.owner[f], 1);
    if (f < mesh.internalFaceCount())
    {
      add(f, mesh.neighbor[f], -1);
    }
  }
  EXPECT_TRUE(std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; }));
}

TEST(MergeFaces, TwoCoplanarFacesOfACellBecomeOne)
{
  FaceMesh mesh = facesOf(boxWithTwoTops());
  const double area = areas(mesh, {}).at(0);
  const MergedFaces merged = merge(mesh);
  // Its front and back are two squares each too.
  EXPECT_EQ(merged.count, 3u);
  EXPECT_EQ(mesh.faceCount(), 6u);
  EXPECT_EQ(mesh.facePoints.size(), mesh.faceOffsets.back());
  EXPECT_TRUE(hasFaceOf(mesh, {0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(merged.faceOf.size(), 9u);
  EXPECT_EQ(std::set<Index>(merged.faceOf.begin(), merged.faceOf.end()).size(), 6u);
  EXPECT_NEAR(areas(mesh, {}).at(0), area, 1e-12 * area);
  expectClosedCells(mesh);
}

TEST(MergeFaces, APointInsideIsLeftWithoutFaces)
{
  const SampleMesh sample = prism(4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.6, 0}},
                                  {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  FaceMesh mesh = facesOf(sample);
  EXPECT_EQ(merge(mesh).count, 3u);
  EXPECT_EQ(mesh.faceCount(), 6u);
  EXPECT_TRUE(hasFaceOf(mesh, {0, 1, 2, 3}));
  EXPECT_EQ(std::count(mesh.facePoints.begin(), mesh.facePoints.end(), 4u), 0);
  expectClosedCells(mesh);
}

TEST(MergeFaces, ThreeFacesAboutAPointBecomeOneWhereNoTwoCould)
{
  // Without the third, sharp one two of them have a corner that their centroid does not see past.
  const SampleMesh sample =
      prism(3, {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0.5, 0.5, 0}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  FaceMesh mesh = facesOf(sample);
  EXPECT_EQ(merge(mesh).count, 2u);
  EXPECT_TRUE(hasFaceOf(mesh, {0, 1, 2}));
}

TEST(MergeFaces, PatchesStayApart)
{
  FaceMesh mesh = facesOf(boxWithTwoTops());
  std::vector<Index> patchOf(mesh.faceCount());
  std::iota(patchOf.begin(), patchOf.end(), 0);
  const FaceMesh before = mesh;
  const MergedFaces merged = merge(mesh, patchOf);
  EXPECT_EQ(merged.count, 0u);
  EXPECT_EQ(mesh.facePoints, before.facePoints);
  std::vector<Index> now(mesh.faceCount());
  std::iota(now.begin(), now.end(), 0);
  std::ranges::transform(now, now.begin(), [&](Index face) { return merged.nowOf(face); });
  EXPECT_EQ(now, patchOf) << "each face is itself";
}

TEST(MergeFaces, FacesAtAnAngleStayApart)
{
  for (const double height : {1e-3, 1e-5, -1e-5})
  {
    SampleMesh sample = boxWithTwoTops();
    const FaceMesh flat = facesOf(sample);
    const Vec3 up = measurePolygon(flat.points, flat.face(0)).area.normalized();
    sample.points[1] += height * up;
    sample.points[4] += height * up;
    FaceMesh mesh = facesOf(sample);
    EXPECT_EQ(merge(mesh).count, 2u) << "front and back alone";
    EXPECT_FALSE(hasFaceOf(mesh, {0, 1, 2, 3, 4, 5}));
  }
}

/// A box 2 x 1 x 1 upon another; the two squares between them are folded by this height. Neither is all of a face.
SampleMesh boxesWithTwoFacesBetween(double fold)
{
  SampleMesh sample;
  const std::vector<Vec3> plan{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const double z : {0.0, 1.0, 2.0})
  {
    for (const Vec3& p : plan)
    {
      const bool isFold = z == 1.0 && p[0] == 1.0;
      sample.points.push_back({p[0], p[1], isFold ? z + fold : z});
    }
  }
  for (const std::int64_t base : {0, 6})
  {
    const auto two = [](std::int64_t at) {
      return std::vector<std::vector<std::int64_t>>{{at, at + 1, at + 4, at + 5}, {at + 1, at + 2, at + 3, at + 4}};
    };
    std::vector<std::vector<std::int64_t>> faces = two(base + 6);
    for (std::vector<std::int64_t> lower : two(base))
    {
      std::reverse(lower.begin(), lower.end());
      faces.push_back(lower);
    }
    for (std::int64_t i = 0; i < 6; ++i)
    {
      const std::int64_t next = (i + 1) % 6;
      faces.push_back({base + i, base + next, base + next + 6, base + i + 6});
    }
    sample.addPolyhedron(faces);
  }
  return sample;
}

TEST(MergeFaces, FacesBetweenTheSameTwoCellsBecomeOne)
{
  for (const double fold : {0.0, 1e-4, -1e-3, 0.01})
  {
    SCOPED_TRACE(fold);
    FaceMesh mesh = facesOf(boxesWithTwoFacesBetween(fold));
    ASSERT_EQ(mesh.internalFaceCount(), 2u);
    const std::size_t before = mesh.faceCount();
    const MergedFaces merged = merge(mesh);
    EXPECT_EQ(mesh.internalFaceCount(), 1u);
    EXPECT_TRUE(hasFaceOf(mesh, {6, 7, 8, 9, 10, 11}));
    EXPECT_EQ(mesh.owner.size() + merged.count, before);
    EXPECT_EQ(mesh.facePoints.size(), mesh.faceOffsets.back());
    EXPECT_EQ(merged.faceOf[0], 0u);
    EXPECT_EQ(merged.faceOf[1], 0u);
    EXPECT_EQ(merged.faceOf[2], 1u) << "boundary faces move up";
    expectClosedCells(mesh);
    EXPECT_EQ(merge(mesh).count, 0u);
  }
  FaceMesh folded = facesOf(boxesWithTwoFacesBetween(0.2));
  merge(folded);
  EXPECT_EQ(folded.internalFaceCount(), 2u);
}

TEST(MergeFaces, RowsThatNoCornerSeesAllOfStayApart)
{
  // Three squares in a row: every corner has another point on its own side, behind which it sees nothing.
  const SampleMesh sample =
      prism(8, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}},
            {{0, 1, 6, 7}, {1, 2, 5, 6}, {2, 3, 4, 5}});
  FaceMesh mesh = facesOf(sample);
  merge(mesh);
  EXPECT_FALSE(hasFaceOf(mesh, {0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(hasFaceOf(mesh, {0, 1, 2, 5, 6, 7})) << "two of them do";
  expectClosedCells(mesh);
}

/// Two cells back to back in the tip of a wedge whose edge bends at 1, about the plane of 0 to 5, in which both have
/// two faces; a third cell belongs over them. Round 0 to 5 these two faces are a strip that bends about its own
/// centroid.
SampleMesh cellsInATip()
{
  SampleMesh sample;
  sample.points = {{0, 0, 0},    {1, 0, -0.8}, {2, 0, 0},     {2, 0, 0.4},  {1, 0, -0.4}, {0, 0, 0.4},
                   {1, 1, -0.3}, {1, 1, 0.5},  {1, -1, -0.3}, {1, -1, 0.5}, {1, 0, 2}};
  sample.addPolyhedron({{1, 4, 5, 0}, {2, 3, 4, 1}, {6, 2, 1, 0}, {4, 3, 7, 5}, {5, 7, 6, 0}, {7, 3, 2, 6}});
  sample.addPolyhedron({{5, 4, 1, 0}, {4, 3, 2, 1}, {1, 2, 8, 0}, {9, 3, 4, 5}, {8, 9, 5, 0}, {2, 3, 9, 8}});
  return sample;
}

std::size_t concaveCells(const FaceMesh& mesh)
{
  const RunContext context = atria::testing::quietContext();
  const std::vector<double> cosines = measure(measureMesh(mesh, context), CheckQuantity::Concavity, context);
  return static_cast<std::size_t>(
      std::count_if(cosines.begin(), cosines.end(), [](double cosine) { return cosine > -1e-6; }));
}

TEST(MergeFaces, AStripThatBendsIsMergedWithoutItsInnerPoint)
{
  SampleMesh sample = cellsInATip();
  sample.addPolyhedron({{7, 3, 4, 5}, {4, 3, 9, 5}, {10, 7, 5}, {10, 3, 7}, {10, 9, 3}, {10, 5, 9}});
  FaceMesh mesh = facesOf(sample);
  EXPECT_EQ(concaveCells(mesh), 2u);
  EXPECT_EQ(merge(mesh).count, 1u);
  EXPECT_TRUE(hasFaceOf(mesh, {0, 1, 2, 3, 5}));
  EXPECT_TRUE(hasFaceOf(mesh, {3, 5, 7}));
  EXPECT_TRUE(hasFaceOf(mesh, {3, 5, 9}));
  EXPECT_EQ(std::count(mesh.facePoints.begin(), mesh.facePoints.end(), 4), 0);
  EXPECT_EQ(concaveCells(mesh), 0u);
  expectClosedCells(mesh);
}

TEST(MergeFaces, APointOfAnotherCellStaysInAStripThatBends)
{
  // The third cell is two: a face between them has the inner point, too.
  SampleMesh sample = cellsInATip();
  sample.addPolyhedron({{7, 3, 4, 5}, {10, 7, 5}, {10, 3, 7}, {4, 3, 10, 5}});
  sample.addPolyhedron({{4, 3, 9, 5}, {10, 9, 3}, {10, 5, 9}, {10, 3, 4, 5}});
  FaceMesh mesh = facesOf(sample);
  EXPECT_EQ(merge(mesh).count, 0u);
}

TEST(MergeFaces, ACellKeepsFourFaces)
{
  SampleMesh sample; // not closed: only the count matters here
  sample.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0.5, -1}};
  sample.addPolyhedron({{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 6, 1}, {2, 6, 3}});
  FaceMesh mesh = facesOf(sample);
  EXPECT_EQ(merge(mesh).count, 0u);
  sample = {};
  sample.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0.5, -1}};
  sample.addPolyhedron({{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 6, 1}, {2, 6, 3}, {0, 5, 6}});
  mesh = facesOf(sample);
  EXPECT_EQ(merge(mesh).count, 1u);
}

TEST(MergeFaces, APointOfOthersStaysWhereItIs)
{
  SampleMesh sample = prism(4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.6, 0}},
                            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto apex = static_cast<std::int64_t>(sample.points.size());
  for (const Vec3& p : {Vec3(5, 0, 0), Vec3(5, 1, 0), Vec3(5, 0, 1)})
  {
    sample.points.push_back(p);
  }
  sample.addCell(tetrahedronCell, {4, apex, apex + 1, apex + 2}); // touches the top from outside
  FaceMesh mesh = facesOf(sample);
  merge(mesh);
  std::size_t facesOfTop = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const auto face = mesh.face(f);
    facesOfTop += mesh.owner[f] == 0 && std::count(face.begin(), face.end(), 4u) == 1 ? 1 : 0;
  }
  EXPECT_GE(facesOfTop, 2u);
  expectClosedCells(mesh);
}

TEST(PolygonUnion, NeedsOneRunOfEdges)
{
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{2, 1, 4, 5}), (Loop{2, 3, 0, 1, 4, 5}));
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{3, 2, 1, 4}), (Loop{3, 0, 1, 4}));
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{4, 5, 6}), std::nullopt) << "apart";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 4, 5}), std::nullopt) << "a point alone";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 4, 3, 2, 5}), std::nullopt) << "two edges apart: a hole or a ring";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 4, 2, 5}), std::nullopt) << "an edge and a point beside it";
  EXPECT_EQ(unite(Loop{0, 1, 2}, Loop{2, 1, 0}), std::nullopt) << "both sides of one face";
}

/// A dual mesh as faces, and the patch of each boundary face: surface and side, or side of the domain.
struct Patched
{
  FaceMesh mesh;
  std::vector<Index> patchOf;
};

Patched patched(const DualMesh& dual)
{
  std::vector<unsigned char> types(dual.elementCount(), hexahedronCell);
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> connectivity;
  for (const auto& corners : dual.corners)
  {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  std::vector<std::vector<std::int64_t>> points;
  for (const BoundaryFace& face : dual.boundaryFaces)
  {
    const ReducedFace reduced = faceOf(dual.corners[face.element], face.direction);
    points.emplace_back(reduced.points.begin(), reduced.points.begin() + reduced.count);
  }
  std::vector<BoundaryFaceKey> keys;
  for (std::size_t f = 0; f < points.size(); ++f)
  {
    keys.push_back({dual.boundaryFaces[f].element, points[f]});
  }
  Patched out;
  out.mesh = makeFaceMesh(dual.points, {types, offsets, connectivity, {}}, keys);
  const std::vector<Index> found = findBoundaryFaces(out.mesh, keys);
  out.patchOf.resize(out.mesh.faceCount() - out.mesh.internalFaceCount());
  for (std::size_t f = 0; f < found.size(); ++f)
  {
    const BoundaryFace& face = dual.boundaryFaces[f];
    out.patchOf[found[f] - out.mesh.internalFaceCount()] = 2 * face.tag + (face.side == SheetSide::back ? 1 : 0);
  }
  return out;
}

Patched meshOfSoup(unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.0), Vec3::Constant(4.0)};
  grid.sizeMin = seed % 2 == 0 ? 0.25 : 0.21;
  grid.sizeMid = 2.0 * grid.sizeMin;
  grid.sizeMax = 4.0 * grid.sizeMin;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  return patched(atria::testing::meshIt(atria::testing::randomSoup(seed), grid, options).mesh());
}

/// The patches of the faces that are left; every face must have become one of its own owner and patch.
std::vector<Index> patchesAfter(const FaceMesh& before, std::span<const Index> patchOf, const FaceMesh& after,
                                const MergedFaces& merged)
{
  const std::size_t internal = before.internalFaceCount();
  std::vector<Index> patches(after.faceCount() - internal, noIndex);
  EXPECT_EQ(after.faceCount() + merged.count, before.faceCount());
  for (std::size_t f = 0; f < before.faceCount(); ++f)
  {
    const Index now = merged.nowOf(static_cast<Index>(f));
    EXPECT_EQ(before.owner[f], after.owner[now]);
    if (f < internal)
    {
      EXPECT_EQ(now, f);
      continue;
    }
    Index& patch = patches[now - internal];
    EXPECT_TRUE(patch == noIndex || patch == patchOf[f - internal]);
    patch = patchOf[f - internal];
  }
  return patches;
}

/// Triangles from the centroid of each face that was merged look away from its owner's centroid.
void expectStarShaped(const FaceMesh& before, const FaceMesh& after, const MergedFaces& merged)
{
  std::vector<int> parts(after.faceCount(), 0);
  for (std::size_t f = 0; f < before.faceCount(); ++f)
  {
    ++parts[merged.nowOf(static_cast<Index>(f))];
  }
  const MeshGeometry geometry = computeGeometry(after, makeCellFaces(after), atria::testing::quietContext());
  for (std::size_t f = after.internalFaceCount(); f < after.faceCount(); ++f)
  {
    const auto face = after.face(f);
    for (std::size_t i = 0; i < face.size() && parts[f] > 1; ++i)
    {
      const Vec3 center = geometry.cellCentroids[after.owner[f]];
      const Vec3 a = after.points[face[i]] - center;
      const Vec3 b = after.points[face[(i + 1) % face.size()]] - center;
      EXPECT_GT(a.cross(b).dot(geometry.faceCentroids[f] - center), 0.0) << "face " << f;
    }
  }
}

TEST(MergeFaces, OnMeshesOfRandomSurfacesAllHoldsThatIsPromised)
{
  std::size_t all = 0;
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Patched source = meshOfSoup(seed);
    FaceMesh mesh = source.mesh;
    const MergedFaces merged = merge(mesh, source.patchOf);
    all += merged.count;
    EXPECT_EQ(mesh.neighbor, source.mesh.neighbor);
    EXPECT_EQ(mesh.points, source.mesh.points);
    ASSERT_EQ(mesh.faceOffsets.size(), mesh.faceCount() + 1);
    ASSERT_EQ(mesh.faceOffsets.back(), mesh.facePoints.size());
    EXPECT_TRUE(
        std::is_sorted(mesh.owner.begin() + static_cast<std::ptrdiff_t>(mesh.internalFaceCount()), mesh.owner.end()));
    const std::vector<Index> patchOf = patchesAfter(source.mesh, source.patchOf, mesh, merged);
    const auto before = areas(source.mesh, source.patchOf);
    const auto after = areas(mesh, patchOf);
    for (const auto& [patch, area] : before)
    {
      EXPECT_NEAR(after.at(patch), area, 1e-12 * area);
    }
    expectClosedCells(mesh);
    expectStarShaped(source.mesh, mesh, merged);

    FaceMesh again = mesh;
    EXPECT_EQ(merge(again, patchOf).count, 0u) << "merging again changes nothing";
    FaceMesh threaded = source.mesh;
    EXPECT_EQ(merge(threaded, source.patchOf, 7).faceOf, merged.faceOf);
    EXPECT_EQ(threaded.facePoints, mesh.facePoints);
  }
  EXPECT_GT(all, 100u) << "there was something to merge";
}

} // namespace
