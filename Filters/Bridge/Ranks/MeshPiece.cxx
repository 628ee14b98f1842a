// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/MeshPiece.h"

#include "Ranks/VtkNumberedPieces.h"
#include "VtkRecordedPatches.h"

#include <vtkCellData.h>
#include <vtkCommunicator.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace atria {

namespace {

constexpr int tag = 27185;

std::vector<std::int64_t> idsOf(vtkDataSetAttributes* data, const char* name)
{
  vtkDataArray* ids = data->GetGlobalIds() ? data->GetGlobalIds() : data->GetArray(name);
  if (!ids)
  {
    return {};
  }
  std::vector<std::int64_t> out(static_cast<std::size_t>(ids->GetNumberOfTuples()));
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    out[i] = static_cast<std::int64_t>(ids->GetComponent(static_cast<vtkIdType>(i), 0)); // exact up to 2^53
  }
  return out;
}

bool hasGhosts(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  return ghosts && std::any_of(ghosts->Begin(), ghosts->End(), [](unsigned char ghost) { return ghost != 0; });
}

/// Returns the sum of `count` over all ranks.
vtkIdType total(vtkIdType count, vtkMultiProcessController& controller)
{
  vtkIdType sum = 0;
  controller.AllReduce(&count, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

void sendValues(const std::vector<double>& values, int rank, vtkMultiProcessController& controller)
{
  const auto count = static_cast<vtkIdType>(values.size());
  controller.Send(&count, 1, rank, tag);
  if (count > 0)
  {
    controller.Send(values.data(), count, rank, tag);
  }
}

std::vector<double> receiveValues(int rank, vtkMultiProcessController& controller)
{
  vtkIdType count = 0;
  controller.Receive(&count, 1, rank, tag);
  std::vector<double> values(static_cast<std::size_t>(count));
  if (count > 0)
  {
    controller.Receive(values.data(), count, rank, tag);
  }
  return values;
}

} // namespace

void RankReduction::reduce(std::span<double> values, int operation) const
{
  const std::vector<double> own(values.begin(), values.end());
  controller.AllReduce(own.data(), values.data(), static_cast<vtkIdType>(own.size()), operation);
}

void RankReduction::sum(std::span<double> values) const { reduce(values, vtkCommunicator::SUM_OP); }
void RankReduction::least(std::span<double> values) const { reduce(values, vtkCommunicator::MIN_OP); }
void RankReduction::greatest(std::span<double> values) const { reduce(values, vtkCommunicator::MAX_OP); }

MeshPiece::Ids::Ids(std::vector<std::int64_t> numbers) : ids(std::move(numbers)), order(ids.size())
{
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [this](Index i) { return std::pair(ids[i], i); });
}

Index MeshPiece::Ids::find(std::int64_t id) const
{
  const auto found = std::ranges::lower_bound(order, id, {}, [this](Index i) { return ids[i]; });
  return found != order.end() && ids[*found] == id ? *found : noIndex;
}

MeshPiece::MeshPiece(vtkUnstructuredGrid* piece, vtkMultiProcessController& ranks)
    : grid(piece), controller(&ranks), own(static_cast<std::size_t>(piece->GetNumberOfCells()), 1)
{
  vtkUnsignedCharArray* marks = grid->GetCellGhostArray();
  if (own.empty() || !marks)
  {
    return;
  }
  for (Index cell = 0; cell < own.size(); ++cell)
  {
    if (marks->GetValue(cell) != 0)
    {
      own[cell] = 0;
      ghosts.push_back(cell);
    }
  }
  cells = Ids(idsOf(grid->GetCellData(), "GlobalCellIds"));
  points = Ids(idsOf(grid->GetPointData(), "GlobalPointIds"));
}

std::optional<MeshPiece> MeshPiece::of(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* given,
                                       vtkMultiProcessController& controller)
{
  const vtkIdType count = grid ? grid->GetNumberOfCells() : 0;
  const vtkIdType faces = given ? given->GetNumberOfElements(vtkDataObject::CELL) : 0;
  const bool areGiven = total(faces, controller) > 0;
  const bool fits =
      grid && (count == 0 || (isNumbered(grid) && hasGhosts(grid) && (areGiven || hasRecordedPatches(grid))));
  const bool isNone = total(fits ? 0 : 1, controller) > 0 || total(count, controller) == 0;
  if (!grid || isNone)
  {
    return std::nullopt;
  }
  MeshPiece piece(grid, controller);
  if (areGiven && given)
  {
    piece.takePatches(given);
  }
  else if (count > 0 && !areGiven)
  {
    piece.takePatches(recordedPatches(grid).value_or(VtkPatches()));
    piece.takeZones(recordedFaceZones(grid).value_or(VtkPatches()));
  }
  return piece;
}

