// SPDX-License-Identifier: GPL-3.0-or-later
/// A volume mesh for formats of finite elements, which have no polyhedra.
#pragma once

#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/NativeCells.h"
#include "SolverMesh.h"
#include "Support/RunContext.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

class vtkUnstructuredGrid;

namespace atria {

struct VtkFaceMesh;

/// Faces have three or four corners. Elements are the cells of the input in its order.
struct ElementMesh
{
  SolverMesh mesh;
  NativeCells elements; ///< points as in `mesh`
};

/// Throws Error if there are cells of the refused types. The text has the number of each type.
void refuseCells(std::span<const unsigned char> types, std::initializer_list<CellType> refused);

/// Returns the elements, patches and zones of a mesh without polyhedra. Takes the faces of `source`.
ElementMesh makeElementMesh(vtkUnstructuredGrid* volume, VtkFaceMesh& source, const RunContext& context);

/// Returns a warning if faces of sheets one face wide share all points with the other side; else an empty string.
std::string lossOfSheets(const FaceMesh& mesh);

/// Corners of an element in the order of Gmsh and Abaqus, as numbers of VTK's. Both see the corners 0, 1, 2 of a wedge
/// counterclockwise from inside, VTK from outside.
std::span<const std::uint8_t> standardOrder(unsigned char type);

} // namespace atria
