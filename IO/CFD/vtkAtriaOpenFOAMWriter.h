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

namespace atria {
enum class OpenFOAMFormat;
}

class ATRIAIOCFD_EXPORT vtkAtriaOpenFOAMWriter : public vtkAtriaPolyhedralMeshWriter
{
public:
  static vtkAtriaOpenFOAMWriter* New();
  vtkTypeMacro(vtkAtriaOpenFOAMWriter, vtkAtriaPolyhedralMeshWriter);
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
   * Also write the mesh divided among so many processors, as OpenFOAM's decomposePar does:
   * `processor0/constant/polyMesh` and so on, with the patches between processors and what belongs to what in the whole
   * mesh, in place of all that are there. Parts have as many cells within a few; METIS divides them. Results of a run
   * in these folders, and patches of a cyclic type, are an error. Default 1: the whole mesh alone.
   */
  vtkAtriaSetInRangeMacro(NumberOfProcessors, int, 1, 100000);
  vtkGetMacro(NumberOfProcessors, int);
  ///@}

protected:
  vtkAtriaOpenFOAMWriter() = default;
  ~vtkAtriaOpenFOAMWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) override;
  /**
   * Divides the mesh that was written.
   */
  virtual void WriteProcessors(const atria::RunContext& context);
  /**
   * Throws atria::Error naming a property that is outside of its range.
   */
  virtual void CheckProperties();
  atria::OpenFOAMFormat GetFormat() const;

private:
  vtkAtriaOpenFOAMWriter(const vtkAtriaOpenFOAMWriter&) = delete;
  void operator=(const vtkAtriaOpenFOAMWriter&) = delete;

  char* CaseDirectory = nullptr;
  bool WriteBinary = false;
  int NumberOfProcessors = 1;
};

#endif
