// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaMeshWriter
 * @brief   What the writers of solvers' formats have in common: a volume mesh with its named patches
 *
 * Input port 0 takes the volume mesh (vtkUnstructuredGrid of tetrahedra, voxels, hexahedra, wedges, pyramids
 * and polyhedra). Input port 1, optional, takes its boundary patches: a vtkPartitionedDataSetCollection of
 * named vtkPolyData with the cell array `OwnerCellId` and the point array `VolumePointId`, such as
 * vtkAtriaDualMesher's second output. Without them those that the mesher recorded in the mesh are taken, as long as its
 * cells are the same; where there are none, a warning says that names are lost. Boundary faces in no patch go to one
 * named `defaultFaces`.
 *
 * Files are put in place when they are complete: what fails or is aborted leaves what was there.
 *
 * An input without cells, a mesh that is not a manifold, a patch face that is not a face of its owner cell
 * and a file that cannot be written are errors: Write() returns 0. For the last GetErrorCode() is
 * vtkErrorCode::CannotOpenFileError.
 *
 * @sa vtkAtriaOpenFOAMWriter
 */
#ifndef vtkAtriaMeshWriter_h
#define vtkAtriaMeshWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "VtkVersions.h"      // For the hook of writers
#include "vtkWriter.h"

#include <cstdint>    // For numbers of ranks
#include <exception>  // For what went wrong
#include <functional> // For what is written
#include <optional>   // For what is written in pieces
#include <span>       // For numbers of ranks
#include <string>     // For where it goes

class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria {
struct FaceMesh;
struct RunContext;
struct VtkFaceMesh;
} // namespace atria

class ATRIAIOCFD_EXPORT vtkAtriaMeshWriter : public vtkWriter
{
public:
  vtkAbstractTypeMacro(vtkAtriaMeshWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add to all points what the reader subtracted when it moved the model to the origin (field array `ModelOffset` of
   * the mesh), so that the mesh written is where the model was. Off by default.
   */
  vtkSetMacro(RestoreOffset, bool);
  vtkGetMacro(RestoreOffset, bool);
  vtkBooleanMacro(RestoreOffset, bool);
  ///@}

  ///@{
  /**
   * How many ranks write together, and the number of this one: what they hold is brought to the first one, which writes
   * it, once. ParaView sets both. 1 and 0 by default: the mesh is written by who is told to.
   */
  vtkSetMacro(NumberOfPieces, int);
  vtkGetMacro(NumberOfPieces, int);
  vtkSetMacro(Piece, int);
  vtkGetMacro(Piece, int);
  ///@}

  /**
   * Connect the patches (input port 1).
   */
  void SetPatchesConnection(vtkAlgorithmOutput* patches);

  /**
   * Set the patches (input port 1) without a pipeline.
   */
  void SetPatchesData(vtkPartitionedDataSetCollection* patches);

protected:
  vtkAtriaMeshWriter();
  ~vtkAtriaMeshWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  ATRIA_WRITE_BY(WriteAll)

  /**
   * Writes the target; sets the error code where that fails.
   */
  virtual void WriteAll();

  /**
   * Those of input port 1, or null.
   */
  vtkPartitionedDataSetCollection* GetPatches();

  /**
   * File or folder, as it was given; empty without.
   */
  virtual std::string GetTarget() const = 0;

  /**
   * What is written and by which property it is told where to, for messages.
   */
  virtual const char* GetFormatName() const = 0;
  virtual const char* GetTargetProperty() const = 0;

  /**
   * On the first of several ranks, before all is written: the rank of each cell, where the mesh came from several.
   */
  virtual void TakeRanks(vtkMultiProcessController&, std::span<const std::uint32_t>) {}

  /**
   * On all of several ranks, with what each of them holds: writes it and returns what RequestData is to, or returns
   * nothing, on all, where the first is to write the whole.
   */
  virtual std::optional<int> WritePieces(vtkMultiProcessController&) { return std::nullopt; }

  /**
   * On all of several ranks, once the first has written what it has to. Throws as WriteMesh(), on the first rank for
   * all of them. Returns whether all went well.
   */
  virtual bool WriteOnRanks(vtkMultiProcessController&) { return true; }

  /**
   * On all of several ranks in the end, whether all went well or not.
   */
  virtual void LeaveRanks() {}

  /**
   * Makes of what `write` throws an error of the writer.
   */
  void WriteAndTell(const std::function<void()>& write);

  /**
   * Writes the mesh, once it is put in its place by Place(). Throws atria::Error or atria::Aborted.
   */
  virtual void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) = 0;

  /**
   * What GetErrorCode() is to be.
   */
  static unsigned long ErrorCodeFor(const std::exception& error);

  /**
   * Restores the offset where that is asked for. Cells are better judged before.
   */
  void Place(vtkUnstructuredGrid* volume, atria::FaceMesh& mesh) const;

private:
  vtkAtriaMeshWriter(const vtkAtriaMeshWriter&) = delete;
  void operator=(const vtkAtriaMeshWriter&) = delete;

  void WriteTarget(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches);

  bool RestoreOffset = false;
  int NumberOfPieces = 1;
  int Piece = 0;
};

#endif
