// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkRecordedPatches.h"

#include "AddArray.h"
#include "Support/Error.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkStringArray.h>
#include <vtkTypeUInt32Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>

namespace atria {

namespace {

/// The field arrays of one kind of faces. Each has `cells` cells, then its points; a triangle has its last point twice.
struct Arrays
{
  const char* names;
  const char* counts;
  const char* faces;
  int cells;

  int length() const { return cells + 4; }
};
constexpr Arrays patchArrays{"PatchName", "PatchFaceCount", "PatchFace", 1};
constexpr Arrays zoneArrays{"FaceZoneName", "FaceZoneFaceCount", "FaceZoneFace", 2};

using RecordedFace = std::array<vtkTypeUInt32, 6>;
static_assert(sizeof(Index) == sizeof(vtkTypeUInt32));

RecordedFace recordOf(const VtkPatches& patches, std::size_t f, int cells)
{
  const std::span<const std::int64_t> face = patches.face(f);
  if (face.size() < 3 || face.size() > 4)
  {
    throw Error("a face of a patch has " + std::to_string(face.size()) + " points; three or four can be recorded");
  }
  RecordedFace record;
  record.fill(static_cast<Index>(face.back()));
  record[0] = patches.owners[f];
  record[1] = cells > 1 ? patches.neighbors[f] : 0;
  std::ranges::transform(face, record.begin() + cells, [](std::int64_t p) { return static_cast<Index>(p); });
  return record;
}

/// Appends a face. Returns false if it holds an invalid id.
bool appendRecord(vtkDataArray* faces, vtkIdType f, const Arrays& arrays, VtkPatches& out)
{
  std::array<double, 6> record;
  faces->GetTuple(f, record.data());
  const auto end = record.begin() + arrays.length();
  if (!std::all_of(record.begin(), end, [](double id) { return id >= 0.0 && id < double{noIndex}; }))
  {
    return false;
  }
  const auto last = *(end - 1) == *(end - 2) ? end - 1 : end;
  out.append(static_cast<Index>(record[0]),
             arrays.cells > 1 ? std::optional(static_cast<Index>(record[1])) : std::nullopt,
             std::vector<std::int64_t>(record.begin() + arrays.cells, last));
  return true;
}

void record(const VtkPatches& all, const Arrays& arrays, vtkUnstructuredGrid* volume)
{
  vtkFieldData* data = volume->GetFieldData();
  addArrayOf<vtkStringArray>(data, arrays.names, all.patches, &VtkPatches::Patch::name);
  addArrayOf<vtkIdTypeArray>(data, arrays.counts, all.patches, &VtkPatches::Patch::faceCount);
  auto* faces = addArray<vtkTypeUInt32Array>(data, arrays.faces, arrays.length());
  faces->SetNumberOfTuples(static_cast<vtkIdType>(all.owners.size()));
  for (std::size_t f = 0; f < all.owners.size(); ++f)
  {
    faces->SetTypedTuple(static_cast<vtkIdType>(f), recordOf(all, f, arrays.cells).data());
  }
}

std::optional<VtkPatches> recorded(vtkUnstructuredGrid* volume, const Arrays& arrays)
{
  vtkFieldData* data = volume->GetFieldData();
  auto* names = vtkStringArray::SafeDownCast(data->GetAbstractArray(arrays.names));
  vtkDataArray* counts = data->GetArray(arrays.counts);
  vtkDataArray* faces = data->GetArray(arrays.faces);
  if (!names || !counts || !faces || counts->GetNumberOfValues() != names->GetNumberOfValues() ||
      faces->GetNumberOfComponents() != arrays.length())
  {
    return std::nullopt;
  }
  VtkPatches out;
  const auto total = static_cast<std::size_t>(faces->GetNumberOfTuples());
  std::size_t first = 0;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    const double count = counts->GetComponent(i, 0);
    if (!(count >= 0.0 && count <= static_cast<double>(total - first)))
    {
      return std::nullopt;
    }
    out.patches.push_back({names->GetValue(i), first, static_cast<std::size_t>(count)});
    first += static_cast<std::size_t>(count);
  }
  if (first != total)
  {
    return std::nullopt;
  }
  for (std::size_t f = 0; f < total; ++f)
  {
    if (!appendRecord(faces, static_cast<vtkIdType>(f), arrays, out))
    {
      return std::nullopt;
    }
  }
  return out;
}

} // namespace

void recordPatches(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume)
{
  recordPatches(patchesFromVtk(patches, volume), faceZonesFromVtk(patches, volume), volume);
}

void recordPatches(const VtkPatches& patches, const VtkPatches& faceZones, vtkUnstructuredGrid* volume)
{
  record(patches, patchArrays, volume);
  if (!faceZones.patches.empty())
  {
    record(faceZones, zoneArrays, volume);
  }
}

bool hasRecordedPatches(vtkUnstructuredGrid* volume)
{
  return volume->GetFieldData()->GetAbstractArray(patchArrays.faces) != nullptr;
}

std::optional<VtkPatches> recordedPatches(vtkUnstructuredGrid* volume) { return recorded(volume, patchArrays); }

std::optional<VtkPatches> recordedFaceZones(vtkUnstructuredGrid* volume) { return recorded(volume, zoneArrays); }

} // namespace atria
