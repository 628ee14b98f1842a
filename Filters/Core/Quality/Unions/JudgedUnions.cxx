// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/JudgedUnions.h"

#include "Quality/Checks/CheckTexts.h"
#include "Quality/Unions/MergeCells.h"
#include "Quality/Unions/MergeFaces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

namespace atria {

namespace {

/// Bits that say which unions a new cell stems from.
enum UnionPart : std::uint8_t
{
  noUnion = 0,
  ofCells = 1,
  ofFaces = 2
};

/// Returns one entry per cell: true if the cell, one of its faces or one of its points fails a check that is an error.
std::vector<bool> failingCells(const MeasuredMesh& mesh, const MeshVerdict& verdict)
{
  const std::vector<std::uint32_t> failed = failedErrorsOfCells(mesh, verdict);
  return {failed.begin(), failed.end()};
}

/// A cell that fails, and the cells that share faces with it.
struct FailingCell
{
  Index cell;
  std::vector<Index> beside;
};

std::vector<FailingCell> withCellsBeside(const std::vector<bool>& fails, const MeasuredMesh& measured)
{
  const FaceMesh& mesh = measured.mesh;
  std::vector<FailingCell> out;
  for (Index cell = 0; cell < fails.size(); ++cell)
  {
    if (!fails[cell])
    {
      continue;
    }
    out.push_back({cell, {}});
    for (const Index face : measured.cellFaces.of(cell))
    {
      if (face < mesh.internalFaceCount())
      {
        out.back().beside.push_back(mesh.owner[face] == cell ? mesh.neighbor[face] : mesh.owner[face]);
      }
    }
  }
  return out;
}

class UnionJudge
{
public:
  UnionJudge(const std::function<FaceMesh()>& meshSource, std::span<const Index> patchOfFace,
             const UnionOptions& unionOptions, const RunContext& within, UnionPort& parts)
      : makeMesh(meshSource), patchOf(patchOfFace), options(unionOptions), context(within), port(parts),
        atEnd(port.cellsAtEnd()), keptCells(unionOptions.keptCells.begin(), unionOptions.keptCells.end())
  {
  }

  JudgedMesh run()
  {
    FaceMesh start = makeMesh();
    for (double left = 1.0;; left *= 0.5)
    {
      const RunContext round = context.part(1.0 - left, 1.0 - 0.5 * left);
      JudgedMesh now = unite(std::move(start), round);
      const std::vector<FailingCell> failing = judge(now, round.part(0.5, 0.8));
      if (!port.isAnywhere(!now.cellOf.empty() || !now.faceOf.empty()) || now.verdict.ok() ||
          !keepSound(failing, now, round.part(0.8, 1.0)))
      {
        port.expectSame(now);
        now.failures = failureTexts(now.verdict);
        return now;
      }
      start = source;
    }
  }

private:
  JudgedMesh unite(FaceMesh&& mesh, const RunContext& round) const
  {
    JudgedMesh now;
    now.mesh = std::move(mesh);
    const std::size_t internalBefore = now.mesh.internalFaceCount();
    if (options.mergeCells)
    {
      const std::vector<Index> kept = withEnd(keptCells);
      MergedCells cells =
          mergeUnderdeterminedCells(now.mesh, patchOf, round.part(0.0, 0.3), {kept, options.zoneOf, port.before()});
      now.cellOf = std::move(cells.cellOf);
      now.added = std::move(cells.added);
      now.faceOf = std::move(cells.faceOf);
      now.mergedCells = cells.count;
    }
    if (options.mergeFaces)
    {
      std::vector<Index> kept = withEnd(keptFaces);
      std::ranges::transform(kept, kept.begin(),
                             [&](Index cell) { return now.cellOf.empty() ? cell : now.cellOf[cell]; });
      sortUnique(kept);
      const std::vector<Index> zones = zonesNow(now);
      const MergedFaces faces =
          mergeCoplanarFaces(now.mesh, patchNow(now, internalBefore), round.part(0.3, 0.5), {kept, zones});
      now.mergedFaces = faces.count;
      follow(now.faceOf, faces);
    }
    return now;
  }

