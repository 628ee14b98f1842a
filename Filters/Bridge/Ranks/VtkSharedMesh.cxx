// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/VtkSharedMesh.h"

#include "Support/FreedMemory.h"
#include "VtkDualMesh.h"
#include "VtkRecordedPatches.h"
#include "VtkSubset.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace atria {

namespace {

/// A face of a patch or a face zone, with the numbers of the whole mesh. All ranks hold all of them: 36 bytes each.
struct SharedFace
{
  Index patch;
  Index owner;
  Index neighbor; ///< for faces of a face zone; else noIndex
  std::array<Index, 4> points;
  std::uint32_t count;
  int rank;
};

VtkIds idsOf(const std::vector<std::uint64_t>& numbers) { return {numbers.begin(), numbers.end()}; }

void addGhosts(vtkDataSetAttributes* data, const std::vector<char>& isGhost, unsigned char mark)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(static_cast<vtkIdType>(isGhost.size()));
  std::ranges::transform(isGhost, ghosts->GetPointer(0), [mark](char ghost) { return ghost ? mark : 0; });
  data->AddArray(ghosts);
}

/// Marks ghost points. A point belongs to the first rank that has an element at it.
std::vector<char> findGhostPoints(const SharedPiece& piece, int rank)
{
  std::vector<int> first(piece.mesh.points.size(), rank);
  std::vector<char> isOwn(first.size(), 0);
  for (Index e = 0; e < piece.mesh.elementCount(); ++e)
  {
    for (const Index p : piece.mesh.corners[e])
    {
      first[p] = std::min(first[p], piece.elementRanks[e]);
      isOwn[p] |= piece.elementRanks[e] == rank ? 1 : 0;
    }
  }
  std::vector<char> isGhost(first.size());
  for (std::size_t p = 0; p < first.size(); ++p)
  {
    isGhost[p] = isOwn[p] && first[p] == rank ? 0 : 1;
  }
  return isGhost;
}

void numberPiece(const SharedPiece& piece, int rank, vtkUnstructuredGrid* volume)
{
  volume->GetCellData()->SetGlobalIds(idArray("GlobalCellIds", idsOf(piece.elementNumbers)));
  volume->GetPointData()->SetGlobalIds(idArray("GlobalPointIds", idsOf(piece.pointNumbers)));
  std::vector<char> isGhost(piece.elementRanks.size());
  std::ranges::transform(piece.elementRanks, isGhost.begin(), [rank](int its) { return its == rank ? 0 : 1; });
  addGhosts(volume->GetCellData(), isGhost, vtkDataSetAttributes::DUPLICATECELL);
  addGhosts(volume->GetPointData(), findGhostPoints(piece, rank), vtkDataSetAttributes::DUPLICATEPOINT);
}

vtkPolyData* patchOf(vtkPartitionedDataSetCollection* patches, unsigned int i)
{
  return vtkPolyData::SafeDownCast(patches->GetPartitionAsDataObject(i, 0));
}

std::vector<SharedFace> facesOf(vtkPartitionedDataSetCollection* patches, int rank)
{
  std::vector<SharedFace> faces;
  vtkNew<vtkIdList> corners;
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkPolyData* patch = patchOf(patches, i);
    auto* owners = vtkIdTypeArray::SafeDownCast(patch->GetCellData()->GetArray("OwnerCellId"));
    auto* neighbors = vtkIdTypeArray::SafeDownCast(patch->GetCellData()->GetArray("NeighborCellId"));
    auto* points = vtkIdTypeArray::SafeDownCast(patch->GetPointData()->GetArray("VolumePointId"));
    for (vtkIdType face = 0; face < patch->GetNumberOfCells(); ++face)
    {
      patch->GetPolys()->GetCellAtId(face, corners);
      SharedFace& shared = faces.emplace_back();
      shared = {i,
                static_cast<Index>(owners->GetValue(face)),
                neighbors ? static_cast<Index>(neighbors->GetValue(face)) : noIndex,
                {},
                0,
                rank};
      for (const vtkIdType corner : *corners)
      {
        shared.points[shared.count++] = static_cast<Index>(points->GetValue(corner));
      }
    }
  }
  return faces;
}

