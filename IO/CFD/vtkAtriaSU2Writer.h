// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaSU2Writer
 * @brief   Writes a mesh and its named patches as an SU2 mesh
 *
 * Inputs are those of vtkAtriaMeshWriter.
 *
 * Written is SU2's text format (.su2). It has no polyhedra: each is cut into pyramids over its quadrilaterals and
 * tetrahedra over triangles, with a common apex inside, at its centroid where that sees all of its faces. A face of
 * more corners is cut into triangles the same way for both of its cells, from its corner of the lowest number that sees
 * all of its edges. Other cells are written as they are, in the order of the input; the parts of a polyhedron stand in
 * its place.
 *
 * Patches become markers (MARKER_TAG); names are made valid (ASCII letters, digits and _ . - + : /), and a comment
 * keeps what they were. `ZoneId` has no place in the format.
 *
 * SU2 knows faces by their points alone: it cannot tell the sides of a sheet one face wide apart, whose points are all
 * on its boundary edges; a warning says how many such faces there are. So does one where parts of polyhedra are inside
 * out.
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
   * The file, replaced where it is there; its folder must be there. No default.
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