  std::vector<FailingCell> judge(JudgedMesh& now, const RunContext& within)
  {
    const MeasuredMesh measured = measureMesh(now.mesh, within.part(0.0, 0.3));
    now.verdict = checkMesh(measured, within.part(0.3, 1.0), port.after(now));
    return withCellsBeside(failingCells(measured, now.verdict), measured);
  }

  std::vector<Index> withEnd(std::vector<Index> cells) const
  {
    mergeUnique(cells, atEnd);
    return cells;
  }

  /// Returns `patchOf` for the faces after merging cells.
  std::vector<Index> patchNow(const JudgedMesh& now, std::size_t internalBefore) const
  {
    std::vector<Index> patches(patchOf.begin(), patchOf.end());
    const std::size_t internal = now.mesh.internalFaceCount();
    for (std::size_t i = 0; !now.faceOf.empty() && i < patchOf.size(); ++i)
    {
      patches[now.faceOf[internalBefore + i] - internal] = patchOf[i];
    }
    return patches;
  }

  /// Returns `options.zoneOf` for the faces after merging cells.
  std::vector<Index> zonesNow(const JudgedMesh& now) const
  {
    if (now.faceOf.empty() || options.zoneOf.empty())
    {
      return {options.zoneOf.begin(), options.zoneOf.end()};
    }
    std::vector<Index> zones(now.mesh.internalFaceCount(), noIndex);
    for (std::size_t face = 0; face < options.zoneOf.size(); ++face)
    {
      if (options.zoneOf[face] != noIndex)
      {
        zones[now.faceOf[face]] = options.zoneOf[face]; // never within a cell
      }
    }
    return zones;
  }

  static void follow(std::vector<Index>& faceOf, const MergedFaces& faces)
  {
    if (faceOf.empty())
    {
      faceOf = faces.faceOf;
      return;
    }
    for (Index& face : faceOf)
    {
      face = face == noIndex ? noIndex : faces.nowOf(face);
    }
  }

  /// Keeps valid cells unmerged in the next round if their union, or a cell beside it, fails. Returns true if there are
  /// any new ones in any part.
  bool keepSound(const std::vector<FailingCell>& failing, const JudgedMesh& now, const RunContext& within)
  {
    judgeSource(within);
    const std::vector<bool> sound = soundBefore(now);
    const std::vector<std::uint8_t> parts = partsOf(now);
    std::vector<Index> undone;
    for (const auto& [cell, beside] : failing)
    {
      if (sound[cell] && parts[cell] != noUnion)
      {
        undone.push_back(cell);
      }
      else if (sound[cell])
      {
        std::ranges::copy_if(beside, std::back_inserter(undone), [&](Index other) { return parts[other] != noUnion; });
      }
    }
    std::erase_if(undone, [&](Index cell) { return !sound[cell]; });
    sortUnique(undone);
    return keep(undone, parts, now);
  }

  /// Judges the mesh without unions, once.
  void judgeSource(const RunContext& within)
  {
    if (!isSourceJudged)
    {
      source = makeMesh();
      const MeasuredMesh measured = measureMesh(source, within.part(0.0, 0.3));
      failedBefore = failingCells(measured, checkMesh(measured, within.part(0.3, 1.0), port.before()));
      isSourceJudged = true;
    }
  }

  /// Returns one entry per new cell: true if none of its old cells failed.
  std::vector<bool> soundBefore(const JudgedMesh& now) const
  {
    std::vector<bool> sound(now.mesh.cellCount, true);
    for (Index cell = 0; cell < failedBefore.size(); ++cell)
    {
      sound[cellNow(now, cell)] = sound[cellNow(now, cell)] && !failedBefore[cell];
    }
    for (std::size_t i = 0; i < now.added.size(); ++i)
    {
      sound[now.pyramid(i)] = sound[now.added[i]];
    }
    return sound;
  }

