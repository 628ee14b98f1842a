// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches and zones in Gmsh's format.
/**
 * @class   vtkAtriaGmshWriter
 * @brief   Writes a mesh and its named patches as a Gmsh mesh
 *
 * Inputs are those of vtkAtriaMeshWriter. The mesh must not have polyhedra: make it with vtkAtriaDualMesher's
 * ElementType Hexahedral. Write() returns 0 with an error that counts them.
 *
 * The file is in Gmsh's text format 4.1 (.msh): hexahedra (type 5), wedges (6), pyramids (7) and tetrahedra (4), and
 * quadrilaterals (3) and triangles (2) on the boundary, whose normals point out of the mesh.
 *
 * Patches are physical surfaces. Zones of cells are physical volumes: rooms and cell zones, or else `ZoneId` if there
 * is more than one. The other cells are the volume `fluid`. A cell in two zones, such as of a tree in a room, is in
 * both volumes. Names are made valid (ASCII letters, digits and _ . - + : /); comments at the end of the file keep
 * originals that differ. Patches without faces are left out, and so are face zones: some solvers take any surface for a
 * boundary.
 *
 * Gmsh knows faces by their points alone. It cannot distinguish the sides of a sheet one face wide, whose points are
 * all on its boundary edges; a warning counts such faces.
 *
 * @sa vtkAtriaAbaqusWriter vtkAtriaFluentWriter vtkAtriaDualMesher
 */
#ifndef vtkAtriaGmshWriter_h
#define vtkAtriaGmshWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaMeshWriter.h"

class ATRIAIOCFD_EXPORT vtkAtriaGmshWriter : public vtkAtriaMeshWriter
{
public:
  static vtkAtriaGmshWriter* New();
  vtkTypeMacro(vtkAtriaGmshWriter, vtkAtriaMeshWriter);

  ///@{
  /**
   * The file to write; an existing one is replaced. Its folder must exist. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkAtriaGmshWriter() = default;
  ~vtkAtriaGmshWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) override;

private:
  vtkAtriaGmshWriter(const vtkAtriaGmshWriter&) = delete;
  void operator=(const vtkAtriaGmshWriter&) = delete;

  char* FileName = nullptr;
};

#endif
