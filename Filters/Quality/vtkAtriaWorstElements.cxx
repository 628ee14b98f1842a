// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaWorstElements.h"

#include "AddArray.h"
#include "AlgorithmProgress.h"
#include "PropertyRange.h"
#include "Quality/Checks/WorstElements.h"
#include "Ranks/Ranks.h"
#include "Support/Error.h"
#include "Support/Text.h"
#include "VtkArrays.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

vtkStandardNewMacro(vtkAtriaWorstElements);

namespace {

vtkDataArray* findArray(vtkUnstructuredGrid* mesh, const std::string& name)
{
  if (mesh->GetNumberOfCells() == 0)
  {
    throw atria::Error("the mesh has no cells");
  }
  vtkCellData* cellData = mesh->GetCellData();
  if (vtkDataArray* array = cellData->GetArray(name.c_str()))
  {
    return array;
  }
  std::vector<std::string> known;
  for (int i = 0; i < cellData->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = cellData->GetArray(i))
    {
      known.emplace_back(array->GetName() ? array->GetName() : "(no name)");
    }
  }
  throw atria::Error("the mesh has no cell array '" + name + "'; " +
                     (known.empty() ? "it has none: measure it with vtkAtriaMeshQuality first"
                                    : "choose MetricName from " + atria::joined(known)));
}

/// Copies cells of a grid with the points they need.
class Extractor
{
public:
  Extractor(vtkUnstructuredGrid* from, vtkUnstructuredGrid* to)
      : input(from), output(to), newIds(static_cast<std::size_t>(from->GetNumberOfPoints()), -1)
  {
    points->SetDataType(input->GetPoints()->GetDataType());
    originalPoints->SetName("vtkOriginalPointIds");
    originalCells->SetName("vtkOriginalCellIds");
  }

  void run(const std::vector<atria::Index>& cells)
  {
    const auto count = static_cast<vtkIdType>(cells.size());
    output->GetCellData()->CopyAllOn();
    output->GetCellData()->CopyAllocate(input->GetCellData(), count);
    output->GetPointData()->CopyAllOn();
    output->GetPointData()->CopyAllocate(input->GetPointData());
    output->AllocateEstimate(count, 8);
    for (const atria::Index cell : cells)
    {
      const vtkIdType id = output->GetNumberOfCells();
      insertCell(cell);
      output->GetCellData()->CopyData(input->GetCellData(), cell, id);
      originalCells->InsertNextValue(cell);
    }
    output->SetPoints(points);
    output->GetCellData()->AddArray(originalCells);
    output->GetPointData()->AddArray(originalPoints);
    output->GetFieldData()->PassData(input->GetFieldData());
  }

private:
  vtkIdType newId(vtkIdType point)
  {
    vtkIdType& id = newIds.at(static_cast<std::size_t>(point));
    if (id < 0)
    {
      id = points->InsertNextPoint(input->GetPoint(point));
      output->GetPointData()->CopyData(input->GetPointData(), point, id);
      originalPoints->InsertNextValue(point);
    }
    return id;
  }

  void insertCell(vtkIdType cell)
  {
    const int type = input->GetCellType(cell);
    if (type != VTK_POLYHEDRON)
    {
      input->GetCellPoints(cell, ids);
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        ids->SetId(i, newId(ids->GetId(i)));
      }
    }
    else
    {
      // The stream holds the number of faces, then for each face the number of its points and the points.
      input->GetFaceStream(cell, ids);
      vtkIdType at = 1;
      for (vtkIdType face = 0; face < ids->GetId(0); ++face)
      {
        for (vtkIdType left = ids->GetId(at++); left > 0; --left, ++at)
        {
          ids->SetId(at, newId(ids->GetId(at)));
        }
      }
    }
    output->InsertNextCell(type, ids);
  }

  vtkUnstructuredGrid* input;
  vtkUnstructuredGrid* output;
  std::vector<vtkIdType> newIds;
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdTypeArray> originalPoints;
  vtkNew<vtkIdTypeArray> originalCells;
  vtkNew<vtkIdList> ids;
};

} // namespace

vtkTypeBool vtkAtriaWorstElements::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return atria::processOnRanks(*this, request, inputs, outputs,
                               [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkAtriaWorstElements::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputs[0], 0);
  return atria::runFilter(*this, outputs, "Cannot find the worst elements: ", [&](const atria::RunContext& context) {
    atriaCheckRange(Order);
    atriaCheckRange(NumberOfElements);
    atriaCheckRange(Limit);
    atriaCheckRange(Rings);
    vtkDataArray* array = findArray(input, this->MetricName);
    std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
    }
    atria::WorstElementsOptions options;
    options.greatestIsWorst =
        this->Order == Automatic ? atria::greatestIsWorst(this->MetricName) : this->Order == GreatestFirst;
    if (this->UseLimit)
    {
      options.limit = this->Limit;
    }
    else
    {
      options.count = static_cast<std::size_t>(this->NumberOfElements);
    }
    options.rings = this->Rings;
    const atria::VtkCells cells(input);
    const atria::WorstElements worst = atria::findWorstElements(
        values, cells.view(), static_cast<std::size_t>(input->GetNumberOfPoints()), options, context.part(0.0, 0.9));
    vtkNew<vtkUnstructuredGrid> extracted;
    Extractor(input, extracted).run(worst.elements);
    atria::addArrayOf<vtkIntArray>(extracted->GetCellData(), "WorstRank", worst.ranks);
    atria::addArrayOf<vtkIntArray>(extracted->GetCellData(), "Ring", worst.rings);
    context.progress.report(1.0, "Worst elements extracted");
    vtkUnstructuredGrid::GetData(outputs, 0)->ShallowCopy(extracted);
  });
}

void vtkAtriaWorstElements::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MetricName: " << this->MetricName << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "NumberOfElements: " << this->NumberOfElements << "\n";
  os << indent << "UseLimit: " << this->UseLimit << "\n";
  os << indent << "Limit: " << this->Limit << "\n";
  os << indent << "Rings: " << this->Rings << "\n";
}
