// SPDX-License-Identifier: GPL-3.0-or-later
/// checkMesh's checks for a mesh whose pieces are on several ranks.
#pragma once

#include "Quality/Checks/MeshChecks.h"
#include "QualityOutputs.h"
#include "Ranks/MeshPiece.h"

namespace atria {

/// A piece with its surroundings, judged together with the pieces of all ranks. All ranks make theirs at the same time.
class PieceChecks
{
public:
  /// The piece and the data it was made of must outlive this. Throws Error as makeFaceMesh() does, but with cell
  /// numbers that are not those of the whole mesh, and if the faces of patches are not the boundary of own cells.
  PieceChecks(const MeshPiece& piece, RankExchange& exchange, const RunContext& context);
  PieceChecks(const PieceChecks&) = delete;
  PieceChecks& operator=(const PieceChecks&) = delete;

  /// Returns the metrics of own cells, one entry per cell of the piece; other cells have 0 and are valid. Face metrics
  /// cover each face of the whole mesh on one rank only.
  QualityMetrics metrics(const RunContext& context) const;

  /// Returns the verdict on the whole mesh; only `failing` is local.
  const MeshVerdict& verdict() const { return verdict_; }

  /// Adds checkMesh's quantities, one after the other, and the checks that cells fail. Ghosts must be filled
  /// afterwards. All ranks must call it.
  void addTo(QualityOutputs& outputs, const RunContext& context) const;

private:
  /// Returns the values of own cells, one entry per cell of the piece; other cells get `ofOthers`.
  template <typename T> Buffer<T> byCell(std::span<const T> values, T ofOthers) const;
  /// Returns the values of faces that count on this rank. `values` are those of all faces, or of internal ones only.
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
