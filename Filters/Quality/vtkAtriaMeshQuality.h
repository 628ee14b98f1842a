// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that measures the quality of every cell of a volume mesh.
/**
 * @class   vtkAtriaMeshQuality
 * @brief   quality of every cell of a volume mesh, with summary and histograms
 *
 * Input port 0 takes a volume mesh of tetrahedra, voxels, hexahedra, wedges, pyramids and polyhedra. Input port 1,
 * optional, takes its boundary patches (vtkPartitionedDataSetCollection of vtkPolyData with the cell array
 * `OwnerCellId` and the point array `VolumePointId`, such as vtkAtriaDualMesher's second output). With them the two
 * sides of a sheet of zero thickness count as boundary, as they do for a solver, even where both have the same points.
 * Without them, patches that the mesher recorded in the mesh are used, if its cells are the same.
 *
 * Output port 0 is the mesh with these cell arrays (double). A is the outward area vector of a face, r goes from the
 * cell's centroid to the face's, d from the cell's centroid to its neighbor's:
 * - `CellSquish`: max 1 - A.r/(|A||r|); 0 is ideal, below 0.99 usable
 * - `FaceSquish`: max 1 - A.d/(|A||d|) over internal faces; 0 is ideal
 * - `AspectRatio`: max/min distance from the centroid to face centroids and points; a cube has 1.732 (Fluent)
 * - `InverseAspectRatio`: its reciprocal; a cube has 0.577
 * - `OrthogonalQuality`: min of the cosines of A to r and of A to d; 1 is ideal (Fluent)
 * - `NonOrthogonality`: max angle in degrees between A and d over internal faces; 0 is ideal, 65 usual
 * - `Skewness`: max over faces, as OpenFOAM's checkMesh; 0 is ideal, up to 4 accepted
 * - `Volume`: cubic model units
 * - `FacePyramids`: volume of the smallest pyramid from a face to the centroid, cubic model units
 * - `ScaledJacobian`: Verdict's; 1 is ideal, not a number for polyhedra
 * - `Valid` (unsigned char): 1 where volume and face pyramids are positive and the cell is closed, else 0
 *
 * With CheckMesh on, also these, as OpenFOAM 1912 defines them:
 * - `Openness`, `AreaAspectRatio`: max over x, y, z of |sum of A| / sum of |A|; checkMesh's aspect ratio
 * - `Determinant`: of the internal faces' A; below 0.001 a cell is under-determined
 * - `Concavity`: max cosine of a face's normal to the way to another face's centroid; above -1e-6 a cell is concave
 * - `FaceWeight`, `VolumeRatio`, `FaceFlatness`, `TetQuality`, `EdgeLength`: min over the faces of the interpolation
 *   weight, the ratio of both cells' volumes, |A| over the sum of its triangles, the quality of the tetrahedra from
 *   centroid to face, and the edges' length in model units
 * - `FaceConcaveAngle`: max over the faces of the angle in degrees by which they turn the wrong way
 * - `FailedChecks` (unsigned int): bit i is set where the cell, a face or a point of it fails the check in row i of
 *   output port 3
 *
 * Output port 1 is a vtkTable with one row per metric: `Metric` (string), `Of` (string: cells or faces), `Minimum`,
 * `Maximum`, `Mean`, `StandardDeviation` (of the population), `Count`. Output port 2 is a vtkTable with NumberOfBins
 * rows and for each metric the columns `<Metric>` (bin center), `<Metric>_PDF` (integrates to 1) and `<Metric>_CDF`
 * (ends at 1), which charts can use directly; before them `Value`, `PDF` and `CDF`, the same for HistogramMetric. In
 * both tables, metrics that begin with Face (except FacePyramids), `VolumeRatio`, `TetQuality` and `EdgeLength` count
 * each face, all others each cell; `FaceNonOrthogonality` and `FaceSkewness` exist only there. Values that are not
 * numbers do not count.
 *
 * Output port 3 is a vtkTable, empty unless CheckMesh is on, with one row per check of `checkMesh -allGeometry`:
 * `Check` (string), `Of` (string: cells, faces, points or mesh), `Limit`, `Worst`, `Mean`, `Failing` (number of values
 * beyond the limit), `IsError` (1 if checkMesh counts it as failed, 0 if it only reports it), `Set` (string:
 * checkMesh's name for the failing set), `Advice` (string: what to do if it fails). The numbers are checkMesh's own.
 *
 * Areas, volumes and centroids are those of OpenFOAM's primitiveMesh, so figures agree with checkMesh's. A mesh without
 * cells, of other cell types or whose faces more than two cells share is an error; the outputs are then empty.
 *
 * @sa vtkAtriaWorstElements vtkAtriaDualMesher vtkAtriaOpenFOAMWriter vtkMeshQuality
 */
