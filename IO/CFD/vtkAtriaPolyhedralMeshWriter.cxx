// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaPolyhedralMeshWriter.h"

#include "Quality/Unions/JudgedUnions.h"
#include "SolverMesh.h"
#include "Support/RunContext.h"
#include "VtkChecks.h"
#include "VtkFaceMesh.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <string>
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

/// The patches by the faces that are written.
void followFaces(std::vector<atria::BoundaryPatch>& patches, const std::vector<atria::Index>& faceOf)
{
  if (faceOf.empty())
  {
    return;
  }
  for (atria::BoundaryPatch& patch : patches)
  {
    for (atria::Index& face : patch.faces)
    {
      face = faceOf[face];
    }
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  }
}

/// The zones by the cells that are written.
void followCells(atria::Buffer<std::int64_t>& zoneIds, const atria::JudgedMesh& written)
{
  if (written.cellOf.empty() || zoneIds.empty())
  {
    return;
  }
  for (std::size_t cell = 0; cell < zoneIds.size(); ++cell)
  {
    zoneIds[written.cellOf[cell]] = zoneIds[cell]; // never a higher number; cells of one zone only become one
  }
  zoneIds.resize(written.mesh.cellCount - written.added.size());
  std::ranges::transform(written.added, std::back_inserter(zoneIds), [&](atria::Index cell) { return zoneIds[cell]; });
}

} // namespace

vtkAtriaPolyhedralMeshWriter::vtkAtriaPolyhedralMeshWriter() = default;

vtkAtriaPolyhedralMeshWriter::~vtkAtriaPolyhedralMeshWriter() = default;

void vtkAtriaPolyhedralMeshWriter::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                             const atria::RunContext& context)
{
  std::vector<atria::BoundaryPatch> patches = atria::boundaryPatchesOf(source);
  atria::Buffer<std::int64_t> zoneIds = zoneIdsOf(volume, context.executor);
  const std::vector<atria::Index> patchOf = patchOfFaces(source.mesh, patches);
  const auto makeMesh = [&, isFirst = true]() mutable {
    return std::exchange(isFirst, false) ? std::move(source.mesh)
                                         : atria::faceMeshFromVtk(volume, this->GetPatches(), context.executor).mesh;
  };
  atria::JudgedMesh written = atria::uniteAndJudge(
      makeMesh, patchOf, {this->MergeUnderdeterminedCells, this->MergeCoplanarFaces}, context.part(0.0, 0.3));
  followFaces(patches, written.faceOf);
  followCells(zoneIds, written);
  this->Tell(written);
  this->Place(volume, written.mesh);
  const atria::SolverMesh mesh = atria::makeSolverMesh(std::move(written.mesh), patches, zoneIds, context.executor);
  context.progress.report(0.3, "Writing the mesh");
  this->WriteSolverMesh(mesh, context.part(0.3, 1.0));
  for (const std::string& failure : written.failures)
  {
    vtkWarningMacro("'" << this->GetTarget() << "': " << failure);
  }
}

void vtkAtriaPolyhedralMeshWriter::Tell(const atria::JudgedMesh& written)
{
  this->NumberOfMergedCells = static_cast<vtkIdType>(written.mergedCells);
  this->NumberOfAddedCells = static_cast<vtkIdType>(written.added.size());
  this->NumberOfMergedFaces = static_cast<vtkIdType>(written.mergedFaces);
  this->NumberOfFailedChecks = written.verdict.failedChecks();
  this->Checks->Initialize();
  atria::checksToVtk(written.verdict, this->Checks);
}

vtkTable* vtkAtriaPolyhedralMeshWriter::GetChecks() { return this->Checks; }

void vtkAtriaPolyhedralMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MergeUnderdeterminedCells: " << (this->MergeUnderdeterminedCells ? "on" : "off") << "\n";
  os << indent << "MergeCoplanarFaces: " << (this->MergeCoplanarFaces ? "on" : "off") << "\n";
  os << indent << "NumberOfMergedCells: " << this->NumberOfMergedCells << "\n";
  os << indent << "NumberOfAddedCells: " << this->NumberOfAddedCells << "\n";
  os << indent << "NumberOfMergedFaces: " << this->NumberOfMergedFaces << "\n";
  os << indent << "NumberOfFailedChecks: " << this->NumberOfFailedChecks << "\n";
}
