// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaCGNSWriter.h"

#include "CgnsMesh.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaCGNSWriter);

vtkAtriaCGNSWriter::~vtkAtriaCGNSWriter() { this->SetFileName(nullptr); }

std::string vtkAtriaCGNSWriter::GetTarget() const { return this->FileName ? this->FileName : ""; }

bool vtkAtriaCGNSWriter::IsAvailable() { return atria::cgnsIsAvailable(); }

const char* vtkAtriaCGNSWriter::GetFormatName() const { return "a CGNS file"; }

const char* vtkAtriaCGNSWriter::GetTargetProperty() const { return "FileName"; }

void vtkAtriaCGNSWriter::WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context)
{
  atria::writeCgnsMesh(this->FileName, mesh, context);
}
