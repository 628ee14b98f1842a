// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PieceLabels.h"

#include "SolverMesh.h"
#include "Support/Sorting.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace atria {

namespace {

/// Returns the label of each present cell; a union has that of its last cell.
std::vector<std::int64_t> labelsNow(const std::vector<std::int64_t>& before, const JudgedMesh& now)
{
  std::vector<std::int64_t> labels(now.mesh.cellCount);
  for (std::size_t cell = 0; cell < before.size(); ++cell)
  {
    labels[now.cellOf.empty() ? cell : now.cellOf[cell]] = before[cell];
  }
  for (std::size_t i = 0; i < now.added.size(); ++i)
  {
    labels[now.pyramid(i)] = labels[now.added[i]];
  }
  return labels;
}

/// Returns the labels that own cells have on any rank, in ascending order.
std::vector<std::int64_t> usedLabels(const std::vector<std::int64_t>& labels, const UnitedCells& cells,
                                     RankExchange& exchange)
{
  std::vector<std::int64_t> own;
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
  {
    if (cells.isOwn[cell] && (own.empty() || own.back() != labels[cell]))
    {
      own.push_back(labels[cell]);
    }
  }
  sortUnique(own);
  std::vector<std::int64_t> all;
  for (const std::vector<std::int64_t>& some : gatherAll(exchange, own))
  {
    mergeUnique(all, some);
  }
  return all;
}

} // namespace

PieceLabels::PieceLabels(vtkUnstructuredGrid* grid, RankExchange& exchange)
{
  add(grid, "ZoneId", nullptr);
  add(grid, "RoomId", "RoomName");
  add(grid, "CellZoneId", "CellZoneName");
  std::vector<std::size_t> sizes;
  std::ranges::transform(lists, std::back_inserter(sizes), [](const List& list) { return list.names.size(); });
  for (const std::vector<std::size_t>& others : gatherAll(exchange, sizes))
  {
    if (others != sizes)
    {
      throw RanksDisagree("ranks do not have the same zones of cells");
    }
  }
}

void PieceLabels::add(vtkUnstructuredGrid* grid, const char* ids, const char* names)
{
  vtkDataArray* array = grid->GetCellData()->GetArray(ids);
  auto* texts = vtkStringArray::SafeDownCast(names ? grid->GetFieldData()->GetAbstractArray(names) : nullptr);
  if (!array || (names && !texts))
  {
    return;
  }
  List& list = lists.emplace_back();
  for (vtkIdType i = 0; texts && i < texts->GetNumberOfValues(); ++i)
  {
    list.names.push_back(texts->GetValue(i));
  }
  for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
  {
    list.ofCell.push_back(static_cast<std::int64_t>(array->GetComponent(cell, 0)));
  }
}

std::vector<IdView> PieceLabels::views() const
{
  std::vector<IdView> out;
  std::ranges::transform(lists, std::back_inserter(out), [](const List& list) { return IdView(list.ofCell); });
  return out;
}

std::vector<Index> PieceLabels::zoneOfFaces(const WideNumbers& piece, const FaceMesh& mesh, Index between) const
{
  const auto hasNames = [](const List& list) { return !list.names.empty(); };
  if (std::ranges::none_of(lists, hasNames))
  {
    return {};
  }
  std::vector<Index> zoneOf(mesh.internalFaceCount(), noIndex);
  for (std::size_t f = 0; f < zoneOf.size(); ++f)
  {
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      const std::vector<std::int64_t>& labels = piece.labels[i];
      const bool differ = hasNames(lists[i]) && labels[mesh.owner[f]] != labels[mesh.neighbor[f]];
      zoneOf[f] = differ ? between : zoneOf[f];
    }
  }
  const bool isAny = std::ranges::any_of(zoneOf, [](Index zone) { return zone != noIndex; });
  return isAny ? zoneOf : std::vector<Index>();
}

std::vector<CellZone> PieceLabels::zonesOf(const WideNumbers& piece, const JudgedMesh& now, const UnitedCells& cells,
                                           RankExchange& exchange) const
{
  std::vector<CellZone> named;
  std::vector<CellZone> numbered;
  for (std::size_t i = 0; i < lists.size(); ++i)
  {
    const std::vector<std::int64_t> labels = labelsNow(piece.labels[i], now);
    const std::vector<std::int64_t> used = usedLabels(labels, cells, exchange);
    const std::vector<std::string>& names = lists[i].names;
    std::vector<CellZone>& out = names.empty() ? numbered : named;
    std::map<std::int64_t, std::size_t> zoneOf;
    for (const std::int64_t label : used)
    {
      const bool hasName = label >= 0 && label < static_cast<std::int64_t>(names.size());
      if (names.empty() ? used.size() > 1 : hasName)
      {
        zoneOf[label] = out.size();
        out.push_back({names.empty() ? zoneName(label) : names[static_cast<std::size_t>(label)], {}});
      }
    }
    for (std::size_t cell = 0; cell < labels.size(); ++cell)
    {
      if (const auto zone = zoneOf.find(labels[cell]); zone != zoneOf.end())
      {
        out[zone->second].cells.push_back(static_cast<Index>(cell));
      }
    }
  }
  return named.empty() ? numbered : named;
}

} // namespace atria
