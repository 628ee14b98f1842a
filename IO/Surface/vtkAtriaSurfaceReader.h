// SPDX-License-Identifier: GPL-3.0-or-later
/// Reader that all readers of models derive from.
/**
 * @class   vtkAtriaSurfaceReader
 * @brief   Common base of the readers of models: units, axes, duplicates, and division into surfaces
 *
 * Formats do not say, or not reliably, which unit a program used and which axis is up: the user has to state both. By
 * default z is up and lengths are meters; a warning reports any sign of the contrary.
 *
 * Output:
 * - triangles with points in double precision;
 * - cell array `SurfaceId` (vtkIntArray): the surface each triangle belongs to;
 * - field data by SurfaceId: `SurfaceName` and `MaterialName` (vtkStringArray), the latter empty where there is none;
 *   `DiffuseColor` (vtkDoubleArray, three components from 0 to 1) and `Transparency` (vtkDoubleArray, 0 opaque to 1),
 *   0.8 and 0 where the file gives none;
 * - field data `ModelOffset` (vtkDoubleArray, three components): what Recenter subtracted from all points, meters.
 *
 * Skipped content and guesses are reported in one VTK warning, and in full by GetWarnings. An error, with empty output,
 * is reported for a file that cannot be read or that holds no surface at all.
 *
 * @sa vtkAtriaVRMLReader vtkAtriaModelReader
 */
#ifndef vtkAtriaSurfaceReader_h
#define vtkAtriaSurfaceReader_h

#include "AtriaIOSurfaceModule.h" // For export macro
#include "vtkAtriaRangeMacros.h"  // For properties with a range
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For arrays of strings

#include <string> // for patterns
#include <vector> // for ExcludedSurfaces and warnings

class vtkPolyData;
class vtkStringArray;

namespace atria {
class ProgressRange;
namespace scene {
class Diagnostics;
struct ModelSource;
} // namespace scene
} // namespace atria

