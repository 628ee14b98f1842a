// SPDX-License-Identifier: GPL-3.0-or-later
#include "ElementMesh.h"

#include "SolverSource.h"
#include "Support/Error.h"
#include "VtkFaceMesh.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

const char* pluralOf(CellType type)
{
  switch (type)
  {
    case tetrahedronCell:
      return "tetrahedra";
    case wedgeCell:
      return "wedges";
    case pyramidCell:
      return "pyramids";
    case polyhedronCell:
      return "polyhedra";
    default:
      return "hexahedra";
  }
}

} // namespace

void refuseCells(std::span<const unsigned char> types, std::initializer_list<CellType> refused)
{
  std::string found;
  for (const CellType type : refused)
  {
    if (const auto count = std::ranges::count(types, static_cast<unsigned char>(type)); count > 0)
    {
      found += (found.empty() ? "" : " and ") + std::to_string(count) + " " + pluralOf(type);
    }
  }
  if (!found.empty())
  {
    throw Error("the format has no place for " + found + " among the mesh's " + std::to_string(types.size()) +
                " elements; mesh with ElementType Hexahedral and few layers, or write another format");
  }
}

ElementMesh makeElementMesh(vtkUnstructuredGrid* volume, VtkFaceMesh& source, const RunContext& context)
{
  SolverSource parts = solverSourceOf(volume, source, context.executor);
  ElementMesh out{solverMeshFrom(std::move(parts), std::move(source.mesh), context.executor), {}};
  out.elements = makeNativeCells(out.mesh.mesh, {}, source.cells.view(), out.mesh.newPoint, context.progress);
  return out;
}

std::string lossOfSheets(const FaceMesh& mesh)
{
  const std::size_t common = facesWithCommonPoints(mesh);
  return common == 0 ? ""
                     : std::to_string(common) +
                           " faces of sheets one face wide have the points of the other side, so that solvers see no "
                           "wall there; mesh finer, or write another format";
}

std::span<const std::uint8_t> standardOrder(unsigned char type)
{
  static constexpr std::array<std::uint8_t, 8> same{0, 1, 2, 3, 4, 5, 6, 7};
  static constexpr std::array<std::uint8_t, 6> wedge{0, 2, 1, 3, 5, 4};
  return type == wedgeCell ? std::span<const std::uint8_t>(wedge)
                           : std::span<const std::uint8_t>(same).first(shapeOf(type).corners);
}

} // namespace atria
