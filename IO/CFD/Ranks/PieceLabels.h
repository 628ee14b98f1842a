// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of cells where a mesh is in pieces.
#pragma once

#include "MeshZones.h"
#include "Ranks/UnionsOnRanks.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace atria {

/// Zone numbers of cells: ZoneId, and the numbers of named rooms and cell zones, as in SolverSource.
class PieceLabels
{
public:
  /// All ranks call it at the same time, with the same arrays. Throws RanksDisagree if the arrays differ.
  PieceLabels(vtkUnstructuredGrid* grid, RankExchange& exchange);

  /// Returns the lists for widen().
  std::vector<IdView> views() const;

  /// One entry per internal face: `between` where named zones meet, else noIndex. Empty if none meet.
  std::vector<Index> zoneOfFaces(const WideNumbers& piece, const FaceMesh& mesh, Index between) const;

  /// Returns the zones of the whole mesh that have cells, with the present cells of this rank. All ranks call it at the
  /// same time.
  std::vector<CellZone> zonesOf(const WideNumbers& piece, const JudgedMesh& now, const UnitedCells& cells,
                                RankExchange& exchange) const;

private:
  struct List
  {
    std::vector<std::string> names; ///< none for ZoneId
    std::vector<std::int64_t> ofCell;
  };

  void add(vtkUnstructuredGrid* grid, const char* ids, const char* names);

  std::vector<List> lists; ///< ZoneId first, if there is one
};

} // namespace atria