class ATRIAIOSURFACE_EXPORT vtkAtriaSurfaceReader : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkAtriaSurfaceReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. None by default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  enum SurfaceByType
  {
    Shape,    ///< each Shape, or geometry node of VRML 1.0; of other formats see vtkAtriaModelReader
    Group,    ///< each group with a DEF name and each inlined file, without the groups in it that have one
    Material, ///< shapes of the same name, color and transparency of material
    Connected ///< pieces of shapes that are smooth in themselves: six for a box
  };

  ///@{
  /**
   * The rule that divides a model into surfaces. Default Shape.
   */
  vtkAtriaSetInRangeMacro(SurfaceBy, int, Shape, Connected);
  vtkGetMacro(SurfaceBy, int);
  void SetSurfaceByToShape() { this->SetSurfaceBy(Shape); }
  void SetSurfaceByToGroup() { this->SetSurfaceBy(Group); }
  void SetSurfaceByToMaterial() { this->SetSurfaceBy(Material); }
  void SetSurfaceByToConnected() { this->SetSurfaceBy(Connected); }
  ///@}

  ///@{
  /**
   * Angle in degrees between neighboring triangles above which Connected parts them. Default 30, from 0 to 180.
   */
  vtkAtriaSetInRangeMacro(SplitAngle, double, 0.0, 180.0);
  vtkGetMacro(SplitAngle, double);
  ///@}

  ///@{
  /**
   * Keep only one of faces that coincide, in one surface or in several, whichever way they face. The smaller surface
   * keeps its faces: a window keeps those that an uncut wall has there too. The first of equally large surfaces keeps
   * them; in SketchUp's exports that is the front of a sheet. GetNotes reports which surface lost how much to which.
   * Default on.
   */
  vtkSetMacro(MergeDuplicateFaces, bool);
  vtkGetMacro(MergeDuplicateFaces, bool);
  vtkBooleanMacro(MergeDuplicateFaces, bool);
  ///@}

  enum UpAxisType
  {
    UnstatedUp, ///< z unless the format says otherwise, with a warning where the model looks otherwise
    YUp,
    ZUp
  };

  ///@{
  /**
   * The axis that is up in the file. With YUp, models are turned about x so that z is. Default UnstatedUp.
   */
  vtkAtriaSetInRangeMacro(UpAxis, int, UnstatedUp, ZUp);
  vtkGetMacro(UpAxis, int);
  void SetUpAxisToY() { this->SetUpAxis(YUp); }
  void SetUpAxisToZ() { this->SetUpAxis(ZUp); }
  void SetUpAxisToUnstated() { this->SetUpAxis(UnstatedUp); }
  ///@}

  enum LengthUnitType
  {
    UnstatedUnit, ///< meters, with a warning where the file or the model's size speaks against it
    Meters,
    Millimeters,
    Centimeters,
    Inches,
    Feet
  };

  ///@{
  /**
   * The unit of length in the file; the output is in meters. VRML has no field for it, and programs write whatever they
   * work in. Default UnstatedUnit.
   */
  vtkAtriaSetInRangeMacro(LengthUnit, int, UnstatedUnit, Feet);
  vtkGetMacro(LengthUnit, int);
  void SetLengthUnitToUnstated() { this->SetLengthUnit(UnstatedUnit); }
  void SetLengthUnitToMeters() { this->SetLengthUnit(Meters); }
  void SetLengthUnitToMillimeters() { this->SetLengthUnit(Millimeters); }
  void SetLengthUnitToCentimeters() { this->SetLengthUnit(Centimeters); }
  void SetLengthUnitToInches() { this->SetLengthUnit(Inches); }
  void SetLengthUnitToFeet() { this->SetLengthUnit(Feet); }
  ///@}

  ///@{
  /**
   * A further factor for all coordinates, for units that are not listed; no unit. Default 1, from 1e-9 to 1e9.
   */
  vtkAtriaSetInRangeMacro(Scale, double, 1e-9, 1e9);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /**
   * Move a model that lies farther from the origin than it is long to the origin, by whole hundreds of meters along
   * each axis. The field array `ModelOffset` has the offset that was subtracted. Default off.
   */
  vtkSetMacro(Recenter, bool);
  vtkGetMacro(Recenter, bool);
  vtkBooleanMacro(Recenter, bool);
  ///@}

  ///@{
  /**
   * Surfaces whose name matches the pattern (`*` any text, `?` any one character) are left out, such as furniture and
   * trees. A pattern that matches none is a warning. None by default.
   */
  void AddExcludedSurface(const char* pattern);
  int GetNumberOfExcludedSurfaces();
  std::string GetExcludedSurface(int i);
  void RemoveAllExcludedSurfaces();
  ///@}

  /**
   * The warnings of the last run, one string each, in the order of the file and without those beyond the
   * first thousand. Never null.
   */
  vtkStringArray* GetWarnings();

  /**
   * Number of warnings of the last run.
   */
  vtkIdType GetNumberOfWarnings() const { return this->NumberOfWarnings; }

  /**
   * Actions of the last run that may be of interest, such as merging faces; one string each. Never null.
   */
  vtkStringArray* GetNotes();

  /**
   * Number of faces that the last run left out because they coincide with others.
   */
  vtkIdType GetNumberOfMergedFaces() const { return this->NumberOfMergedFaces; }

  /**
   * Content of the file that makes no surface, such as "IndexedLineSet: 12". Never null.
   */
  vtkStringArray* GetSkippedNodes();

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaSurfaceReader();
  ~vtkAtriaSurfaceReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /**
   * Throws atria::Error naming a property that is out of range.
   */
  virtual void CheckProperties();

  /**
   * Returns the length of the file's unit in meters, Scale included.
   */
  double MetersPerUnit() const;

  /**
   * Reads FileName without changes. Throws atria::Error with a text for the user, or atria::Aborted.
   */
  virtual atria::scene::ModelSource ReadSource(atria::scene::Diagnostics& diagnostics,
                                               const atria::ProgressRange& progress) = 0;

  char* FileName = nullptr;
  int SurfaceBy = Shape;
  double SplitAngle = 30.0;
  bool MergeDuplicateFaces = true;
  int UpAxis = UnstatedUp;
  int LengthUnit = UnstatedUnit;
  double Scale = 1.0;
  bool Recenter = false;
  std::vector<std::string> ExcludedSurfaces;
  vtkIdType NumberOfMergedFaces = 0;
  vtkIdType NumberOfWarnings = 0;
  vtkSmartPointer<vtkStringArray> Warnings;
  vtkSmartPointer<vtkStringArray> Notes;
  vtkSmartPointer<vtkStringArray> SkippedNodes;

private:
  bool ReadModel(vtkPolyData* output, atria::scene::Diagnostics& diagnostics, std::vector<std::string>& grave);
  void Report(const atria::scene::Diagnostics& diagnostics, const std::vector<std::string>& grave);

  vtkAtriaSurfaceReader(const vtkAtriaSurfaceReader&) = delete;
  void operator=(const vtkAtriaSurfaceReader&) = delete;
};

#endif
