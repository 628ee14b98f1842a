// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaAbaqusWriter.h"

#include "AbaqusMesh.h"
#include "VtkFaceMesh.h"

#include <vtkObjectFactory.h>

#include <string>

vtkStandardNewMacro(vtkAtriaAbaqusWriter);

vtkAtriaAbaqusWriter::~vtkAtriaAbaqusWriter() { this->SetFileName(nullptr); }

std::string vtkAtriaAbaqusWriter::GetTarget() const { return this->FileName ? this->FileName : ""; }

const char* vtkAtriaAbaqusWriter::GetFormatName() const { return "an Abaqus mesh"; }

const char* vtkAtriaAbaqusWriter::GetTargetProperty() const { return "FileName"; }

void vtkAtriaAbaqusWriter::WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source,
                                     const atria::RunContext& context)
{
  atria::refuseCells(source.cells.view().types, {atria::polyhedronCell, atria::pyramidCell});
  this->Place(volume, source.mesh);
  const atria::ElementMesh mesh = atria::makeElementMesh(volume, source, context.part(0.0, 0.3));
  atria::writeAbaqusMesh(this->FileName, mesh, context.part(0.3, 1.0));
  if (const std::string loss = atria::lossOfSheets(mesh.mesh.mesh); !loss.empty())
  {
    vtkWarningMacro("'" << this->FileName << "': " << loss);
  }
}
