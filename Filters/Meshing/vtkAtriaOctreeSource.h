// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that makes the octree of a domain, refined at surfaces.
/**
 * @class   vtkAtriaOctreeSource
 * @brief   the 2:1 balanced octree of a domain, fitted to surfaces
 *
 * Every octant in the domain goes down to the level of SizeMax, one that a surface passes through to that of SizeMid,
 * one with a feature curve or corner, or with surfaces that do not meet inside it, to SizeMin. Leaves that share a
 * face, an edge or a corner differ by one level at most. The grid's phase puts the domain's lower planes through the
 * centers of finest octants.
 *
 * Input port 0 (optional): surfaces; see vtkAtriaGridAlgorithm. Without, DomainMode must be Explicit.
 *
 * Output: leaves that share volume with the domain (or, if the domain is turned in the grid, with a box of the grid
 * around it), as vtkUnstructuredGrid of voxels, of hexahedra if the grid is turned, or as vtkHyperTreeGrid, which
 * cannot be turned: that is an error. Cell arrays: `Level` (unsigned char, root 0), `FeatureType` (unsigned char: 0
 * none, 1 surface, 2 curve, 3 corner, 4 several surfaces that do not meet). Field arrays: `OctreeFrame`, with which
 * vtkAtriaDualMesher accepts the octree as input; `SizingWarning`, the sizes that MaxElements coarsened, if any.
 */
#ifndef vtkAtriaOctreeSource_h
#define vtkAtriaOctreeSource_h

#include "vtkAtriaGridAlgorithm.h"

#include <string>  // for EstimateWarning
#include <utility> // for EstimatedOctants
#include <vector>  // for EstimatedOctants

class ATRIAFILTERSMESHING_EXPORT vtkAtriaOctreeSource : public vtkAtriaGridAlgorithm
{
public:
  static vtkAtriaOctreeSource* New();
  vtkTypeMacro(vtkAtriaOctreeSource, vtkAtriaGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Type of the output.
   */
  enum OutputTypes
  {
    UnstructuredGrid = 0,
    HyperTreeGrid = 1
  };

  ///@{
  /**
   * Type of the output. Default UnstructuredGrid.
   */
  vtkAtriaSetInRangeMacro(OutputType, int, UnstructuredGrid, HyperTreeGrid);
  vtkGetMacro(OutputType, int);
  void SetOutputTypeToUnstructuredGrid() { this->SetOutputType(UnstructuredGrid); }
  void SetOutputTypeToHyperTreeGrid() { this->SetOutputType(HyperTreeGrid); }
  ///@}

  /**
   * Sizes the octants for the current input and properties and counts the elements of their mesh, without building
   * octree or mesh. The counts are exact for a mesh of all zones; zones omitted by a zone rule have no elements. If a
   * mesh would be refused for MemoryLimit, EstimateIsTooLarge is true and the counts are estimated lower bounds.
   * Returns false, after an error, if sizes or domain are impossible.
   */
  bool Estimate();

  ///@{
  /**
   * Results of Estimate():
   * - number of elements;
   * - rough peak memory of meshing, in bytes;
   * - number and edge length of the leaves in the domain for each level of the octree (0 out of range);
   * - EstimateIsTooLarge, true if meshing would be refused because it needs more memory than there is;
   * - warnings, one per line: where the domain does not suit the model, which sizes MaxElements coarsens, why meshing
   *   would be refused.
   */
  vtkGetMacro(EstimatedElements, vtkIdType);
  vtkGetMacro(EstimatedBytes, vtkTypeInt64);
  int GetNumberOfEstimatedLevels() { return static_cast<int>(this->EstimatedOctants.size()); }
  vtkIdType GetEstimatedOctants(int level);
  double GetEstimatedOctantSize(int level);
  vtkGetMacro(EstimateIsTooLarge, bool);
  std::string GetEstimateWarning() { return this->EstimateWarning; }
  ///@}

protected:
  vtkAtriaOctreeSource();
  ~vtkAtriaOctreeSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void CheckProperties() override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int OutputType = UnstructuredGrid;
  std::vector<std::pair<double, vtkIdType>> EstimatedOctants; ///< size and number
  vtkIdType EstimatedElements = 0;
  vtkTypeInt64 EstimatedBytes = 0;
  bool EstimateIsTooLarge = false;
  std::string EstimateWarning;

private:
  vtkAtriaOctreeSource(const vtkAtriaOctreeSource&) = delete;
  void operator=(const vtkAtriaOctreeSource&) = delete;
};

#endif
