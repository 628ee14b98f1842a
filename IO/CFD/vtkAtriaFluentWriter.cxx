// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaFluentWriter.h"

#include "FluentMesh.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaFluentWriter);

vtkAtriaFluentWriter::~vtkAtriaFluentWriter() { this->SetFileName(nullptr); }

std::string vtkAtriaFluentWriter::GetTarget() const { return this->FileName ? this->FileName : ""; }

const char* vtkAtriaFluentWriter::GetFormatName() const { return "a Fluent mesh"; }

const char* vtkAtriaFluentWriter::GetTargetProperty() const { return "FileName"; }

void vtkAtriaFluentWriter::WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context)
{
  atria::writeFluentMesh(this->FileName, mesh, context);
}
