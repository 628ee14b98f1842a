// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaSU2Writer.h"

#include "SU2Mesh.h"
#include "VtkFaceMesh.h"

#include <vtkObjectFactory.h>

#include <utility>

vtkStandardNewMacro(vtkAtriaSU2Writer);

vtkAtriaSU2Writer::~vtkAtriaSU2Writer() { this->SetFileName(nullptr); }

std::string vtkAtriaSU2Writer::GetTarget() const { return this->FileName ? this->FileName : ""; }

const char* vtkAtriaSU2Writer::GetFormatName() const { return "an SU2 mesh"; }

const char* vtkAtriaSU2Writer::GetTargetProperty() const { return "FileName"; }

void vtkAtriaSU2Writer::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                  const atria::RunContext& context)
{
  this->Place(volume, source.mesh);
  const std::vector<atria::BoundaryPatch> patches = atria::boundaryPatchesOf(source);
  const atria::SolverMesh mesh = atria::makeSolverMesh(std::move(source.mesh), patches, {}, context.executor);
  const atria::NativeCells cells = atria::makeNativeCells(mesh.mesh, makeCellFaces(mesh.mesh), source.cells.view(),
                                                          mesh.newPoint, context.progress.part(0.0, 0.3));
  atria::writeSU2Mesh(this->FileName, mesh, cells, context.part(0.3, 1.0));
  if (cells.invertedCells > 0)
  {
    vtkWarningMacro("'" << this->FileName << "': " << cells.invertedCells << " parts of " << cells.dividedPolyhedra
                        << " polyhedra are inside out, as no point sees all faces of their polyhedra");
  }
  if (const std::size_t common = atria::facesWithCommonPoints(mesh.mesh); common > 0)
  {
    vtkWarningMacro("'" << this->FileName << "': " << common
                        << " faces of sheets one face wide have the points of the other side, so that SU2 does not see "
                           "a wall there; mesh finer, or write another format");
  }
}
