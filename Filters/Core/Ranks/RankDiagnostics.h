// SPDX-License-Identifier: GPL-3.0-or-later
/// Brings the diagnostics of ranks together.
#pragma once

#include "Mesher/Diagnostic.h"
#include "Mesher/Improvement/VertexDetachment.h"
#include "Ranks/SharedPiece.h"

namespace atria {

/// Diagnostics at the elements that a rank owns. gather() brings those of all to the first rank, in the order of one
/// process.
class RankDiagnostics
{
public:
  /// \param found  In the order in which one process finds them. `piece.askedNumbers` has the numbers that their
  ///               elements have in the mesh of all ranks, as far as they have elements.
  /// \param layer  The layers from which elements were left out.
  RankDiagnostics(const std::vector<Diagnostic>& found, const SharedPiece& piece, const LayerMesh& layer);

  /// Adds vertices that are not where the model wants them, if this rank owns the first element that has them.
  void addDetached(const std::vector<DetachedVertex>& detached, const SharedPiece& piece, int rank);

  /// Returns the diagnostics of all ranks on the first one; none on others.
  std::vector<Diagnostic> gather(RankExchange& exchange) const;

private:
  std::vector<Diagnostic> own_;
};

} // namespace atria
