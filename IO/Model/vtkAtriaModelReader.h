// SPDX-License-Identifier: GPL-3.0-or-later
/// Reader that loads models of many formats, from OBJ to IFC.
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
 * | .json, .jsonl | CityJSON, text sequences | a semantic class of a city object, else the object |
 * | .dae | COLLADA | a node, in one material |
 * | .3ds | 3D Studio | an object, in one material |
 * | .fbx | FBX, ASCII or binary | a node, in one material |
 * | .dxf | DXF in text form: faces, meshes, what has a thickness | a layer |
 * | .ifc | IFC 2x3 | an element by class and name, `IfcWall_South`, in one material |
 *
 * The strings are UTF-8. An object or node of several materials is as many surfaces, `Wall_Brick` and `Wall_Glass`.
 * Names that repeat by accident are numbered, `Wall`, `Wall_2`; equal names of solids of STL or of blocks are one
 * surface. Repeated names in formats with a tree get the name of the outermost node in which they differ ahead of them,
 * such as the storey of IFC or the object of CityJSON. A surface without a name is named after its material, else after
 * the file. SurfaceBy Group puts an object and group, or a node, into one surface. The material of CityJSON is the
 * class.
 *
 * Polygons, concave ones too, quads and triangle strips are triangulated; faces without area are dropped. Lines and
 * points make no surface and are counted in a warning, as is anything else that was left out. Colors are not read.
 *
 * glTF is Y up and in meters by definition, and taken so unless UpAxis and LengthUnit say otherwise. COLLADA, FBX and
 * IFC state their unit and axis, DXF may state its unit: these are taken, and LengthUnit is left out with a warning if
 * it is set as well. 3DS and DXF are Z up. CityJSON is Z up and in meters. Binary STL, glTF and files read by assimp
 * have single precision; a warning says so if that is coarse for the model, such as far from the origin.
 *
 * COLLADA, 3DS, FBX and IFC are read by assimp, in the program atria-assimp, which runs for as long as it reads. It
 * crashes on many damaged files: the run then reports an error that names the file, and the output is empty. Elements
 * of IFC that it fails on are left out. A warning names them, those of later schemas than IFC 2x3, and those that are
 * solids in the file but not closed when read. Another warning names solids of CityJSON that are not closed.
 *
 * The highest level of detail of a city object is read. An object whose children have a higher one is left out.
 *
 * A damaged OBJ, STL, PLY, glTF or CityJSON file is read as far as possible, and a warning says what is wrong with the
 * rest. An error is reported if no face can be read. Damaged JSON is an error, too, that names line and column. VTK's
 * own formats are read by VTK, which requires intact files.
 *
 * Limits: IFC 4 is read as far as IFC 2x3 has its elements and shapes, and its face sets; solids of DXF (ACIS) are not
 * read; OBJ's free-form surfaces, glTF's skins, animations and compressed meshes, and PLY's strips are not read.
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
   * True if the file's name has one of the endings above.
   */
  static bool CanReadFile(const char* fileName);

  /**
   * For a file that cannot be read, returns the name of its program and the formats to export, by the file's ending,
   * such as `.skp`. Empty for an unknown ending.
   */
  static std::string GetExportAdvice(const char* fileName);

  /**
   * The endings above, parted by spaces.
   */
  static std::string GetFileExtensions();

protected:
  vtkAtriaModelReader() = default;
  ~vtkAtriaModelReader() override = default;

  atria::scene::ModelSource ReadSource(atria::scene::Diagnostics& diagnostics,
                                       const atria::ProgressRange& progress) override;

private:
  vtkAtriaModelReader(const vtkAtriaModelReader&) = delete;
  void operator=(const vtkAtriaModelReader&) = delete;
};

#endif
