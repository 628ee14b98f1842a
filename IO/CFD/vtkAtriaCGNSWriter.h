// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches and zones as CGNS.
/**
 * @class   vtkAtriaCGNSWriter
 * @brief   Writes a mesh and its named patches as a CGNS file
 *
 * Inputs are those of vtkAtriaMeshWriter; cells and faces are merged as vtkAtriaPolyhedralMeshWriter says.
 *
 * The file is CGNS in HDF5 with one unstructured zone: faces as NGON_n, internal ones first and then patch by patch,
 * cells as NFACE_n, coordinates in double precision. Each patch is a boundary condition. The family of its name states
 * its type: BCWall, or BCGeneral for the domain's sides and `defaultFaces`. Both sides of a sheet have `<name>` as a
 * further family. Cells of one `ZoneId` are a ZoneSubRegion if there are several.
 *
 * Names are made valid (32 ASCII characters without /); the descriptor `OriginalName` of a family keeps the original.
 *
 * If Atria was built without libcgns, every Write() is an error, see IsAvailable().
 *
 * @sa vtkAtriaOpenFOAMWriter vtkAtriaDualMesher
 */
#ifndef vtkAtriaCGNSWriter_h
#define vtkAtriaCGNSWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaPolyhedralMeshWriter.h"

class ATRIAIOCFD_EXPORT vtkAtriaCGNSWriter : public vtkAtriaPolyhedralMeshWriter
{
public:
  static vtkAtriaCGNSWriter* New();
  vtkTypeMacro(vtkAtriaCGNSWriter, vtkAtriaPolyhedralMeshWriter);

  ///@{
  /**
   * The file to write; an existing one is replaced. Its folder must exist. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * True if Atria was built with libcgns.
   */
  static bool IsAvailable();

protected:
  vtkAtriaCGNSWriter() = default;
  ~vtkAtriaCGNSWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) override;

private:
  vtkAtriaCGNSWriter(const vtkAtriaCGNSWriter&) = delete;
  void operator=(const vtkAtriaCGNSWriter&) = delete;

  char* FileName = nullptr;
};

#endif
