// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PieceCase.h"

#include "OpenFOAMCase.h"
#include "OutputFolders.h"
#include "ProcessorFolders.h"
#include "Quality/Checks/PartCounts.h"
#include "Ranks/PieceLabels.h"
#include "Ranks/PieceProcessor.h"
#include "Ranks/PieceZones.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

namespace atria {

namespace {

namespace fs = std::filesystem;

/// Most rings around a piece. If ranks still disagree with as many, the whole mesh has to be written.
constexpr int mostRings = 4 * unionRings;

/// Throws Error if a rank has no cells.
void checkCells(std::size_t own, RankExchange& exchange)
{
  const auto [cells, empty] = sumAll(exchange, std::array{own, own == 0 ? std::size_t{1} : 0});
  if (empty > 0)
  {
    throw Error("a mesh of " + std::to_string(cells) + " cells cannot be divided among " +
                std::to_string(exchange.ranks()) + " ranks so that each has some");
  }
}

/// Makes and writes the processor of a rank.
class PieceCaseWriter
{
public:
  PieceCaseWriter(const PieceCase& pieceCase, const MeshPiece& meshPiece, vtkUnstructuredGrid* volume,
                  RankExchange& rankExchange, const RunContext& within, int ringCount)
      : target(pieceCase), piece(meshPiece), exchange(rankExchange), context(within), rings(ringCount),
        labels(volume, rankExchange), zones(meshPiece, rankExchange)
  {
  }

  WrittenPieces run()
  {
    FaceMesh first = begin();
    const auto makeMesh = [&] { return first.points.empty() ? makeAgain() : std::exchange(first, FaceMesh()); };
    const PieceOnRanks part{wide, exchange};
    UnionsOnRanks port(part);
    const JudgedMesh now = uniteAndJudge(
        makeMesh, before.patchOf, {target.mergeCells, target.mergeFaces, before.zoneOf}, context.part(0.1, 0.6), port);
    const UnitedCells cells = unitedCells(now, part);
    UnitedPiece united{now,
                       cells,
                       patchNow(now),
                       {},
                       namedZones(faceZonesOf(zones.faces(), now.faceOf, now.mesh)),
                       namedZones(labels.zonesOf(wide, now, cells, exchange))};
    united.patches = namePatches(united);
    const PieceNumbers numbers = numberPiece(now, cells, part, before.ownPoints);
    const FaceNumbers faces = numberFaces(now.mesh, cells, numbers, united.patchOf, exchange);
    context.progress.report(0.7, "Writing the processors' meshes");
    ProcessorMesh made = makeProcessor(united, numbers, faces, static_cast<std::size_t>(exchange.rank()));
    target.place(made.mesh);
    write(made);
    return report(now, cells, !made.cells.empty());
  }

private:
  /// Properties of the mesh before unions that are needed after them.
  struct MeshBefore
  {
    std::size_t internal = 0;
    std::vector<bool> isOwnFace;
    std::vector<Index> patchOf;  ///< one per boundary face; noIndex without a patch
    std::vector<Index> zoneOf;   ///< one per internal face
    std::vector<char> ownPoints; ///< one per point; true if an own cell has it
  };

  WidePiece widen() const { return piece.widen(rings, exchange, context.executor, labels.views()); }

  /// Takes points and cells out of `cells`.
  FaceMesh meshOf(WidePiece& cells) const
  {
    return makeFaceMesh(std::move(cells.points), cells.cells(), cells.faceKeys(), context.executor,
                        [&] { cells.releaseCells(); });
  }

  FaceMesh makeAgain() const
  {
    WidePiece cells = widen();
    return meshOf(cells);
  }

  /// Keeps only the numbers of the wide piece. The mesh is made again where it is needed, which is seldom.
  FaceMesh begin()
  {
    WidePiece cells = widen();
    FaceMesh mesh = meshOf(cells);
    before = {mesh.internalFaceCount(),
              {},
              patchOfFaces(mesh, cells),
              zoneOfFaces(mesh, cells),
              pointsOfOwn(mesh, cells.ownCells())};
    std::ranges::transform(mesh.owner, std::back_inserter(before.isOwnFace),
                           [&](Index cell) { return cells.rings[cell] == 0; });
    wide = std::move(cells);
    return mesh;
  }

  /// Returns the same as zoneOfFaces() of SolverSource.h.
  std::vector<Index> zoneOfFaces(const FaceMesh& mesh, const WideNumbers& cells)
  {
    std::vector<Index> zoneOf = labels.zoneOfFaces(cells, mesh, static_cast<Index>(zones.count()));
    if (zones.count() > 0)
    {
      zoneOf.resize(mesh.internalFaceCount(), noIndex);
      zones.find(cells, mesh, context.executor);
      markZones(zones.faces(), zoneOf);
    }
    return zoneOf;
  }

  std::vector<Index> patchOfFaces(const FaceMesh& mesh, const WidePiece& cells) const
  {
    const std::vector<Index> faces = findBoundaryFaces(mesh, cells.faceKeys(), context.executor);
    std::vector<Index> patchOf(mesh.faceCount() - mesh.internalFaceCount(), noIndex);
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      if (faces[f] == noIndex || patchOf[faces[f] - mesh.internalFaceCount()] != noIndex)
      {
        throw RanksDisagree("a face of a patch is no face of its cell, or in two patches");
      }
      patchOf[faces[f] - mesh.internalFaceCount()] = cells.patchOf[f];
    }
    return patchOf;
  }

