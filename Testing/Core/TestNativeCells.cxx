// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests cells and faces in parts, for formats without polyhedra.
#include "FaceSamples.h"
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/Geometry.h"
#include "Quality/Faces/NativeCells.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace {

using namespace atria;
using atria::testing::facesOf;
using atria::testing::Loop;
using atria::testing::measureCellOf;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::RandomShapes;
using atria::testing::SampleMesh;
using atria::testing::upTo;

/// A prism of height 1 over a polygon, turned away from the axes.
SampleMesh prismOver(const std::vector<Vec3>& plan)
{
  SampleMesh sample;
  const Eigen::AngleAxisd turned(0.7, Vec3(1, 2, 3).normalized());
  const auto n = static_cast<std::int64_t>(plan.size());
  for (const double z : {0.0, 1.0})
  {
    for (const Vec3& p : plan)
    {
      sample.points.push_back(turned * Vec3(p[0], p[1], z));
    }
  }
  std::vector<std::int64_t> bottom;
  std::vector<std::int64_t> top;
  std::vector<std::vector<std::int64_t>> faces;
  for (std::int64_t i = 0; i < n; ++i)
  {
    const std::int64_t next = (i + 1) % n;
    bottom.insert(bottom.begin(), i);
    top.push_back(i + n);
    faces.push_back({i, next, next + n, i + n});
  }
  faces.push_back(bottom);
  faces.push_back(top);
  sample.addPolyhedron(faces);
  return sample;
}

NativeCells cut(const SampleMesh& sample)
{
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  return makeNativeCells(mesh, makeCellFaces(mesh), sample.view(), {}, atria::testing::quietContext().progress);
}

/// Of tetrahedra and of pyramids over flat bases; negative ones count as such.
double volumeOf(const SampleMesh& sample, const NativeCells& cells)
{
  const auto at = [&](Index p) {
    return p < sample.points.size() ? sample.points[p] : cells.apices[p - sample.points.size()];
  };
  double sum = 0.0;
  for (std::size_t cell = 0; cell < cells.types.size(); ++cell)
  {
    const auto corners = cells.cornersOf(cell);
    const Vec3 apex = at(corners.back());
    for (std::size_t i = 1; i + 2 < corners.size(); ++i)
    {
      const Vec3 a = at(corners[0]);
      const double part = (at(corners[i]) - a).cross(at(corners[i + 1]) - a).dot(apex - a) / 6.0;
      EXPECT_GT(part, 0.0);
      sum += part;
    }
  }
  return sum;
}

