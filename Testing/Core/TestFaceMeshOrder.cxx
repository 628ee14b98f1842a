// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the order of the faces of a mesh, against pairs of half-faces that are compared one by one.
#include "FaceSamples.h"
#include "Quality/Faces/FaceMesh.h"
#include "Quality/Faces/HalfFaces.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace {

using namespace atria;
using atria::testing::facesOf;
using atria::testing::Loop;
using atria::testing::mixedCells;
using atria::testing::SampleMesh;

/// Faces by their sorted points: owner, neighbor, and the loop as the owner sees it.
struct NaiveFace
{
  Index owner;
  Index neighbor;
  Loop loop;
};

std::vector<NaiveFace> naiveFaces(const SampleMesh& sample)
{
  std::vector<NaiveFace> all;
  for (Index cell = 0; cell < sample.types.size(); ++cell)
  {
    for (const Loop& loop : facesOf(sample, cell))
    {
      const auto other = std::ranges::find_if(all, [&](const NaiveFace& face) { return samePoints(face.loop, loop); });
      if (other == all.end())
      {
        all.push_back({cell, noIndex, loop});
      }
      else
      {
        other->neighbor = cell;
      }
    }
  }
  std::ranges::stable_sort(all, [](const NaiveFace& a, const NaiveFace& b) {
    const auto key = [](const NaiveFace& f) {
      return std::tuple(f.neighbor == noIndex, f.owner, f.neighbor == noIndex ? 0 : f.neighbor);
    };
    return key(a) < key(b);
  });
  return all;
}

TEST(FaceOrder, IsOwnerByOwnerThenNeighborByNeighborThenTheBoundary)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh sample = mixedCells({3, 2, 3}, seed);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    const std::vector<NaiveFace> faces = naiveFaces(sample);
    ASSERT_EQ(mesh.faceCount(), faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      EXPECT_EQ(mesh.owner[f], faces[f].owner) << f;
      EXPECT_EQ(f < mesh.internalFaceCount() ? mesh.neighbor[f] : noIndex, faces[f].neighbor) << f;
      EXPECT_TRUE(std::ranges::equal(mesh.face(f), faces[f].loop)) << f;
    }
  }
}

TEST(FaceOrder, FindsEachFaceByItsCellAndPoints)
{
  const SampleMesh sample = mixedCells({3, 3, 2}, 4);
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<std::vector<std::int64_t>> points;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    points.emplace_back(mesh.face(f).rbegin(), mesh.face(f).rend());
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const auto face = static_cast<Index>(f);
    const bool isInternal = f < internal;
    const Index neighbor = isInternal ? mesh.neighbor[f] : noIndex;
    const std::vector<BoundaryFaceKey> keys{{mesh.owner[f], points[f]}, {mesh.owner[f] + 1, points[f]}};
    EXPECT_EQ(findBoundaryFaces(mesh, keys), (Loop{isInternal ? noIndex : face, noIndex})) << f;
    EXPECT_EQ(findInternalFaces(mesh, keys, Loop{neighbor, neighbor})[0], isInternal ? face : noIndex) << f;
    if (isInternal)
    {
      const std::vector<BoundaryFaceKey> turned{{neighbor, points[f]}, {neighbor, points[(f + 1) % internal]}};
      EXPECT_EQ(findInternalFaces(mesh, turned, Loop{mesh.owner[f], mesh.owner[f]})[0], face) << f;
    }
  }
}

TEST(FaceOrder, PutsTheLowerCellFirst)
{
  const OrderedFace kept = orderFace(5, 1, 2);
  EXPECT_EQ(kept, (OrderedFace{false, 1, 2, 5, false}));
  EXPECT_EQ(orderFace(5, 2, 1), (OrderedFace{false, 1, 2, 5, true}));
  EXPECT_EQ(orderFace(5, 3, noIndex), (OrderedFace{true, 3, noIndex, 5, false}));
  EXPECT_EQ(orderFace(5, noIndex, 3), (OrderedFace{true, 3, noIndex, 5, true}));
}

TEST(FaceOrder, SortsInternalFacesBeforeAllOthers)
{
  const std::vector<OrderedFace> inOrder{orderFace(9, 0, 1),      orderFace(2, 3, 0),       orderFace(3, 0, 3),
                                         orderFace(1, 2, 1),      orderFace(7, 0, noIndex), orderFace(8, noIndex, 0),
                                         orderFace(0, 4, noIndex)};
  EXPECT_TRUE(std::ranges::is_sorted(inOrder));
  EXPECT_LT(orderFace(1, 9, 8), orderFace(0, 0, noIndex));
  EXPECT_LT(orderFace(3, 1, 2), orderFace(4, 1, 2)) << "faces between the same cells keep their order";
}

TEST(FaceOrder, AppendsFacesAsTheirOwnersSeeThem)
{
  FaceMesh mesh;
  appendFace(mesh, orderFace(0, 0, 1), Loop{4, 5, 6});
  appendFace(mesh, orderFace(1, 2, 1), Loop{1, 2, 3, 7});
  appendFace(mesh, orderFace(2, 3, noIndex), Loop{8, 9, 4});
  appendFace(mesh, orderFace(3, noIndex, 4), Loop{1, 2, 3});
  EXPECT_EQ(mesh.owner, (Buffer<Index>{0, 1, 3, 4}));
  EXPECT_EQ(mesh.neighbor, (Buffer<Index>{1, 2}));
  EXPECT_EQ(mesh.faceOffsets, (Buffer<Index>{0, 3, 7, 10, 13}));
  EXPECT_EQ(mesh.facePoints, (Buffer<Index>{4, 5, 6, 7, 3, 2, 1, 8, 9, 4, 3, 2, 1}));
}

} // namespace