/// Gathers the faces of all ranks in the order of one process: sorted by patch and element, those of an element as its
/// rank has them.
std::vector<SharedFace> gatherFaces(const std::vector<SharedFace>& own, RankExchange& exchange)
{
  std::vector<SharedFace> all;
  std::vector<SharedFace> some;
  std::vector<Bytes> received = exchange.gather(bytesOf(own));
  all.reserve(std::accumulate(received.begin(), received.end(), std::size_t{0},
                              [](std::size_t sum, const Bytes& bytes) { return sum + bytes.size(); }) /
              sizeof(SharedFace));
  for (Bytes& bytes : received)
  {
    readBytes(std::exchange(bytes, {}), some);
    all.insert(all.end(), some.begin(), some.end());
  }
  release(some);
  std::stable_sort(all.begin(), all.end(), [](const SharedFace& l, const SharedFace& r) {
    return std::tuple(l.patch, l.owner) < std::tuple(r.patch, r.owner);
  });
  return all;
}

/// Gives faces and points of patches global ids, which go on from patch to patch in the order of all faces.
void numberPatches(const std::vector<SharedFace>& all, int rank, vtkPartitionedDataSetCollection* patches)
{
  auto next = all.begin();
  vtkIdType firstPoint = 0;
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    VtkIds faceIds;
    std::unordered_map<Index, vtkIdType> pointIds;
    for (; next != all.end() && next->patch == i; ++next)
    {
      for (std::size_t corner = 0; corner < next->count; ++corner)
      {
        pointIds.try_emplace(next->points[corner], firstPoint + static_cast<vtkIdType>(pointIds.size()));
      }
      if (next->rank == rank)
      {
        faceIds.push_back(static_cast<vtkIdType>(next - all.begin()));
      }
    }
    firstPoint += static_cast<vtkIdType>(pointIds.size());
    vtkPolyData* patch = patchOf(patches, i);
    auto* points = vtkIdTypeArray::SafeDownCast(patch->GetPointData()->GetArray("VolumePointId"));
    VtkIds ownIds(static_cast<std::size_t>(points->GetNumberOfValues()));
    std::transform(points->Begin(), points->End(), ownIds.begin(),
                   [&](vtkIdType point) { return pointIds.at(static_cast<Index>(point)); });
    patch->GetCellData()->SetGlobalIds(idArray("GlobalCellIds", faceIds));
    patch->GetPointData()->SetGlobalIds(idArray("GlobalPointIds", ownIds));
  }
}

void recordFaces(const std::vector<SharedFace>& all, vtkPartitionedDataSetCollection* patches,
                 vtkUnstructuredGrid* volume)
{
  VtkPatches ofPatches;
  VtkPatches ofZones;
  auto next = all.begin();
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    const bool isZone = patchOf(patches, i)->GetCellData()->HasArray("NeighborCellId") != 0;
    VtkPatches& record = isZone ? ofZones : ofPatches;
    const std::size_t first = record.owners.size();
    for (; next != all.end() && next->patch == i; ++next)
    {
      record.append(next->owner, isZone ? std::optional(next->neighbor) : std::nullopt,
                    std::span(next->points).first(next->count));
    }
    record.close(patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()), first);
  }
  recordPatches(ofPatches, ofZones, volume);
}

} // namespace

void sharedMeshToVtk(SharedModel& model, RankExchange& exchange, const Executor& executor, vtkUnstructuredGrid* volume,
                     vtkPartitionedDataSetCollection* patches)
{
  SharedPiece& piece = model.piece;
  const MeshedModel& meshed = model.meshed;
  if (std::max(piece.elementCount, piece.pointCount) >= noIndex)
  {
    throw Error("the mesh has " + std::to_string(piece.elementCount) + " elements and " +
                std::to_string(piece.pointCount) +
                " points, of which there can be 4.2e9; raise the sizes (SizeMax, SizeMid, SizeMin)");
  }
  volumeToVtk(piece.mesh, volume, executor);
  roomsToVtk(meshed.rooms, volume);
  cellZonesToVtk(piece.mesh, meshed.names, meshed.kinds, volume, executor);
  numberPiece(piece, exchange.rank(), volume);
  patchesToVtk(piece.mesh, meshed.metSides, meshed.names, meshed.kinds, meshed.layers, patches,
               NumbersOfAll{piece.elementNumbers, piece.pointNumbers});
  piece = {};
  giveBackFreedMemory(); // otherwise it would still be held while later filters run
  const std::vector<SharedFace> faces = gatherFaces(facesOf(patches, exchange.rank()), exchange);
  numberPatches(faces, exchange.rank(), patches);
  recordFaces(faces, patches, volume);
}

} // namespace atria
