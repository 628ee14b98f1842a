// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkDualMesh.h"

#include "AddArray.h"
#include "Support/Pieces.h"
#include "VtkArrays.h"
#include "VtkVersions.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

namespace atria {

namespace {

/// An element in VTK's terms.
struct VtkElement
{
  unsigned char type = VTK_EMPTY_CELL;
  std::array<Index, 8> points{};
  int pointCount = 0;
  std::array<ReducedFace, 6> faces;
};

/// Makes a pyramid or a tetrahedron. The base's normal points to the apex, opposite to the outward face's.
void setPyramid(VtkElement& element, const ReducedFace& base)
{
  const auto end = base.points.begin() + base.count;
  for (int i = 0; i < element.pointCount; ++i)
  {
    if (std::find(base.points.begin(), end, element.points[i]) == end)
    {
      element.points[base.count] = element.points[i];
      break;
    }
  }
  std::reverse_copy(base.points.begin(), end, element.points.begin());
  element.type = VTK_PYRAMID;
}

/// Returns the point next to `p` in a quad that is not in the triangle `end`.
Index acrossWedge(const VtkElement& element, const ReducedFace& end, Index p)
{
  for (const ReducedFace& face : element.faces)
  {
    for (int i = 0; face.count == 4 && i < 4; ++i)
    {
      const Index q = face.points[(i + 1) % 4];
      const Index r = face.points[(i + 3) % 4];
      if (face.points[i] == p)
      {
        return std::find(end.points.begin(), end.points.begin() + 3, q) == end.points.begin() + 3 ? q : r;
      }
    }
  }
  return p;
}

VtkElement translate(const std::array<Index, 8>& corners)
{
  VtkElement element;
  int triangles = 0;
  int quads = 0;
  const ReducedFace* aTriangle = nullptr;
  const ReducedFace* aQuad = nullptr;
  for (int d = 0; d < 6; ++d)
  {
    ReducedFace& face = element.faces[d];
    face = faceOf(corners, d);
    triangles += face.count == 3 ? 1 : 0;
    quads += face.count == 4 ? 1 : 0;
    aTriangle = face.count == 3 ? &face : aTriangle;
    aQuad = face.count == 4 ? &face : aQuad;
  }
  for (const Index p : corners)
  {
    const auto end = element.points.begin() + element.pointCount;
    if (std::find(element.points.begin(), end, p) == end)
    {
      element.points[element.pointCount++] = p;
    }
  }
  if (quads == 6)
  {
    element.type = VTK_HEXAHEDRON;
  }
  else if (quads == 1 && triangles == 4)
  {
    setPyramid(element, *aQuad);
  }
  else if (quads == 0 && triangles == 4)
  {
    setPyramid(element, *aTriangle);
    element.type = VTK_TETRA;
  }
  else if (quads == 3 && triangles == 2)
  {
    const ReducedFace end = *aTriangle;
    for (int i = 0; i < 3; ++i)
    {
      element.points[i] = end.points[i];
      element.points[i + 3] = acrossWedge(element, end, end.points[i]);
    }
    element.type = VTK_WEDGE;
  }
  else
  {
    element.type = VTK_POLYHEDRON;
  }
  return element;
}

/// Number of entries of a piece of the elements in VTK's arrays.
struct CellSizes
{
  vtkIdType points = 0;
  FaceSizes faces;

  CellSizes operator+(const CellSizes& other) const { return {points + other.points, faces + other.faces}; }
};

bool isHexahedron(const std::array<Index, 8>& corners)
{
  for (int i = 1; i < 8; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if (corners[i] == corners[j])
      {
        return false;
      }
    }
  }
  return true;
}

/// Returns the number of entries that a cell's faces need.
FaceSizes sizesOf(const VtkElement& element)
{
  FaceSizes sizes;
  if (element.type == VTK_POLYHEDRON)
  {
    sizes.cells = 1;
    for (const ReducedFace& face : element.faces)
    {
      sizes.faces += face.count >= 3 ? 1 : 0;
      sizes.points += face.count >= 3 ? face.count : 0;
    }
  }
  return sizes;
}

/// Writes the faces of a polyhedron. `used` counts the entries before it, and afterwards its own, too.
void writeFaces(const VtkElement& element, vtkIdType cell, FaceSizes& used, FaceLists& lists)
{
  lists.begin(cell, used, sizesOf(element).faces);
  ++used.cells;
  for (const ReducedFace& face : element.faces)
  {
    if (face.count >= 3)
    {
      lists.addFace(used, std::span<const Index>(face.points.data(), static_cast<std::size_t>(face.count)));
    }
  }
}

/// Sets the types of a piece's cells. Returns the number of entries that they need.
CellSizes countCells(const DualMesh& mesh, std::size_t begin, std::size_t end, unsigned char* types)
{
  CellSizes sizes;
  for (std::size_t e = begin; e < end; ++e)
  {
    if (isHexahedron(mesh.corners[e]))
    {
      types[e] = VTK_HEXAHEDRON;
      sizes.points += 8;
      continue;
    }
    const VtkElement element = translate(mesh.corners[e]);
    types[e] = element.type;
    sizes.points += element.pointCount;
    sizes.faces = sizes.faces + sizesOf(element);
  }
  return sizes;
}

/// VTK's arrays of cells, filled piece by piece.
template <typename Value> struct CellTarget
{
  Value* offsets;
  Value* connectivity;
  FaceLists& faces;

  void fill(const DualMesh& mesh, std::size_t begin, std::size_t end, const unsigned char* types, CellSizes used) const
  {
    for (std::size_t e = begin; e < end; ++e)
    {
      offsets[e] = static_cast<Value>(used.points);
      const bool whole = types[e] == VTK_HEXAHEDRON;
      const VtkElement element = whole ? VtkElement{} : translate(mesh.corners[e]);
      const std::array<Index, 8>& points = whole ? mesh.corners[e] : element.points;
      std::copy_n(points.begin(), whole ? 8 : element.pointCount, connectivity + used.points);
      used.points += whole ? 8 : element.pointCount;
      if (types[e] == VTK_POLYHEDRON)
      {
        writeFaces(element, static_cast<vtkIdType>(e), used.faces, faces);
      }
      else
      {
        faces.skip(static_cast<vtkIdType>(e), used.faces);
      }
    }
  }
};

template <typename Array> vtkNew<Array> arrayOf(vtkIdType count, const char* name = nullptr)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(count);
  return array;
}

