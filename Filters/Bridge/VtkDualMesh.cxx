// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkDualMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
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

/// Also a tetrahedron. The base's normal points to the apex, against the outward face's.
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

/// The point next to `p` in some quad that is not in the triangle `end`.
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

/// Appends a polyhedron to VTK's face stream.
void appendFaces(const VtkElement& element, vtkIdTypeArray* stream)
{
  const auto count =
      std::count_if(element.faces.begin(), element.faces.end(), [](const ReducedFace& f) { return f.count >= 3; });
  stream->InsertNextValue(static_cast<vtkIdType>(count));
  for (const ReducedFace& face : element.faces)
  {
    if (face.count >= 3)
    {
      stream->InsertNextValue(face.count);
      for (int i = 0; i < face.count; ++i)
      {
        stream->InsertNextValue(face.points[i]);
      }
    }
  }
}

/// 32-bit where they suffice.
template <typename Array> void fillCells(const DualMesh& mesh, vtkUnstructuredGrid* out)
{
  const auto count = static_cast<vtkIdType>(mesh.elementCount());
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(count);
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  vtkNew<Array> connectivity;
  connectivity->SetNumberOfValues(8 * count);
  vtkNew<vtkIdTypeArray> stream;
  vtkNew<vtkIdTypeArray> locations;
  vtkIdType used = 0;
  for (vtkIdType e = 0; e < count; ++e)
  {
    const VtkElement element = translate(mesh.corners[e]);
    types->SetValue(e, element.type);
    offsets->SetValue(e, used);
    const bool isHexahedron = element.type == VTK_HEXAHEDRON;
    for (int i = 0; i < element.pointCount; ++i)
    {
      connectivity->SetValue(used++, isHexahedron ? mesh.corners[e][i] : element.points[i]);
    }
    if (element.type == VTK_POLYHEDRON)
    {
      if (locations->GetNumberOfValues() == 0)
      {
        locations->SetNumberOfValues(count);
        std::fill_n(locations->GetPointer(0), count, -1);
      }
      locations->SetValue(e, stream->GetNumberOfValues());
      appendFaces(element, stream);
    }
  }
  offsets->SetValue(count, used);
  connectivity->Resize(used);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  const bool polyhedral = locations->GetNumberOfValues() > 0;
  out->SetCells(types, cells, polyhedral ? locations.Get() : nullptr, polyhedral ? stream.Get() : nullptr);
}

} // namespace

void volumeToVtk(const DualMesh& mesh, vtkUnstructuredGrid* out)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  out->SetPoints(points);
  if (8 * mesh.elementCount() < static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    fillCells<vtkTypeInt32Array>(mesh, out);
  }
  else
  {
    fillCells<vtkTypeInt64Array>(mesh, out);
  }
  vtkNew<vtkIntArray> zones;
  zones->SetName("ZoneId");
  zones->SetNumberOfValues(static_cast<vtkIdType>(mesh.zones.size()));
  std::copy(mesh.zones.begin(), mesh.zones.end(), zones->GetPointer(0));
  out->GetCellData()->AddArray(zones);
  vtkNew<vtkUnsignedCharArray> levels;
  levels->SetName("Level");
  levels->SetNumberOfValues(static_cast<vtkIdType>(mesh.levels.size()));
  std::copy(mesh.levels.begin(), mesh.levels.end(), levels->GetPointer(0));
  out->GetCellData()->AddArray(levels);
}

} // namespace atria
