// SPDX-License-Identifier: GPL-3.0-or-later
/// A rank's piece of a distributed mesh, to be processed in place.
#pragma once

#include "Quality/Checks/BoxQuality.h"
#include "Quality/Checks/Statistics.h"
#include "Ranks/WidePiece.h"
#include "VtkArrays.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <cstdint>
#include <optional>
#include <vector>

class vtkDataArray;
class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria {

/// Sums and extremes over ranks.
class RankReduction : public Reduction
{
public:
  explicit RankReduction(vtkMultiProcessController& ranks) : controller(ranks) {}
  void sum(std::span<double> values) const override;
  void least(std::span<double> values) const override;
  void greatest(std::span<double> values) const override;

private:
  void reduce(std::span<double> values, int operation) const;

  vtkMultiProcessController& controller;
};

/// A piece with ghost cells and global ids. All ranks make their pieces at the same time; functions marked "all ranks"
/// must be called by all at the same time, too.
class MeshPiece
{
public:
  /// Returns the piece, or nullopt on all ranks unless every rank with cells has such a piece, and at least one has
  /// cells. `grid` must outlive it. Patches are the given ones if they have faces anywhere, else those recorded in the
  /// mesh.
  static std::optional<MeshPiece> of(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* given,
                                     vtkMultiProcessController& controller);

  bool isOwn(std::size_t cell) const { return own[cell] != 0; }
  std::vector<Index> ownCells() const;
  std::size_t cellCount() const { return own.size(); }

  /// Returns the metrics of its own cells and of its faces; each face of the whole mesh counts on one rank. Returns
  /// nullopt if the faces of patches are not the whole boundary of its own cells.
  std::optional<QualityByBoxes> measure(const RunContext& context) const;

  /// Faces of patches, with the numbers of the piece; recorded patches include faces of ghosts. A rank without cells
  /// may have no patches.
  const VtkPatches& facesOfPatches() const { return patches; }
  /// Faces of face zones that belong to its own cells, with the numbers of the whole mesh.
  const VtkPatches& facesOfZones() const { return zones; }

  /// Returns the piece with `rings` rings of cells around its own, and the labels of these cells. All ranks.
  WidePiece widen(int rings, RankExchange& exchange, const Executor& executor,
                  const std::vector<IdView>& labels = {}) const;
  /// Returns one entry per cell of a wide piece: its number in this piece, or noIndex.
  std::vector<Index> numbersOf(const WidePiece& wide) const;

  /// Gives ghost cells the values of the ranks that own them. All ranks.
  void fillGhosts(const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const;

private:
  MeshPiece(vtkUnstructuredGrid* piece, vtkMultiProcessController& ranks);
  void takePatches(const VtkPatches& all);
  void takePatches(vtkPartitionedDataSetCollection* given);
  void takePatch(vtkPolyData* patch);
  template <typename IdOf> void takeFace(vtkIdType owner, std::size_t corners, IdOf&& idOf);
  void takeZones(const VtkPatches& all);
  void takeZone(vtkPolyData* zone);
  std::vector<double> answer(std::span<const vtkIdType> asked,
                             const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const;
  void take(const std::vector<double>& answers, const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const;

  /// Numbers in the whole mesh, with a search for the local cell or point of a number.
  struct Ids
  {
    std::vector<std::int64_t> ids;
    std::vector<Index> order; ///< local numbers, sorted by id

    Ids() = default;
    explicit Ids(std::vector<std::int64_t> numbers);
    Index find(std::int64_t id) const; ///< noIndex if it is not in the piece
  };

  vtkUnstructuredGrid* grid;
  vtkMultiProcessController* controller;
  std::vector<char> own;
  std::vector<Index> ghosts;
  Ids cells;
  Ids points;
  VtkPatches patches;
  VtkPatches zones;
};

} // namespace atria
