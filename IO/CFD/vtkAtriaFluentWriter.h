// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches and zones in Fluent's format.
/**
 * @class   vtkAtriaFluentWriter
 * @brief   Writes a mesh and its named patches as a Fluent mesh
 *
 * Inputs are those of vtkAtriaMeshWriter; cells and faces are merged as vtkAtriaPolyhedralMeshWriter says.
 *
 * The file is in Fluent's text format (.msh) of faces, which holds polyhedra: points, cells with their types, faces
 * zone by zone, and the names of zones. Cells of one `ZoneId` are one fluid zone; they are numbered zone by zone.
 *
 * Patches are zones of type `wall`, except the domain's sides (xMin, xMax, yMin, yMax, zMin, zMax, domainSide1 …) and
 * `defaultFaces`: these are of type `pressure-outlet`, which is for the user to change. Names are made valid (ASCII
 * letters, digits and _ . -) and unique without regard to capitals. The two sides of a sheet, `<name>_front` and
 * `<name>_back`, are the wall `<name>` and its shadow `<name>-shadow`. Patches without faces are left out.
 *
 * @sa vtkAtriaOpenFOAMWriter vtkAtriaDualMesher
 */
#ifndef vtkAtriaFluentWriter_h
#define vtkAtriaFluentWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaPolyhedralMeshWriter.h"

class ATRIAIOCFD_EXPORT vtkAtriaFluentWriter : public vtkAtriaPolyhedralMeshWriter
{
public:
  static vtkAtriaFluentWriter* New();
  vtkTypeMacro(vtkAtriaFluentWriter, vtkAtriaPolyhedralMeshWriter);

  ///@{
  /**
   * The file to write; an existing one is replaced. Its folder must exist. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkAtriaFluentWriter() = default;
  ~vtkAtriaFluentWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context) override;

private:
  vtkAtriaFluentWriter(const vtkAtriaFluentWriter&) = delete;
  void operator=(const vtkAtriaFluentWriter&) = delete;

  char* FileName = nullptr;
};

#endif
