// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that improves a volume mesh by moving its points.
/**
 * @class   vtkAtriaMeshOptimizer
 * @brief   moves the points of a volume mesh until its cells are valid and good
 *
 * Input port 0 takes any volume mesh of tetrahedra, voxels, hexahedra, wedges, pyramids and polyhedra. Input port 1,
 * optional, takes its boundary patches as vtkAtriaMeshQuality does (vtkPartitionedDataSetCollection of vtkPolyData with
 * the cell array `OwnerCellId` and the point array `VolumePointId`, such as vtkAtriaDualMesher's second output).
 * Without them, patches that the mesher recorded in the mesh are used, if its cells are the same.
 *
 * Points of cells that miss a target, and points around them, are moved; all others stay the same, bit by bit. A mesh
 * that meets all targets is not changed; stricter targets are needed to improve it. Besides the targets below, cells
 * are judged by interpolation weights, volume ratios, determinants, coplanar faces and OpenFOAM's decomposition into
 * tetrahedra.
 *
 * The boundary keeps its shape. Its edges are kept where its normals turn by more than FeatureAngle, where it ends or
 * branches, and where two patches meet. Points at corners of these edges stay; points on an edge slide along it; all
 * others slide along the original boundary, so that flat parts stay flat. Boundary points in the same place, such as
 * those on the two sides of a sheet, move together.
 *
 * The worst value of the mesh never gets worse in any metric of vtkAtriaMeshQuality, nor in Determinant, FaceWeight and
 * VolumeRatio of its CheckMesh. The result has the same bits for any number of threads.
 *
 * Output port 0 is the mesh with its points moved, in double precision, and all its arrays. It also has
 * - cell array `TargetShare` (float): the smallest of the cell's measures, its faces included, on a scale on which 1
 *   reaches all targets and 0 is the limit that solvers accept. It stays below 1 where the mesh's connectivity or
 *   boundary prevents better values;
 * - point array `Displacement` (double, 3 components): how far the point was moved, model units;
 * - field arrays `MovedPoints`, `PoorCellsBefore` and `PoorCells` (id): see GetNumberOfMovedPoints() and the next.
 *
 * Output port 1 has the patches with the same points moved, if there are any.
 *
 * Cells of another type or dimension, cells that do not fit the others, and patches that do not belong to the mesh are
 * errors that name them.
 *
 * @sa vtkAtriaMeshQuality, vtkAtriaDualMesher
 */
#ifndef vtkAtriaMeshOptimizer_h
#define vtkAtriaMeshOptimizer_h

#include "AtriaFiltersQualityModule.h"
#include "vtkAtriaRangeMacros.h" // For properties with a range
#include "vtkUnstructuredGridAlgorithm.h"

class vtkPartitionedDataSetCollection;

class ATRIAFILTERSQUALITY_EXPORT vtkAtriaMeshOptimizer : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkAtriaMeshOptimizer* New();
  vtkTypeMacro(vtkAtriaMeshOptimizer, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Angle in degrees, from 0 to 180. Boundary edges are kept if the normals there differ by more, and points if these
   * edges turn there by more. Default 30.
   */
  vtkAtriaSetInRangeMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * If on, no point of the boundary moves. Default off. Points of face zones, and between cell zones, never move.
   */
  vtkSetMacro(FixBoundary, bool);
  vtkGetMacro(FixBoundary, bool);
  vtkBooleanMacro(FixBoundary, bool);
  ///@}

  ///@{
  /**
   * CellSquish that is good enough, from 0 to 0.999; no unit. Default 0.8.
   */
  vtkAtriaSetInRangeMacro(TargetCellSquish, double, 0.0, 0.999);
  vtkGetMacro(TargetCellSquish, double);
  ///@}

  ///@{
  /**
   * NonOrthogonality that is good enough, in degrees, from 1 to 89.9. Default 60, which is a FaceSquish of 0.5.
   */
  vtkAtriaSetInRangeMacro(TargetNonOrthogonality, double, 1.0, 89.9);
  vtkGetMacro(TargetNonOrthogonality, double);
  ///@}

  ///@{
  /**
   * Skewness that is good enough, from 0.01 to 1000; no unit. Default 2.
   */
  vtkAtriaSetInRangeMacro(TargetSkewness, double, 0.01, 1000.0);
  vtkGetMacro(TargetSkewness, double);
  ///@}

  ///@{
  /**
   * ScaledJacobian that is good enough for cells that have one, from 0 (not considered) to 1; no unit. Default 0.3.
   */
  vtkAtriaSetInRangeMacro(TargetScaledJacobian, double, 0.0, 1.0);
  vtkGetMacro(TargetScaledJacobian, double);
  ///@}

  ///@{
  /**
   * Largest number of passes over all unresolved points, from 1 to 10000. Default 50.
   */
  vtkAtriaSetInRangeMacro(NumberOfSweeps, int, 1, 10000);
  vtkGetMacro(NumberOfSweeps, int);
  ///@}

  /**
   * Number of points moved in the last run, of cells that missed a target before it, and of cells that still do.
   */
  ///@{
  vtkGetMacro(NumberOfMovedPoints, vtkIdType);
  vtkGetMacro(NumberOfPoorCellsBefore, vtkIdType);
  vtkGetMacro(NumberOfPoorCells, vtkIdType);
  ///@}

  /**
   * Connect the patches (input port 1).
   */
  void SetPatchesConnection(vtkAlgorithmOutput* patches);

  /**
   * Set the patches (input port 1) without a pipeline.
   */
  void SetPatchesData(vtkPartitionedDataSetCollection* patches);

  /**
   * Output port 1.
   */
  vtkPartitionedDataSetCollection* GetPatches();

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaMeshOptimizer();
  ~vtkAtriaMeshOptimizer() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  void CheckProperties();

  vtkAtriaMeshOptimizer(const vtkAtriaMeshOptimizer&) = delete;
  void operator=(const vtkAtriaMeshOptimizer&) = delete;

  double FeatureAngle = 30.0;
  bool FixBoundary = false;
  double TargetCellSquish = 0.8;
  double TargetNonOrthogonality = 60.0;
  double TargetSkewness = 2.0;
  double TargetScaledJacobian = 0.3;
  int NumberOfSweeps = 50;
  vtkIdType NumberOfMovedPoints = 0;
  vtkIdType NumberOfPoorCellsBefore = 0;
  vtkIdType NumberOfPoorCells = 0;
};

#endif
