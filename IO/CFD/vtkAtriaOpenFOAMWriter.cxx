// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMWriter.h"

#include "Decomposition.h"
#include "OpenFOAMCase.h"
#include "PropertyRange.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaOpenFOAMWriter);

vtkAtriaOpenFOAMWriter::~vtkAtriaOpenFOAMWriter() { this->SetCaseDirectory(nullptr); }

std::string vtkAtriaOpenFOAMWriter::GetTarget() const { return this->CaseDirectory ? this->CaseDirectory : ""; }

const char* vtkAtriaOpenFOAMWriter::GetFormatName() const { return "an OpenFOAM case"; }

const char* vtkAtriaOpenFOAMWriter::GetTargetProperty() const { return "CaseDirectory"; }

void vtkAtriaOpenFOAMWriter::WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context)
{
  this->CheckProperties();
  if (this->NumberOfProcessors > 1)
  {
    atria::refuseProcessorResults(this->CaseDirectory);
  }
  atria::writePolyMesh(this->CaseDirectory, mesh, this->GetFormat(), context.part(0.0, 0.5));
  context.progress.report(0.5, "Completing the case");
  atria::completeCase(this->CaseDirectory);
  this->WriteProcessors(context.part(0.5, 1.0));
}

void vtkAtriaOpenFOAMWriter::WriteProcessors(const atria::RunContext& context)
{
  if (this->NumberOfProcessors > 1)
  {
    atria::writeProcessors(this->CaseDirectory, atria::readPolyMesh(this->CaseDirectory),
                           static_cast<std::size_t>(this->NumberOfProcessors), this->GetFormat(), context);
  }
}

void vtkAtriaOpenFOAMWriter::CheckProperties() { atriaCheckRange(NumberOfProcessors); }

atria::OpenFOAMFormat vtkAtriaOpenFOAMWriter::GetFormat() const
{
  return this->WriteBinary ? atria::OpenFOAMFormat::Binary : atria::OpenFOAMFormat::Ascii;
}

void vtkAtriaOpenFOAMWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "WriteBinary: " << (this->WriteBinary ? "on" : "off") << "\n";
  os << indent << "NumberOfProcessors: " << this->NumberOfProcessors << "\n";
}
