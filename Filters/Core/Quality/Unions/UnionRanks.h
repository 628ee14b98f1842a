// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of a mesh that is divided among ranks: each makes those about its own cells, as they are in the whole.
#pragma once

#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/WidePiece.h"

#include <optional>
#include <vector>

namespace atria {

struct JudgedMesh;

/// Rings of cells about those of a rank as far as which unions mostly reach. Where they reach farther ranks do not
/// agree, and more rings may do: six cells become one at most, and what becomes of cells beside them counts.
inline constexpr int unionRings = 3;

/// What a rank makes unions of, together with all others. Both must outlive it.
struct PieceOnRanks
{
  const WideNumbers& piece;
  RankExchange& exchange;
};

/// The cells of a part as unions have left them.
struct UnitedCells
{
  std::vector<char> isOwn; ///< a union is where the last of its cells is
  std::vector<Index> ranks;
  std::vector<std::int64_t> cellIds;  ///< the lowest of the cells that each was made of, by number in the whole; those
                                      ///< of further pyramids are higher than all others
  std::vector<std::int64_t> pointIds; ///< those of apices are higher than all others

  CheckedPart part(RankExchange& exchange) const { return {isOwn, cellIds, pointIds, exchange}; }
};

/// Of the mesh that a part became.
UnitedCells unitedCells(const JudgedMesh& now, const PieceOnRanks& part);

/// What the judge of unions asks other ranks; without a part there are none.
class UnionRanks
{
public:
  explicit UnionRanks(const PieceOnRanks* piece);
  UnionRanks(const UnionRanks&) = delete;
  UnionRanks& operator=(const UnionRanks&) = delete;

  /// Those of the last ring, whose neighbors are not all there.
  std::vector<Index> cellsAtEnd() const;
  bool isAnywhere(bool here) const;
  /// Of cells before unions, keeps own ones and adds those that others have found, as far as they are here. Sorted.
  void share(std::vector<Index>& cells) const;
  /// Before unions; null without a part.
  const CheckedPart* before() const { return whole ? &*whole : nullptr; }
  /// What became of it, until this is called again. Null likewise.
  const CheckedPart* after(const JudgedMesh& now);
  /// Throws RanksDisagree where ranks have made other unions of the same cells, or given these other faces.
  void expectSame(const JudgedMesh& now) const;

private:
  const PieceOnRanks* part;
  std::vector<char> isOwn;
  std::optional<CheckedPart> whole;
  UnitedCells united;
  std::optional<CheckedPart> current;
};

} // namespace atria