template <typename NumberOf>
void addLabels(const char* name, const Buffer<std::int32_t>& labels, NumberOf&& numberOf, vtkUnstructuredGrid* out,
               const Executor& executor)
{
  const auto ids = arrayOf<vtkIntArray>(static_cast<vtkIdType>(labels.size()), name);
  executor.forEach(labels.size(), 65536,
                   [&](std::size_t e) { ids->SetValue(static_cast<vtkIdType>(e), numberOf(labels[e])); });
  out->GetCellData()->AddArray(ids);
}

/// Fills the cells of a grid; `Array` has 32-bit ids if they suffice.
template <typename Array> void fillCells(const DualMesh& mesh, vtkUnstructuredGrid* out, const Executor& executor)
{
  const auto count = static_cast<vtkIdType>(mesh.elementCount());
  const auto types = arrayOf<vtkUnsignedCharArray>(count);
  const Pieces pieces(mesh.elementCount());
  std::vector<CellSizes> sizes(pieces.count);
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    sizes[piece] = countCells(mesh, pieces.begin(piece), pieces.end(piece), types->GetPointer(0));
  });
  const CellSizes all = scan(sizes);
  const auto offsets = arrayOf<Array>(count + 1);
  const auto connectivity = arrayOf<Array>(all.points);
  FaceLists faces(count, all.faces);
  const CellTarget<typename Array::ValueType> target{offsets->GetPointer(0), connectivity->GetPointer(0), faces};
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    target.fill(mesh, pieces.begin(piece), pieces.end(piece), types->GetPointer(0), sizes[piece]);
  });
  offsets->SetValue(count, static_cast<typename Array::ValueType>(all.points));
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  setCells(out, types, cells, faces.arrays());
}

} // namespace

void volumeToVtk(const DualMesh& mesh, vtkUnstructuredGrid* out, const Executor& executor)
{
  constexpr std::size_t grain = 65536;
  out->SetPoints(pointsToVtk(mesh.points, executor));
  if (8 * mesh.elementCount() < static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    fillCells<vtkTypeInt32Array>(mesh, out, executor);
  }
  else
  {
    fillCells<vtkTypeInt64Array>(mesh, out, executor);
  }
  const auto zones = arrayOf<vtkIntArray>(static_cast<vtkIdType>(mesh.zones.size()), "ZoneId");
  const auto levels = arrayOf<vtkUnsignedCharArray>(static_cast<vtkIdType>(mesh.levels.size()), "Level");
  executor.forRanges(mesh.elementCount(), grain, [&](std::size_t begin, std::size_t end) {
    std::copy_n(mesh.zones.begin() + begin, end - begin, zones->GetPointer(static_cast<vtkIdType>(begin)));
    std::copy_n(mesh.levels.begin() + begin, end - begin, levels->GetPointer(static_cast<vtkIdType>(begin)));
  });
  out->GetCellData()->AddArray(zones);
  out->GetCellData()->AddArray(levels);
  if (!mesh.rooms.empty())
  {
    addLabels(
        "RoomId", mesh.rooms, [](std::int32_t room) { return room; }, out, executor);
  }
}

void roomsToVtk(const RoomReport& report, vtkUnstructuredGrid* out)
{
  if (report.rooms.empty())
  {
    return;
  }
  addArrayOf<vtkStringArray>(out->GetFieldData(), "RoomName", report.rooms, &Room::name);
}

void cellZonesToVtk(const DualMesh& mesh, const std::vector<std::string>& surfaceNames,
                    const std::vector<SurfaceKind>& kinds, vtkUnstructuredGrid* out, const Executor& executor)
{
  if (mesh.cellZones.empty())
  {
    return;
  }
  auto* names = addArray<vtkStringArray>(out->GetFieldData(), "CellZoneName");
  std::vector<std::int32_t> numbers(kinds.size(), -1);
  for (std::size_t surface = 0; surface < kinds.size(); ++surface)
  {
    if (kinds[surface] == SurfaceKind::cellZone)
    {
      numbers[surface] = static_cast<std::int32_t>(names->InsertNextValue(surfaceNames[surface]));
    }
  }
  addLabels(
      "CellZoneId", mesh.cellZones, [&](std::int32_t surface) { return surface < 0 ? -1 : numbers[surface]; }, out,
      executor);
}

} // namespace atria
