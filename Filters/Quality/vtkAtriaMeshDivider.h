// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that distributes a mesh to MPI ranks, or joins its pieces.
/**
 * @class   vtkAtriaMeshDivider
 * @brief   distributes a mesh and its patches to MPI ranks, or joins their pieces
 *
 * Input port 0 takes a volume mesh (vtkUnstructuredGrid), input port 1, optional, its patches
 * (vtkPartitionedDataSetCollection). The outputs are the same.
 *
 * If a piece is requested on each rank of VTK's global controller, as UpdatePiece() does, each rank gets its piece: as
 * many cells as the others, in ranges along a space-filling curve, with ghost cells and global ids, and the faces of
 * its cells from every patch. vtkAtriaDualMesher distributes its mesh in the same way. The inputs of all ranks are
 * joined on the first one before: one rank may hold everything, or each a piece.
 *
 * If everything is requested, the output is the whole mesh: the input, or the mesh that was divided into the input's
 * pieces, joined by their global ids. A reader's mesh in pieces thus becomes one mesh, with its original bits.
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
