// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells in a mesh that is divided among ranks. Each rank makes those around its own cells as in the whole
/// mesh.
#pragma once

#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/WidePiece.h"

#include <optional>
#include <vector>

namespace atria {

struct JudgedMesh;

/// Number of rings of cells around those of a rank within which unions usually stay. Ranks disagree if unions reach
/// farther; more rings may help then. Six cells are merged at most, and the result for cells beside them counts.
inline constexpr int unionRings = 3;

/// Piece of the mesh that a rank merges cells of, together with all other ranks. Both members must outlive it.
struct PieceOnRanks
{
  const WideNumbers& piece;
  RankExchange& exchange;
};

/// Cells of a part after unions.
struct UnitedCells
{
  std::vector<char> isOwn; ///< one entry per cell; a union belongs to the rank of its last cell
  std::vector<Index> ranks;
  std::vector<std::int64_t> cellIds;  ///< the lowest old cell of each, by its number in the whole; further pyramids
                                      ///< have higher numbers than all others
  std::vector<std::int64_t> pointIds; ///< apices have higher numbers than all others

  CheckedPart part(RankExchange& exchange) const { return {isOwn, cellIds, pointIds, exchange}; }
};

/// Returns the cells of a part after unions.
UnitedCells unitedCells(const JudgedMesh& now, const PieceOnRanks& part);

/// Exchange between the ranks that judge unions; without a part there is only one rank.
class UnionRanks
{
public:
  explicit UnionRanks(const PieceOnRanks* piece);
  UnionRanks(const UnionRanks&) = delete;
  UnionRanks& operator=(const UnionRanks&) = delete;

  /// Returns the cells of the last ring, some of whose neighbors are missing.
  std::vector<Index> cellsAtEnd() const;
  bool isAnywhere(bool here) const;
  /// Keeps the rank's own cells of a list of cells before unions, and adds the cells that other ranks found and that
  /// are in this piece. Sorts the list.
  void share(std::vector<Index>& cells) const;
  /// Returns the part before unions; null without a part.
  const CheckedPart* before() const { return whole ? &*whole : nullptr; }
  /// Returns the part after unions, valid until the next call. Null without a part.
  const CheckedPart* after(const JudgedMesh& now);
  /// Throws RanksDisagree if ranks made different unions of the same cells, or gave them different faces.
  void expectSame(const JudgedMesh& now) const;

private:
  const PieceOnRanks* part;
  std::vector<char> isOwn;
  std::optional<CheckedPart> whole;
  UnitedCells united;
  std::optional<CheckedPart> current;
};

} // namespace atria
