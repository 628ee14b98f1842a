// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches and zones as an OpenFOAM case.
/**
 * @class   vtkAtriaOpenFOAMWriter
 * @brief   Writes a mesh and its named patches as an OpenFOAM case
 *
 * Inputs are those of vtkAtriaMeshWriter.
 *
 * The case has constant/polyMesh: points, faces, owner, neighbor, boundary, and cellZones if the mesh has a cell array
 * `ZoneId` of more than one value. It also has the files in `system` without which OpenFOAM's utilities do not start,
 * if these are missing, and an empty file `<case>.foam` to open in ParaView. Faces are in upper-triangular order,
 * internal ones first, then patch by patch.
 *
 * Patches named after the domain's sides (xMin, xMax, yMin, yMax, zMin, zMax, domainSide1 …) become OpenFOAM patches of
 * type `patch`, all others of type `wall`. Names are made valid and unique; a comment in `boundary` keeps the
 * originals. The two sides of a sheet, `<name>_front` and `<name>_back`, share the group `<name>`, so one entry in a
 * field's boundaryField serves both. Boundary faces in no patch go to `defaultFaces`, of type `patch`.
 *
 * @sa vtkAtriaDualMesher vtkAtriaMeshQuality
 */
#ifndef vtkAtriaOpenFOAMWriter_h
#define vtkAtriaOpenFOAMWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaPolyhedralMeshWriter.h"
#include "vtkAtriaRangeMacros.h"

#include <memory> // For the mesh in parts
#include <vector> // For parts

namespace atria {
struct DividedMesh;
class MeshPiece;
class NewFolders;
class RankExchange;
enum class OpenFOAMFormat;
} // namespace atria

class ATRIAIOCFD_EXPORT vtkAtriaOpenFOAMWriter : public vtkAtriaPolyhedralMeshWriter
{
public:
  static vtkAtriaOpenFOAMWriter* New();
  vtkTypeMacro(vtkAtriaOpenFOAMWriter, vtkAtriaPolyhedralMeshWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Folder of the case; created if missing. An existing mesh is replaced. If writing fails or is aborted, new folders
   * are removed and an earlier mesh stays. No default.
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
   * Also write the mesh divided among so many processors, as OpenFOAM's decomposePar does:
   * `processor0/constant/polyMesh` and so on, with the patches between processors and the numbers of cells, faces and
   * points in the whole mesh. All existing processor folders are replaced. METIS divides the mesh; sizes of parts
   * differ by a few cells. Results of a run in these folders, and patches of a cyclic type, are an error. Default 1:
   * the whole mesh alone.
   */
  vtkAtriaSetInRangeMacro(NumberOfProcessors, int, 1, 100000);
  vtkGetMacro(NumberOfProcessors, int);
  ///@}

  ///@{
  /**
   * If several ranks write together (NumberOfPieces), each of them writes the folder of the processor of its number, in
   * place of NumberOfProcessors. A processor has the cells that the rank has of the mesh. If one rank holds the whole
   * mesh, all have as many cells, in the order in which vtkAtriaDualMesher deals them out. A merged cell is where the
   * last of its cells is. Files are as decomposePar makes them of the same division; all ranks see the folder of the
   * case. Off by default.
   */
  vtkSetMacro(UseRanksAsProcessors, bool);
  vtkGetMacro(UseRanksAsProcessors, bool);
  vtkBooleanMacro(UseRanksAsProcessors, bool);
  ///@}

  ///@{
  /**
   * With UseRanksAsProcessors on several ranks: write the whole mesh, too. If off, no rank needs memory for it: each
   * makes its processor of its own cells. The case then has no constant/polyMesh; that of an earlier mesh is removed.
   * The folders are the same. The whole is written all the same, with a warning, if pieces have no ghost cells or their
   * global ids have gaps, and always in one process. If 32-bit labels cannot number the whole mesh, processors do not
   * record the numbers of their cells, faces and points in it, with a warning. On by default.
   */
  vtkSetMacro(WriteWholeMesh, bool);
  vtkGetMacro(WriteWholeMesh, bool);
  vtkBooleanMacro(WriteWholeMesh, bool);
  ///@}

protected:
  vtkAtriaOpenFOAMWriter();
  ~vtkAtriaOpenFOAMWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) override;
  void TakeRanks(vtkMultiProcessController& controller, std::span<const std::uint32_t> rankOf) override;
  std::vector<std::uint32_t> DivideCells(vtkUnstructuredGrid* volume, const atria::Executor& executor) override;
  std::optional<int> WritePieces(vtkMultiProcessController& controller) override;
  bool WriteOnRanks(vtkMultiProcessController& controller) override;
  void LeaveRanks() override;
  /**
   * Divides the written mesh, in the given parts if there are any.
   */
  virtual void WriteProcessors(const std::vector<std::uint32_t>& partOf, const atria::RunContext& context);
  /**
   * Throws atria::Error naming a property that is out of range.
   */
  virtual void CheckProperties();
  atria::OpenFOAMFormat GetFormat() const;

private:
  vtkAtriaOpenFOAMWriter(const vtkAtriaOpenFOAMWriter&) = delete;
  void operator=(const vtkAtriaOpenFOAMWriter&) = delete;

  void WarnOfResults();
  void WritePiece(const atria::MeshPiece& piece, vtkUnstructuredGrid* volume, atria::RankExchange& ranks);

  char* CaseDirectory = nullptr;
  bool WriteBinary = false;
  int NumberOfProcessors = 1;
  bool UseRanksAsProcessors = false;
  bool WriteWholeMesh = true;
  int Ranks = 1;                             ///< number of ranks that write together now
  std::vector<std::uint32_t> RankOfCells;    ///< rank of each cell of the input, if known
  std::unique_ptr<atria::DividedMesh> Parts; ///< mesh for the ranks to write
  std::unique_ptr<atria::NewFolders> Made;   ///< folders to remove if the ranks fail
};

#endif
