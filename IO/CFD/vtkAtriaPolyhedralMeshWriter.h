// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaPolyhedralMeshWriter
 * @brief   What the writers of formats that hold polyhedra have in common: cells and faces that are made one
 *
 * Coplanar faces of one patch that one cell owns, and nearly coplanar ones between the same two cells, are written as
 * one face where that is possible (see MergeCoplanarFaces): OpenFOAM's checkMesh takes such a cell, or one of such two,
 * for concave.
 *
 * A cell with one or two neighbors, in a corner between walls, is made one with a neighbor where that is possible
 * (see MergeUnderdeterminedCells): no gradient can be determined from two neighbors, and checkMesh objects to it.
 *
 * What is written is judged as OpenFOAM's `checkMesh -allGeometry` does. Cells and faces are left as they are where a
 * sound cell would fail a check. For each check that fails a warning says where, in the coordinates of the input, and
 * what to do.
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
   * Make a cell with too few neighbors one with a neighbor, or with up to five other cells, where the union is valid
   * and checkMesh does not object to it, concavity apart. Where the union would be concave, or there is none, the cell
   * is cut into pyramids over its faces if checkMesh does not object to these. Too few are three at most with a
   * determinant below checkMesh's limit of 0.001. The input's cells and patches stay as they are. On by default.
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
   * Judge what Write() would write, with cells and faces merged, and write nothing. The properties below tell what came
   * of it, as after a Write(). Returns false where the input cannot be judged, after an error. In one process only.
   */
  bool Judge();

  /**
   * Number of checks that fail in what was written last, as checkMesh counts them. 0 before the first Write().
   */
  vtkGetMacro(NumberOfFailedChecks, int);

  /**
   * The checks of what was written last, with a row for each as in vtkAtriaMeshQuality's output port 3. Empty before
   * the first Write().
   */
  vtkTable* GetChecks();

  /**
   * How many cells fewer were written than the input has, as some were merged. 0 before the first Write().
   */
  vtkGetMacro(NumberOfMergedCells, vtkIdType);

  /**
   * How many cells more were written than the input has, as some were cut into pyramids. 0 before the first Write().
   */
  vtkGetMacro(NumberOfAddedCells, vtkIdType);

  /**
   * How many faces fewer were written than the input has, as coplanar ones were merged. 0 before the first Write().
   */
  vtkGetMacro(NumberOfMergedFaces, vtkIdType);

protected:
  vtkAtriaPolyhedralMeshWriter();
  ~vtkAtriaPolyhedralMeshWriter() override;

  void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) override;

  /**
   * The part of each cell of the input, where cells are to be written in parts: SolverMesh::partOf. None, if not
   * overridden.
   */
  virtual std::vector<std::uint32_t> DivideCells(vtkUnstructuredGrid*, const atria::Executor&) { return {}; }

  /**
   * Writes what all of that became.
   */
  virtual void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) = 0;

  /**
   * What came of unions, for the properties that tell it.
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
