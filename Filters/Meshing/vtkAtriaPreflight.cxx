// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaPreflight.h"

#include "AddArray.h"
#include "AlgorithmProgress.h"
#include "GridInput.h"
#include "Mesher/Preflight.h"
#include "VtkDualMesh.h"

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <cctype>
#include <iterator>

vtkStandardNewMacro(vtkAtriaPreflight);

namespace {

class TableWriter
{
public:
  explicit TableWriter(vtkTable* out)
      : quantities(atria::addArray<vtkStringArray>(out->GetRowData(), "Quantity")),
        values(atria::addArray<vtkDoubleArray>(out->GetRowData(), "Value")),
        units(atria::addArray<vtkStringArray>(out->GetRowData(), "Unit"))
  {
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

private:
  vtkStringArray* quantities;
  vtkDoubleArray* values;
  vtkStringArray* units;
};

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

/// Adds distances to the sides, the largest blockage, and for a prism that is no box the blockages of all winds
/// perpendicular to a side.
void addBySide(const atria::Preflight& report, TableWriter& table)
{
  std::vector<atria::Index> upright;
  std::ranges::transform(report.domain.sides(), std::back_inserter(upright), &atria::PrismSide::number);
  std::ranges::sort(upright); // sides of a box are in the order of Direction
  const auto named = [](const char* what, atria::Index side) {
    std::string name = atria::sideName(side);
    name[0] = static_cast<char>(std::toupper(name[0]));
    return what + name;
  };
  for (const atria::Index side : upright)
  {
    table.add(named("Distance", side), report.distances[side], "H");
  }
  table.add(named("Distance", atria::zMax), report.distances[atria::zMax], "H");
  table.add("Blockage", report.blockages[report.mostBlocked], "");
  for (const atria::Index side : upright)
  {
    if (!report.domain.isBox())
    {
      table.add(named("Blockage", side), report.blockages[side], "");
    }
  }
}

void preflightToVtk(const atria::Preflight& report, const atria::GridOptions& sizes,
                    const std::vector<std::string>& names, vtkTable* out)
{
  static const char* const sides[6] = {"XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax"};
  TableWriter table(out);
  table.add("SizeMax", sizes.sizeMax, "m");
  table.add("SizeMid", sizes.sizeMid, "m");
  table.add("SizeMin", sizes.sizeMin, "m");
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
    addBySide(report, table);
    table.add("Widened", report.widened, "");
  }
  table.addNarrow("Opening", report.narrow.opening, report.octantsAcrossOpening);
  table.addNarrow("Gap", report.narrow.gap, report.octantsAcrossGap);
  table.add("EstimatedElements", static_cast<double>(report.estimatedElements), "");
  atria::hiddenDetailToVtk(report.hidden, names, out->GetFieldData());
  vtkFieldData* data = out->GetFieldData();
  atria::addArrayOf<vtkStringArray>(data, "Warning", report.warnings);
  atria::addArrayOf<vtkStringArray>(data, "InputNote", report.ground.notes);
  atria::addArrayOf<vtkStringArray>(data, "OpeningSurface", surfacesOf(report.narrow.opening, names));
  atria::addArrayOf<vtkStringArray>(data, "GapSurface", surfacesOf(report.narrow.gap, names));
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
  atria::clearOutputs(outputs);
  std::ranges::fill(this->SizesTaken, 0.0);
  return atria::runFilter(*this, outputs, "", [&](const atria::RunContext& context) {
    context.progress.report(0.0, "Reading surfaces");
    std::vector<std::string> warnings;
    const atria::TriangleSurface surface = atria::readSurfaces(vtkDataObject::GetData(inputs[0]), warnings);
    const atria::ModelOptions options = atria::modelOptionsOf(*this, vtkDataObject::GetData(inputs[0]), surface);
    atria::Preflight report = atria::preflight(surface, options, context);
    report.warnings.insert(report.warnings.begin(), warnings.begin(), warnings.end());
    const double taken[3] = {options.sizes.sizeMax, options.sizes.sizeMid, options.sizes.sizeMin};
    std::ranges::copy(taken, this->SizesTaken);
    preflightToVtk(report, options.sizes, surface.names, output);
    for (const std::string& warning : report.warnings)
    {
      vtkWarningMacro(<< warning);
    }
    context.progress.report(1.0, "Estimated");
  });
}

void vtkAtriaPreflight::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SizesTaken: " << this->SizesTaken[0] << " " << this->SizesTaken[1] << " " << this->SizesTaken[2]
     << "\n";
}
