// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of data objects; see MeshOutput.h.
#include "MeshOutput.h"
#include "VtkVersions.h"

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkHyperTreeGrid.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <cstring>

namespace atria::testing {

namespace {

/// Gathers the first difference.
class Comparison
{
public:
  bool same() const { return difference.empty(); }
  ::testing::AssertionResult result() const
  {
    return same() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << difference;
  }

  void require(bool equal, const std::string& what)
  {
    if (!equal && same())
    {
      difference = what + " differs";
    }
  }

  void arrays(vtkAbstractArray* a, vtkAbstractArray* b, const std::string& what)
  {
    require((a != nullptr) == (b != nullptr), what);
    if (a && b)
    {
      require(a->GetDataType() == b->GetDataType() && a->GetNumberOfValues() == b->GetNumberOfValues() &&
                  a->GetNumberOfComponents() == b->GetNumberOfComponents() && same() && sameValues(a, b),
              what);
    }
  }

  void fields(vtkFieldData* a, vtkFieldData* b)
  {
    require(a->GetNumberOfArrays() == b->GetNumberOfArrays(), "the number of arrays");
    for (int i = 0; i < a->GetNumberOfArrays() && same(); ++i)
    {
      const std::string name = a->GetAbstractArray(i)->GetName();
      arrays(a->GetAbstractArray(i), b->GetAbstractArray(name.c_str()), name);
    }
  }

  void cells(vtkCellArray* a, vtkCellArray* b, const char* what)
  {
    arrays(a->GetOffsetsArray(), b->GetOffsetsArray(), what);
    arrays(a->GetConnectivityArray(), b->GetConnectivityArray(), what);
  }

  void points(vtkPointSet* a, vtkPointSet* b)
  {
    require((a->GetPoints() != nullptr) == (b->GetPoints() != nullptr), "points");
    if (a->GetPoints() && same())
    {
      arrays(a->GetPoints()->GetData(), b->GetPoints()->GetData(), "points");
    }
    fields(a->GetPointData(), b->GetPointData());
    fields(a->GetCellData(), b->GetCellData());
  }

  void grids(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
  {
    points(a, b);
    cells(a->GetCells(), b->GetCells(), "cells");
    arrays(atria::cellTypesOf(a), atria::cellTypesOf(b), "cell types");
    const std::vector<vtkDataArray*> ofA = atria::faceArraysOf(a);
    const std::vector<vtkDataArray*> ofB = atria::faceArraysOf(b);
    for (std::size_t i = 0; i < ofA.size(); ++i)
    {
      arrays(ofA[i], ofB[i], "faces");
    }
  }

  void surfaces(vtkPolyData* a, vtkPolyData* b)
  {
    points(a, b);
    cells(a->GetPolys(), b->GetPolys(), "polygons");
    cells(a->GetLines(), b->GetLines(), "lines");
  }

  void trees(vtkHyperTreeGrid* a, vtkHyperTreeGrid* b)
  {
    arrays(a->GetMask(), b->GetMask(), "mask");
    arrays(a->GetXCoordinates(), b->GetXCoordinates(), "x coordinates");
    arrays(a->GetYCoordinates(), b->GetYCoordinates(), "y coordinates");
    arrays(a->GetZCoordinates(), b->GetZCoordinates(), "z coordinates");
    fields(a->GetCellData(), b->GetCellData());
  }

  void collections(vtkPartitionedDataSetCollection* a, vtkPartitionedDataSetCollection* b)
  {
    const unsigned count = a->GetNumberOfPartitionedDataSets();
    require(count == b->GetNumberOfPartitionedDataSets(), "the number of patches");
    for (unsigned i = 0; i < count && same(); ++i)
    {
      const auto name = [i](auto* all) { return std::string(all->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())); };
      require(name(a) == name(b), "the name of a patch");
      objects(a->GetPartitionAsDataObject(i, 0), b->GetPartitionAsDataObject(i, 0));
    }
  }

  void objects(vtkDataObject* a, vtkDataObject* b)
  {
    require(a->GetDataObjectType() == b->GetDataObjectType(), "the type");
    if (!same())
    {
      return;
    }
    fields(a->GetFieldData(), b->GetFieldData());
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(a))
    {
      grids(grid, vtkUnstructuredGrid::SafeDownCast(b));
    }
    else if (auto* polyData = vtkPolyData::SafeDownCast(a))
    {
      surfaces(polyData, vtkPolyData::SafeDownCast(b));
    }
    else if (auto* tree = vtkHyperTreeGrid::SafeDownCast(a))
    {
      trees(tree, vtkHyperTreeGrid::SafeDownCast(b));
    }
    else
    {
      collections(vtkPartitionedDataSetCollection::SafeDownCast(a), vtkPartitionedDataSetCollection::SafeDownCast(b));
    }
  }

private:
  static bool sameValues(vtkAbstractArray* a, vtkAbstractArray* b)
  {
    // Bits, strings and values that follow a rule are not bytes in a row.
    if (vtkBitArray::SafeDownCast(a) || vtkStringArray::SafeDownCast(a) || !a->HasStandardMemoryLayout() ||
        !b->HasStandardMemoryLayout())
    {
      for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
      {
        if (a->GetVariantValue(i) != b->GetVariantValue(i))
        {
          return false;
        }
      }
      return true;
    }
    const std::size_t bytes = static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize();
    return bytes == 0 || std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes) == 0;
  }

  std::string difference;
};

} // namespace

::testing::AssertionResult identical(vtkDataObject* a, vtkDataObject* b)
{
  Comparison comparison;
  comparison.objects(a, b);
  return comparison.result();
}

} // namespace atria::testing
