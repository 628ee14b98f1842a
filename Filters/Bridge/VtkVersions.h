// SPDX-License-Identifier: GPL-3.0-or-later
/// Differences between the versions of VTK, from 9.1 on. No other code asks for the version.
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

/// Polyhedra have lists of faces, as vtkCellArray, in place of a stream: from VTK 9.4 on, and in the snapshot of 9.3
/// that ParaView 5.13 has.
#define ATRIA_VTK_HAS_FACE_LISTS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 20240617))

/// The pipeline sends the last progress event also after an abort.
#define ATRIA_VTK_ENDS_ABORTED_RUNS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0))

namespace atria {

class IdView;
class PolyhedronFaces;

/// Returns the types of a grid's cells, which need not be contiguous in memory; null without cells.
vtkDataArray* cellTypesOf(vtkUnstructuredGrid* grid);

/// Returns the arrays in which a grid keeps the faces of its polyhedra, or nulls, in the order of setCells().
std::vector<vtkDataArray*> faceArraysOf(vtkUnstructuredGrid* grid);

/// Number of these arrays.
constexpr std::size_t faceArrayCount = ATRIA_VTK_HAS_FACE_LISTS ? 4 : 2;

/// Sets a grid's cells, their types and the faces of its polyhedra; `faces` are nulls if it has none.
void setCells(vtkUnstructuredGrid* grid, vtkDataArray* types, vtkCellArray* cells,
              std::span<vtkDataArray* const> faces);

/// Returns the faces in views of these arrays; see Quality/Faces/CellArrays.h.
PolyhedronFaces facesIn(std::span<const IdView> faces);

/// Number of entries that polyhedra need.
struct FaceSizes
{
  vtkIdType cells = 0; ///< polyhedra
  vtkIdType faces = 0;
  vtkIdType points = 0; ///< points of the faces

  FaceSizes operator+(const FaceSizes& other) const
  {
    return {cells + other.cells, faces + other.faces, points + other.points};
  }
};

/// Writes faces of polyhedra directly into the arrays of a grid. Cells may be written in any order and by any number of
/// threads; the caller gives the sizes of all cells before. Without polyhedra there are no arrays.
class FaceLists
{
public:
  FaceLists(vtkIdType cellCount, const FaceSizes& all);

  /// Writes a cell without faces of its own.
  void skip(vtkIdType cell, const FaceSizes& before);
  /// Starts a polyhedron of `count` faces, which addFace() must add next.
  void begin(vtkIdType cell, const FaceSizes& before, vtkIdType count);

  /// Adds a face of a polyhedron. `before` counts all faces before it, and includes its own cell. The face is added to
  /// it.
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

  /// Returns the arrays; nulls without polyhedra.
  std::vector<vtkDataArray*> arrays() const;

private:
  /// Returns the place for the points of the next face.
  vtkIdType* place(const FaceSizes& before, vtkIdType count);

  std::vector<vtkSmartPointer<vtkDataArray>> owned_;
  std::vector<vtkIdType*> values_;
};

/// True if an algorithm was asked to stop.
bool isAskedToStop(vtkAlgorithm& algorithm);

} // namespace atria

/// Makes a subclass of vtkWriter write by `write()`, which sets the writer's error code.
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