#ifndef vtkAtriaMeshQuality_h
#define vtkAtriaMeshQuality_h

#include "AtriaFiltersQualityModule.h"
#include "vtkAtriaRangeMacros.h" // For properties with a range
#include "vtkUnstructuredGridAlgorithm.h"

#include <optional> // for MeasurePieces
#include <string>   // for HistogramMetric

class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkTable;

class ATRIAFILTERSQUALITY_EXPORT vtkAtriaMeshQuality : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkAtriaMeshQuality* New();
  vtkTypeMacro(vtkAtriaMeshQuality, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of bins of the histograms, from 2 to 10000. Default 50.
   */
  vtkAtriaSetInRangeMacro(NumberOfBins, int, 2, 10000);
  vtkGetMacro(NumberOfBins, int);
  ///@}

  ///@{
  /**
   * Metric of the first three columns of the histogram: a row of port 1. Metrics of CheckMesh require CheckMesh to be
   * on. Default CellSquish.
   */
  vtkSetMacro(HistogramMetric, std::string);
  vtkGetMacro(HistogramMetric, std::string);
  ///@}

  ///@{
  /**
   * Judge the mesh as OpenFOAM's `checkMesh -allGeometry` does: more cell arrays, and output port 3. Default
   * off, as it takes about twice the time and memory.
   */
  vtkSetMacro(CheckMesh, bool);
  vtkGetMacro(CheckMesh, bool);
  vtkBooleanMacro(CheckMesh, bool);
  ///@}

  /**
   * Number of checks that failed in the last run, as checkMesh counts them. 0 if CheckMesh is off.
   */
  vtkGetMacro(NumberOfFailedChecks, int);

  /**
   * Number of cells of the last run that are not valid. 0 before the first run and after a failed one.
   */
  vtkGetMacro(NumberOfInvalidCells, vtkIdType);

  /**
   * Connect the patches (input port 1).
   */
  void SetPatchesConnection(vtkAlgorithmOutput* patches);

  /**
   * Set the patches (input port 1) without a pipeline.
   */
  void SetPatchesData(vtkPartitionedDataSetCollection* patches);

  ///@{
  /**
   * Output ports 1, 2 and 3.
   */
  vtkTable* GetSummary();
  vtkTable* GetHistogram();
  vtkTable* GetChecks();
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaMeshQuality();
  ~vtkAtriaMeshQuality() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  /**
   * Does the work of RequestData on the pieces of a distributed mesh. Returns nullopt if the whole mesh is needed on
   * one rank.
   */
  std::optional<int> MeasurePieces(vtkInformationVector**, vtkInformationVector*, vtkMultiProcessController&);

  vtkAtriaMeshQuality(const vtkAtriaMeshQuality&) = delete;
  void operator=(const vtkAtriaMeshQuality&) = delete;

  int NumberOfBins = 50;
  std::string HistogramMetric = "CellSquish";
  bool CheckMesh = false;
  int NumberOfFailedChecks = 0;
  vtkIdType NumberOfInvalidCells = 0;
};

#endif