  std::vector<Index> patchNow(const JudgedMesh& now) const
  {
    if (now.faceOf.empty())
    {
      return before.patchOf;
    }
    const std::size_t internal = now.mesh.internalFaceCount();
    std::vector<Index> patches(now.mesh.faceCount() - internal, noIndex);
    for (std::size_t i = 0; i < before.patchOf.size(); ++i)
    {
      patches[now.faceOf[before.internal + i] - internal] = before.patchOf[i];
    }
    return patches;
  }

  /// Returns the patches. Faces of own cells in no patch get one of their own, the last.
  std::vector<PatchEntry> namePatches(UnitedPiece& united) const
  {
    std::vector<SolverPatch> patches;
    for (const VtkPatches::Patch& patch : piece.facesOfPatches().patches)
    {
      patches.push_back(solverPatch(patch.name));
    }
    const auto rest = static_cast<Index>(patches.size());
    const FaceMesh& mesh = united.now.mesh;
    std::size_t unclaimed = 0;
    for (std::size_t i = 0; i < united.patchOf.size(); ++i)
    {
      const bool isRest = united.patchOf[i] == noIndex;
      unclaimed += isRest && united.cells.isOwn[mesh.owner[mesh.internalFaceCount() + i]] ? 1 : 0;
      united.patchOf[i] = isRest ? rest : united.patchOf[i];
    }
    const auto [all, names] = sumAll(exchange, std::array{unclaimed, patches.size()});
    if (names != patches.size() * static_cast<std::size_t>(exchange.ranks()))
    {
      throw RanksDisagree("ranks do not have the same patches");
    }
    if (all > 0)
    {
      patches.push_back(unclaimedPatch());
    }
    return patchEntries(patches);
  }

  void write(const ProcessorMesh& made) const
  {
    checkLabels(made.mesh);
    const fs::path unfinished = unfinishedProcessors(target.folder);
    const bool isFirst = exchange.rank() == 0;
    std::optional<NewFolders> folders;
    std::optional<UnfinishedFolder> files;
    if (isFirst)
    {
      folders.emplace(std::vector<fs::path>{target.folder / "system"});
      completeCase(target.folder);
      files.emplace(unfinished);
    }
    exchange.gather({}); // the folder is there
    try
    {
      writeProcessor(unfinished, static_cast<std::size_t>(exchange.rank()), made, target.format, context.progress);
    }
    catch (const OutputError& error)
    {
      throw OutputError("rank " + std::to_string(exchange.rank()) + ": " + error.what());
    }
    Box3 bounds;
    std::ranges::for_each(made.mesh.points, [&](const Vec3& point) { bounds.extend(point); });
    for (const Box3& other : gatherAll(exchange, bounds)) // all are written
    {
      bounds.extend(other.min);
      bounds.extend(other.max);
    }
    if (isFirst)
    {
      placeProcessors(target.folder, static_cast<std::size_t>(exchange.ranks()), bounds.size());
      removeMesh(target.folder);
      folders->keep();
    }
  }

  WrittenPieces report(const JudgedMesh& now, const UnitedCells& cells, bool hasNumbers) const
  {
    std::size_t cellsBefore = 0;
    std::size_t cellsNow = 0;
    std::size_t added = 0;
    for (const Index ring : wide.rings)
    {
      cellsBefore += ring == 0 ? 1 : 0;
    }
    for (std::size_t cell = 0; cell < cells.isOwn.size(); ++cell)
    {
      cellsNow += cells.isOwn[cell] ? 1 : 0;
      added += cells.isOwn[cell] && cell >= now.pyramid(0) ? 1 : 0;
    }
    std::size_t facesBefore = 0;
    std::vector<char> isMade(now.mesh.faceCount(), 0);
    for (std::size_t f = 0; f < before.isOwnFace.size(); ++f)
    {
      const Index face = now.faceOf.empty() ? static_cast<Index>(f) : now.faceOf[f];
      if (face != noIndex)
      {
        facesBefore += before.isOwnFace[f] ? 1 : 0;
        isMade[face] = 1;
      }
    }
    std::size_t facesNow = 0;
    for (std::size_t f = 0; f < isMade.size(); ++f)
    {
      facesNow += isMade[f] && cells.isOwn[now.mesh.owner[f]] ? 1 : 0;
    }
    const auto all = sumAll(exchange, std::array{cellsBefore, cellsNow, added, facesBefore, facesNow});
    return {now.verdict, now.failures, all[0] + all[2] - all[1], all[2], all[3] - all[4], hasNumbers};
  }

  const PieceCase& target;
  const MeshPiece& piece;
  RankExchange& exchange;
  const RunContext& context;
  int rings;
  PieceLabels labels;
  PieceZones zones;
  WideNumbers wide;
  MeshBefore before;
};

} // namespace

WrittenPieces writePieces(const PieceCase& target, const MeshPiece& piece, vtkUnstructuredGrid* grid,
                          RankExchange& exchange, const RunContext& context)
{
  checkCells(piece.ownCells().size(), exchange);
  std::optional<WrittenPieces> written;
  const auto write = [&](int rings) { written = PieceCaseWriter(target, piece, grid, exchange, context, rings).run(); };
  int rings = unionRings;
  while (rings < mostRings && !exchange.agreeOn([&] { write(rings); }))
  {
    rings *= 2;
  }
  if (!written)
  {
    write(rings);
  }
  return std::move(*written);
}

} // namespace atria
