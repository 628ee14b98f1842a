// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that all writers of solvers' formats derive from.
/**
 * @class   vtkAtriaMeshWriter
 * @brief   Common base of the writers of solvers' formats: takes a volume mesh with its named patches
 *
 * Input port 0 takes the volume mesh (vtkUnstructuredGrid of tetrahedra, voxels, hexahedra, wedges, pyramids and
 * polyhedra). Input port 1, optional, takes its boundary patches: a vtkPartitionedDataSetCollection of named
 * vtkPolyData with the cell array `OwnerCellId` and the point array `VolumePointId`, such as vtkAtriaDualMesher's
 * second output. Without them, the patches that the mesher recorded in the mesh are used, as long as its cells are the
 * same. If there are none, a warning says that names are lost. Boundary faces in no patch go to one named
 * `defaultFaces`.
 *
 * Files are put in place when they are complete: a failed or aborted Write() leaves earlier files.
 *
 * An input without cells, a mesh that is not a manifold, a patch face that is not a face of its owner cell and a file
 * that cannot be written are errors: Write() returns 0. After the last of these, GetErrorCode() is
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
   * Add the offset that the reader subtracted when it moved the model to the origin (field array `ModelOffset` of the
   * mesh) to all points, so that the written mesh is in the model's place. Off by default.
   */
  vtkSetMacro(RestoreOffset, bool);
  vtkGetMacro(RestoreOffset, bool);
  vtkBooleanMacro(RestoreOffset, bool);
  ///@}

  ///@{
  /**
   * Number of ranks that write together, and the number of this one. The data of all ranks is brought to the first one,
   * which writes it once. ParaView sets both. 1 and 0 by default: each process writes its own data.
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
   * Writes the target. Sets the error code on failure.
   */
  virtual void WriteAll();

  /**
   * Returns the patches of input port 1, or null.
   */
  vtkPartitionedDataSetCollection* GetPatches();

  /**
   * Returns the file or folder as it was given; empty if none was given.
   */
  virtual std::string GetTarget() const = 0;

  /**
   * Return the name of the format, and the property that sets the target, for messages.
   */
  virtual const char* GetFormatName() const = 0;
  virtual const char* GetTargetProperty() const = 0;

  /**
   * Called on the first of several ranks before all is written, with the rank of each cell if the mesh came from
   * several.
   */
  virtual void TakeRanks(vtkMultiProcessController&, std::span<const std::uint32_t>) {}

  /**
   * Called on all of several ranks, with the data of each. Writes it and returns the result of RequestData. Returns
   * nullopt on all ranks if the first rank is to write the whole mesh.
   */
  virtual std::optional<int> WritePieces(vtkMultiProcessController&) { return std::nullopt; }

  /**
   * Called on all of several ranks, after the first has written its files. Throws as WriteMesh() does, on the first
   * rank for all of them. Returns true on success.
   */
  virtual bool WriteOnRanks(vtkMultiProcessController&) { return true; }

  /**
   * Called on all of several ranks in the end, also after a failure, unless WritePieces() has written the mesh.
   */
  virtual void LeaveRanks() {}

  /**
   * Reports what `write` throws as an error of the writer.
   */
  void WriteAndTell(const std::function<void()>& write);

  /**
   * Writes the mesh; Place() puts its points in place. Throws atria::Error or atria::Aborted.
   */
  virtual void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) = 0;

  /**
   * Returns the value for GetErrorCode().
   */
  static unsigned long ErrorCodeFor(const std::exception& error);

  /**
   * Restores the offset if RestoreOffset is on. Cells are better judged before.
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
