// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaOpenFOAMWriter
 * @brief   writes a volume mesh and its patches as an OpenFOAM case
 *
 * Input port 0 takes the volume mesh (vtkUnstructuredGrid of tetrahedra, voxels, hexahedra, wedges, pyramids
 * and polyhedra). Input port 1, optional, takes its boundary patches: a vtkPartitionedDataSetCollection of
 * named vtkPolyData with the cell array `OwnerCellId` and the point array `VolumePointId`, such as
 * vtkAtriaDualMesher's second output. Without them those that the mesher recorded in the mesh are taken, as long as its
 * cells are the same; where there are none, a warning says that names are lost.
 *
 * Written are constant/polyMesh (points, faces, owner, neighbor, boundary; cellZones where the mesh has a
 * cell array `ZoneId` of more than one value), the files in `system` without which OpenFOAM's utilities do
 * not start, where these are missing, and an empty file `<case>.foam` to open in ParaView. Cells keep their
 * order; where some were merged, all later ones have lower numbers. Faces are in upper-triangular order, internal ones
 * first, then patch by patch.
 *
 * Patches named after the domain's sides (xMin, xMax, yMin, yMax, zMin, zMax) become OpenFOAM patches of type
 * `patch`, all others of type `wall`. Names are made valid and unique; a comment in `boundary` keeps what
 * they were. The two sides of a sheet, `<name>_front` and `<name>_back`, share the group `<name>`, so one
 * entry in a field's boundaryField serves both. Boundary faces in no patch go to `defaultFaces`, of type
 * `patch`.
 *
 * Coplanar faces of one patch that one cell owns, and nearly coplanar ones between the same two cells, are written as
 * one face where that is possible (see MergeCoplanarFaces): checkMesh takes such a cell, or one of such two, for
 * concave.
 *
 * A cell with one or two neighbors, in a corner between walls, is made one with a neighbor where that is possible
 * (see MergeUnderdeterminedCells): no gradient can be determined from two neighbors, and checkMesh objects to it.
 *
 * An input without cells, a mesh that is not a manifold, a patch face that is not a face of its owner cell
 * and a folder that cannot be written are errors: Write() returns 0.
 *
 * @sa vtkAtriaDualMesher vtkAtriaMeshQuality
 */
#ifndef vtkAtriaOpenFOAMWriter_h
#define vtkAtriaOpenFOAMWriter_h

#include "AtriaIOCFDModule.h"
#include "vtkWriter.h"

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

class ATRIAIOCFD_EXPORT vtkAtriaOpenFOAMWriter : public vtkWriter
{
public:
  static vtkAtriaOpenFOAMWriter* New();
  vtkTypeMacro(vtkAtriaOpenFOAMWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Folder of the case; made if missing. A mesh that is there already is replaced. No default.
   */
  vtkSetFilePathMacro(CaseDirectory);
  vtkGetFilePathMacro(CaseDirectory);
  ///@}

  ///@{
  /**
   * Write lists in OpenFOAM's binary format (32-bit labels, 64-bit scalars) instead of text. Both read back
   * to the same bits; binary is smaller and faster. Off by default.
   */
  vtkSetMacro(WriteBinary, bool);
  vtkGetMacro(WriteBinary, bool);
  vtkBooleanMacro(WriteBinary, bool);
  ///@}

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

  ///@{
  /**
   * Add to all points what the reader subtracted when it moved the model to the origin (field array `ModelOffset` of
   * the mesh), so that the case is where the model was. Off by default.
   */
  vtkSetMacro(RestoreOffset, bool);
  vtkGetMacro(RestoreOffset, bool);
  vtkBooleanMacro(RestoreOffset, bool);
  ///@}

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

  /**
   * Connect the patches (input port 1).
   */
  void SetPatchesConnection(vtkAlgorithmOutput* patches);

  /**
   * Set the patches (input port 1) without a pipeline.
   */
  void SetPatchesData(vtkPartitionedDataSetCollection* patches);

protected:
  vtkAtriaOpenFOAMWriter();
  ~vtkAtriaOpenFOAMWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkAtriaOpenFOAMWriter(const vtkAtriaOpenFOAMWriter&) = delete;
  void operator=(const vtkAtriaOpenFOAMWriter&) = delete;

  void WriteCase(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches);

  char* CaseDirectory = nullptr;
  bool WriteBinary = false;
  bool MergeUnderdeterminedCells = true;
  bool MergeCoplanarFaces = true;
  bool RestoreOffset = false;
  vtkIdType NumberOfMergedCells = 0;
  vtkIdType NumberOfAddedCells = 0;
  vtkIdType NumberOfMergedFaces = 0;
};

#endif
