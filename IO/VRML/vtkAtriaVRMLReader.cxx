// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaVRMLReader.h"

#include "Evaluator.h"
#include "Input.h"
#include "Library.h"

#include "AlgorithmProgress.h"
#include "Support/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <new>

vtkStandardNewMacro(vtkAtriaVRMLReader);

namespace {

/// Warnings shown in VTK's message; GetWarnings has more.
constexpr vtkIdType shownWarnings = 20;

vtkNew<vtkStringArray> toStrings(const std::vector<std::string>& texts, const char* name)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  return array;
}

vtkNew<vtkPoints> toPoints(const std::vector<atria::Vec3>& source)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(source.size()));
  for (std::size_t i = 0; i < source.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), source[i].data());
  }
  return points;
}

vtkNew<vtkCellArray> toCells(const std::vector<std::array<atria::Index, 3>>& triangles)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  const auto count = static_cast<vtkIdType>(triangles.size());
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, 3 * i);
    for (int k = 0; k < 3; ++k)
    {
      connectivity->SetValue(3 * i + k, triangles[static_cast<std::size_t>(i)][k]);
    }
  }
  offsets->SetValue(count, 3 * count);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  return cells;
}

void fill(vtkPolyData* output, const atria::vrml::Model& model)
{
  output->SetPoints(toPoints(model.points));
  output->SetPolys(toCells(model.triangles));
  vtkNew<vtkIntArray> ids;
  ids->SetName("SurfaceId");
  ids->SetNumberOfValues(static_cast<vtkIdType>(model.surfaceIds.size()));
  std::copy(model.surfaceIds.begin(), model.surfaceIds.end(), ids->GetPointer(0));
  output->GetCellData()->AddArray(ids);
  output->GetFieldData()->AddArray(toStrings(model.surfaceNames, "SurfaceName"));
  output->GetFieldData()->AddArray(toStrings(model.materialNames, "MaterialName"));
}

/// What a file without surfaces holds instead.
std::string describe(const std::map<std::string, std::size_t>& skipped)
{
  std::string text;
  for (const auto& [type, count] : skipped)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + type;
  }
  return text.empty() ? "it is empty" : "it holds " + text;
}

} // namespace

vtkAtriaVRMLReader::vtkAtriaVRMLReader()
    : Warnings(vtkSmartPointer<vtkStringArray>::New()), SkippedNodes(vtkSmartPointer<vtkStringArray>::New())
{
  this->SetNumberOfInputPorts(0);
}

vtkAtriaVRMLReader::~vtkAtriaVRMLReader() { delete[] this->FileName; }

bool vtkAtriaVRMLReader::CanReadFile(const char* fileName)
{
  return fileName && atria::vrml::versionOf(atria::vrml::readStart(fileName)) == atria::vrml::Version::vrml97;
}

vtkStringArray* vtkAtriaVRMLReader::GetWarnings() { return this->Warnings; }

vtkStringArray* vtkAtriaVRMLReader::GetSkippedNodes() { return this->SkippedNodes; }

void vtkAtriaVRMLReader::ReportWarnings()
{
  if (this->NumberOfWarnings == 0)
  {
    return;
  }
  std::string text;
  const vtkIdType shown = std::min(shownWarnings, this->Warnings->GetNumberOfValues());
  for (vtkIdType i = 0; i < shown; ++i)
  {
    text += "\n  " + this->Warnings->GetValue(i);
  }
  if (this->NumberOfWarnings > shown)
  {
    text += "\n  and " + std::to_string(this->NumberOfWarnings - shown) + " more";
  }
  vtkWarningMacro("'" << this->FileName << "' was read with " << this->NumberOfWarnings
                      << (this->NumberOfWarnings == 1 ? " warning:" : " warnings:") << text);
}

int vtkAtriaVRMLReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->Warnings = vtkSmartPointer<vtkStringArray>::New();
  this->SkippedNodes = vtkSmartPointer<vtkStringArray>::New();
  this->NumberOfWarnings = 0;
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("FileName is not set");
    return 0;
  }
  atria::vrml::Diagnostics diagnostics;
  const auto keepWarnings = [&] {
    this->NumberOfWarnings = static_cast<vtkIdType>(diagnostics.count());
    this->Warnings = toStrings(diagnostics.texts(), "Warnings").Get();
    this->ReportWarnings();
  };
  try
  {
    atria::AlgorithmProgress monitor(*this);
    const atria::ProgressRange progress(monitor);
    atria::vrml::Library library(diagnostics, progress.part(0.0, 0.6));
    const atria::vrml::Document& document = library.open(this->FileName);
    atria::vrml::Evaluator evaluator(library, diagnostics, progress.part(0.6, 0.9), this->TessellationAngle);
    const atria::vrml::Model model = evaluator.run(document);
    for (const auto& [type, count] : model.skipped)
    {
      this->SkippedNodes->InsertNextValue(type + ": " + std::to_string(count));
    }
    keepWarnings();
    if (model.triangles.empty())
    {
      vtkErrorMacro("'" << this->FileName << "' holds no surfaces: " << describe(model.skipped));
      return 0;
    }
    progress.report(0.9, "Writing triangles");
    fill(output, model);
    progress.report(1.0, "Model read");
    return 1;
  }
  catch (const atria::Aborted&)
  {
    output->Initialize();
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("not enough memory to read '" << this->FileName << "'");
  }
  catch (const std::exception& error)
  {
    keepWarnings();
    vtkErrorMacro(<< error.what());
  }
  output->Initialize();
  return 0;
}

void vtkAtriaVRMLReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "TessellationAngle: " << this->TessellationAngle << "\n";
  os << indent << "NumberOfWarnings: " << this->NumberOfWarnings << "\n";
  os << indent << "Warnings: " << this->Warnings->GetNumberOfValues() << " strings\n";
  os << indent << "SkippedNodes: " << this->SkippedNodes->GetNumberOfValues() << " strings\n";
}
