// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/UnionsOnRanks.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Number above all cell and point numbers of a whole mesh.
constexpr std::int64_t beyond = std::int64_t{1} << 60;

/// Identity and hash of a cell, which ranks compare.
struct ToldCell
{
  std::int64_t id;
  std::uint64_t hash;
};

/// Hash by Fowler, Noll and Vo, over 64 bits at once.
class Hash
{
public:
  void add(std::int64_t value)
  {
    sum = (sum ^ static_cast<std::uint64_t>(value)) * 1099511628211U;
    sum ^= sum >> 29U;
  }
  std::uint64_t value() const { return sum; }

private:
  std::uint64_t sum = 14695981039346656037U;
};

/// Returns one hash per new cell, over its old cells and its faces.
std::vector<Hash> hashesOf(const JudgedMesh& now, const WideNumbers& piece, const UnitedCells& united)
{
  const FaceMesh& mesh = now.mesh;
  std::vector<Hash> hashes(mesh.cellCount);
  for (std::size_t cell = 0; cell < piece.cellIds.size(); ++cell)
  {
    hashes[now.cellOf.empty() ? cell : now.cellOf[cell]].add(piece.cellIds[cell]);
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const bool isInternal = f < mesh.internalFaceCount();
    for (const Index cell : {mesh.owner[f], isInternal ? mesh.neighbor[f] : noIndex})
    {
      if (cell != noIndex)
      {
        hashes[cell].add(united.cellIds[mesh.owner[f]]);
        hashes[cell].add(isInternal ? united.cellIds[mesh.neighbor[f]] : -1);
        std::ranges::for_each(mesh.face(f), [&](Index point) { hashes[cell].add(united.pointIds[point]); });
      }
    }
  }
  return hashes;
}

} // namespace

UnitedCells unitedCells(const JudgedMesh& now, const PieceOnRanks& part)
{
  const WideNumbers& piece = part.piece;
  UnitedCells out;
  out.ranks.resize(now.mesh.cellCount);
  out.cellIds.assign(now.mesh.cellCount, -1);
  for (std::size_t before = 0; before < piece.cellIds.size(); ++before)
  {
    const std::size_t cell = now.cellOf.empty() ? before : now.cellOf[before];
    out.ranks[cell] = piece.ranks[before]; // the last cell's rank counts
    out.cellIds[cell] = out.cellIds[cell] < 0 ? piece.cellIds[before] : out.cellIds[cell];
  }
  out.pointIds = piece.pointIds;
  for (std::size_t i = 0; i < now.added.size(); ++i)
  {
    const Index cut = now.added[i];
    out.ranks[now.pyramid(i)] = out.ranks[cut];
    out.cellIds[now.pyramid(i)] = i == 0 ? beyond : out.cellIds[now.pyramid(i) - 1] + 1;
    if (i == 0 || now.added[i - 1] != cut)
    {
      out.cellIds[now.pyramid(i)] = beyond + 4096 * out.cellIds[cut]; // no cell has as many faces
      out.pointIds.push_back(beyond + out.cellIds[cut]);
    }
  }
  const auto self = static_cast<Index>(part.exchange.rank());
  std::ranges::transform(out.ranks, std::back_inserter(out.isOwn), [&](Index rank) { return rank == self ? 1 : 0; });
  return out;
}

UnionsOnRanks::UnionsOnRanks(const PieceOnRanks& piece)
    : part(piece),
      isOwn(piece.piece.ownCells()), whole{isOwn, piece.piece.cellIds, piece.piece.pointIds, piece.exchange}
{
}

std::vector<Index> UnionsOnRanks::cellsAtEnd() const
{
  std::vector<Index> cells;
  for (Index cell = 0; cell < part.piece.rings.size(); ++cell)
  {
    if (part.piece.rings[cell] == part.piece.ringCount)
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

bool UnionsOnRanks::isAnywhere(bool here) const { return atria::isAnywhere(here, part.exchange); }

void UnionsOnRanks::share(std::vector<Index>& cells) const
{
  std::vector<std::int64_t> own;
  for (const Index cell : cells)
  {
    if (part.piece.rings[cell] == 0)
    {
      own.push_back(part.piece.cellIds[cell]);
    }
  }
  cells.clear();
  for (const std::vector<std::int64_t>& some : gatherAll(part.exchange, own))
  {
    std::ranges::transform(some, std::back_inserter(cells), [&](std::int64_t id) { return part.piece.findCell(id); });
  }
  std::erase(cells, noIndex);
  sortUnique(cells);
}

const CheckedPart* UnionsOnRanks::after(const JudgedMesh& now)
{
  if (now.cellOf.empty())
  {
    return before();
  }
  united = unitedCells(now, part);
  current.emplace(united.part(part.exchange));
  return &*current;
}

void UnionsOnRanks::expectSame(const JudgedMesh& now) const
{
  const WideNumbers& piece = part.piece;
  const std::vector<Hash> hashes = hashesOf(now, piece, unitedCells(now, part));
  const auto hashOf = [&](Index cell) { return hashes[now.cellOf.empty() ? cell : now.cellOf[cell]].value(); };
  std::vector<std::vector<ToldCell>> told(static_cast<std::size_t>(part.exchange.ranks()));
  for (Index cell = 0; cell < piece.rings.size(); ++cell)
  {
    if (piece.rings[cell] == 1)
    {
      told[piece.ranks[cell]].push_back({piece.cellIds[cell], hashOf(cell)});
    }
  }
  for (const std::vector<ToldCell>& some : exchangeLists(part.exchange, told))
  {
    for (const ToldCell& other : some)
    {
      if (hashOf(piece.findCell(other.id)) != other.hash)
      {
        throw RanksDisagree("ranks do not make the same unions of cells");
      }
    }
  }
}

} // namespace atria
