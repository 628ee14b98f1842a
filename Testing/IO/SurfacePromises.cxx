// SPDX-License-Identifier: GPL-3.0-or-later
#include "SurfacePromises.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <set>

namespace atria::testing {

namespace {

std::string wrongWithSurfaces(vtkPolyData* output)
{
  vtkFieldData* fields = output->GetFieldData();
  auto* ids = vtkIntArray::SafeDownCast(output->GetCellData()->GetArray("SurfaceId"));
  auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("SurfaceName"));
  auto* materials = vtkStringArray::SafeDownCast(fields->GetAbstractArray("MaterialName"));
  if (!ids || ids->GetNumberOfTuples() != output->GetNumberOfCells() || ids->GetNumberOfComponents() != 1)
  {
    return "SurfaceId is missing or of another length than the cells";
  }
  const vtkIdType count = names ? names->GetNumberOfValues() : 0;
  std::set<std::string> different;
  for (vtkIdType i = 0; i < count; ++i)
  {
    different.insert(names->GetValue(i));
  }
  if (static_cast<vtkIdType>(different.size()) != count || !materials || materials->GetNumberOfValues() != count)
  {
    return "names repeat, or materials are not one a surface";
  }
  vtkDataArray* colors = fields->GetArray("DiffuseColor");
  vtkDataArray* transparencies = fields->GetArray("Transparency");
  if (!colors || colors->GetNumberOfValues() != 3 * count || !transparencies ||
      transparencies->GetNumberOfValues() != count)
  {
    return "colors or transparencies are not one a surface";
  }
  std::set<int> used;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    used.insert(ids->GetValue(i));
  }
  const bool match = !used.empty() && static_cast<vtkIdType>(used.size()) == count && *used.begin() == 0 &&
                     *used.rbegin() == static_cast<int>(count) - 1;
  return match ? "" : "surface ids and names do not match";
}

} // namespace

std::string brokenPromise(vtkPolyData* output)
{
  if (std::string wrong = wrongWithSurfaces(output); !wrong.empty())
  {
    return wrong;
  }
  if (output->GetPoints()->GetDataType() != VTK_DOUBLE)
  {
    return "points are not double";
  }
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    if (output->GetCellType(i) != VTK_TRIANGLE)
    {
      return "a cell is no triangle";
    }
  }
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* p = output->GetPoint(i);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      return "a point is not finite";
    }
  }
  return {};
}

} // namespace atria::testing
