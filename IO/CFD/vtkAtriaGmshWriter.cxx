// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaGmshWriter.h"

#include "GmshMesh.h"
#include "VtkFaceMesh.h"

#include <vtkObjectFactory.h>

#include <string>

vtkStandardNewMacro(vtkAtriaGmshWriter);

vtkAtriaGmshWriter::~vtkAtriaGmshWriter() { this->SetFileName(nullptr); }

std::string vtkAtriaGmshWriter::GetTarget() const { return this->FileName ? this->FileName : ""; }

const char* vtkAtriaGmshWriter::GetFormatName() const { return "a Gmsh mesh"; }

const char* vtkAtriaGmshWriter::GetTargetProperty() const { return "FileName"; }

void vtkAtriaGmshWriter::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                   const atria::RunContext& context)
{
  atria::refuseCells(source.cells.view().types, {atria::polyhedronCell});
  this->Place(volume, source.mesh);
  const atria::ElementMesh mesh = atria::makeElementMesh(volume, source, context.part(0.0, 0.3));
  atria::writeGmshMesh(this->FileName, mesh, context.part(0.3, 1.0));
  if (const std::string loss = atria::lossOfSheets(mesh.mesh.mesh); !loss.empty())
  {
    vtkWarningMacro("'" << this->FileName << "': " << loss);
  }
}
