// SPDX-License-Identifier: GPL-3.0-or-later
/// What a rank holds of a mesh that was dealt out, to be worked on where it is.
#pragma once

#include "Quality/Checks/BoxQuality.h"
#include "Quality/Checks/Statistics.h"
#include "Quality/Faces/WidePiece.h"
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

/// A piece with ghost cells and global ids. All ranks make theirs, and call what is said to be of all, at the same
/// time.
class MeshPiece
{
public:
  /// Nothing, on all ranks, unless every rank that has cells has such a piece, and one has cells. `grid` outlives this.
  /// Patches are those given, if they have faces anywhere, else those recorded in the mesh.
  static std::optional<MeshPiece> of(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* given,
                                     vtkMultiProcessController& controller);

  bool isOwn(std::size_t cell) const { return own[cell] != 0; }
  std::vector<Index> ownCells() const;
  std::size_t cellCount() const { return own.size(); }

  /// The metrics of its own cells, and of faces such that each one of the whole mesh is counted once. Nothing where the
  /// faces of patches are not all of the boundary of its own cells.
  std::optional<QualityByBoxes> measure(const RunContext& context) const;

  /// Faces of patches, ghosts' among them where patches are recorded, with the numbers of the piece. A rank without
  /// cells may have no patches.
  const VtkPatches& facesOfPatches() const { return patches; }
  /// Faces of face zones that are of its own cells, with numbers of the whole.
  const VtkPatches& facesOfZones() const { return zones; }

  /// With so many rings of cells about its own, and what cells bear; of all.
  WidePiece widen(int rings, RankExchange& exchange, const Executor& executor,
                  const std::vector<IdView>& labels = {}) const;
  /// By cell of a wide piece, its number here, or noIndex if it is not there.
  std::vector<Index> numbersOf(const WidePiece& wide) const;

  /// Gives ghost cells the values that their ranks have; of all.
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

  /// Numbers of things in the whole, and which one here has a number.
  struct Ids
  {
    std::vector<std::int64_t> ids;
    std::vector<Index> order; ///< in which they rise

    Ids() = default;
    explicit Ids(std::vector<std::int64_t> numbers);
    Index find(std::int64_t id) const; ///< noIndex where it is not here
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
