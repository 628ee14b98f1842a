// SPDX-License-Identifier: GPL-3.0-or-later
/// Reader that loads VRML models, of VRML97 and VRML 1.0.
/**
 * @class   vtkAtriaVRMLReader
 * @brief   Reads the surfaces of a VRML model as named triangles
 *
 * The reader takes a VRML97 (VRML 2.0) or VRML 1.0 file, plain or compressed with gzip whatever its name, and returns
 * the surfaces of all its shapes as triangles in double precision. VRML does not say which unit an exporter used nor,
 * for architecture, reliably which axis is up: the user has to state both. By default z is up and lengths are meters; a
 * warning reports any sign of the contrary.
 *
 * Output:
 * - points in double precision, shared within a shape as the file shares them;
 * - triangles whose front is the side VRML calls the front: `ccw FALSE` and mirroring transforms are
 *   resolved;
 * - cell array `SurfaceId` (vtkIntArray): the surface each triangle belongs to;
 * - field data by SurfaceId: `SurfaceName` and `MaterialName` (vtkStringArray), the latter empty where there is none;
 *   `DiffuseColor` (vtkDoubleArray, three components from 0 to 1) and `Transparency` (vtkDoubleArray, 0 opaque to 1),
 *   VRML's defaults where the file gives none;
 * - field data `ModelOffset` (vtkDoubleArray, three components): what Recenter subtracted from all points, meters.
 *
 * Each Shape met (in VRML 1.0, each geometry node) is one surface, unless SurfaceBy says otherwise; a Shape used
 * several times (USE, instances of prototypes) is as many. Its name is the DEF name of the Shape, else of its
 * geometry, else of the nearest node around it, else of the material or the appearance, else `Shape`. Names that
 * repeat have the outermost group in which they differ ahead of them, `East/Wall` and `West/Wall`; those that still
 * repeat are numbered in the order of the file: `Wall`, `Wall_2`, `Wall_3`. An Inline without a name goes by that of
 * its file. All strings are UTF-8; names in other encodings are read as Latin-1.
 *
 * The reader handles Transform, Group, Anchor, Billboard (not turned), Collision (not its proxy), Switch (the choice
 * the file makes), LOD (the finest level), Inline (files beside this one, at any depth), DEF and USE, PROTO and
 * EXTERNPROTO, and Shape with IndexedFaceSet, Box, Sphere, Cone, Cylinder, ElevationGrid and Extrusion. Of VRML 1.0 it
 * handles all groups, transforms, ShapeHints, Material, WWWInline, IndexedFaceSet, Cube, Sphere, Cone, Cylinder, and
 * nodes of others that state by `isA` what they are. Faces are triangulated properly whether or not the file calls them
 * convex; faces without area are dropped. Lines, points, text, lights, sensors, scripts and the like make no surface:
 * GetSkippedNodes lists them.
 *
 * A damaged file is read as far as possible. Skipped content and guesses are reported in one VTK warning, and in full
 * by GetWarnings. An error, with empty output, is reported for a file that cannot be read or that holds no surface at
 * all.
 *
 * Limits: only files are inlined, no network addresses; animations stay at their initial state; a scene
 * that repeats its nodes more than five million times is refused.
 */
#ifndef vtkAtriaVRMLReader_h
#define vtkAtriaVRMLReader_h

#include "AtriaIOVRMLModule.h" // For export macro
#include "vtkAtriaSurfaceReader.h"

class ATRIAIOVRML_EXPORT vtkAtriaVRMLReader : public vtkAtriaSurfaceReader
{
public:
  static vtkAtriaVRMLReader* New();
  vtkTypeMacro(vtkAtriaVRMLReader, vtkAtriaSurfaceReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Angle in degrees between neighboring points of spheres, cones and cylinders; the number of points around
   * is rounded up. Solids whose radius is less than a hundredth of the model's diagonal have fewer, though six at
   * least: their facets are as far off as those of a solid with that radius. Default 10 (36 points around), from 1
   * to 90.
   */
  vtkAtriaSetInRangeMacro(TessellationAngle, double, 1.0, 90.0);
  vtkGetMacro(TessellationAngle, double);
  ///@}

  ///@{
  /**
   * Maximum distance in meters between the facets of spheres, cones and cylinders and their true surface, after
   * transforms, units and Scale. More points around are taken than TessellationAngle requires, up to 3600. Points lie
   * on the true surface, so that facets are inside of it. Default 0, for any.
   */
  vtkAtriaSetInRangeMacro(TessellationError, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TessellationError, double);
  ///@}

  /**
   * True if the file, or its content unpacked from gzip, begins like a VRML file. Files without a header can be read
   * nevertheless.
   */
  static bool CanReadFile(const char* fileName);

protected:
  vtkAtriaVRMLReader() = default;
  ~vtkAtriaVRMLReader() override = default;

  void CheckProperties() override;
  atria::scene::ModelSource ReadSource(atria::scene::Diagnostics& diagnostics,
                                       const atria::ProgressRange& progress) override;

  double TessellationAngle = 10.0;
  double TessellationError = 0.0;

private:
  vtkAtriaVRMLReader(const vtkAtriaVRMLReader&) = delete;
  void operator=(const vtkAtriaVRMLReader&) = delete;
};

#endif
