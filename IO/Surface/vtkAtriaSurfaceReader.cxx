// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaSurfaceReader.h"

#include "Hints.h"
#include "ModelSource.h"
#include "SceneChanges.h"
#include "Support/Warning.h"
#include "Surfaces.h"

#include "AddArray.h"
#include "AlgorithmProgress.h"
#include "PropertyLists.h"
#include "PropertyRange.h"
#include "Ranks/Ranks.h"
#include "Support/Error.h"
#include "Support/Memory.h"
#include "VtkArrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <system_error>
#include <utility>

namespace {

/// Kinds of warnings shown in VTK's message; GetWarnings has more.
constexpr std::size_t shownWarnings = 20;

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

vtkNew<vtkCellArray> toCells(const std::vector<std::array<atria::Index, 3>>& triangles)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  const auto count = static_cast<vtkIdType>(triangles.size());
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  vtkIdType* corner = connectivity->GetPointer(0);
  atria::useLargePages(corner, 3 * triangles.size() * sizeof(vtkIdType));
  atria::useLargePages(offsets->GetPointer(0), triangles.size() * sizeof(vtkIdType));
  for (const auto& t : triangles)
  {
    corner = std::copy(t.begin(), t.end(), corner);
  }
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Adds names and looks of the surfaces.
void addSurfaces(vtkFieldData* data, const std::vector<atria::scene::Surface>& surfaces)
{
  using atria::scene::Surface;
  atria::addArrayOf<vtkStringArray>(data, "SurfaceName", surfaces, &Surface::name);
  atria::addArrayOf<vtkStringArray>(data, "MaterialName", surfaces, [](const Surface& s) { return s.material.name; });
  auto* colors = atria::addArray<vtkDoubleArray>(data, "DiffuseColor", 3);
  for (const Surface& surface : surfaces)
  {
    colors->InsertNextTuple(surface.material.diffuse.data());
  }
  atria::addArrayOf<vtkDoubleArray>(data, "Transparency", surfaces,
                                    [](const Surface& s) { return s.material.transparency; });
}

/// True if a surface's name, behind those of groups, begins like that of ground, or if its material is that of ground.
bool isGround(const atria::scene::Surface& surface, const atria::scene::ModelSource& source)
{
  const std::string name = surface.name.substr(surface.name.rfind('/') + 1);
  const auto begins = [&](const std::string& start) { return name.compare(0, start.size(), start) == 0; };
  const std::vector<std::string>& materials = source.groundMaterials;
  return std::any_of(source.groundNames.begin(), source.groundNames.end(), begins) ||
         std::find(materials.begin(), materials.end(), surface.material.name) != materials.end();
}

/// Adds the array IsGround if there is ground.
void addGround(vtkFieldData* data, const std::vector<atria::scene::Surface>& surfaces,
               const atria::scene::ModelSource& source)
{
  std::vector<unsigned char> flags(surfaces.size());
  std::ranges::transform(surfaces, flags.begin(), [&](const atria::scene::Surface& surface) {
    return static_cast<unsigned char>(isGround(surface, source) ? 1 : 0);
  });
  if (std::find(flags.begin(), flags.end(), 1) != flags.end())
  {
    atria::addArrayOf<vtkUnsignedCharArray>(data, "IsGround", flags);
  }
}

/// Frees each array as soon as it is copied.
void fill(vtkPolyData* output, atria::scene::Scene scene, const atria::scene::Surfaces& surfaces)
{
  output->SetPoints(atria::pointsToVtk(scene.points));
  scene.points = {};
  output->SetPolys(toCells(scene.triangles));
  scene.triangles = {};
  vtkNew<vtkIntArray> ids;
  ids->SetName("SurfaceId");
  ids->SetNumberOfValues(static_cast<vtkIdType>(surfaces.ids.size()));
  atria::useLargePages(ids->GetPointer(0), surfaces.ids.size() * sizeof(int));
  std::copy(surfaces.ids.begin(), surfaces.ids.end(), ids->GetPointer(0));
  output->GetCellData()->SetScalars(ids); // programs color by scalars by default
  addSurfaces(output->GetFieldData(), surfaces.surfaces);
}

/// Returns the content of a file without surfaces, for a message.
std::string describe(vtkStringArray* skipped, bool isWarnedOf)
{
  std::string text;
  for (vtkIdType i = 0; i < skipped->GetNumberOfValues(); ++i)
  {
    text += (i == 0 ? "" : ", ") + skipped->GetValue(i);
  }
  return !text.empty() ? "it holds " + text
         : isWarnedOf  ? "what it holds cannot be read, as the warnings say"
                       : "it is empty";
}

} // namespace

