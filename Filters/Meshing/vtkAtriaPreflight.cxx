// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaPreflight.h"

#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "Mesher/Preflight.h"
#include "VtkDualMesh.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkAtriaPreflight);

namespace {

class TableWriter
{
public:
  TableWriter()
  {
    quantities->SetName("Quantity");
    values->SetName("Value");
    units->SetName("Unit");
  }

  void add(const std::string& quantity, double value, const char* unit)
  {
    quantities->InsertNextValue(quantity);
    values->InsertNextValue(value);
    units->InsertNextValue(unit);
  }

  void addNarrow(const std::string& kind, const atria::Narrow& narrow, double across)
  {
    if (narrow.found())
    {
      const atria::Vec3 middle = 0.5 * (narrow.from + narrow.to);
      add(kind + "Width", narrow.width, "m");
      add("OctantsAcross" + kind, across, "");
      for (int axis = 0; axis < 3; ++axis)
      {
        add(kind + "XYZ"[axis], middle[axis], "m");
      }
    }
  }

  void finish(vtkTable* out)
  {
    out->AddColumn(quantities);
    out->AddColumn(values);
    out->AddColumn(units);
  }

private:
  vtkNew<vtkStringArray> quantities;
  vtkNew<vtkDoubleArray> values;
  vtkNew<vtkStringArray> units;
};

void addStrings(vtkTable* out, const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> strings;
  strings->SetName(name);
  for (const std::string& text : texts)
  {
    strings->InsertNextValue(text);
  }
  out->GetFieldData()->AddArray(strings);
}

std::vector<std::string> surfacesOf(const atria::Narrow& narrow, const std::vector<std::string>& names)
{
  std::vector<std::string> found;
  for (const atria::Index surface : narrow.surfaces)
  {
    if (narrow.found() && surface < names.size())
    {
      found.push_back(names[surface]);
    }
  }
  return found;
}

void preflightToVtk(const atria::Preflight& report, const std::vector<std::string>& names, vtkTable* out)
{
  static const char* const sides[6] = {"XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax"};
  TableWriter table;
  table.add("DomainAngle", report.domain.axes.angle(), "degrees");
  table.add("DomainSides", static_cast<double>(report.domain.sides().size()), "");
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& bounds = report.domain.bounds;
    const int axis = atria::axisOf(direction);
    table.add(std::string("Domain") + sides[direction], atria::isUpper(direction) ? bounds.max[axis] : bounds.min[axis],
              "m");
  }
  table.add("GridAngle", report.gridAngle, "degrees");
  if (report.buildingHeight > 0.0)
  {
    table.add("BuildingHeight", report.buildingHeight, "m");
    for (const int direction : {atria::xMin, atria::xMax, atria::yMin, atria::yMax, atria::zMax})
    {
      table.add(std::string("Distance") + sides[direction], report.distances[direction], "H");
    }
    table.add("Blockage", report.blockage, "");
    table.add("Widened", report.widened, "");
  }
  table.addNarrow("Opening", report.narrow.opening, report.octantsAcrossOpening);
  table.addNarrow("Gap", report.narrow.gap, report.octantsAcrossGap);
  table.add("EstimatedElements", static_cast<double>(report.estimatedElements), "");
  table.finish(out);
  atria::hiddenDetailToVtk(report.hidden, names, out->GetFieldData());
  addStrings(out, "Warning", report.warnings);
  addStrings(out, "OpeningSurface", surfacesOf(report.narrow.opening, names));
  addStrings(out, "GapSurface", surfacesOf(report.narrow.gap, names));
}

} // namespace

vtkAtriaPreflight::vtkAtriaPreflight() = default;
vtkAtriaPreflight::~vtkAtriaPreflight() = default;

vtkTable* vtkAtriaPreflight::GetOutput() { return vtkTable::SafeDownCast(this->GetOutputDataObject(0)); }

int vtkAtriaPreflight::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
  return 1;
}

int vtkAtriaPreflight::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (!vtkTable::GetData(outputs))
  {
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkTable>());
  }
  return 1;
}

int vtkAtriaPreflight::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkTable* output = vtkTable::GetData(outputs);
  output->Initialize();
  const atria::AlgorithmRun run(*this);
  const atria::RunContext& context = run.context;
  try
  {
    context.progress.report(0.0, "Reading surfaces");
    std::vector<std::string> warnings;
    const atria::TriangleSurface surface = atria::readSurfaces(vtkDataObject::GetData(inputs[0]), warnings);
    atria::Preflight report = atria::preflight(surface, atria::modelOptionsOf(*this), context);
    report.warnings.insert(report.warnings.begin(), warnings.begin(), warnings.end());
    preflightToVtk(report, surface.names, output);
    context.progress.report(1.0, "Estimated");
  }
  catch (const atria::Aborted&)
  {
    output->Initialize();
    atria::markAborted(outputs);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkAtriaPreflight::PrintSelf(ostream& os, vtkIndent indent) { this->Superclass::PrintSelf(os, indent); }
