// SPDX-License-Identifier: GPL-3.0-or-later
/// Fixture of the dual mesher's tests.
#pragma once

#include "MeshOutput.h"
#include "Support/Shapes.h"
#include "Support/VtkErrorGuard.h"
#include "SurfaceInput.h"
#include "vtkAtriaDualMesher.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>

namespace atria::testing {

class DualMesherTest : public VtkTest
{
protected:
  DualMesherTest() { setGrid(mesher, domain, 0.5, 1.0, 2.0); }

  void setSurface(const TriangleSurface& surface) { mesher->SetInputDataObject(toPolyData(surface)); }

  vtkUnstructuredGrid* volume() { return vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0)); }
  vtkPartitionedDataSetCollection* patches()
  {
    return vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1));
  }
  vtkPolyData* diagnostics() { return vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2)); }

  std::map<std::string, vtkPolyData*> namedPatches() { return patchesByName(patches()); }
  double meshVolume() { return totalVolume(volume(), patches()); }
  /// Of elements that are not in the mesh, as they could not be made valid.
  double volumeLeftOut()
  {
    auto* names = vtkStringArray::SafeDownCast(diagnostics()->GetFieldData()->GetAbstractArray("DiagnosticName"));
    vtkCellData* cells = diagnostics()->GetCellData();
    double sum = 0.0;
    for (vtkIdType i = 0; i < diagnostics()->GetNumberOfCells(); ++i)
    {
      const auto kind = static_cast<vtkIdType>(cells->GetArray("Diagnostic")->GetTuple1(i));
      sum += names->GetValue(kind) == "LeftOutElement" ? std::pow(cells->GetArray("Width")->GetTuple1(i), 3) : 0.0;
    }
    return sum;
  }

  /// Copies of the three outputs, brought up to date.
  std::array<vtkSmartPointer<vtkDataObject>, 3> copiesOfOutputs()
  {
    mesher->Update();
    std::array<vtkSmartPointer<vtkDataObject>, 3> copies;
    for (int port = 0; port < 3; ++port)
    {
      copies[port].TakeReference(mesher->GetOutputDataObject(port)->NewInstance());
      copies[port]->DeepCopy(mesher->GetOutputDataObject(port));
    }
    return copies;
  }

  void expectOutputs(const std::array<vtkSmartPointer<vtkDataObject>, 3>& wanted)
  {
    mesher->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    for (int port = 0; port < 3; ++port)
    {
      EXPECT_TRUE(identical(wanted[port], mesher->GetOutputDataObject(port))) << "port " << port;
    }
  }

  void expectEmpty()
  {
    EXPECT_EQ(volume()->GetNumberOfPoints(), 0);
    EXPECT_EQ(volume()->GetNumberOfCells(), 0);
    EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(), 0u);
    EXPECT_EQ(diagnostics()->GetNumberOfPoints(), 0);
  }

  Box3 domain{Vec3(-5, -4, 0), Vec3(7, 5, 6)};
  vtkNew<vtkAtriaDualMesher> mesher;
};

} // namespace atria::testing