vtkAtriaSurfaceReader::vtkAtriaSurfaceReader()
    : Warnings(vtkSmartPointer<vtkStringArray>::New()), Notes(vtkSmartPointer<vtkStringArray>::New()),
      SkippedNodes(vtkSmartPointer<vtkStringArray>::New())
{
  this->SetNumberOfInputPorts(0);
}

vtkAtriaSurfaceReader::~vtkAtriaSurfaceReader() { delete[] this->FileName; }

vtkStringArray* vtkAtriaSurfaceReader::GetWarnings() { return this->Warnings; }

vtkStringArray* vtkAtriaSurfaceReader::GetNotes() { return this->Notes; }

vtkStringArray* vtkAtriaSurfaceReader::GetSkippedNodes() { return this->SkippedNodes; }

void vtkAtriaSurfaceReader::AddExcludedSurface(const char* pattern)
{
  atria::addText(*this, this->ExcludedSurfaces, pattern);
}
int vtkAtriaSurfaceReader::GetNumberOfExcludedSurfaces() { return atria::numberOf(this->ExcludedSurfaces); }
std::string vtkAtriaSurfaceReader::GetExcludedSurface(int i) { return atria::entryAt(this->ExcludedSurfaces, i); }
void vtkAtriaSurfaceReader::RemoveAllExcludedSurfaces() { atria::removeAll(*this, this->ExcludedSurfaces); }

/// Keeps the messages of a run, and shows warnings: first the grave ones, which put the whole model in doubt.
void vtkAtriaSurfaceReader::Report(const atria::scene::Diagnostics& diagnostics, const std::vector<std::string>& grave)
{
  const std::size_t count = diagnostics.count() + grave.size();
  this->NumberOfWarnings = static_cast<vtkIdType>(count);
  std::vector<atria::Warning> warnings;
  warnings.reserve(count);
  for (const std::string& text : grave)
  {
    warnings.push_back({text, atria::Gravity::grave});
  }
  for (const std::string& text : diagnostics.texts())
  {
    warnings.push_back({text});
  }
  std::vector<std::string> texts;
  std::ranges::transform(warnings, std::back_inserter(texts), &atria::Warning::text);
  this->Warnings = toStrings(texts, "Warnings").Get();
  this->Notes = toStrings(diagnostics.notes(), "Notes").Get();
  if (this->NumberOfWarnings == 0)
  {
    return;
  }
  std::string text;
  vtkIdType more = this->NumberOfWarnings;
  const std::vector<atria::Warning> all = atria::counted(warnings);
  for (const atria::Warning& warning : std::span(all).first(std::min<std::size_t>(shownWarnings, all.size())))
  {
    text += "\n  " + warning.text;
    more -= static_cast<vtkIdType>(warning.count);
  }
  if (more > 0)
  {
    text += "\n  and " + std::to_string(more) + " more";
  }
  vtkWarningMacro("'" << this->FileName << "' was read with " << this->NumberOfWarnings
                      << (this->NumberOfWarnings == 1 ? " warning:" : " warnings:") << text);
}

double vtkAtriaSurfaceReader::MetersPerUnit() const
{
  switch (this->LengthUnit)
  {
    case Millimeters:
      return 0.001 * this->Scale;
    case Centimeters:
      return 0.01 * this->Scale;
    case Inches:
      return 0.0254 * this->Scale;
    case Feet:
      return 0.3048 * this->Scale;
    default:
      return this->Scale;
  }
}

void vtkAtriaSurfaceReader::CheckProperties()
{
  atriaCheckRange(SurfaceBy);
  atriaCheckRange(SplitAngle);
  atriaCheckRange(UpAxis);
  atriaCheckRange(LengthUnit);
  atriaCheckRange(Scale);
}

