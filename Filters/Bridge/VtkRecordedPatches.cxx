// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkRecordedPatches.h"

#include "Support/Error.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTypeUInt32Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>

namespace atria {

namespace {

const char* const namesArray = "PatchName";
const char* const countsArray = "PatchFaceCount";
const char* const facesArray = "PatchFace";

/// The cell, then the points; a triangle has its last point twice.
constexpr int faceLength = 5;
using RecordedFace = std::array<vtkTypeUInt32, faceLength>;
static_assert(sizeof(Index) == sizeof(vtkTypeUInt32));

RecordedFace recordOf(const VtkPatches& patches, std::size_t f)
{
  const auto begin = patches.points.begin() + patches.offsets[f];
  const auto end = patches.points.begin() + patches.offsets[f + 1];
  if (end - begin < 3 || end - begin >= faceLength)
  {
    throw Error("a face of a patch has " + std::to_string(end - begin) + " points; three or four can be recorded");
  }
  RecordedFace record;
  record.fill(static_cast<Index>(*(end - 1)));
  record[0] = patches.owners[f];
  std::transform(begin, end, record.begin() + 1, [](std::int64_t p) { return static_cast<Index>(p); });
  return record;
}

/// Appends a face; false where it holds what is no id.
bool appendRecord(vtkDataArray* faces, vtkIdType f, VtkPatches& out)
{
  std::array<double, faceLength> record;
  faces->GetTuple(f, record.data());
  const bool sound = std::ranges::all_of(record, [](double id) { return id >= 0.0 && id < double{noIndex}; });
  if (!sound)
  {
    return false;
  }
  out.owners.push_back(static_cast<Index>(record[0]));
  const int length = record[faceLength - 1] == record[faceLength - 2] ? faceLength - 1 : faceLength;
  std::for_each(record.begin() + 1, record.begin() + length,
                [&](double id) { out.points.push_back(static_cast<std::int64_t>(id)); });
  out.offsets.push_back(static_cast<std::int64_t>(out.points.size()));
  return true;
}

} // namespace

void recordPatches(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume)
{
  const VtkPatches all = patchesFromVtk(patches, volume);
  vtkNew<vtkStringArray> names;
  names->SetName(namesArray);
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName(countsArray);
  for (const VtkPatches::Patch& patch : all.patches)
  {
    names->InsertNextValue(patch.name);
    counts->InsertNextValue(static_cast<vtkIdType>(patch.faceCount));
  }
  vtkNew<vtkTypeUInt32Array> faces;
  faces->SetName(facesArray);
  faces->SetNumberOfComponents(faceLength);
  faces->SetNumberOfTuples(static_cast<vtkIdType>(all.owners.size()));
  for (std::size_t f = 0; f < all.owners.size(); ++f)
  {
    faces->SetTypedTuple(static_cast<vtkIdType>(f), recordOf(all, f).data());
  }
  volume->GetFieldData()->AddArray(names);
  volume->GetFieldData()->AddArray(counts);
  volume->GetFieldData()->AddArray(faces);
}

bool hasRecordedPatches(vtkUnstructuredGrid* volume)
{
  return volume->GetFieldData()->GetAbstractArray(facesArray) != nullptr;
}

std::optional<VtkPatches> recordedPatches(vtkUnstructuredGrid* volume)
{
  vtkFieldData* data = volume->GetFieldData();
  auto* names = vtkStringArray::SafeDownCast(data->GetAbstractArray(namesArray));
  vtkDataArray* counts = data->GetArray(countsArray);
  vtkDataArray* faces = data->GetArray(facesArray);
  if (!names || !counts || !faces || counts->GetNumberOfValues() != names->GetNumberOfValues() ||
      faces->GetNumberOfComponents() != faceLength)
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
    if (!appendRecord(faces, static_cast<vtkIdType>(f), out))
    {
      return std::nullopt;
    }
  }
  return out;
}

} // namespace atria
