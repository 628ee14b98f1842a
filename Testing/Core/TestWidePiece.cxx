// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of a mesh with rings of cells of other ranks, and the mesh judged by them.
#include "Quality/Checks/MeshChecks.h"
#include "Support/DividedMesh.h"
#include "Support/QuietContext.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using namespace atria;
using namespace atria::testing;

std::vector<std::vector<std::int64_t>> facesOf(const FaceMesh& mesh, const std::vector<std::int64_t>& pointIds,
                                               const CellFaces& cellFaces, Index cell)
{
  std::vector<std::vector<std::int64_t>> faces;
  for (const Index face : cellFaces.of(cell))
  {
    std::vector<std::int64_t>& points = faces.emplace_back();
    std::ranges::transform(mesh.face(face), std::back_inserter(points), [&](Index p) { return pointIds[p]; });
  }
  return faces;
}

class WidePieces : public ::testing::TestWithParam<int>
{
};

TEST_P(WidePieces, HaveTheCellsOfTheWholeWithTheirFaces)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const DividedSample sample(seed, static_cast<std::size_t>(GetParam()));
    const FaceMesh whole = makeFaceMesh(sample.mesh.points, sample.mesh.view(), sample.faces());
    const MeasuredMesh measuredWhole = measureMesh(whole, quietContext());
    std::vector<std::int64_t> all(whole.points.size());
    std::iota(all.begin(), all.end(), 0);
    onRanks(GetParam(), [&](RankExchange& exchange) {
      const auto rank = static_cast<Index>(exchange.rank());
      const PieceOfSample piece(sample, rank);
      const int rings = 1 + static_cast<int>(seed % 3);
      const WidePiece wide = widen(piece.view(), rings, exchange);
      const std::vector<Index> ringOf = ringsAbout(sample, rank);
      const FaceMesh mesh = makeFaceMesh(wide.points, wide.cells(), wide.faceKeys());
      const MeasuredMesh measured = measureMesh(mesh, quietContext());
      std::size_t next = 0;
      for (Index cell = 0; cell < ringOf.size(); ++cell)
      {
        if (ringOf[cell] > static_cast<Index>(rings))
        {
          EXPECT_EQ(wide.findCell(cell), noIndex);
          continue;
        }
        ASSERT_EQ(wide.findCell(cell), next);
        EXPECT_EQ(wide.rings[next], ringOf[cell]);
        EXPECT_EQ(wide.ranks[next], sample.rankOf[cell]);
        EXPECT_EQ(wide.labels.at(0)[next], sample.labels[cell]);
        if (ringOf[cell] < static_cast<Index>(rings))
        {
          EXPECT_EQ(facesOf(mesh, wide.pointIds, measured.cellFaces, static_cast<Index>(next)),
                    facesOf(whole, all, measuredWhole.cellFaces, cell));
          EXPECT_EQ(measured.geometry.cellCentroids[next], measuredWhole.geometry.cellCentroids[cell]);
          EXPECT_EQ(measured.geometry.cellVolumes[next], measuredWhole.geometry.cellVolumes[cell]);
        }
        ++next;
      }
      EXPECT_EQ(next, wide.types.size());
    });
  }
}

/// The same number, or none.
void expectSame(double value, double wanted, double rounding, const char* what)
{
  EXPECT_TRUE((std::isnan(value) && std::isnan(wanted)) || std::abs(value - wanted) <= rounding)
      << what << ": " << value << ", " << wanted;
}

TEST_P(WidePieces, AreJudgedAsTheWhole)
{
  std::size_t failing = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const DividedSample sample(seed, static_cast<std::size_t>(GetParam()));
    const FaceMesh whole = makeFaceMesh(sample.mesh.points, sample.mesh.view(), sample.faces());
    const MeasuredMesh measuredWhole = measureMesh(whole, quietContext());
    const MeshVerdict wanted = checkMesh(measuredWhole, quietContext());
    const std::vector<std::uint32_t> failedChecks = failedChecksOfCells(measuredWhole, wanted);
    EXPECT_GT(wanted["PointDistance"].failingCount, 0U);
    onRanks(GetParam(), [&](RankExchange& exchange) {
      const PieceOfSample piece(sample, static_cast<Index>(exchange.rank()));
      const WidePiece wide = widen(piece.view(), 2, exchange);
      const FaceMesh mesh = makeFaceMesh(wide.points, wide.cells(), wide.faceKeys());
      const MeasuredMesh measured = measureMesh(mesh, quietContext());
      const std::vector<char> isOwn = wide.ownCells();
      const CheckedPart part{isOwn, wide.cellIds, wide.pointIds, exchange};
      const MeshVerdict verdict = checkMesh(measured, quietContext(), &part);
      EXPECT_EQ(verdict.failedChecks(), wanted.failedChecks());
      for (std::size_t i = 0; i < wanted.checks.size(); ++i)
      {
        const MeshCheck& check = verdict.checks[i];
        const MeshCheck& other = wanted.checks[i];
        EXPECT_EQ(check.failingCount, other.failing.size()) << other.name;
        EXPECT_EQ(other.failingCount, other.failing.size()) << other.name;
        EXPECT_EQ(check.first, other.first) << other.name;
        const bool isSum = std::strcmp(other.name, "BoundaryOpenness") == 0;
        expectSame(check.worst, other.worst, isSum ? 1e-15 : 0.0, other.name);
        expectSame(check.mean, other.mean, 1e-12 * std::max(1.0, std::abs(other.mean)), other.name);
      }
      const std::vector<std::uint32_t> failed = failedChecksOfCells(measured, verdict);
      for (Index cell = 0; cell < failed.size(); ++cell)
      {
        if (isOwn[cell])
        {
          EXPECT_EQ(failed[cell], failedChecks[static_cast<std::size_t>(wide.cellIds[cell])]);
        }
      }
    });
    failing += static_cast<std::size_t>(wanted.failedChecks());
  }
  EXPECT_GT(failing, 5U);
}

INSTANTIATE_TEST_SUITE_P(Ranks, WidePieces, ::testing::Values(1, 2, 3, 5),
                         [](const auto& one) { return std::to_string(one.param); });

} // namespace
