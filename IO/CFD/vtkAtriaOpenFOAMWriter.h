// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaOpenFOAMWriter
 * @brief   Writes a mesh and its named patches as an OpenFOAM case
 *
 * Inputs are those of vtkAtriaMeshWriter.
 *
 * Written are constant/polyMesh (points, faces, owner, neighbor, boundary; cellZones where the mesh has a
 * cell array `ZoneId` of more than one value), the files in `system` without which OpenFOAM's utilities do
 * not start, where these are missing, and an empty file `<case>.foam` to open in ParaView. Faces are in
 * upper-triangular order, internal ones first, then patch by patch.
 *
 * Patches named after the domain's sides (xMin, xMax, yMin, yMax, zMin, zMax, domainSide1 …) become OpenFOAM patches of
 * type `patch`, all others of type `wall`. Names are made valid and unique; a comment in `boundary` keeps what they
 * were. The two sides of a sheet, `<name>_front` and `<name>_back`, share the group `<name>`, so one entry in a field's
 * boundaryField serves both. Boundary faces in no patch go to `defaultFaces`, of type `patch`.
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
   * Folder of the case; made if missing. A mesh that is there already is replaced. Where writing fails or is aborted,
   * folders that were made are removed, and an earlier mesh stays. No default.
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
   * `processor0/constant/polyMesh` and so on, with the patches between processors and what belongs to what in the whole
   * mesh, in place of all that are there. Parts have as many cells within a few; METIS divides them. Results of a run
   * in these folders, and patches of a cyclic type, are an error. Default 1: the whole mesh alone.
   */
  vtkAtriaSetInRangeMacro(NumberOfProcessors, int, 1, 100000);
  vtkGetMacro(NumberOfProcessors, int);
  ///@}

  ///@{
  /**
   * Where several ranks write together (NumberOfPieces), have each of them write the folder of the processor of its
   * number, in place of NumberOfProcessors. A processor has the cells that the rank has of the mesh; where one rank
   * holds it all, as many as the others, in the order in which vtkAtriaDualMesher deals them out. A cell that was made
   * one with others is where the last of these is. Files are as decomposePar makes them of the same division; all ranks
   * see the folder of the case. Off by default.
   */
  vtkSetMacro(UseRanksAsProcessors, bool);
  vtkGetMacro(UseRanksAsProcessors, bool);
  vtkBooleanMacro(UseRanksAsProcessors, bool);
  ///@}

  ///@{
  /**
   * With UseRanksAsProcessors on several ranks: write the whole mesh, too. Without it no rank needs memory for it: each
   * makes its processor of what it has, and there is no constant/polyMesh in the case: that of an earlier mesh is
   * removed. The folders are the same. Of a mesh whose pieces have no ghost cells or global ids without gaps, the whole
   * is written all the same, with a warning; in one process always. Where the whole has more than labels of 32 bits can
   * number, processors do not tell what their cells, faces and points are in it, with a warning. On by default.
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
   * Divides the mesh that was written, in the given parts if there are some.
   */
  virtual void WriteProcessors(const std::vector<std::uint32_t>& partOf, const atria::RunContext& context);
  /**
   * Throws atria::Error naming a property that is outside of its range.
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
  int Ranks = 1;                             ///< that write together now
  std::vector<std::uint32_t> RankOfCells;    ///< of the input, if known
  std::unique_ptr<atria::DividedMesh> Parts; ///< that the ranks are to write
  std::unique_ptr<atria::NewFolders> Made;   ///< that go again if they cannot
};

#endif