/// Returns false if the file has no surfaces. `grave` gets the warnings that put the whole model in doubt.
bool vtkAtriaSurfaceReader::ReadModel(vtkPolyData* output, atria::scene::Diagnostics& diagnostics,
                                      std::vector<std::string>& grave)
{
  this->CheckProperties();
  atria::AlgorithmProgress monitor(*this);
  const atria::ProgressRange progress(monitor);
  progress.report(0.0, "Reading the file");
  atria::scene::ModelSource source = this->ReadSource(diagnostics, progress.part(0.0, 0.9));
  atria::scene::Scene& scene = source.scene;
  for (const auto& [type, count] : scene.skipped)
  {
    this->SkippedNodes->InsertNextValue(type + ": " + std::to_string(count));
  }
  if (scene.triangles.empty())
  {
    return false;
  }
  progress.report(0.9, "Merging faces");
  const int upAxis = this->UpAxis == UnstatedUp ? source.upAxis : this->UpAxis == YUp ? 1 : 2;
  const bool isConverted = source.unitConverted && this->LengthUnit != UnstatedUnit;
  if (isConverted)
  {
    diagnostics.warn(source.name +
                     ": the file states its unit itself, and LengthUnit is left out; correct it by Scale");
  }
  const double scale = isConverted ? this->Scale : this->MetersPerUnit();
  const atria::Vec3 offset = atria::scene::place(scene, {upAxis, scale, this->Recenter});
  if (this->MergeDuplicateFaces)
  {
    this->NumberOfMergedFaces = static_cast<vtkIdType>(
        atria::scene::mergeDuplicateFaces(scene, static_cast<atria::scene::SurfaceBy>(this->SurfaceBy), diagnostics));
  }
  const atria::scene::Stated stated{this->LengthUnit != UnstatedUnit || this->Scale != 1.0,
                                    this->UpAxis != UnstatedUp,
                                    this->Recenter,
                                    source.unitKnown,
                                    source.unitConverted,
                                    source.axisKnown};
  for (const std::string& hint : atria::scene::hintsOf(scene, source.head, stated))
  {
    grave.push_back(source.name + ": " + hint);
  }
  progress.report(0.95, "Naming surfaces");
  scene.faceIds = {};
  if (const std::string hint = atria::scene::hintAtGroupNames(scene); this->SurfaceBy == Shape && !hint.empty())
  {
    diagnostics.warn(source.name + ": " + hint);
  }
  auto surfaces =
      atria::scene::makeSurfaces(scene, static_cast<atria::scene::SurfaceBy>(this->SurfaceBy), this->SplitAngle);
  if (!this->ExcludedSurfaces.empty())
  {
    atria::scene::excludeSurfaces(scene, surfaces, this->ExcludedSurfaces, diagnostics);
  }
  addGround(output->GetFieldData(), surfaces.surfaces, source);
  fill(output, std::move(scene), surfaces);
  atria::addArray<vtkDoubleArray>(output->GetFieldData(), "ModelOffset", 3)->InsertNextTuple(offset.data());
  progress.report(1.0, "Model read");
  return true;
}

namespace {

/// Throws Error for an empty file, of any format, and before any warning.
void checkNotEmpty(const std::string& file)
{
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) == 0 && !error)
  {
    throw atria::Error("'" + file + "' holds no surfaces: it is empty; export the model with its faces");
  }
}

} // namespace

vtkTypeBool vtkAtriaSurfaceReader::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return atria::processOnRanks(*this, request, inputs, outputs,
                               [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkAtriaSurfaceReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->Warnings = vtkSmartPointer<vtkStringArray>::New();
  this->SkippedNodes = vtkSmartPointer<vtkStringArray>::New();
  this->Notes = vtkSmartPointer<vtkStringArray>::New();
  this->NumberOfWarnings = 0;
  this->NumberOfMergedFaces = 0;
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("FileName is not set");
    return 0;
  }
  atria::scene::Diagnostics diagnostics;
  std::vector<std::string> grave;
  try
  {
    checkNotEmpty(this->FileName);
    const bool found = this->ReadModel(output, diagnostics, grave);
    this->Report(diagnostics, grave);
    if (!found)
    {
      vtkErrorMacro("'" << this->FileName
                        << "' holds no surfaces: " << describe(this->SkippedNodes, diagnostics.count() > 0)
                        << "; export the model with its faces");
      return 0;
    }
    return 1;
  }
  catch (const atria::Aborted&)
  {
    output->Initialize();
    atria::markAborted(outputVector);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("not enough memory to read '" << this->FileName << "'");
  }
  catch (const std::exception& error)
  {
    this->Report(diagnostics, grave);
    vtkErrorMacro(<< error.what());
  }
  output->Initialize();
  return 0;
}

void vtkAtriaSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "SurfaceBy: " << this->SurfaceBy << "\n";
  os << indent << "SplitAngle: " << this->SplitAngle << "\n";
  os << indent << "MergeDuplicateFaces: " << (this->MergeDuplicateFaces ? "on" : "off") << "\n";
  os << indent << "UpAxis: " << this->UpAxis << "\n";
  os << indent << "LengthUnit: " << this->LengthUnit << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "Recenter: " << (this->Recenter ? "on" : "off") << "\n";
  for (const std::string& pattern : this->ExcludedSurfaces)
  {
    os << indent << "ExcludedSurface: " << pattern << "\n";
  }
  os << indent << "NumberOfMergedFaces: " << this->NumberOfMergedFaces << "\n";
  os << indent << "Notes: " << this->Notes->GetNumberOfValues() << " strings\n";
  os << indent << "NumberOfWarnings: " << this->NumberOfWarnings << "\n";
  os << indent << "Warnings: " << this->Warnings->GetNumberOfValues() << " strings\n";
  os << indent << "SkippedNodes: " << this->SkippedNodes->GetNumberOfValues() << " strings\n";
}
