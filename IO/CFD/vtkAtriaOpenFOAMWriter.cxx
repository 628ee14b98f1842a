// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMWriter.h"

#include "AlgorithmProgress.h"
#include "OpenFOAMCase.h"
#include "Quality/Unions/MergeCells.h"
#include "Quality/Unions/MergeFaces.h"
#include "VtkFaceMesh.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <string>

vtkStandardNewMacro(vtkAtriaOpenFOAMWriter);

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

/// What a user should know where the names of patches are lost; else nothing.
std::string lossOf(atria::PatchOrigin origin)
{
  if (origin == atria::PatchOrigin::None)
  {
    return "No patches were given, and none are recorded in the mesh: all of its boundary goes to the patch "
           "defaultFaces. "
           "Give the patches on the second input, such as the mesher's second output; in ParaView choose them in the "
           "dialog of Save Data.";
  }
  if (origin == atria::PatchOrigin::Lost)
  {
    return "The names of the patches are lost, as a filter such as Clip or Threshold has changed the mesh's cells: all "
           "of "
           "its boundary goes to the patch defaultFaces. Write the mesh as the mesher made it, or give the patches of "
           "this mesh on the second input.";
  }
  return {};
}

std::vector<atria::BoundaryPatch> patchesOf(const atria::VtkFaceMesh& source)
{
  std::vector<atria::BoundaryPatch> patches;
  for (const atria::VtkPatches::Patch& patch : source.patches.patches)
  {
    const auto first = source.patchFaces.begin() + static_cast<std::ptrdiff_t>(patch.firstFace);
    patches.push_back({patch.name, {first, first + static_cast<std::ptrdiff_t>(patch.faceCount)}});
  }
  return patches;
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

vtkAtriaOpenFOAMWriter::vtkAtriaOpenFOAMWriter() { this->SetNumberOfInputPorts(2); }

vtkAtriaOpenFOAMWriter::~vtkAtriaOpenFOAMWriter() { this->SetCaseDirectory(nullptr); }

void vtkAtriaOpenFOAMWriter::SetPatchesConnection(vtkAlgorithmOutput* patches) { this->SetInputConnection(1, patches); }

void vtkAtriaOpenFOAMWriter::SetPatchesData(vtkPartitionedDataSetCollection* patches)
{
  this->SetInputDataInternal(1, patches);
}

int vtkAtriaOpenFOAMWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkAtriaOpenFOAMWriter::WriteData()
{
  auto* volume = vtkUnstructuredGrid::SafeDownCast(this->GetInputDataObject(0, 0));
  auto* patches = vtkPartitionedDataSetCollection::SafeDownCast(
      this->GetNumberOfInputConnections(1) > 0 ? this->GetInputDataObject(1, 0) : nullptr);
  if (!this->CaseDirectory || !*this->CaseDirectory)
  {
    vtkErrorMacro("No CaseDirectory was given.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return;
  }
  try
  {
    this->WriteCase(volume, patches);
  }
  catch (const atria::Aborted&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cannot write an OpenFOAM case to '" << this->CaseDirectory << "': " << error.what());
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

void vtkAtriaOpenFOAMWriter::WriteCase(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches)
{
  const atria::AlgorithmRun run(*this);
  const atria::ProgressRange& progress = run.context.progress;
  progress.report(0.0, "Finding faces");
  atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, patches, run.context.executor);
  std::vector<atria::BoundaryPatch> boundary = patchesOf(source);
  atria::Buffer<std::int64_t> zoneIds = zoneIdsOf(volume, run.context.executor);
  this->NumberOfMergedCells = 0;
  this->NumberOfAddedCells = 0;
  this->NumberOfMergedFaces = 0;
  if (this->MergeUnderdeterminedCells)
  {
    const atria::MergedCells merged = mergeCells(source, boundary, zoneIds, run.context.part(0.3, 0.4));
    this->NumberOfMergedCells = static_cast<vtkIdType>(merged.count);
    this->NumberOfAddedCells = static_cast<vtkIdType>(merged.added.size());
  }
  if (this->MergeCoplanarFaces)
  {
    this->NumberOfMergedFaces = static_cast<vtkIdType>(mergeFaces(source, boundary, run.context.part(0.4, 0.5)));
  }
  vtkDataArray* offset = volume->GetFieldData()->GetArray("ModelOffset");
  if (this->RestoreOffset && offset && offset->GetNumberOfValues() == 3)
  {
    const atria::Vec3 moved(offset->GetTuple3(0));
    for (atria::Vec3& p : source.mesh.points)
    {
      p += moved;
    }
  }
  progress.report(0.5, "Writing the mesh");
  const auto format = this->WriteBinary ? atria::OpenFOAMFormat::Binary : atria::OpenFOAMFormat::Ascii;
  atria::writePolyMesh(this->CaseDirectory, source.mesh, boundary, zoneIds, format, run.context.part(0.5, 0.95));
  progress.report(0.95, "Completing the case");
  atria::completeCase(this->CaseDirectory);
  progress.report(1.0, "Case written");
  if (const std::string loss = lossOf(source.origin); !loss.empty())
  {
    vtkWarningMacro("'" << this->CaseDirectory << "': " << loss);
  }
}

void vtkAtriaOpenFOAMWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CaseDirectory: " << (this->CaseDirectory ? this->CaseDirectory : "(none)") << "\n";
  os << indent << "WriteBinary: " << (this->WriteBinary ? "on" : "off") << "\n";
  os << indent << "MergeUnderdeterminedCells: " << (this->MergeUnderdeterminedCells ? "on" : "off") << "\n";
  os << indent << "MergeCoplanarFaces: " << (this->MergeCoplanarFaces ? "on" : "off") << "\n";
  os << indent << "RestoreOffset: " << (this->RestoreOffset ? "on" : "off") << "\n";
  os << indent << "NumberOfMergedCells: " << this->NumberOfMergedCells << "\n";
  os << indent << "NumberOfAddedCells: " << this->NumberOfAddedCells << "\n";
  os << indent << "NumberOfMergedFaces: " << this->NumberOfMergedFaces << "\n";
}
