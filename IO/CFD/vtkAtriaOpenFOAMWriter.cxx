// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMWriter.h"

#include "OpenFOAMCase.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaOpenFOAMWriter);

vtkAtriaOpenFOAMWriter::~vtkAtriaOpenFOAMWriter() { this->SetCaseDirectory(nullptr); }

std::string vtkAtriaOpenFOAMWriter::GetTarget() const { return this->CaseDirectory ? this->CaseDirectory : ""; }

const char* vtkAtriaOpenFOAMWriter::GetFormatName() const { return "an OpenFOAM case"; }

const char* vtkAtriaOpenFOAMWriter::GetTargetProperty() const { return "CaseDirectory"; }

void vtkAtriaOpenFOAMWriter::WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context)
{
  const auto format = this->WriteBinary ? atria::OpenFOAMFormat::Binary : atria::OpenFOAMFormat::Ascii;
  atria::writePolyMesh(this->CaseDirectory, mesh, format, context.part(0.0, 0.9));
  context.progress.report(0.9, "Completing the case");
  atria::completeCase(this->CaseDirectory);
}

void vtkAtriaOpenFOAMWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "WriteBinary: " << (this->WriteBinary ? "on" : "off") << "\n";
}
