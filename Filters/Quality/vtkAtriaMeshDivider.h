// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaMeshDivider
 * @brief   deals out a mesh and its patches to MPI ranks, and makes one of pieces
 *
 * Input port 0 takes a volume mesh (vtkUnstructuredGrid), input port 1, optional, its patches
 * (vtkPartitionedDataSetCollection). The outputs are the same.
 *
 * Asked for a piece on each rank of VTK's global controller, as UpdatePiece() does, each rank gets its piece: as many
 * cells as the others, in ranges along a space-filling curve, with ghost cells and global ids; and of every patch the
 * faces of its cells. So vtkAtriaDualMesher deals out its mesh. What of the inputs the ranks hold is brought together
 * on the first one before: one of them may hold all, or each a piece.
 *
 * Asked for everything, the output is the whole mesh: the input, or what the pieces in it were that such a division has
 * made, by their global ids. So a reader's mesh in pieces becomes one, with the bits that it had.
 *
 * @sa vtkAtriaDualMesher
 */
#ifndef vtkAtriaMeshDivider_h
#define vtkAtriaMeshDivider_h

#include "AtriaFiltersQualityModule.h"
#include "vtkUnstructuredGridAlgorithm.h"

class vtkPartitionedDataSetCollection;

class ATRIAFILTERSQUALITY_EXPORT vtkAtriaMeshDivider : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkAtriaMeshDivider* New();
  vtkTypeMacro(vtkAtriaMeshDivider, vtkUnstructuredGridAlgorithm);

  /**
   * The patches of output port 1; empty without patches on input port 1.
   */
  vtkPartitionedDataSetCollection* GetPatches();

protected:
  vtkAtriaMeshDivider();
  ~vtkAtriaMeshDivider() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkAtriaMeshDivider(const vtkAtriaMeshDivider&) = delete;
  void operator=(const vtkAtriaMeshDivider&) = delete;
};

#endif
