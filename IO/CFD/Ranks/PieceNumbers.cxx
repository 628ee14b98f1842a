// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PieceNumbers.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <map>
#include <utility>

namespace atria {

namespace {

using Numbers = std::vector<std::int64_t>;

/// Returns the values of all ranks, sorted.
template <typename T> std::vector<T> gatherSorted(const std::vector<T>& own, RankExchange& exchange)
{
  std::vector<T> all;
  for (const std::vector<T>& some : gatherAll(exchange, own))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  std::ranges::sort(all);
  return all;
}

/// Returns a number after those in a sorted list are left out.
std::int64_t without(const Numbers& leftOut, std::int64_t number)
{
  return number - (std::ranges::lower_bound(leftOut, number) - leftOut.begin());
}

/// Returns the sum over all ranks. Throws if the numbers are not 0, 1 and so on.
std::int64_t countAll(std::int64_t own, std::int64_t greatest, RankExchange& exchange)
{
  std::int64_t count = 0;
  std::int64_t last = -1;
  for (const auto& [some, itsGreatest] : gatherAll(exchange, std::pair(own, greatest)))
  {
    count += some;
    last = std::max(last, itsGreatest);
  }
  if (last + 1 != count)
  {
    throw RanksDisagree("numbers of a mesh in pieces have gaps");
  }
  return count;
}

/// A cell that was cut, and the number of pyramids beyond the first.
using CutCell = std::pair<std::int64_t, std::int64_t>;

std::vector<CutCell> ownCutCells(const JudgedMesh& now, const UnitedCells& united)
{
  std::vector<CutCell> cut;
  for (const Index cell : now.added)
  {
    if (united.isOwn[cell])
    {
      if (cut.empty() || cut.back().first != united.cellIds[cell])
      {
        cut.emplace_back(united.cellIds[cell], 0);
      }
      ++cut.back().second;
    }
  }
  return cut;
}

void numberCells(const JudgedMesh& now, const UnitedCells& united, const PieceOnRanks& on,
                 const std::vector<CutCell>& cut, PieceNumbers& out)
{
  const WideNumbers& piece = on.piece;
  Numbers leftOut;
  std::int64_t count = 0;
  std::int64_t greatest = -1;
  for (std::size_t cell = 0; cell < piece.cellIds.size(); ++cell)
  {
    if (piece.rings[cell] == 0)
    {
      ++count;
      greatest = piece.cellIds[cell];
      if (!now.cellOf.empty() && united.cellIds[now.cellOf[cell]] != piece.cellIds[cell])
      {
        leftOut.push_back(piece.cellIds[cell]);
      }
    }
  }
  const std::int64_t before = countAll(count, greatest, on.exchange);
  leftOut = gatherSorted(leftOut, on.exchange);
  out.cellCount = before - static_cast<std::int64_t>(leftOut.size());
  std::map<std::int64_t, std::int64_t> firstPyramid; ///< keyed by the cell that was cut
  for (const auto& [cell, added] : cut)
  {
    firstPyramid[cell] = std::exchange(out.cellCount, out.cellCount + added);
  }
  const std::size_t firstAdded = now.pyramid(0);
  out.cells.resize(now.mesh.cellCount);
  for (std::size_t cell = 0; cell < firstAdded; ++cell)
  {
    out.cells[cell] = without(leftOut, united.cellIds[cell]);
  }
  for (std::size_t i = 0; i < now.added.size(); ++i)
  {
    // Cells far from own cells may be cut on this rank only.
    const auto first = firstPyramid.find(united.cellIds[now.added[i]]);
    out.cells[firstAdded + i] = first == firstPyramid.end() ? -1 : first->second++;
  }
}

void numberPoints(const JudgedMesh& now, const UnitedCells& united, const PieceOnRanks& on, std::span<const char> isOwn,
                  const std::vector<CutCell>& cut, PieceNumbers& out)
{
  const WideNumbers& piece = on.piece;
  std::vector<char> isUsed(now.mesh.points.size(), 0);
  std::ranges::for_each(now.mesh.facePoints, [&](Index point) { isUsed[point] = 1; });
  Numbers leftOut;
  std::int64_t count = 0;
  std::int64_t greatest = -1;
  for (std::size_t point = 0; point < isOwn.size(); ++point)
  {
    if (isOwn[point])
    {
      ++count;
      greatest = piece.pointIds[point];
      if (!isUsed[point])
      {
        leftOut.push_back(piece.pointIds[point]);
      }
    }
  }
  const std::int64_t before = countAll(count, greatest, on.exchange);
  leftOut = gatherSorted(leftOut, on.exchange);
  const std::int64_t firstApex = before - static_cast<std::int64_t>(leftOut.size());
  out.pointCount = firstApex + static_cast<std::int64_t>(cut.size());
  out.points.resize(now.mesh.points.size());
  for (std::size_t point = 0; point < isOwn.size(); ++point)
  {
    out.points[point] = without(leftOut, piece.pointIds[point]);
  }
  std::size_t apex = isOwn.size();
  for (std::size_t i = 0; i < now.added.size(); ++i)
  {
    if (i == 0 || now.added[i] != now.added[i - 1])
    {
      const std::int64_t cell = united.cellIds[now.added[i]];
      const auto found = std::ranges::lower_bound(cut, cell, {}, &CutCell::first);
      out.points[apex++] = firstApex + (found - cut.begin());
    }
  }
}

/// Consecutive own cells, given by the first, and the number of faces of one patch, or within the mesh, that they own.
struct FaceRun
{
  Index patch; ///< 0 within the mesh, 1 for the first patch and so on
  std::int64_t firstCell;
  std::int64_t faces;

