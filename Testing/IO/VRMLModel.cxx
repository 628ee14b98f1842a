// SPDX-License-Identifier: GPL-3.0-or-later
#include "VRMLModel.h"

#include "SurfacePromises.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace atria::testing {

namespace {

using Corners = std::array<std::array<double, 3>, 3>;

std::vector<std::string> toVector(vtkStringArray* array)
{
  std::vector<std::string> out;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    out.push_back(array->GetValue(i));
  }
  return out;
}

double areaOf(const Corners& t)
{
  double a[3];
  double b[3];
  double cross[3];
  vtkMath::Subtract(t[1].data(), t[0].data(), a);
  vtkMath::Subtract(t[2].data(), t[0].data(), b);
  vtkMath::Cross(a, b, cross);
  return 0.5 * vtkMath::Norm(cross);
}

} // namespace

VRMLModel::VRMLModel(const std::filesystem::path& file, double tessellationAngle)
    : VRMLModel(file, [&](vtkAtriaVRMLReader& to) { to.SetTessellationAngle(tessellationAngle); })
{
}

VRMLModel::VRMLModel(const std::filesystem::path& file, const Settings& settings)
    : reader(vtkSmartPointer<vtkAtriaVRMLReader>::New())
{
  reader->SetFileName(file.c_str());
  // Everything as the file has it.
  reader->SetMergeDuplicateFaces(false);
  reader->SetUpAxis(vtkAtriaVRMLReader::ZUp);
  reader->SetLengthUnit(vtkAtriaVRMLReader::Meters);
  settings(*reader);
  reader->Update();
}

VRMLModel::~VRMLModel() = default;

vtkPolyData* VRMLModel::output() const { return reader->GetOutput(); }

long long VRMLModel::triangles() const { return output()->GetNumberOfCells(); }

template <class Visitor> void VRMLModel::forTriangles(int surface, Visitor&& visit) const
{
  auto* ids = vtkIntArray::SafeDownCast(output()->GetCellData()->GetArray("SurfaceId"));
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < output()->GetNumberOfCells(); ++i)
  {
    if (surface >= 0 && ids->GetValue(i) != surface)
    {
      continue;
    }
    output()->GetCellPoints(i, cell);
    Corners corners;
    for (int k = 0; k < 3; ++k)
    {
      output()->GetPoint(cell->GetId(k), corners[k].data());
    }
    visit(corners);
  }
}

int VRMLModel::idOf(const std::string& surface) const
{
  const std::vector<std::string> all = names();
  const auto found = std::find(all.begin(), all.end(), surface);
  if (found == all.end())
  {
    throw std::runtime_error("no surface '" + surface + "'");
  }
  return static_cast<int>(found - all.begin());
}

double VRMLModel::area() const
{
  double sum = 0.0;
  forTriangles(-1, [&](const Corners& t) { sum += areaOf(t); });
  return sum;
}

double VRMLModel::area(const std::string& surface) const
{
  double sum = 0.0;
  forTriangles(idOf(surface), [&](const Corners& t) { sum += areaOf(t); });
  return sum;
}

double VRMLModel::volume() const
{
  double sum = 0.0;
  forTriangles(-1,
               [&](const Corners& t) { sum += vtkMath::Determinant3x3(t[0].data(), t[1].data(), t[2].data()) / 6.0; });
  return sum;
}

std::vector<double> VRMLModel::bounds() const { return bounds(""); }

std::vector<double> VRMLModel::bounds(const std::string& surface) const
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<double> box{inf, -inf, inf, -inf, inf, -inf};
  forTriangles(surface.empty() ? -1 : idOf(surface), [&](const Corners& t) {
    for (const auto& p : t)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        box[2 * axis] = std::min(box[2 * axis], p[axis]);
        box[2 * axis + 1] = std::max(box[2 * axis + 1], p[axis]);
      }
    }
  });
  return box;
}

std::vector<std::string> VRMLModel::fieldStrings(const char* array) const
{
  return toVector(vtkStringArray::SafeDownCast(output()->GetFieldData()->GetAbstractArray(array)));
}

std::vector<double> VRMLModel::numbers(const char* array) const
{
  std::vector<double> out;
  vtkDataArray* values = output()->GetFieldData()->GetArray(array);
  for (vtkIdType i = 0; values && i < values->GetNumberOfValues(); ++i)
  {
    out.push_back(values->GetComponent(i / values->GetNumberOfComponents(),
                                       static_cast<int>(i % values->GetNumberOfComponents())));
  }
  return out;
}

std::vector<std::string> VRMLModel::names() const { return fieldStrings("SurfaceName"); }
std::vector<std::string> VRMLModel::materials() const { return fieldStrings("MaterialName"); }
std::vector<std::string> VRMLModel::warnings() const { return toVector(reader->GetWarnings()); }
std::vector<std::string> VRMLModel::notes() const { return toVector(reader->GetNotes()); }
std::vector<std::string> VRMLModel::skipped() const { return toVector(reader->GetSkippedNodes()); }

std::string VRMLModel::brokenPromise() const { return testing::brokenPromise(output()); }

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines)
  {
    text += line + "\n";
  }
  return text;
}

std::filesystem::path writeFile(const std::filesystem::path& folder, const std::string& name, const std::string& text)
{
  const std::filesystem::path file = folder / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

} // namespace atria::testing
