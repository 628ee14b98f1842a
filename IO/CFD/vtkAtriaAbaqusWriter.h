// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that saves a mesh with its patches and zones in the format of Abaqus and CalculiX.
/**
 * @class   vtkAtriaAbaqusWriter
 * @brief   Writes a mesh and its named patches as an input file of Abaqus and CalculiX
 *
 * Inputs are those of vtkAtriaMeshWriter. The mesh must have neither polyhedra nor pyramids: make it with
 * vtkAtriaDualMesher's ElementType Hexahedral. Write() returns 0 with an error that counts them.
 *
 * The file (.inp) has the mesh only, to be included in a model: nodes (set `NALL`) and elements of the types C3D8, C3D6
 * and C3D4 (set `EALL`), numbered from 1 as in the input. Numbers have 20 characters at most, as both programs read no
 * more: up to 17 digits, but at least 13.
 *
 * Patches are surfaces of type ELEMENT, with faces S1 to S6 of elements. Zones of cells are sets of elements: rooms and
 * cell zones, or else `ZoneId` if there is more than one. Names are made valid (ASCII letters, digits, _ and -, first a
 * letter, up to 80 characters) and unique without regard to capitals; comments keep the originals. Patches without
 * faces and face zones are left out.
 *
 * Elements are connected where they share points. The sides of a sheet one face wide share all points; a warning counts
 * such faces.
 *
 * @sa vtkAtriaGmshWriter vtkAtriaDualMesher
 */
#ifndef vtkAtriaAbaqusWriter_h
#define vtkAtriaAbaqusWriter_h

#include "AtriaIOCFDModule.h" // For export macro
#include "vtkAtriaMeshWriter.h"

class ATRIAIOCFD_EXPORT vtkAtriaAbaqusWriter : public vtkAtriaMeshWriter
{
public:
  static vtkAtriaAbaqusWriter* New();
  vtkTypeMacro(vtkAtriaAbaqusWriter, vtkAtriaMeshWriter);

  ///@{
  /**
   * The file to write; an existing one is replaced. Its folder must exist. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkAtriaAbaqusWriter() = default;
  ~vtkAtriaAbaqusWriter() override;

  std::string GetTarget() const override;
  const char* GetFormatName() const override;
  const char* GetTargetProperty() const override;
  void WriteMesh(vtkUnstructuredGrid* volume, atria::VtkFaceMesh& source, const atria::RunContext& context) override;

private:
  vtkAtriaAbaqusWriter(const vtkAtriaAbaqusWriter&) = delete;
  void operator=(const vtkAtriaAbaqusWriter&) = delete;

  char* FileName = nullptr;
};

#endif
