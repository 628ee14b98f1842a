// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaVRMLReader
 * @brief   Reads the surfaces of a VRML model as named triangles
 *
 * The reader takes a VRML97 (VRML 2.0) or VRML 1.0 file, plain or compressed with gzip whatever its name, and gives
 * the surfaces of all its shapes as triangles in double precision. VRML does
 * not say which unit an exporter used nor, for architecture, reliably which axis is up: that is for the user to say.
 * Where it is not said, z is up and lengths are metres, and what speaks against it is a warning.
 *
 * Output:
 * - points in double precision, shared within a shape as the file shares them;
 * - triangles whose front is the side VRML calls the front: `ccw FALSE` and mirroring transforms are
 *   resolved;
 * - cell array `SurfaceId` (vtkIntArray): the surface each triangle belongs to;
 * - field data by SurfaceId: `SurfaceName` and `MaterialName` (vtkStringArray), the latter empty where there is none;
 *   `DiffuseColor` (vtkDoubleArray, three components from 0 to 1) and `Transparency` (vtkDoubleArray, 0 opaque to 1),
 *   VRML's defaults where the file gives none;
 * - field data `ModelOffset` (vtkDoubleArray, three components): what Recentre subtracted from all points, metres.
 *
 * Each Shape met (in VRML 1.0, each geometry node) is one surface, unless SurfaceBy says otherwise; a Shape used
 * several times (USE, instances of prototypes) is as many. Its name is the DEF name of the Shape, else of its
 * geometry, else of the nearest node around it, else of the material or the appearance, else `Shape`. Names that
 * repeat have the outermost group in which they differ ahead of them, `East/Wall` and `West/Wall`; those that still
 * repeat are numbered in the order of the file: `Wall`, `Wall_2`, `Wall_3`. An Inline without a name goes by that of
 * its file. All strings are UTF-8; names in other encodings are read as Latin-1.
 *
 * Read are Transform, Group, Anchor, Billboard (not turned), Collision (not its proxy), Switch (the choice
 * the file makes), LOD (the finest level), Inline (files beside this one, at any depth), DEF and USE, PROTO
 * and EXTERNPROTO, and Shape with IndexedFaceSet, Box, Sphere, Cone, Cylinder, ElevationGrid and Extrusion; of
 * VRML 1.0 all groups, transforms, ShapeHints, Material, WWWInline, IndexedFaceSet, Cube, Sphere, Cone, Cylinder, and
 * nodes of others that say by `isA` what they are.
 * Faces are triangulated properly whether or not the file calls them convex; faces without area are dropped.
 * Lines, points, text, lights, sensors, scripts and the like make no surface: GetSkippedNodes lists them.
 *
 * A damaged file is read as far as possible. What was skipped or had to be guessed is reported in one VTK
 * warning, and in full by GetWarnings. An error, with empty output, is reported for a file that cannot be
 * read or that holds no surface at all.
 *
 * Limits: only files are inlined, no network addresses; animations stay at their initial state; a scene
 * that repeats its nodes more than five million times is refused.
 */
#ifndef vtkAtriaVRMLReader_h
#define vtkAtriaVRMLReader_h

#include "AtriaIOVRMLModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For arrays of strings

class vtkPolyData;
class vtkStringArray;

namespace atria {
namespace vrml {
class Diagnostics;
}
} // namespace atria

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

  enum SurfaceByType
  {
    Shape,    ///< each Shape, or geometry node of VRML 1.0
    Group,    ///< each group with a DEF name and each inlined file, without the groups in it that have one
    Material, ///< shapes of the same name, colour and transparency of material
    Connected ///< pieces of shapes that are smooth in themselves: six for a box
  };

  ///@{
  /**
   * What makes a surface. Default Shape.
   */
  vtkSetClampMacro(SurfaceBy, int, Shape, Connected);
  vtkGetMacro(SurfaceBy, int);
  ///@}

  ///@{
  /**
   * Angle in degrees between neighbouring triangles above which Connected parts them. Default 30, from 0 to 180.
   */
  vtkSetClampMacro(SplitAngle, double, 0.0, 180.0);
  vtkGetMacro(SplitAngle, double);
  ///@}

  ///@{
  /**
   * Whether a face that coincides with an earlier one, of the same shape or of another, is left out, whichever way it
   * faces. The first one keeps its name; in SketchUp's exports that is the front. GetNotes tells what was merged.
   * Default on.
   */
  vtkSetMacro(MergeDuplicateFaces, bool);
  vtkGetMacro(MergeDuplicateFaces, bool);
  vtkBooleanMacro(MergeDuplicateFaces, bool);
  ///@}

  enum UpAxisType
  {
    UnstatedUp, ///< z, with a warning where the model looks otherwise
    YUp,
    ZUp
  };

  ///@{
  /**
   * The axis that is up in the file. With YUp, models are turned about x so that z is. Default UnstatedUp.
   */
  vtkSetClampMacro(UpAxis, int, UnstatedUp, ZUp);
  vtkGetMacro(UpAxis, int);
  ///@}

  enum LengthUnitType
  {
    UnstatedUnit, ///< metres, with a warning where the file or the model's size speaks against it
    Metres,
    Millimetres,
    Centimetres,
    Inches,
    Feet
  };

  ///@{
  /**
   * The unit of length in the file; the output is in metres. VRML has no field for it, and programs write whatever they
   * work in. Default UnstatedUnit.
   */
  vtkSetClampMacro(LengthUnit, int, UnstatedUnit, Feet);
  vtkGetMacro(LengthUnit, int);
  ///@}

  ///@{
  /**
   * A further factor for all coordinates, for units that are not listed; no unit. Default 1, from 1e-9 to 1e9.
   */
  vtkSetClampMacro(Scale, double, 1e-9, 1e9);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /**
   * Whether a model that lies farther from the origin than it is long is moved there, by whole hundreds of metres along
   * each axis. The field array `ModelOffset` tells what was subtracted. Default off.
   */
  vtkSetMacro(Recentre, bool);
  vtkGetMacro(Recentre, bool);
  vtkBooleanMacro(Recentre, bool);
  ///@}

  /**
   * Whether the file begins like a VRML file, looking inside gzip too. Files without a header can be read
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
   * What the last run did that may be of interest, such as merging faces; one string each. Never null.
   */
  vtkStringArray* GetNotes();

  /**
   * How many faces the last run left out as they coincide with others.
   */
  vtkIdType GetNumberOfMergedFaces() const { return this->NumberOfMergedFaces; }

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
  int SurfaceBy = Shape;
  double SplitAngle = 30.0;
  bool MergeDuplicateFaces = true;
  int UpAxis = UnstatedUp;
  int LengthUnit = UnstatedUnit;
  double Scale = 1.0;
  bool Recentre = false;
  vtkIdType NumberOfMergedFaces = 0;
  vtkIdType NumberOfWarnings = 0;
  vtkSmartPointer<vtkStringArray> Warnings;
  vtkSmartPointer<vtkStringArray> Notes;
  vtkSmartPointer<vtkStringArray> SkippedNodes;

private:
  bool ReadModel(vtkPolyData* output, atria::vrml::Diagnostics& diagnostics);
  void Report(const atria::vrml::Diagnostics& diagnostics);
  double MetresPerUnit() const;

  vtkAtriaVRMLReader(const vtkAtriaVRMLReader&) = delete;
  void operator=(const vtkAtriaVRMLReader&) = delete;
};

#endif
