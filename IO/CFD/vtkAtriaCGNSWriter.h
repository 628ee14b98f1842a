// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaCGNSWriter
 * @brief   Writes a mesh and its named patches as a CGNS file
 *
 * Inputs are those of vtkAtriaMeshWriter; cells and faces are merged as vtkAtriaPolyhedralMeshWriter says.
 *
 * Written is a CGNS file in HDF5 with one unstructured zone: faces as NGON_n, internal ones first and then patch by
 * patch, cells as NFACE_n, coordinates in double precision. Each patch is a boundary condition of the family of its
 * name, which says what it is (BCWall, or BCGeneral for the domain's sides and `defaultFaces`); both sides of a sheet
 * have the family
 * `<name>` as a further one. Cells of one `ZoneId` are a ZoneSubRegion where there are several.
 *
 * Names are made valid (32 ASCII characters without /); the descriptor `OriginalName` of a family keeps what they were.
 *
 * Without libcgns when Atria was built every Write() is an error, see IsAvailable().
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
   * The file, replaced where it is there; its folder must be there. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether libcgns was there when Atria was built.
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
