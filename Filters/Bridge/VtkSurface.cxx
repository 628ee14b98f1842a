// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkSurface.h"

#include "Support/Error.h"
#include "Surface/Triangulation/PolygonTriangulation.h"
#include "VtkArrays.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace atria {

namespace {

/// Names in the order in which they are found, and the number of each.
class SurfaceNames
{
public:
  void add(vtkPolyData* data, const std::string& blockName)
  {
    auto* cellNames = namesOfCells(data);
    auto* fieldNames = namesOfField(data);
    if (data->GetCellData()->GetArray("SurfaceId") && fieldNames)
    {
      addAll(fieldNames);
    }
    else if (cellNames)
    {
      addAll(cellNames);
    }
    else if (data->GetNumberOfCells() > 0)
    {
      idOf(blockName);
    }
  }

  /// Returns the surface of each cell.
  std::vector<Index> idsOf(vtkPolyData* data, const std::string& blockName)
  {
    vtkDataArray* ids = data->GetCellData()->GetArray("SurfaceId");
    auto* fieldNames = namesOfField(data);
    auto* cellNames = namesOfCells(data);
    if (ids && fieldNames)
    {
      return idsOf(ids, fieldNames, blockName);
    }
    if (cellNames)
    {
      return addAll(cellNames);
    }
    const vtkIdType count = data->GetNumberOfCells();
    return std::vector<Index>(count, count > 0 ? idOf(blockName) : 0);
  }

  std::vector<std::string> names;

private:
  static vtkStringArray* namesOfField(vtkPolyData* data)
  {
    return vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SurfaceName"));
  }

  static vtkStringArray* namesOfCells(vtkPolyData* data)
  {
    return vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("SurfaceName"));
  }

  Index idOf(const std::string& name)
  {
    const auto [found, isNew] = known.try_emplace(name, static_cast<Index>(names.size()));
    if (isNew)
    {
      names.push_back(name);
    }
    return found->second;
  }

  std::vector<Index> addAll(vtkStringArray* texts)
  {
    std::vector<Index> result(texts->GetNumberOfValues());
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      result[i] = idOf(texts->GetValue(static_cast<vtkIdType>(i)));
    }
    return result;
  }

  std::vector<Index> idsOf(vtkDataArray* ids, vtkStringArray* texts, const std::string& blockName)
  {
    const std::vector<Index> own = addAll(texts);
    std::vector<Index> result(ids->GetNumberOfTuples());
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      const double id = ids->GetComponent(static_cast<vtkIdType>(i), 0);
      if (!(id >= 0 && id < static_cast<double>(own.size())))
      {
        throw Error("cell " + std::to_string(i) + " of '" + blockName + "' has a SurfaceId without a SurfaceName");
      }
      result[i] = own[static_cast<std::size_t>(id)];
    }
    return result;
  }

  std::unordered_map<std::string, Index> known;
};

class Collector
{
public:
  explicit Collector(VtkSurface& target) : out(target) {}

  void add(vtkPolyData* data, const std::string& blockName)
  {
    const std::vector<Vec3> points = pointsFromVtk(data->GetPoints());
    for (const Vec3& p : points)
    {
      if (!p.allFinite())
      {
        throw Error("surface '" + blockName + "' has a point that is not finite");
      }
    }
    out.singlePrecision =
        out.singlePrecision || (data->GetNumberOfPolys() + data->GetNumberOfStrips() > 0 &&
                                data->GetPoints() != nullptr && data->GetPoints()->GetDataType() == VTK_FLOAT);
    base = static_cast<Index>(out.surface.points.size());
    out.surface.points.insert(out.surface.points.end(), points.begin(), points.end());
    const std::vector<Index> ids = names.idsOf(data, blockName);
    vtkNew<vtkIdList> cell;
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
    {
      data->GetCellPoints(i, cell);
      checkPoints(i, cell, points.size(), blockName);
      addCell(data->GetCellType(i), cell, points, ids[i]);
    }
  }

  void ignore(std::size_t cells) { out.ignoredCells += cells; }

  std::vector<std::string> takeNames() { return std::move(names.names); }

private:
  static void checkPoints(vtkIdType index, vtkIdList* cell, std::size_t count, const std::string& blockName)
  {
    const auto missing = [&](vtkIdType id) { return id < 0 || static_cast<std::size_t>(id) >= count; };
    if (std::any_of(cell->begin(), cell->end(), missing))
    {
      throw Error("cell " + std::to_string(index) + " of '" + blockName + "' has a point that does not exist");
    }
  }

