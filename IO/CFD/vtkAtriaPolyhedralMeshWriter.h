// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that all writers of formats with polyhedra derive from.
/**
 * @class   vtkAtriaPolyhedralMeshWriter
 * @brief   Common base of the writers of formats that hold polyhedra: merges cells and faces
 *
 * Coplanar faces of one patch that one cell owns, and nearly coplanar ones between the same two cells, are written as
 * one face if possible (see MergeCoplanarFaces). OpenFOAM's checkMesh reports such a cell, or one of such two, as
 * concave.
 *
 * A cell with one or two neighbors, in a corner between walls, is merged with a neighbor if possible (see
 * MergeUnderdeterminedCells): no gradient can be determined from two neighbors, and checkMesh objects to it.
 *
 * The written mesh is judged as OpenFOAM's `checkMesh -allGeometry` does. Cells and faces are not merged if a valid
 * cell would then fail a check. For each failed check a warning gives the places, in the coordinates of the input, and
 * a remedy.
 *
 * Cells keep their order; where some were merged, all later ones have lower numbers.
 *
 * @sa vtkAtriaOpenFOAMWriter
 */
#ifndef vtkAtriaPolyhedralMeshWriter_h
#define vtkAtriaPolyhedralMeshWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaMeshWriter.h"
#include "vtkNew.h" // For Checks

#include <cstddef> // For numbers of cells
#include <vector>  // For parts

class vtkTable;

namespace atria {
class Executor;
struct JudgedMesh;
struct MeshVerdict;
struct SolverSource;
struct SolverMesh;
} // namespace atria

class ATRIAIOCFD_EXPORT vtkAtriaPolyhedralMeshWriter : public vtkAtriaMeshWriter
{
public:
  vtkAbstractTypeMacro(vtkAtriaPolyhedralMeshWriter, vtkAtriaMeshWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Merge a cell with too few neighbors with a neighbor, or with up to five other cells, if the union is valid and
   * checkMesh does not object to it, concavity apart. If the union would be concave, or there is none, the cell is cut
   * into pyramids over its faces if checkMesh does not object to these. Too few are three at most with a determinant
   * below checkMesh's limit of 0.001. The input's cells and patches stay as they are. On by default.
   */
  vtkSetMacro(MergeUnderdeterminedCells, bool);
  vtkGetMacro(MergeUnderdeterminedCells, bool);
  vtkBooleanMacro(MergeUnderdeterminedCells, bool);
  ///@}

  ///@{
  /**
   * Write coplanar faces of one cell and one patch that share edges as one polygon, and faces that the same two cells
   * share with less than 3 degrees between them. A patch keeps its area, a cell at least four faces. The input's cells
   * and patches stay as they are. On by default.
   */
  vtkSetMacro(MergeCoplanarFaces, bool);
  vtkGetMacro(MergeCoplanarFaces, bool);
  vtkBooleanMacro(MergeCoplanarFaces, bool);
  ///@}

  /**
   * Judge what Write() would write, with cells and faces merged, and write nothing. The properties below report the
   * result, as after a Write(). Returns false if the input cannot be judged, after an error. In one process only.
   */
  bool Judge();

  /**
   * Number of checks that the mesh written last fails, as checkMesh counts them. 0 before the first Write().
   */
  vtkGetMacro(NumberOfFailedChecks, int);

  /**
   * The checks of the mesh written last, with a row for each as in vtkAtriaMeshQuality's output port 3. Empty before
   * the first Write().
   */
  vtkTable* GetChecks();

  /**
   * Number of cells of the input that disappeared in merges. 0 before the first Write().
   */
  vtkGetMacro(NumberOfMergedCells, vtkIdType);

  /**
   * Number of cells added by cutting cells into pyramids. 0 before the first Write().
   */
  vtkGetMacro(NumberOfAddedCells, vtkIdType);

  /**
   * Number of faces of the input that disappeared in merges of coplanar ones. 0 before the first Write().
   */
  vtkGetMacro(NumberOfMergedFaces, vtkIdType);

protected:
  vtkAtriaPolyhedralMeshWriter();
  ~vtkAtriaPolyhedralMeshWriter() override;

  void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) override;

  /**
   * Returns the part of each cell of the input if cells are written in parts: SolverMesh::partOf. Empty unless
   * overridden.
   */
  virtual std::vector<std::uint32_t> DivideCells(vtkUnstructuredGrid*, const atria::Executor&) { return {}; }

  /**
   * Writes the mesh after merges.
   */
  virtual void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) = 0;

  /**
   * Stores the results of merges for the properties that report them.
   */
  void Tell(const atria::MeshVerdict& verdict, std::size_t mergedCells, std::size_t addedCells,
            std::size_t mergedFaces);

private:
  atria::JudgedMesh Unite(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::SolverSource& parts,
                          const atria::RunContext& context);

  vtkAtriaPolyhedralMeshWriter(const vtkAtriaPolyhedralMeshWriter&) = delete;
  void operator=(const vtkAtriaPolyhedralMeshWriter&) = delete;

  vtkNew<vtkTable> Checks;
  int NumberOfFailedChecks = 0;
  bool MergeUnderdeterminedCells = true;
  bool MergeCoplanarFaces = true;
  vtkIdType NumberOfMergedCells = 0;
  vtkIdType NumberOfAddedCells = 0;
  vtkIdType NumberOfMergedFaces = 0;
};

#endif