template <typename IdOf> void MeshPiece::takeFace(vtkIdType owner, std::size_t corners, IdOf&& idOf)
{
  const Index cell = cells.find(owner);
  std::vector<std::int64_t> face;
  for (std::size_t i = 0; i < corners && cell != noIndex; ++i)
  {
    face.push_back(points.find(idOf(i)));
  }
  if (face.empty() || std::ranges::find(face, std::int64_t{noIndex}) != face.end())
  {
    return;
  }
  patches.append(cell, std::nullopt, face);
}

void MeshPiece::takePatches(const VtkPatches& all)
{
  for (const VtkPatches::Patch& patch : all.patches)
  {
    const std::size_t before = patches.owners.size();
    for (std::size_t f = patch.firstFace; f < patch.firstFace + patch.faceCount; ++f)
    {
      const std::span<const std::int64_t> face = all.face(f);
      takeFace(all.owners[f], face.size(), [face](std::size_t i) { return static_cast<vtkIdType>(face[i]); });
    }
    patches.close(patch.name, before);
  }
}

void MeshPiece::takeZones(const VtkPatches& all)
{
  for (const VtkPatches::Patch& zone : all.patches)
  {
    const std::size_t before = zones.owners.size();
    for (std::size_t f = zone.firstFace; f < zone.firstFace + zone.faceCount; ++f)
    {
      const Index cell = cells.find(all.owners[f]);
      if (cell != noIndex && isOwn(cell))
      {
        zones.append(all.owners[f], all.neighbors[f], all.face(f));
      }
    }
    zones.close(zone.name, before);
  }
}

void MeshPiece::takeZone(vtkPolyData* zone)
{
  vtkDataArray* owners = zone->GetCellData()->GetArray("OwnerCellId");
  vtkDataArray* neighbors = zone->GetCellData()->GetArray("NeighborCellId");
  vtkDataArray* ids = zone->GetPointData()->GetArray("VolumePointId");
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; owners && neighbors && ids && face < zone->GetNumberOfCells(); ++face)
  {
    zone->GetCellPoints(face, corners);
    std::vector<std::int64_t> ofFace;
    std::transform(corners->begin(), corners->end(), std::back_inserter(ofFace),
                   [ids](vtkIdType corner) { return static_cast<std::int64_t>(ids->GetComponent(corner, 0)); });
    zones.append(static_cast<Index>(owners->GetComponent(face, 0)),
                 static_cast<Index>(neighbors->GetComponent(face, 0)), ofFace);
  }
}

void MeshPiece::takePatches(vtkPartitionedDataSetCollection* given)
{
  for (unsigned int i = 0; i < given->GetNumberOfPartitionedDataSets(); ++i)
  {
    const std::size_t before = patches.owners.size();
    const std::size_t zonesBefore = zones.owners.size();
    bool isZone = false;
    for (unsigned int j = 0; j < given->GetNumberOfPartitions(i); ++j)
    {
      auto* patch = vtkPolyData::SafeDownCast(given->GetPartitionAsDataObject(i, j));
      isZone = isZone || (patch && patch->GetCellData()->GetArray("NeighborCellId"));
      if (patch)
      {
        isZone ? takeZone(patch) : takePatch(patch);
      }
    }
    const std::string name = patchNameOf(given, i);
    isZone ? zones.close(name, zonesBefore) : patches.close(name, before);
  }
}

void MeshPiece::takePatch(vtkPolyData* patch)
{
  vtkDataArray* owners = patch->GetCellData()->GetArray("OwnerCellId");
  vtkDataArray* ids = patch->GetPointData()->GetArray("VolumePointId");
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; owners && ids && face < patch->GetNumberOfCells(); ++face)
  {
    patch->GetCellPoints(face, corners);
    takeFace(static_cast<vtkIdType>(owners->GetComponent(face, 0)), static_cast<std::size_t>(corners->GetNumberOfIds()),
             [&](std::size_t corner) {
               const vtkIdType point = corners->GetId(static_cast<vtkIdType>(corner));
               return static_cast<vtkIdType>(ids->GetComponent(point, 0));
             });
  }
}

