// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaVRMLReader.h"

#include "Evaluator.h"
#include "Input.h"
#include "Library.h"
#include "ModelSource.h"
#include "PropertyRange.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaVRMLReader);

bool vtkAtriaVRMLReader::CanReadFile(const char* fileName)
{
  using atria::vrml::Version;
  const Version version = fileName ? atria::vrml::versionOf(atria::vrml::readStart(fileName)) : Version::missing;
  return version == Version::vrml97 || version == Version::vrml1;
}

void vtkAtriaVRMLReader::CheckProperties()
{
  this->Superclass::CheckProperties();
  atriaCheckRange(TessellationAngle);
  atriaCheckRange(TessellationError);
}

atria::scene::ModelSource vtkAtriaVRMLReader::ReadSource(atria::scene::Diagnostics& diagnostics,
                                                         const atria::ProgressRange& progress)
{
  atria::vrml::Library library(diagnostics, progress.part(0.0, 0.7));
  const atria::vrml::Document& document = library.open(this->FileName);
  atria::vrml::Evaluator evaluator(library, diagnostics, progress.part(0.7, 1.0),
                                   {this->TessellationAngle, this->TessellationError / this->MetersPerUnit()});
  atria::scene::ModelSource source;
  source.scene = evaluator.run(document);
  source.name = document.displayName();
  source.head = document.head;
  return source;
}

void vtkAtriaVRMLReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TessellationAngle: " << this->TessellationAngle << "\n";
  os << indent << "TessellationError: " << this->TessellationError << "\n";
}
