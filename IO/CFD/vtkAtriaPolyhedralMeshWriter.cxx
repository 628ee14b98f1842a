// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaPolyhedralMeshWriter.h"

#include "Quality/Unions/MergeCells.h"
#include "Quality/Unions/MergeFaces.h"
#include "SolverMesh.h"
#include "Support/RunContext.h"
#include "VtkFaceMesh.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace {

atria::Buffer<std::int64_t> zoneIdsOf(vtkUnstructuredGrid* volume, const atria::Executor& executor)
{
  vtkDataArray* array = volume->GetCellData()->GetArray("ZoneId");
  atria::Buffer<std::int64_t> ids(array ? static_cast<std::size_t>(array->GetNumberOfTuples()) : 0);
  executor.forEach(ids.size(), 65536, [&](std::size_t cell) {
    ids[cell] = static_cast<std::int64_t>(array->GetComponent(static_cast<vtkIdType>(cell), 0));
  });
  return ids;
}

/// By boundary face the number of its patch.
std::vector<atria::Index> patchOfFaces(const atria::FaceMesh& mesh, const std::vector<atria::BoundaryPatch>& patches)
{
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<atria::Index> patchOf(mesh.faceCount() - internal, atria::noIndex);
  for (std::size_t p = 0; p < patches.size(); ++p)
  {
    for (const atria::Index face : patches[p].faces)
    {
      patchOf[face - internal] = static_cast<atria::Index>(p);
    }
  }
  return patchOf;
}

/// Merges cells of `source`, and has patches and zones go by what is left.
atria::MergedCells mergeCells(atria::VtkFaceMesh& source, std::vector<atria::BoundaryPatch>& patches,
                              atria::Buffer<std::int64_t>& zoneIds, const atria::RunContext& context)
{
  atria::MergedCells merged =
      atria::mergeUnderdeterminedCells(source.mesh, patchOfFaces(source.mesh, patches), context);
  if (merged.cellOf.empty())
  {
    return merged;
  }
  for (atria::BoundaryPatch& patch : patches)
  {
    for (atria::Index& face : patch.faces)
    {
      face = merged.faceOf[face];
    }
    std::sort(patch.faces.begin(), patch.faces.end());
  }
  for (std::size_t cell = 0; cell < zoneIds.size(); ++cell)
  {
    zoneIds[merged.cellOf[cell]] = zoneIds[cell]; // never a higher number; cells of one zone only become one
  }
  if (!zoneIds.empty())
  {
    zoneIds.resize(source.mesh.cellCount - merged.added.size());
    std::ranges::transform(merged.added, std::back_inserter(zoneIds), [&](atria::Index cell) { return zoneIds[cell]; });
  }
  return merged;
}

/// Merges faces of `source`, and has patches name the faces that are left.
std::size_t mergeFaces(atria::VtkFaceMesh& source, std::vector<atria::BoundaryPatch>& patches,
                       const atria::RunContext& context)
{
  const atria::MergedFaces merged = atria::mergeCoplanarFaces(source.mesh, patchOfFaces(source.mesh, patches), context);
  if (merged.count == 0)
  {
    return 0;
  }
  for (atria::BoundaryPatch& patch : patches)
  {
    for (atria::Index& face : patch.faces)
    {
      face = merged.faceOf[face];
    }
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  }
  return merged.count;
}

} // namespace

void vtkAtriaPolyhedralMeshWriter::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                             const atria::RunContext& context)
{
  std::vector<atria::BoundaryPatch> patches = atria::boundaryPatchesOf(source);
  atria::Buffer<std::int64_t> zoneIds = zoneIdsOf(volume, context.executor);
  this->NumberOfMergedCells = 0;
  this->NumberOfAddedCells = 0;
  this->NumberOfMergedFaces = 0;
  if (this->MergeUnderdeterminedCells)
  {
    const atria::MergedCells merged = mergeCells(source, patches, zoneIds, context.part(0.0, 0.2));
    this->NumberOfMergedCells = static_cast<vtkIdType>(merged.count);
    this->NumberOfAddedCells = static_cast<vtkIdType>(merged.added.size());
  }
  if (this->MergeCoplanarFaces)
  {
    this->NumberOfMergedFaces = static_cast<vtkIdType>(mergeFaces(source, patches, context.part(0.2, 0.3)));
  }
  this->Place(volume, source.mesh);
  const atria::SolverMesh mesh = atria::makeSolverMesh(std::move(source.mesh), patches, zoneIds, context.executor);
  context.progress.report(0.3, "Writing the mesh");
  this->WriteSolverMesh(mesh, context.part(0.3, 1.0));
}

void vtkAtriaPolyhedralMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MergeUnderdeterminedCells: " << (this->MergeUnderdeterminedCells ? "on" : "off") << "\n";
  os << indent << "MergeCoplanarFaces: " << (this->MergeCoplanarFaces ? "on" : "off") << "\n";
  os << indent << "NumberOfMergedCells: " << this->NumberOfMergedCells << "\n";
  os << indent << "NumberOfAddedCells: " << this->NumberOfAddedCells << "\n";
  os << indent << "NumberOfMergedFaces: " << this->NumberOfMergedFaces << "\n";
}
