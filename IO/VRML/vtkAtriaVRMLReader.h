// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaVRMLReader
 * @brief   Reads the surfaces of a VRML97 model as named triangles
 *
 * The reader takes a VRML97 (VRML 2.0) file, plain or compressed with gzip whatever its name, and gives the
 * surfaces of all its shapes as triangles in the coordinates and the double precision of the file. VRML does
 * not say which unit an exporter used nor, for architecture, reliably which axis is up; nothing is converted.
 *
 * Output:
 * - points in double precision, shared within a shape as the file shares them;
 * - triangles whose front is the side VRML calls the front: `ccw FALSE` and mirroring transforms are
 * resolved;
 * - cell array `SurfaceId` (vtkIntArray): the shape each triangle belongs to;
 * - field data `SurfaceName` and `MaterialName` (vtkStringArray): per SurfaceId, the name of the shape and of
 *   its material, the latter empty where there is none.
 *
 * Each Shape met is one surface; a Shape used several times (USE, instances of prototypes) is as many. Its
 * name is the DEF name of the Shape, else of its geometry, else of the nearest node around it, else the DEF
 * name of the material or the appearance, else `Shape`. Names that repeat are numbered in the order of the
 * file: `Wall`, `Wall_2`, `Wall_3`. All strings are UTF-8; names in other encodings are read as Latin-1.
 *
 * Read are Transform, Group, Anchor, Billboard (not turned), Collision (not its proxy), Switch (the choice
 * the file makes), LOD (the finest level), Inline (files beside this one, at any depth), DEF and USE, PROTO
 * and EXTERNPROTO, and Shape with IndexedFaceSet, Box, Sphere, Cone, Cylinder, ElevationGrid and Extrusion.
 * Faces are triangulated properly whether or not the file calls them convex; faces without area are dropped.
 * Lines, points, text, lights, sensors, scripts and the like make no surface: GetSkippedNodes lists them.
 *
 * A damaged file is read as far as possible. What was skipped or had to be guessed is reported in one VTK
 * warning, and in full by GetWarnings. An error, with empty output, is reported for a file that cannot be
 * read, that is VRML 1.0 (another language), or that holds no surface at all.
 *
 * Limits: only files are inlined, no network addresses; animations stay at their initial state; a scene
 * that repeats its nodes more than five million times is refused.
 */
#ifndef vtkAtriaVRMLReader_h
#define vtkAtriaVRMLReader_h

#include "AtriaIOVRMLModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For arrays of strings

class vtkStringArray;

class ATRIAIOVRML_EXPORT vtkAtriaVRMLReader : public vtkPolyDataAlgorithm
{
public:
  static vtkAtriaVRMLReader* New();
  vtkTypeMacro(vtkAtriaVRMLReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read, .wrl, .wrz or .wrl.gz. None by default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Angle in degrees between neighbouring points of spheres, cones and cylinders; the number of points around
   * is rounded up. Default 10 (36 points around), from 1 to 90.
   */
  vtkSetClampMacro(TessellationAngle, double, 1.0, 90.0);
  vtkGetMacro(TessellationAngle, double);
  ///@}

  /**
   * Whether the file begins like a VRML97 file, looking inside gzip too. Files without a header can be read
   * nevertheless.
   */
  static bool CanReadFile(const char* fileName);

  /**
   * The warnings of the last run, one string each, in the order of the file and without those beyond the
   * first thousand. Never null.
   */
  vtkStringArray* GetWarnings();

  /**
   * How many warnings the last run had.
   */
  vtkIdType GetNumberOfWarnings() const { return this->NumberOfWarnings; }

  /**
   * What the last run met that makes no surface, such as "IndexedLineSet: 12". Never null.
   */
  vtkStringArray* GetSkippedNodes();

protected:
  vtkAtriaVRMLReader();
  ~vtkAtriaVRMLReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;
  double TessellationAngle = 10.0;
  vtkIdType NumberOfWarnings = 0;
  vtkSmartPointer<vtkStringArray> Warnings;
  vtkSmartPointer<vtkStringArray> SkippedNodes;

private:
  void ReportWarnings();

  vtkAtriaVRMLReader(const vtkAtriaVRMLReader&) = delete;
  void operator=(const vtkAtriaVRMLReader&) = delete;
};

#endif
