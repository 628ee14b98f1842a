// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaPolyhedralMeshWriter.h"

#include "AlgorithmProgress.h"
#include "Quality/Unions/JudgedUnions.h"
#include "SolverSource.h"
#include "Support/Error.h"
#include "VtkChecks.h"

#include <vtkAlgorithmOutput.h>
#include <vtkErrorCode.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <utility>

vtkAtriaPolyhedralMeshWriter::vtkAtriaPolyhedralMeshWriter() = default;

vtkAtriaPolyhedralMeshWriter::~vtkAtriaPolyhedralMeshWriter() = default;

/// Merges cells and faces, and reports the verdict on the result.
atria::JudgedMesh vtkAtriaPolyhedralMeshWriter::Unite(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                                      const atria::SolverSource& parts,
                                                      const atria::RunContext& context)
{
  const std::vector<atria::Index> patchOf = atria::patchOfFaces(parts, source.mesh);
  const std::vector<atria::Index> zoneOf = atria::zoneOfFaces(parts, source.mesh, context.executor);
  const auto makeMesh = [&, isFirst = true]() mutable {
    return std::exchange(isFirst, false) ? std::move(source.mesh)
                                         : atria::faceMeshFromVtk(volume, this->GetPatches(), context.executor).mesh;
  };
  atria::JudgedMesh written = atria::uniteAndJudge(
      makeMesh, patchOf, {this->MergeUnderdeterminedCells, this->MergeCoplanarFaces, zoneOf}, context);
  this->Tell(written.verdict, written.mergedCells, written.added.size(), written.mergedFaces);
  return written;
}

bool vtkAtriaPolyhedralMeshWriter::Judge()
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    if (vtkAlgorithm* from = this->GetInputAlgorithm(port, 0))
    {
      from->Update(this->GetInputConnection(port, 0)->GetIndex());
    }
  }
  auto* volume = vtkUnstructuredGrid::SafeDownCast(this->GetInputDataObject(0, 0));
  this->SetErrorCode(vtkErrorCode::NoError);
  this->WriteAndTell([&] {
    if (!volume)
    {
      throw atria::Error("there is no mesh: set the input");
    }
    const atria::AlgorithmRun run(*this);
    run.context.progress.report(0.0, "Finding faces");
    atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, this->GetPatches(), run.context.executor);
    const atria::SolverSource parts = atria::solverSourceOf(volume, source, run.context.executor);
    this->Unite(volume, source, parts, run.context.part(0.3, 1.0));
  });
  return this->GetErrorCode() == vtkErrorCode::NoError;
}

void vtkAtriaPolyhedralMeshWriter::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                             const atria::RunContext& context)
{
  atria::SolverSource parts = atria::solverSourceOf(volume, source, context.executor);
  const std::vector<atria::Index> partOf = this->DivideCells(volume, context.executor);
  parts.partOf = {partOf.begin(), partOf.end()};
  atria::JudgedMesh written = this->Unite(volume, source, parts, context.part(0.0, 0.3));
  atria::followUnions(parts, written);
  this->Place(volume, written.mesh);
  const atria::SolverMesh mesh = atria::solverMeshFrom(std::move(parts), std::move(written.mesh), context.executor);
  context.progress.report(0.3, "Writing the mesh");
  this->WriteSolverMesh(mesh, context.part(0.3, 1.0));
  for (const std::string& failure : written.failures)
  {
    vtkWarningMacro("'" << this->GetTarget() << "': " << failure);
  }
}

void vtkAtriaPolyhedralMeshWriter::Tell(const atria::MeshVerdict& verdict, std::size_t mergedCells,
                                        std::size_t addedCells, std::size_t mergedFaces)
{
  this->NumberOfMergedCells = static_cast<vtkIdType>(mergedCells);
  this->NumberOfAddedCells = static_cast<vtkIdType>(addedCells);
  this->NumberOfMergedFaces = static_cast<vtkIdType>(mergedFaces);
  this->NumberOfFailedChecks = verdict.failedChecks();
  this->Checks->Initialize();
  atria::checksToVtk(verdict, this->Checks);
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
