// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaModelReader
 * @brief   Reads the surfaces of a model in other formats than VRML as named triangles
 *
 * The format follows from the ending of the file's name, in capitals or not:
 *
 * | ending | format | a surface is |
 * |---|---|---|
 * | .obj | Wavefront OBJ | the faces of one object, group and material |
 * | .stl | STL, ASCII or binary | the solids of one name |
 * | .ply | PLY, ASCII or binary | the file |
 * | .gltf, .glb | glTF 2.0 | a primitive (one material) of a node of the scene |
 * | .vtp | VTK XML polydata | as the arrays SurfaceId and SurfaceName say, else the file |
 * | .vtm, .vtpc | VTK XML composites | likewise in each block, else a named block |
 *
 * The strings are UTF-8. An object or node of several materials is as many surfaces, `Wall_Brick` and `Wall_Glass`.
 * Names that repeat by accident are numbered, `Wall`, `Wall_2`; equal names of solids of STL or of blocks are one
 * surface. What has no name is called by its material, else like the file. SurfaceBy Group takes together what is one
 * object and group, or one node.
 *
 * Polygons, concave ones too, quads and triangle strips are triangulated; faces without area are dropped. Lines and
 * points make no surface and are counted in a warning, as is anything else that was left out. Colors are not read.
 *
 * glTF is Y up and in meters by definition, and taken so unless UpAxis and LengthUnit say otherwise. Binary STL and
 * glTF have single precision; a warning says so where that is coarse for the model, as far from the origin.
 *
 * Of a damaged OBJ, STL, PLY or glTF file the faces that can be read are read, and a warning says what is wrong with
 * the rest; an error is reported where none can be. VTK's own formats are read by VTK, which asks for sound files.
 *
 * Limits: OBJ's free-form surfaces, glTF's skins, animations and compressed meshes, and PLY's strips are not read.
 */
#ifndef vtkAtriaModelReader_h
#define vtkAtriaModelReader_h

#include "AtriaIOModelModule.h" // For export macro
#include "vtkAtriaSurfaceReader.h"

#include <string> // For the list of endings

class ATRIAIOMODEL_EXPORT vtkAtriaModelReader : public vtkAtriaSurfaceReader
{
public:
  static vtkAtriaModelReader* New();
  vtkTypeMacro(vtkAtriaModelReader, vtkAtriaSurfaceReader);

  /**
   * Whether the file's name has one of the endings above.
   */
  static bool CanReadFile(const char* fileName);

  /**
   * The endings above, parted by spaces.
   */
  static std::string GetFileExtensions();

protected:
  vtkAtriaModelReader() = default;
  ~vtkAtriaModelReader() override = default;

  atria::vrml::ModelSource ReadSource(atria::vrml::Diagnostics& diagnostics,
                                      const atria::ProgressRange& progress) override;

private:
  vtkAtriaModelReader(const vtkAtriaModelReader&) = delete;
  void operator=(const vtkAtriaModelReader&) = delete;
};

#endif
