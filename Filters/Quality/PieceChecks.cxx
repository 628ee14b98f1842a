// SPDX-License-Identifier: GPL-3.0-or-later
#include "PieceChecks.h"

#include "Quality/Checks/CheckQuantities.h"
#include "Support/Error.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Number of rings around own cells. Cells beside own ones then have all their neighbors, so that their centroids have
/// the same bits as in the whole mesh.
constexpr int rings = 2;

MeshVerdict judge(const MeasuredMesh& measured, const WidePiece& wide, RankExchange& exchange,
                  const RunContext& context)
{
  const std::vector<char> isOwn = wide.ownCells();
  const CheckedPart part{isOwn, wide.cellIds, wide.pointIds, exchange};
  return checkMesh(measured, context, &part);
}

} // namespace

PieceChecks::PieceChecks(const MeshPiece& piece, RankExchange& exchange, const RunContext& context)
    : cellCount_(piece.cellCount()), wide_(piece.widen(rings, exchange, context.executor)),
      numbers_(piece.numbersOf(wide_)),
      mesh_(makeFaceMesh(wide_.points, wide_.cells(), wide_.faceKeys(), context.executor)),
      measured_(measureMesh(mesh_, context.part(0.0, 0.5))),
      verdict_(judge(measured_, wide_, exchange, context.part(0.5, 1.0)))
{
  checkPatches();
}

void PieceChecks::checkPatches() const
{
  const std::vector<Index> faces = findBoundaryFaces(mesh_, wide_.faceKeys());
  std::vector<char> isNamed(mesh_.faceCount(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    if (faces[i] == noIndex || std::exchange(isNamed[faces[i]], char{1}))
    {
      throw Error("a face of a patch is no face of its cell, or in two patches");
    }
  }
  for (std::size_t f = mesh_.internalFaceCount(); f < mesh_.faceCount(); ++f)
  {
    if (wide_.rings[mesh_.owner[f]] == 0 && !isNamed[f])
    {
      throw Error("a face of the boundary is in no patch");
    }
  }
}

template <typename T> Buffer<T> PieceChecks::byCell(std::span<const T> values, T ofOthers) const
{
  Buffer<T> out(cellCount_, ofOthers);
  for (std::size_t cell = 0; cell < values.size(); ++cell)
  {
    if (wide_.rings[cell] == 0)
    {
      out[numbers_[cell]] = values[cell];
    }
  }
  return out;
}

Buffer<double> PieceChecks::countedFaces(std::span<const double> values) const
{
  Buffer<double> counted;
  for (std::size_t f = 0; f < values.size(); ++f)
  {
    if (wide_.rings[mesh_.owner[f]] == 0)
    {
      counted.push_back(values[f]);
    }
  }
  return counted;
}

QualityMetrics PieceChecks::metrics(const RunContext& context) const
{
  QualityMetrics out = computeQuality(measured_, wide_.cells(), context);
  for (const QualityList metric : cellMetrics)
  {
    out.*metric = byCell(std::span<const double>(out.*metric), 0.0);
  }
  for (const QualityList metric : faceMetrics)
  {
    out.*metric = countedFaces(out.*metric);
  }
  out.valid = byCell(std::span<const unsigned char>(out.valid), static_cast<unsigned char>(1));
  out.invalidCells = static_cast<std::size_t>(std::ranges::count(out.valid, 0));
  return out;
}

void PieceChecks::addTo(QualityOutputs& outputs, const RunContext& context) const
{
  for (const CheckQuantityInfo& info : checkQuantities())
  {
    const std::vector<double> values = measure(measured_, info.quantity, context);
    const Buffer<double> cells =
        byCell(std::span<const double>(info.ofFaces ? worstOverFaces(measured_, values, info.greaterIsWorse, context)
                                                    : values),
               0.0);
    outputs.addCells(info.name, cells);
    if (info.ofFaces)
    {
      const std::span<const double> all(values);
      outputs.addSample(
          {info.name, true, countedFaces(info.needsTwoCells ? all.first(mesh_.internalFaceCount()) : all)});
    }
    else
    {
      outputs.addSample({info.name, false, cells});
    }
  }
  const std::vector<std::uint32_t> bits = failedChecksOfCells(measured_, verdict_);
  std::vector<std::uint32_t> ofCells(cellCount_, 0);
  for (std::size_t cell = 0; cell < bits.size(); ++cell)
  {
    if (wide_.rings[cell] == 0)
    {
      ofCells[numbers_[cell]] = bits[cell];
    }
  }
  outputs.addFailedChecks(ofCells);
}

} // namespace atria
