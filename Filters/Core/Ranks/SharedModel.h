// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes the surfaces of a model on several ranks together.
#pragma once

#include "Mesher/MeshModel.h"
#include "Ranks/RankShare.h"
#include "Ranks/SharedPiece.h"

namespace atria {

/// The mesh of a model as a rank has it.
struct SharedModel
{
  /// The result without a mesh. Lists by boundary face are for those of the piece. All else is of the whole and the
  /// same on all ranks, except diagnostics, which the first one has.
  MeshedModel meshed;
  SharedPiece piece;
};

/// Makes the mesh of meshModel() with the same options, in pieces, each with so many ghost levels: the same elements,
/// numbers, names and bits of points for any number of ranks. All ranks call it at the same time, with the same
/// arguments.
/// \param rows  Rows of leaves that the octrees of ranks have around their shares; twice and four times as many if
///              ranks disagree.
/// \return Nullopt, on all ranks, if one has to make the whole mesh: without a block size, if there are fewer blocks
///         than ranks or fewer than two, and if the zone of a sealed seed leaks.
/// \throws As meshModel(), and RanksDisagree if ranks disagree even then.
std::optional<SharedModel> meshSharedModel(const TriangleSurface& surface, const MesherOptions& options,
                                           int ghostLevels, RankExchange& exchange, const RunContext& context,
                                           const ShareRows& rows = {});

} // namespace atria
