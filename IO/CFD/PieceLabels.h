// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of cells where a mesh is in pieces.
#pragma once

#include "MeshZones.h"
#include "Quality/Unions/JudgedUnions.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace atria {

/// Numbers that cells bear: ZoneId, and those of rooms and cell zones that have names, as in SolverSource.
class PieceLabels
{
public:
  /// Of all ranks, which have the same arrays: throws RanksDisagree where they have not.
  PieceLabels(vtkUnstructuredGrid* grid, RankExchange& exchange);

  /// The lists, as widen() takes them.
  std::vector<IdView> views() const;

  /// By internal face `between` where zones with names meet, noIndex elsewhere; empty where none do.
  std::vector<Index> zoneOfFaces(const WideNumbers& piece, const FaceMesh& mesh, Index between) const;

  /// Those of the whole that have cells, with the cells that are here now. Of all ranks.
  std::vector<CellZone> zonesOf(const WideNumbers& piece, const JudgedMesh& now, const UnitedCells& cells,
                                RankExchange& exchange) const;

private:
  struct List
  {
    std::vector<std::string> names; ///< none of ZoneId
    std::vector<std::int64_t> ofCell;
  };

  void add(vtkUnstructuredGrid* grid, const char* ids, const char* names);

  std::vector<List> lists; ///< ZoneId first, if there is one
};

} // namespace atria