std::vector<Index> MeshPiece::ownCells() const
{
  std::vector<Index> list;
  for (Index cell = 0; cell < own.size(); ++cell)
  {
    if (own[cell])
    {
      list.push_back(cell);
    }
  }
  return list;
}

std::optional<QualityByBoxes> MeshPiece::measure(const RunContext& context) const
{
  const VtkCells itsCells(grid);
  const VtkPoints itsPoints(grid->GetPoints(), context.executor);
  const std::vector<BoundaryFaceKey> keys = patches.keys();
  const CountedPart part{
      own, [this](Index one, Index other) { return isOwn(cells.ids[one] < cells.ids[other] ? one : other); }};
  return computeQualityByBoxes(itsPoints.view(), itsCells.view(), {keys, true, {}, {}}, context, measuredAtOnce, &part);
}

WidePiece MeshPiece::widen(int rings, RankExchange& exchange, const Executor& executor,
                           const std::vector<IdView>& labels) const
{
  const VtkCells itsCells(grid);
  const VtkPoints itsPoints(grid->GetPoints(), executor);
  const std::vector<BoundaryFaceKey> keys = patches.keys();
  std::vector<Index> patchOf;
  for (Index p = 0; p < patches.patches.size(); ++p)
  {
    patchOf.resize(patchOf.size() + patches.patches[p].faceCount, p);
  }
  return atria::widen({itsPoints.view(), itsCells.view(), cells.ids, points.ids, own, keys, patchOf, labels}, rings,
                      exchange);
}

std::vector<Index> MeshPiece::numbersOf(const WidePiece& wide) const
{
  std::vector<Index> numbers;
  std::ranges::transform(wide.cellIds, std::back_inserter(numbers), [this](std::int64_t id) { return cells.find(id); });
  return numbers;
}

/// Returns, for each requested cell that is an own one, its place in `asked`, then its values.
std::vector<double> MeshPiece::answer(std::span<const vtkIdType> asked,
                                      const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const
{
  std::vector<double> values;
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const Index cell = cells.find(asked[i]);
    if (cell != noIndex && isOwn(cell))
    {
      values.push_back(static_cast<double>(i));
      std::ranges::transform(arrays, std::back_inserter(values),
                             [cell](vtkDataArray* array) { return array->GetComponent(cell, 0); });
    }
  }
  return values;
}

void MeshPiece::take(const std::vector<double>& answers, const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const
{
  for (auto value = answers.begin(); value != answers.end();)
  {
    const Index cell = ghosts[static_cast<std::size_t>(*value++)];
    for (vtkDataArray* array : arrays)
    {
      array->SetComponent(cell, 0, *value++);
    }
  }
}

void MeshPiece::fillGhosts(const std::vector<vtkSmartPointer<vtkDataArray>>& arrays) const
{
  const auto ranks = static_cast<std::size_t>(controller->GetNumberOfProcesses());
  const int self = controller->GetLocalProcessId();
  std::vector<vtkIdType> wanted;
  std::ranges::transform(ghosts, std::back_inserter(wanted), [this](Index cell) { return vtkIdType{cells.ids[cell]}; });
  const auto count = static_cast<vtkIdType>(wanted.size());
  std::vector<vtkIdType> counts(ranks);
  controller->AllGather(&count, counts.data(), 1);
  for (int asking = 0; asking < static_cast<int>(ranks); ++asking)
  {
    std::vector<vtkIdType> asked =
        asking == self ? wanted : std::vector<vtkIdType>(static_cast<std::size_t>(counts[asking]));
    if (asked.empty())
    {
      continue;
    }
    controller->Broadcast(asked.data(), counts[asking], asking);
    if (asking != self)
    {
      sendValues(answer(asked, arrays), asking, *controller);
      continue;
    }
    for (int other = 0; other < static_cast<int>(ranks); ++other)
    {
      if (other != self)
      {
        take(receiveValues(other, *controller), arrays);
      }
    }
  }
}

} // namespace atria
