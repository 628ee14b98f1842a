// SPDX-License-Identifier: GPL-3.0-or-later
/// The fixture of tests of the formats that architects' programs exchange.
#pragma once

#include "VRMLModel.h"
#include "vtkAtriaModelReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTriangle.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace atria::testing {

inline std::string sample(const std::string& name) { return bytesOf(dataFolder() / "Models" / name); }

inline std::string houseAs(const std::string& ending) { return sample("house." + ending); }

inline std::string replaced(std::string text, const std::string& old, const std::string& with)
{
  EXPECT_NE(text.find(old), text.npos) << old;
  return text.replace(text.find(old), old.size(), with);
}

class ExchangeModels : public VtkTest
{
protected:
  ExchangeModels() { reader->MergeDuplicateFacesOff(); }

  void read(const std::string& name, const std::string& bytes)
  {
    reader->SetFileName(writeFile(scratch.path(), name, bytes).c_str());
    reader->Modified();
    reader->Update();
    warned = joined(messages.takeWarnings());
    errors = messages.takeErrors();
  }
  vtkIdType triangles() const { return reader->GetOutput()->GetNumberOfCells(); }
  std::vector<std::string> names() const
  {
    auto* array = vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray("SurfaceName"));
    std::vector<std::string> all;
    for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
    {
      all.push_back(array->GetValue(i));
    }
    return all;
  }
  std::string error() const { return errors.empty() ? "" : errors.front(); }
  /// Per surface.
  std::map<std::string, double> areas() const
  {
    std::map<std::string, double> all;
    vtkDataArray* ids = reader->GetOutput()->GetCellData()->GetArray("SurfaceId");
    const std::vector<std::string> known = names();
    for (vtkIdType i = 0; i < triangles(); ++i)
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      reader->GetOutput()->GetCellPoints(i, count, corners);
      double p[3][3];
      for (int k = 0; k < 3; ++k)
      {
        reader->GetOutput()->GetPoint(corners[k], p[k]);
      }
      all[known[static_cast<std::size_t>(ids->GetTuple1(i))]] += vtkTriangle::TriangleArea(p[0], p[1], p[2]);
    }
    return all;
  }
  double area() const
  {
    double sum = 0.0;
    for (const auto& [name, own] : areas())
    {
      sum += own;
    }
    return sum;
  }
  double height() const { return reader->GetOutput()->GetBounds()[5] - reader->GetOutput()->GetBounds()[4]; }

  ScratchFolder scratch;
  vtkNew<vtkAtriaModelReader> reader;
  std::string warned;
  std::vector<std::string> errors;
};

} // namespace atria::testing
