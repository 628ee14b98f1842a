// SPDX-License-Identifier: GPL-3.0-or-later
/// What differs between the versions of VTK, from 9.1 on. Nothing else asks for the version.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>
#include <vtkVersionMacros.h>

#include <span>
#include <vector>

class vtkAlgorithm;
class vtkCellArray;
class vtkDataArray;
class vtkUnstructuredGrid;

/// Polyhedra have lists of faces, as vtkCellArray, in place of a stream.
#define ATRIA_VTK_HAS_FACE_LISTS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))

namespace atria {

class IdView;
class PolyhedronFaces;

/// The types of a grid's cells, which need not stand in memory one by one; null without cells.
vtkDataArray* cellTypesOf(vtkUnstructuredGrid* grid);

/// The arrays in which a grid keeps the faces of its polyhedra, or nulls, in the order of setCells().
std::vector<vtkDataArray*> faceArraysOf(vtkUnstructuredGrid* grid);

/// How many arrays these are.
constexpr std::size_t faceArrayCount = ATRIA_VTK_HAS_FACE_LISTS ? 4 : 2;

/// Gives a grid cells of the types given, and faces to its polyhedra; these are nulls where it has none.
void setCells(vtkUnstructuredGrid* grid, vtkDataArray* types, vtkCellArray* cells,
              std::span<vtkDataArray* const> faces);

/// The faces in views of these arrays; see Quality/Faces/CellArrays.h.
PolyhedronFaces facesIn(std::span<const IdView> faces);

/// How much polyhedra need.
struct FaceSizes
{
  vtkIdType cells = 0; ///< polyhedra
  vtkIdType faces = 0;
  vtkIdType points = 0; ///< of the faces

  FaceSizes operator+(const FaceSizes& other) const
  {
    return {cells + other.cells, faces + other.faces, points + other.points};
  }
};

/// Faces of polyhedra in the making, written straight into the arrays of a grid. Cells may be written in any order, and
/// by any number of threads; each knows the sizes of those before it. Without polyhedra there are no arrays.
class FaceLists
{
public:
  FaceLists(vtkIdType cellCount, const FaceSizes& all);

  /// A cell without faces of its own.
  void skip(vtkIdType cell, const FaceSizes& before);
  /// A polyhedron of `count` faces, which addFace() has to give next.
  void begin(vtkIdType cell, const FaceSizes& before, vtkIdType count);

  /// A face of a polyhedron; `before` counts all faces before it, and its own cell as one before. Adds itself.
  template <typename Point> void addFace(FaceSizes& before, std::span<const Point> points)
  {
    vtkIdType* to = place(before, static_cast<vtkIdType>(points.size()));
    for (const Point p : points)
    {
      *to++ = static_cast<vtkIdType>(p);
    }
    ++before.faces;
    before.points += static_cast<vtkIdType>(points.size());
  }

  /// Nulls without polyhedra.
  std::vector<vtkDataArray*> arrays() const;

private:
  /// Where the points of the next face stand.
  vtkIdType* place(const FaceSizes& before, vtkIdType count);

  std::vector<vtkSmartPointer<vtkDataArray>> owned_;
  std::vector<vtkIdType*> values_;
};

/// Whether someone asked an algorithm to stop.
bool isAskedToStop(vtkAlgorithm& algorithm);

} // namespace atria

/// Has a subclass of vtkWriter write by `write()`, which sets the writer's error code.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
#define ATRIA_WRITE_BY(write)                                                                                          \
  bool WriteDataAndReturn() override                                                                                   \
  {                                                                                                                    \
    this->write();                                                                                                     \
    return this->GetErrorCode() == 0;                                                                                  \
  }
#else
#define ATRIA_WRITE_BY(write)                                                                                          \
  void WriteData() override { this->write(); }
#endif
