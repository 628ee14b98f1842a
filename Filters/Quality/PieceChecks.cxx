// SPDX-License-Identifier: GPL-3.0-or-later
#include "PieceChecks.h"

#include "Quality/Checks/CheckQuantities.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Of cells beside own ones all neighbors are there then, so that their centroids are those of the whole to the bit.
constexpr int rings = 2;

MeshVerdict judge(const MeasuredMesh& measured, const WidePiece& wide, const std::vector<char>& isOwn,
                  RankExchange& exchange, const RunContext& context)
{
  const CheckedPart part{isOwn, wide.cellIds, wide.pointIds, exchange};
  return checkMesh(measured, context, &part);
}

} // namespace

PieceChecks::PieceChecks(const MeshPiece& piece, RankExchange& exchange, const RunContext& context)
    : cellCount_(piece.cellCount()), wide_(piece.widen(rings, exchange, context.executor)),
      numbers_(piece.numbersOf(wide_)),
      mesh_(makeFaceMesh(wide_.points, wide_.cells(), wide_.faceKeys(), context.executor)),
      measured_(measureMesh(mesh_, context.part(0.0, 0.5))),
      verdict_(judge(measured_, wide_, ownCells(), exchange, context.part(0.5, 1.0)))
{
}

std::vector<char> PieceChecks::ownCells() const
{
  std::vector<char> isOwn;
  std::ranges::transform(wide_.rings, std::back_inserter(isOwn), [](Index ring) { return ring == 0 ? 1 : 0; });
  return isOwn;
}

std::vector<double> PieceChecks::byCell(std::span<const double> values) const
{
  std::vector<double> out(cellCount_, 0.0);
  for (std::size_t cell = 0; cell < values.size(); ++cell)
  {
    if (wide_.rings[cell] == 0)
    {
      out[numbers_[cell]] = values[cell];
    }
  }
  return out;
}

std::vector<double> PieceChecks::countedFaces(const std::vector<double>& values, bool needsTwoCells) const
{
  std::vector<double> counted;
  for (std::size_t f = 0; f < (needsTwoCells ? mesh_.internalFaceCount() : mesh_.faceCount()); ++f)
  {
    if (wide_.rings[mesh_.owner[f]] == 0)
    {
      counted.push_back(values[f]);
    }
  }
  return counted;
}

void PieceChecks::addTo(QualityOutputs& outputs, const RunContext& context) const
{
  for (const CheckQuantityInfo& info : checkQuantities())
  {
    const std::vector<double> values = measure(measured_, info.quantity, context);
    const std::vector<double> cells =
        byCell(info.ofFaces ? worstOverFaces(measured_, values, info.greaterIsWorse, context) : values);
    outputs.addCells(info.name, cells);
    if (info.ofFaces)
    {
      outputs.addSample({info.name, true, countedFaces(values, info.needsTwoCells)});
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
