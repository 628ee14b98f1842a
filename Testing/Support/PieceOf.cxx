// SPDX-License-Identifier: GPL-3.0-or-later
#include "PieceOf.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace atria::testing {

namespace {

std::int32_t labelOf(const Buffer<std::int32_t>& labels, Index element)
{
  return labels.empty() ? -2 : labels[element];
}

using FaceOfZone = std::tuple<std::uint64_t, int, Index, int, std::uint64_t>;

void expectZoneFaces(const DualMesh& whole, const SharedPiece& piece, int rank)
{
  std::set<FaceOfZone> all;
  for (const ZoneFace& face : whole.zoneFaces)
  {
    all.emplace(face.element, face.direction, face.tag, static_cast<int>(face.side),
                whole.neighbors[face.element][face.direction]);
  }
  for (const ZoneFace& face : piece.mesh.zoneFaces)
  {
    const std::int32_t other = piece.mesh.neighbors[face.element][face.direction];
    ASSERT_GE(other, 0);
    EXPECT_EQ(piece.elementRanks[face.element], rank);
    EXPECT_TRUE(all.contains({piece.elementNumbers[face.element], face.direction, face.tag, static_cast<int>(face.side),
                              piece.elementNumbers[static_cast<Index>(other)]}));
  }
}

} // namespace

void expectPiece(const DualMesh& whole, const SharedPiece& piece, int rank)
{
  ASSERT_EQ(piece.elementCount, whole.elementCount());
  ASSERT_EQ(piece.pointCount, whole.points.size());
  std::size_t wrongCorners = 0;
  std::size_t wrongPlaces = 0;
  std::size_t wrongLabels = 0;
  for (Index e = 0; e < piece.mesh.elementCount(); ++e)
  {
    const auto global = static_cast<Index>(piece.elementNumbers[e]);
    for (int c = 0; c < 8; ++c)
    {
      const Index p = piece.mesh.corners[e][c];
      wrongCorners += piece.pointNumbers[p] != whole.corners[global][c];
      wrongPlaces += piece.mesh.points[p] != whole.points[whole.corners[global][c]];
    }
    wrongLabels += piece.mesh.zones[e] != whole.zones[global] || piece.mesh.levels[e] != whole.levels[global];
    wrongLabels += labelOf(piece.mesh.rooms, e) != labelOf(whole.rooms, global);
    wrongLabels += labelOf(piece.mesh.cellZones, e) != labelOf(whole.cellZones, global);
  }
  EXPECT_EQ(wrongCorners, 0U);
  EXPECT_EQ(wrongPlaces, 0U);
  EXPECT_EQ(wrongLabels, 0U);
  for (std::size_t f = 0; f < piece.mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = piece.mesh.boundaryFaces[f];
    const std::int32_t code = whole.neighbors[piece.elementNumbers[face.element]][face.direction];
    ASSERT_TRUE(DualMesh::isBoundary(code));
    const BoundaryFace& other = whole.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    EXPECT_EQ(face.tag, other.tag);
    EXPECT_EQ(face.side, other.side);
    EXPECT_EQ(face.onDomainSide, other.onDomainSide);
    EXPECT_EQ(piece.hasOpposite[f] != 0, other.opposite != noIndex);
    EXPECT_EQ(piece.elementRanks[face.element], rank);
  }
  expectZoneFaces(whole, piece, rank);
}

} // namespace atria::testing