  void addTriangle(Index a, Index b, Index c, Index surface)
  {
    out.surface.triangles.push_back({base + a, base + b, base + c});
    out.surface.surfaceIds.push_back(surface);
    out.faceIds.push_back(face);
  }

  void addCell(int type, vtkIdList* cell, const std::vector<Vec3>& points, Index surface)
  {
    std::vector<Index> ids(cell->begin(), cell->end());
    ++face;
    if (type == VTK_TRIANGLE)
    {
      addTriangle(ids[0], ids[1], ids[2], surface);
    }
    else if (type == VTK_TRIANGLE_STRIP)
    {
      for (std::size_t i = 2; i < ids.size(); ++i)
      {
        const bool odd = i % 2 != 0;
        ++face;
        addTriangle(ids[i - 2], ids[odd ? i : i - 1], ids[odd ? i - 1 : i], surface);
      }
    }
    else if (type == VTK_POLYGON || type == VTK_QUAD)
    {
      const PolygonTriangles made = triangulatePolygon(points, ids);
      for (const auto& t : made.triangles)
      {
        addTriangle(t[0], t[1], t[2], surface);
      }
      if (!made.simple)
      {
        out.firstCrossing = out.crossingFaces == 0 ? surface : out.firstCrossing;
        ++out.crossingFaces;
      }
    }
    else
    {
      ++out.ignoredCells;
    }
  }

  VtkSurface& out;
  Index base = 0;
  Index face = 0; ///< face id of the next triangles
  SurfaceNames names;
};

/// Calls `visit(data, name)` for every leaf of the object, with its own name or that of the block around it.
template <class Visitor> void visitLeaves(vtkDataObject* object, const std::string& name, const Visitor& visit)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
  {
    // Visits one level: blocks that hold blocks are visited as a whole, so that unnamed blocks get the name of the
    // block around them.
    vtkSmartPointer<vtkDataObjectTreeIterator> it;
    it.TakeReference(tree->NewTreeIterator());
    it->VisitOnlyLeavesOff();
    it->TraverseSubTreeOff();
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      vtkInformation* about = it->HasCurrentMetaData() ? it->GetCurrentMetaData() : nullptr;
      const char* own = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
      visitLeaves(it->GetCurrentDataObject(), own && *own ? own : name, visit);
    }
  }
  else if (object)
  {
    visit(object, name);
  }
}

constexpr const char* withoutName = "surface";

} // namespace

double coarseRounding(const TriangleSurface& surface)
{
  constexpr double coarse = 1e-5;
  constexpr double rounding = 6e-8; // 2^-24
  Box3 box;
  double largest = 0.0;
  for (const Vec3& p : surface.points)
  {
    box.extend(p);
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return !box.empty() && rounding * largest > coarse * box.size().norm() ? rounding * largest : 0.0;
}

VtkSurface surfaceFromVtk(const std::vector<vtkDataObject*>& inputs)
{
  VtkSurface result;
  Collector collector(result);
  for (vtkDataObject* input : inputs)
  {
    visitLeaves(input, withoutName, [&](vtkDataObject* leaf, const std::string& name) {
      if (auto* polyData = vtkPolyData::SafeDownCast(leaf))
      {
        collector.add(polyData, name);
      }
      else
      {
        collector.ignore(static_cast<std::size_t>(leaf->GetNumberOfElements(vtkDataObject::CELL)));
      }
    });
  }
  result.surface.names = collector.takeNames();
  return result;
}

std::vector<std::string> surfaceNamesFromVtk(vtkDataObject* input)
{
  SurfaceNames found;
  visitLeaves(input, withoutName, [&](vtkDataObject* leaf, const std::string& name) {
    if (auto* polyData = vtkPolyData::SafeDownCast(leaf))
    {
      found.add(polyData, name);
    }
  });
  return std::move(found.names);
}

std::vector<std::string> groundNamesFromVtk(vtkDataObject* input)
{
  std::vector<std::string> grounds;
  visitLeaves(input, withoutName, [&](vtkDataObject* leaf, const std::string&) {
    vtkDataArray* isGround = leaf->GetFieldData()->GetArray("IsGround");
    auto* names = vtkStringArray::SafeDownCast(leaf->GetFieldData()->GetAbstractArray("SurfaceName"));
    for (vtkIdType i = 0; isGround && names && i < names->GetNumberOfValues(); ++i)
    {
      if (i < isGround->GetNumberOfTuples() && isGround->GetComponent(i, 0) != 0.0)
      {
        grounds.push_back(names->GetValue(i));
      }
    }
  });
  return grounds;
}

} // namespace atria
