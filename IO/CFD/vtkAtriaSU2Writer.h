// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches in SU2's format.
/**
 * @class   vtkAtriaSU2Writer
 * @brief   Writes a mesh and its named patches as an SU2 mesh
 *
 * Inputs are those of vtkAtriaMeshWriter.
 *
 * The file is in SU2's text format (.su2). The format has no polyhedra: each is cut into pyramids over its
 * quadrilaterals and tetrahedra over triangles. Their common apex is inside, at the centroid if that sees all faces. A
 * face of more corners is cut into triangles the same way for both of its cells, from its corner of the lowest number
 * that sees all of its edges. Other cells are written unchanged, in the order of the input; the parts of a polyhedron
 * stand in its place.
 *
 * Patches become markers (MARKER_TAG). Names are made valid (ASCII letters, digits and _ . - + : /), and a comment
 * keeps the originals. `ZoneId` has no place in the format.
 *
 * SU2 knows faces by their points alone. It cannot distinguish the sides of a sheet one face wide, whose points are all
 * on its boundary edges; a warning counts such faces. Another warning reports parts of polyhedra that are inside out.
 *
 * @sa vtkAtriaOpenFOAMWriter vtkAtriaDualMesher
 */
#ifndef vtkAtriaSU2Writer_h
#define vtkAtriaSU2Writer_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaMeshWriter.h"

class ATRIAIOCFD_EXPORT vtkAtriaSU2Writer : public vtkAtriaMeshWriter
{
public:
  static vtkAtriaSU2Writer* New();
  vtkTypeMacro(vtkAtriaSU2Writer, vtkAtriaMeshWriter);

  ///@{
  /**
   * The file to write; an existing one is replaced. Its folder must exist. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkAtriaSU2Writer() = default;
  ~vtkAtriaSU2Writer() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) override;

private:
  vtkAtriaSU2Writer(const vtkAtriaSU2Writer&) = delete;
  void operator=(const vtkAtriaSU2Writer&) = delete;

  char* FileName = nullptr;
};

#endif