TEST(NativeCells, OfAnAngleMeetWhereAllFacesAreSeen)
{
  // Neither its centroid at (1.36, 1.36) nor the mean of its points sees all: only places within (0, 0) to (1, 1) do.
  const SampleMesh angle = prismOver({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  const NativeCells cells = cut(angle);
  EXPECT_EQ(cells.dividedPolyhedra, 1u);
  EXPECT_EQ(cells.invertedCells, 0u);
  EXPECT_EQ(cells.types.size(), 6u + 2u * 4u);
  EXPECT_NEAR(volumeOf(angle, cells), 7.0, 1e-12);
}

TEST(NativeCells, OfAShapeThatNoPlaceSeesAllOfAreCounted)
{
  const SampleMesh channel =
      prismOver({{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 4, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  const NativeCells cells = cut(channel);
  EXPECT_GT(cells.invertedCells, 0u);
  EXPECT_EQ(cells.apices.size(), 1u);
}

/// Returns the triangles of the fan from the lowest-numbered corner that sees the whole polygon; from the lowest corner
/// if there is none.
std::set<Loop> fanOf(const std::vector<Vec3>& points, const Loop& face)
{
  const Vec3 normal = measurePolygon(points, face).area;
  const std::size_t size = face.size();
  Loop starts = face;
  std::ranges::sort(starts);
  starts.push_back(starts.front());
  std::set<Loop> triangles;
  for (const Index start : starts)
  {
    triangles.clear();
    const auto from = static_cast<std::size_t>(std::ranges::find(face, start) - face.begin());
    bool fits = true;
    for (std::size_t i = 1; i + 1 < size; ++i)
    {
      Loop part{start, face[(from + i) % size], face[(from + i + 1) % size]};
      fits = fits && measurePolygon(points, part).area.dot(normal) > 0.0;
      std::ranges::sort(part);
      triangles.insert(part);
    }
    if (fits)
    {
      break;
    }
  }
  return triangles;
}

TEST(DividedFaces, AreFansFromTheLowestCornerThatSeesAll)
{
  RandomShapes shapes(11);
  std::mt19937 random(13);
  for (int round = 0; round < 300; ++round)
  {
    Loop face = upTo(5 + static_cast<std::size_t>(round % 4));
    Vec3 normal;
    std::vector<Vec3> points = shapes.convexPolygon(face.size(), normal);
    for (int dent = 0; dent < round % 3; ++dent) // corners that not all others see
    {
      Vec3& corner = points[random() % points.size()];
      corner += 0.8 * (measurePolygon(points, face).centroid - corner);
    }
    std::vector<Vec3> renamed = points;
    Loop names = face;
    std::ranges::shuffle(names, random);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      renamed[names[i]] = points[i];
    }
    const std::set<Loop> expected = fanOf(renamed, names);
    for (int side = 0; side < 2; ++side)
    {
      std::set<Loop> found;
      const Vec3 area = measurePolygon(renamed, names).area;
      Vec3 sum = Vec3::Zero();
      divideFace(renamed, names, [&](std::span<const Index> part) {
        sum += measurePolygon(renamed, part).area;
        Loop sorted(part.begin(), part.end());
        std::ranges::sort(sorted);
        found.insert(sorted);
      });
      EXPECT_EQ(found, expected) << round;
      EXPECT_LT((sum - area).norm(), 1e-12) << "triangles are wound as the face";
      std::ranges::reverse(names);
    }
  }
}

TEST(DividedFaces, OfUpToFourCornersStayWhole)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const Loop& face : {Loop{2, 0, 1}, Loop{3, 0, 1, 2}})
  {
    std::vector<Loop> parts;
    divideFace(points, face, [&](std::span<const Index> part) { parts.emplace_back(part.begin(), part.end()); });
    EXPECT_EQ(parts, std::vector<Loop>{face});
  }
}

TEST(NativeCells, KeepTheVolumesOfAllCells)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const SampleMesh sample = mixedCells({3, 3, 3}, seed, 0.1);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    const CellFaces cellFaces = makeCellFaces(mesh);
    const NativeCells native = makeNativeCells(mesh, cellFaces, sample.view(), {}, quietContext().progress);
    SampleMesh made;
    made.points = sample.points;
    made.points.insert(made.points.end(), native.apices.begin(), native.apices.end());
    for (std::size_t cell = 0; cell < native.types.size(); ++cell)
    {
      made.addCell(native.types[cell], {native.cornersOf(cell).begin(), native.cornersOf(cell).end()});
      EXPECT_GT(measureCellOf(made.points, facesOf(made, cell)).volume, 0.0);
    }
    const auto polyhedra = static_cast<std::size_t>(std::ranges::count(sample.types, polyhedronCell));
    EXPECT_EQ(native.dividedPolyhedra, polyhedra);
    EXPECT_EQ(native.apices.size(), polyhedra);
    EXPECT_EQ(native.invertedCells, 0U);
    EXPECT_EQ(std::ranges::count(native.types, voxelCell), 0);
    const FaceMesh again = makeFaceMesh(made.points, made.view());
    EXPECT_EQ(again.faceCount() - again.internalFaceCount(), mesh.faceCount() - mesh.internalFaceCount())
        << "parts meet without gaps";
  }
}

} // namespace