  auto key() const { return std::pair(patch, firstCell); }
};

/// Numbers the faces that own cells own.
class RunNumbers
{
public:
  RunNumbers(const UnitedCells& united, const PieceNumbers& numbers)
  {
    std::int64_t last = -2;
    firstOfRun.resize(united.isOwn.size(), -1);
    for (std::size_t cell = 0; cell < united.isOwn.size(); ++cell)
    {
      if (united.isOwn[cell])
      {
        first = numbers.cells[cell] == last + 1 ? first : numbers.cells[cell];
        last = numbers.cells[cell];
        firstOfRun[cell] = first;
      }
    }
  }

  void count(Index patch, Index owner) { ++next[{patch, firstOfRun[owner]}]; }

  /// Returns the number of faces on all ranks.
  std::int64_t place(RankExchange& exchange)
  {
    std::vector<FaceRun> own;
    for (const auto& [key, faces] : next)
    {
      own.push_back({key.first, key.second, faces});
    }
    std::vector<FaceRun> all;
    for (const std::vector<FaceRun>& some : gatherAll(exchange, own))
    {
      all.insert(all.end(), some.begin(), some.end());
    }
    std::ranges::sort(all, {}, &FaceRun::key);
    std::int64_t sum = 0;
    for (const FaceRun& run : all)
    {
      if (const auto found = next.find(run.key()); found != next.end())
      {
        found->second = sum;
      }
      sum += run.faces;
    }
    return sum;
  }

  std::int64_t take(Index patch, Index owner) { return next[{patch, firstOfRun[owner]}]++; }

private:
  std::int64_t first = -1;
  Numbers firstOfRun;                                          ///< one per cell
  std::map<std::pair<Index, std::int64_t>, std::int64_t> next; ///< keyed by patch and run
};

} // namespace

PieceNumbers numberPiece(const JudgedMesh& now, const UnitedCells& united, const PieceOnRanks& piece,
                         std::span<const char> ownPoints)
{
  PieceNumbers out;
  const std::vector<CutCell> cut = gatherSorted(ownCutCells(now, united), piece.exchange);
  numberCells(now, united, piece, cut, out);
  numberPoints(now, united, piece, ownPoints, cut, out);
  return out;
}

FaceNumbers numberFaces(const FaceMesh& mesh, const UnitedCells& united, const PieceNumbers& numbers,
                        const std::vector<Index>& patchOf, RankExchange& exchange)
{
  const std::size_t internal = mesh.internalFaceCount();
  const auto slotOf = [&](std::size_t f) { return f < internal ? Index{0} : patchOf[f - internal] + 1; };
  RunNumbers runs(united, numbers);
  const auto forOwned = [&](auto&& body) {
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    {
      if (united.isOwn[mesh.owner[f]])
      {
        body(f);
      }
    }
  };
  FaceNumbers out;
  out.faces.resize(mesh.faceCount(), -1);
  forOwned([&](std::size_t f) { runs.count(slotOf(f), mesh.owner[f]); });
  out.faceCount = runs.place(exchange);
  std::vector<Numbers> told(static_cast<std::size_t>(exchange.ranks()));
  forOwned([&](std::size_t f) {
    out.faces[f] = runs.take(slotOf(f), mesh.owner[f]);
    if (f < internal && !united.isOwn[mesh.neighbor[f]])
    {
      told[united.ranks[mesh.neighbor[f]]].push_back(out.faces[f]);
    }
  });
  const std::vector<Numbers> heard = exchangeLists(exchange, told);
  std::vector<std::size_t> next(heard.size(), 0);
  for (std::size_t f = 0; f < internal; ++f)
  {
    const Index rank = united.ranks[mesh.owner[f]];
    if (!united.isOwn[mesh.owner[f]] && united.isOwn[mesh.neighbor[f]])
    {
      if (next[rank] == heard[rank].size())
      {
        throw RanksDisagree("ranks do not have the same faces between them");
      }
      out.faces[f] = heard[rank][next[rank]++];
    }
  }
  return out;
}

} // namespace atria
