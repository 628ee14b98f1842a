// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells in a mesh that is divided among ranks. Each rank makes those around its own cells as in the whole
/// mesh.
#pragma once

#include "Quality/Unions/JudgedUnions.h"
#include "Ranks/WidePiece.h"

#include <optional>
#include <vector>

namespace atria {

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

/// The ranks' answers to uniteAndJudge(). `piece` must outlive it.
class UnionsOnRanks : public UnionPort
{
public:
  explicit UnionsOnRanks(const PieceOnRanks& piece);
  UnionsOnRanks(const UnionsOnRanks&) = delete;
  UnionsOnRanks& operator=(const UnionsOnRanks&) = delete;

  std::vector<Index> cellsAtEnd() const override;
  bool isAnywhere(bool here) const override;
  void share(std::vector<Index>& cells) const override;
  const CheckedPart* before() const override { return &whole; }
  const CheckedPart* after(const JudgedMesh& now) override;
  void expectSame(const JudgedMesh& now) const override;

private:
  const PieceOnRanks& part;
  std::vector<char> isOwn;
  CheckedPart whole;
  UnitedCells united;
  std::optional<CheckedPart> current;
};

} // namespace atria
