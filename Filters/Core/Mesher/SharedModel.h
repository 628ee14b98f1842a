// SPDX-License-Identifier: GPL-3.0-or-later
/// From the surfaces of a model to a mesh that several ranks make together.
#pragma once

#include "Mesher/MeshModel.h"
#include "Mesher/Shares/RankShare.h"
#include "Mesher/Shares/SharedPiece.h"

namespace atria {

/// What a rank has of it.
struct SharedModel
{
  /// Without a mesh; what is by boundary face is by those of the piece. All else is of the whole, and the same on all
  /// ranks, but for diagnostics, which the first one has.
  MeshedModel meshed;
  SharedPiece piece;
};

/// The mesh of meshModel() with the same options, in pieces, each with so many ghost levels: the same elements,
/// numbers, names and bits of points for any number of ranks. All ranks call it at the same time, with the same
/// arguments. Returns nothing, on all ranks, where only one can make the mesh, as a whole: without a block size, where
/// that leaves fewer blocks than ranks, or one, and where the zone of a sealed seed leaks.
/// Octrees of ranks have so many `rows` about their shares, and twice and four times as many where ranks disagree.
/// Throws as meshModel(), and RanksDisagree where they do even then.
std::optional<SharedModel> meshSharedModel(const TriangleSurface& surface, const MesherOptions& options,
                                           int ghostLevels, RankExchange& exchange, const RunContext& context,
                                           const ShareRows& rows = {});

} // namespace atria
