// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelFaces.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

namespace atria::model {

bool ModelFaces::add(std::span<const std::size_t> corners, int part)
{
  const bool good = corners.size() >= 3 && std::all_of(corners.begin(), corners.end(), [&](std::size_t id) {
                      return id < points.size() && std::all_of(points[id].begin(), points[id].end(),
                                                               [](double value) { return std::isfinite(value); });
                    });
  if (!good)
  {
    ++leftOut;
    return false;
  }
  ids.insert(ids.end(), corners.begin(), corners.end());
  offsets.push_back(ids.size());
  parts.push_back(part);
  return true;
}

vtkSmartPointer<vtkPolyData> ModelFaces::polyData(const std::vector<std::string>& names) const
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const auto& p : points)
  {
    const bool finite = std::all_of(p.begin(), p.end(), [](double value) { return std::isfinite(value); });
    places->InsertNextPoint(finite ? p.data() : std::array<double, 3>{}.data());
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
  {
    const std::vector<vtkIdType> face(ids.begin() + static_cast<std::ptrdiff_t>(offsets[i]),
                                      ids.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1]));
    cells->InsertNextCell(static_cast<vtkIdType>(face.size()), face.data());
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(places);
  data->SetPolys(cells);
  setSurfaces(data, parts, names);
  return data;
}

} // namespace atria::model