  static Index cellNow(const JudgedMesh& now, Index cell) { return now.cellOf.empty() ? cell : now.cellOf[cell]; }

  /// Returns the UnionPart bits, one entry per new cell.
  std::vector<std::uint8_t> partsOf(const JudgedMesh& now) const
  {
    std::vector<std::uint8_t> parts(now.mesh.cellCount, noUnion);
    markCells(now, parts);
    std::vector<std::uint8_t> uses(now.mesh.faceCount(), 0);
    for (const Index face : now.faceOf)
    {
      if (face != noIndex && uses[face]++ == 1)
      {
        parts[now.mesh.owner[face]] |= ofFaces;
        if (face < now.mesh.internalFaceCount())
        {
          parts[now.mesh.neighbor[face]] |= ofFaces;
        }
      }
    }
    return parts;
  }

  static void markCells(const JudgedMesh& now, std::vector<std::uint8_t>& parts)
  {
    std::vector<bool> seen(now.mesh.cellCount, false);
    for (const Index cell : now.cellOf)
    {
      parts[cell] |= seen[cell] ? ofCells : noUnion;
      seen[cell] = true;
    }
    for (std::size_t i = 0; i < now.added.size(); ++i)
    {
      parts[now.added[i]] |= ofCells;
      parts[now.pyramid(i)] |= ofCells;
    }
  }

  /// Marks cells to keep in the next round. A merged or cut cell is only undone itself at first; its faces may still
  /// merge. Returns true if anything is undone in any part.
  bool keep(const std::vector<Index>& undone, const std::vector<std::uint8_t>& parts, const JudgedMesh& now)
  {
    std::vector<bool> isUndone(now.mesh.cellCount, false);
    for (const Index cell : undone)
    {
      isUndone[cell] = true;
    }
    for (std::size_t i = 0; i < now.added.size(); ++i)
    {
      if (isUndone[now.pyramid(i)])
      {
        isUndone[now.added[i]] = true;
      }
    }
    const std::size_t keptBefore = keptCells.size() + keptFaces.size();
    for (Index cell = 0; cell < failedBefore.size(); ++cell)
    {
      const Index at = cellNow(now, cell);
      if (isUndone[at])
      {
        ((parts[at] & ofCells) != 0 ? keptCells : keptFaces).push_back(cell);
      }
    }
    port.share(keptCells);
    port.share(keptFaces);
    return port.isAnywhere(keptCells.size() + keptFaces.size() > keptBefore);
  }

  const std::function<FaceMesh()>& makeMesh;
  std::span<const Index> patchOf;
  const UnionOptions& options;
  const RunContext& context;
  UnionPort& port;
  std::vector<Index> atEnd; ///< cells that no union has
  bool isSourceJudged = false;
  FaceMesh source;                ///< the mesh without unions, once it is needed
  std::vector<bool> failedBefore; ///< one entry per cell of `source`
  std::vector<Index> keptCells;   ///< cells that are neither merged nor cut; rising
  std::vector<Index> keptFaces;   ///< cells whose faces are not merged; rising
};

} // namespace

void UnionPort::share(std::vector<Index>& cells) const { sortUnique(cells); }

JudgedMesh uniteAndJudge(const std::function<FaceMesh()>& makeMesh, std::span<const Index> patchOf,
                         const UnionOptions& options, const RunContext& context, UnionPort& port)
{
  return UnionJudge(makeMesh, patchOf, options, context, port).run();
}

JudgedMesh uniteAndJudge(const std::function<FaceMesh()>& makeMesh, std::span<const Index> patchOf,
                         const UnionOptions& options, const RunContext& context)
{
  UnionPort whole;
  return uniteAndJudge(makeMesh, patchOf, options, context, whole);
}

} // namespace atria
