// SPDX-License-Identifier: GPL-3.0-or-later
/// checkMesh's checks of a mesh where ranks have its pieces.
#pragma once

#include "MeshPiece.h"
#include "Quality/Checks/MeshChecks.h"
#include "QualityOutputs.h"

namespace atria {

/// A piece with what is about it, judged together with those of all ranks, who make theirs at the same time.
class PieceChecks
{
public:
  /// Both pieces and what they were made of must outlive this. Throws Error as makeFaceMesh() does, with numbers of
  /// cells that the whole has not, and where faces of patches are not the boundary of own cells.
  PieceChecks(const MeshPiece& piece, RankExchange& exchange, const RunContext& context);
  PieceChecks(const PieceChecks&) = delete;
  PieceChecks& operator=(const PieceChecks&) = delete;

  /// The metrics of own cells, by the numbers that they have in the piece; others have 0, and are valid. Those of faces
  /// are such that each face of the whole is counted once.
  QualityMetrics metrics(const RunContext& context) const;

  /// Of the whole, but for `failing`.
  const MeshVerdict& verdict() const { return verdict_; }

  /// Adds what checkMesh measures, one quantity after the other, and the checks that cells fail; ghosts are to be
  /// filled then. Of all ranks.
  void addTo(QualityOutputs& outputs, const RunContext& context) const;

private:
  /// Of own cells, by the numbers that they have in the piece; others are 0.
  template <typename T> Buffer<T> byCell(std::span<const T> values, T ofOthers) const;
  /// Of all faces, or of internal ones alone where there are no more values.
  Buffer<double> countedFaces(std::span<const double> values) const;
  void checkPatches() const;

  std::size_t cellCount_;
  WidePiece wide_;
  std::vector<Index> numbers_;
  FaceMesh mesh_;
  MeasuredMesh measured_;
  MeshVerdict verdict_;
};

} // namespace atria
