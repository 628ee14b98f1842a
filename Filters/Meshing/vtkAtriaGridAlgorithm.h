// SPDX-License-Identifier: GPL-3.0-or-later
/// Base class of the filters that make a grid around surfaces.
/**
 * @class   vtkAtriaGridAlgorithm
 * @brief   sizes, domain and features, common to the feature graph, the octree source and the dual mesher
 *
 * Lengths are in the model's units; defaults suit a building in meters. Input port 0 takes the surface model: a
 * vtkPolyData, or a composite of named vtkPolyData blocks. A vtkPolyData names its surfaces by the cell array
 * `SurfaceId` and the field array `SurfaceName`, as vtkAtriaVRMLReader writes them. Surfaces that the field array
 * `IsGround` marks, by SurfaceId, are ground without being named.
 *
 * A property outside its range, or that is no number, is an error of the run that names the property.
 */
#ifndef vtkAtriaGridAlgorithm_h
#define vtkAtriaGridAlgorithm_h

#include "AtriaFiltersMeshingModule.h"
#include "vtkAlgorithm.h"
#include "vtkAtriaRangeMacros.h" // For properties with a range

#include <array>    // for RefinementBoxes
#include <optional> // for RequestDataOnRanks
#include <string>   // for names
#include <vector>   // for SurfaceSizeRules

class vtkMultiProcessController;
namespace atria {
struct DealtOutputs;
}

class ATRIAFILTERSMESHING_EXPORT vtkAtriaGridAlgorithm : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkAtriaGridAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Edge length of the largest octants, away from surfaces. The level with the closest octant size is used. With 0 it
   * follows from the domain: four times SizeMid, or more if the domain would otherwise take more than some fifty
   * thousand octants, or than a twentieth of MaxElements if that is less. Default 8; at least 0.
   */
  vtkAtriaSetInRangeMacro(SizeMax, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMax, double);
  ///@}

  ///@{
  /**
   * Edge length of octants that a surface passes through. With 0 it follows: twice SizeMin, or a quarter of SizeMax,
   * or, if these are 0 too, a size from the model, at which its surfaces take some fifty thousand octants, or a
   * twentieth of MaxElements if that is less. Default 2; at least 0.
   */
  vtkAtriaSetInRangeMacro(SizeMid, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMid, double);
  ///@}

  ///@{
  /**
   * Edge length of octants with a feature curve, a corner, or surfaces that do not meet inside them, and the grid's
   * unit: the finest octants unless a rule below requests finer ones. With 0 it is half of SizeMid. Default 1; at least
   * 0.
   */
  vtkAtriaSetInRangeMacro(SizeMin, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMin, double);
  ///@}

  ///@{
  /**
   * CompleteSizes sets sizes of 0 to values that follow from the other sizes, the model and the domain, which must be
   * set before; a run with sizes of 0 uses the same values. SuggestSizes does so for all three sizes, whatever they
   * are. Both update the input. They return false, with an error, if the model has no area or there is no domain.
   */
  bool CompleteSizes();
  bool SuggestSizes();
  ///@}

  ///@{
  /**
   * Level to which every octant of the domain is refined at least; the root cube is level 0. Default 4; from 0 to
   * 20.
   */
  vtkAtriaSetInRangeMacro(StartLevel, int, 0, 20);
  vtkGetMacro(StartLevel, int);
  ///@}

  ///@{
  /**
   * Degrees between the normals of two triangles above which their edge is a crease, and between two pieces of a curve
   * above which their point is a corner. Default 30; from 0 to 180.
   */
  vtkAtriaSetInRangeMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * Sizes at the surfaces whose name matches `pattern` (`*` any text, `?` any one character): octants that touch them
   * are at most `size` large, those with their feature curves and corners, or where they come close to others, at most
   * `featureSize` (default: SizeMin, or `size` if that is finer). They replace SizeMid and SizeMin there. Octants have
   * a size of SizeMin * 2^j: the largest of these that is not above the requested size is used. The finest of several
   * rules for a surface holds. AddSurfaceSizeRule takes a rule as text, `PATTERN SIZE [FEATURESIZE]`, the pattern in
   * double quotes if it holds blanks; GetSurfaceSizeRule returns this form. A pattern that matches no surface, or a
   * size that is not positive, is an error of the run. None by default.
   */
  void AddSurfaceSizeRule(const std::string& pattern, double size);
  void AddSurfaceSizeRule(const std::string& pattern, double size, double featureSize);
  void AddSurfaceSizeRule(const char* rule);
  int GetNumberOfSurfaceSizeRules();
  std::string GetSurfaceSizeRule(int i);
  void RemoveAllSurfaceSizeRules();
  ///@}

  ///@{
  /**
   * Octants that share volume with the box are at most `size` large. The box must reach into the domain. None by
   * default.
   */
  void AddRefinementBox(const double bounds[6], double size);
  void AddRefinementBox(double x0, double x1, double y0, double y1, double z0, double z1, double size);
  int GetNumberOfRefinementBoxes();
  void GetRefinementBox(int i, double boundsAndSize[7]);
  void RemoveAllRefinementBoxes();
  ///@}

  ///@{
  /**
   * Octants nearer than `distance` to a surface that matches `pattern` are at most `size` large. AddDistanceSizeRule
   * takes a rule as text, `PATTERN DISTANCE SIZE [DISTANCE SIZE ...]`. None by default.
   */
  void AddDistanceSizeRule(const std::string& pattern, double distance, double size);
  void AddDistanceSizeRule(const char* rule);
  int GetNumberOfDistanceSizeRules();
  std::string GetDistanceSizeRule(int i);
  void RemoveAllDistanceSizeRules();
  ///@}

  ///@{
  /**
   * Degrees by which the normals of a smooth surface may differ in an octant before it is refined, down to the size of
   * the surface's features at most. Default 0: curved surfaces are treated like flat ones; from 0 to 90.
   */
  vtkAtriaSetInRangeMacro(CurvatureAngle, double, 0.0, 90.0);
  vtkGetMacro(CurvatureAngle, double);
  ///@}

  ///@{
  /**
   * Octants across the space between two surfaces that face each other, down to the size of their features at most.
   * Walls count as well as passages, as it is not known yet which of them is fluid. Default 0: gaps are not searched
   * for; from 0 to 64.
   */
  vtkAtriaSetInRangeMacro(CellsAcrossGap, int, 0, 64);
  vtkGetMacro(CellsAcrossGap, int);
  ///@}

  ///@{
  /**
   * Layers of octants of each size between the next finer and the next coarser ones. Default 1, the 2:1 balance alone;
   * from 1 to 8.
   */
  vtkAtriaSetInRangeMacro(CellsPerLevel, int, 1, 8);
  vtkGetMacro(CellsPerLevel, int);
  ///@}

  /**
   * Shapes of elements.
   */
  enum ElementTypes
  {
    HexahedralDominant = 0, ///< polyhedra of up to eight corners where sizes change
    Hexahedral = 1          ///< hexahedra only
  };

  ///@{
  /**
   * Shapes of the elements. For hexahedra only, octants are refined in families of eight, and have one size at and near
   * each connected piece of surface: the finest there. Default HexahedralDominant.
   */
  vtkAtriaSetInRangeMacro(ElementType, int, HexahedralDominant, Hexahedral);
  vtkGetMacro(ElementType, int);
  void SetElementTypeToHexahedralDominant() { this->SetElementType(HexahedralDominant); }
  void SetElementTypeToHexahedral() { this->SetElementType(Hexahedral); }
  ///@}

  ///@{
  /**
   * Limit of the number of elements (all zones counted, layers not). Above it, coarser sizes are used: first a larger
   * SizeMax, then fewer CellsPerLevel, then coarser boxes, distances and gaps away from surfaces, then coarser
   * surfaces, and features last. A warning names the sizes that were used. Default 0: no limit; at least 0.
   */
  vtkAtriaSetInRangeMacro(MaxElements, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaxElements, int);
  ///@}

  ///@{
  /**
   * Gigabytes of memory (10^9 bytes) that meshing may take. Sizes that need more are refused while octants are sized,
   * before memory runs out; the error names sizes that fit. About 700 bytes per element are counted, for all zones and
   * without layers. Default 0: what the machine, its container and the shell's ulimit allow; at least 0.
   */
  vtkAtriaSetInRangeMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /**
   * Points closer than this to another point, an edge or a face that they are not connected with are moved onto it, so
   * that parts that nearly touch become connected. 0 closes no gap; a negative value means 0.05 times SizeMin. Default
   * -1.
   */
  vtkAtriaSetInRangeMacro(GapTolerance, double, VTK_DOUBLE_MIN, VTK_DOUBLE_MAX);
  vtkGetMacro(GapTolerance, double);
  ///@}

  ///@{
  /**
   * Connected parts of the model are omitted if the diagonal of their bounding box is shorter than this many octants of
   * SizeMin (or of the smaller size requested there), as they could not be seen in the mesh. Parts close to each other
   * count as one. Parts that may close a hole stay; so do surfaces that size rules name. 0 omits none. Default 1.
   */
  vtkAtriaSetInRangeMacro(SmallPartSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SmallPartSize, double);
  ///@}

  ///@{
  /**
   * Name patterns of permeable surfaces, such as panes of open windows, screens and measuring planes (`*` any text, `?`
   * any one character). The mesh conforms to them as to others, but they separate nothing and get no layers: their
   * faces are inside the mesh and form a face zone with the surface's name. A pattern that matches no surface is an
   * error of the run. None by default.
   */
  void AddFaceZone(const char* pattern);
  int GetNumberOfFaceZones();
  std::string GetFaceZone(int i);
  void RemoveAllFaceZones();
  ///@}

  ///@{
  /**
   * If on, windows, doors, hatches and gaps between walls are found by rule. Each becomes a face zone
   * `<Surface>_opening_<n>`, and they separate rooms. An opening is a hole in a plane wall that is closed all around,
   * by ends of walls and by parts that pass through the plane, such as floors, and is no narrower than 0.9 times
   * SizeMin. Default off.
   */
  vtkSetMacro(FindOpenings, bool);
  vtkGetMacro(FindOpenings, bool);
  vtkBooleanMacro(FindOpenings, bool);
  ///@}

  ///@{
  /**
   * Name patterns of surfaces in which no openings are searched for, such as furniture. A pattern that matches no
   * surface is an error of the run. None by default.
   */
  void AddSurfaceWithoutOpenings(const char* pattern);
  int GetNumberOfSurfacesWithoutOpenings();
  std::string GetSurfaceWithoutOpenings(int i);
  void RemoveAllSurfacesWithoutOpenings();
  ///@}

  ///@{
  /**
   * Name patterns of closed surfaces that enclose a cell zone, such as trees, porous screens and sources of heat. The
   * mesh conforms to them, but they are no walls; elements inside form a cell zone with the surface's name. A pattern
   * that matches no surface, and a surface that is not closed, is an error of the run. None by default.
   */
  void AddCellZone(const char* pattern);
  int GetNumberOfCellZones();
  std::string GetCellZone(int i);
  void RemoveAllCellZones();
  ///@}

  /**
   * Where the domain box comes from.
   */
  enum DomainModes
  {
    FromSurfaces = 0, ///< the bounds of the surfaces, for rooms and channels whose walls are the domain's sides
    Explicit = 1,     ///< DomainBounds
    Site = 2,         ///< above the surface SiteName: its bounds, and 0.3 times its longer side above its highest point
    Automatic =
        3 ///< from the buildings' height H: 5 H to inlet, sides and top, 15 H to the outlet, blockage at most 3 %
  };

  ///@{
  /**
   * Where the domain box comes from. Default Automatic.
   */
  vtkAtriaSetInRangeMacro(DomainMode, int, FromSurfaces, Automatic);
  vtkGetMacro(DomainMode, int);
  void SetDomainModeToFromSurfaces() { this->SetDomainMode(FromSurfaces); }
  void SetDomainModeToExplicit() { this->SetDomainMode(Explicit); }
  void SetDomainModeToSite() { this->SetDomainMode(Site); }
  void SetDomainModeToAutomatic() { this->SetDomainMode(Automatic); }
  ///@}

  ///@{
  /**
   * xMin, xMax, yMin, yMax, zMin, zMax of the domain if DomainMode is Explicit. Default: -50 to 50 in x and y, 0 to 50
   * in z.
   */
  vtkSetVector6Macro(DomainBounds, double);
  vtkGetVector6Macro(DomainBounds, double);
  ///@}

  ///@{
  /**
   * Degrees, counterclockwise seen from above, by which the domain is turned. DomainBounds are turned around their
   * middle; from surfaces and site it is the smallest box along the turned axes. Not used if DomainMode is Automatic.
   * Default 0; from -180 to 180.
   */
  vtkAtriaSetInRangeMacro(DomainAngle, double, -180.0, 180.0);
  vtkGetMacro(DomainAngle, double);
  ///@}

  ///@{
  /**
   * Upright sides of the domain. Default 4, a box; from 3 to 48. Otherwise a regular polygon, stretched to fill the
   * bounds, whose sides are the patches domainSide1, domainSide2 and so on, counterclockwise; the normal of the first
   * points along the domain's -x. If DomainMode is Automatic it then serves wind from all directions: 15 H from the
   * circle that holds the buildings to the sides, 5 H to the top, and side 1 faces WindAngle.
   */
  vtkAtriaSetInRangeMacro(DomainSides, int, 3, 48);
  vtkGetMacro(DomainSides, int);
  ///@}

  /**
   * Sets DomainMode to Explicit, and DomainBounds so that the regular polygon of DomainSides, which must be set before,
   * touches the circle around (x, y).
   */
  void SetDomainCylinder(double x, double y, double radius, double bottom, double top);

  ///@{
  /**
   * Corners of a convex polygon, in x and y, that the domain stands on; from 3 to 48. DomainMode then only determines
   * its bottom and top: DomainBounds in z, the surfaces', the site's, or the lowest ground and 5 H above the buildings.
   * Sides are the patches domainSide1 and so on, the first from the first corner, counterclockwise; clockwise corners
   * are reversed. DomainSides is not used, and DomainAngle must be 0. None by default.
   */
  void AddDomainCorner(double x, double y);
  int GetNumberOfDomainCorners();
  void GetDomainCorner(int i, double corner[2]);
  void RemoveAllDomainCorners();
  ///@}

  ///@{
  /**
   * Direction that the wind blows to if DomainMode is Automatic, in degrees from the x axis, counterclockwise seen from
   * above. With x to the east and y to the north, a wind from the meteorological direction D has the angle 270 - D. The
   * side xMin of the domain is the inlet. Default 0, along +x; from -360 to 360.
   */
  vtkAtriaSetInRangeMacro(WindAngle, double, -360.0, 360.0);
  vtkGetMacro(WindAngle, double);
  ///@}

  ///@{
  /**
   * Name of the surface that is the site: the domain's ground if DomainMode is Site, and no building if it is
   * Automatic. Default "Site".
   */
  vtkSetMacro(SiteName, std::string);
  vtkGetMacro(SiteName, std::string);
  ///@}

  ///@{
  /**
   * Pattern of the names of surfaces that are terrain; `*` stands for any characters, `?` for one. Terrain is extended
   * level to the domain's sides, and the domain's bottom is put below it. Default empty: the surface SiteName, if it is
   * not flat.
   */
  vtkSetMacro(TerrainName, std::string);
  vtkGetMacro(TerrainName, std::string);
  ///@}

  ///@{
  /**
   * Largest gap between a body and the ground below it, as a share of the body's height, that is closed by moving the
   * points of its base to the ground. Bases beside lower parts of the model are lowered only if the gap is less than 2
   * m and less than half as high as wide. Not used if DomainMode is Explicit or FromSurfaces. Default 0.25; from 0,
   * which moves nothing, to 1.
   */
  vtkAtriaSetInRangeMacro(GroundSnapRatio, double, 0.0, 1.0);
  vtkGetMacro(GroundSnapRatio, double);
  ///@}

  /**
   * What the grid stands along.
   */
  enum GridAlignments
  {
    ToAxes = 0,  ///< x and y
    ToWalls = 1, ///< the direction most walls have
    ToDomain = 2 ///< the sides of the domain
  };

  ///@{
  /**
   * Direction of the grid. If it is not the direction of the domain's sides, these are meshed like surfaces. Default
   * ToAxes.
   */
  vtkAtriaSetInRangeMacro(AlignGrid, int, ToAxes, ToDomain);
  vtkGetMacro(AlignGrid, int);
  void SetAlignGridToAxes() { this->SetAlignGrid(ToAxes); }
  void SetAlignGridToWalls() { this->SetAlignGrid(ToWalls); }
  void SetAlignGridToDomain() { this->SetAlignGrid(ToDomain); }
  ///@}

  ///@{
  /**
   * Sets the data of an input port, without a pipeline before it.
   */
  void SetInputData(vtkDataObject* data);
  void SetInputData(int port, vtkDataObject* data);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaGridAlgorithm();
  ~vtkAtriaGridAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /**
   * Throws atria::Error that names a property outside its range.
   */
  virtual void CheckProperties();
  /**
   * Returns the outputs with a mesh, of which each rank gets a piece. None by default.
   */
  virtual atria::DealtOutputs GetDealtOutputs() const;
  virtual int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) { return 1; }
  virtual int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) = 0;
  // Does the same on all ranks together, each with its piece of the inputs. Returns nullopt if one rank has to do it.
  virtual std::optional<int> RequestDataOnRanks(vtkMultiProcessController&, vtkInformationVector**,
                                                vtkInformationVector*);
  vtkTypeBool ProcessRequestHere(vtkInformation*, vtkInformationVector**, vtkInformationVector*);

  double SizeMax = 8.0;
  double SizeMid = 2.0;
  double SizeMin = 1.0;
  int StartLevel = 4;
  double FeatureAngle = 30.0;
  std::vector<std::string> SurfaceSizeRules;
  std::vector<std::array<double, 7>> RefinementBoxes;
  std::vector<std::string> DistanceSizeRules;
  double CurvatureAngle = 0.0;
  int CellsAcrossGap = 0;
  int CellsPerLevel = 1;
  int ElementType = HexahedralDominant;
  std::vector<std::string> FaceZones;
  std::vector<std::string> CellZones;
  bool FindOpenings = false;
  std::vector<std::string> SurfacesWithoutOpenings;
  double GapTolerance = -1.0;
  double SmallPartSize = 1.0;
  int MaxElements = 0;
  double MemoryLimit = 0.0;
  int DomainMode = Automatic;
  double DomainBounds[6] = {-50.0, 50.0, -50.0, 50.0, 0.0, 50.0};
  double DomainAngle = 0.0;
  int DomainSides = 4;
  std::vector<std::array<double, 2>> DomainPolygon;
  double WindAngle = 0.0;
  std::string SiteName = "Site";
  std::string TerrainName;
  int AlignGrid = ToAxes;
  double GroundSnapRatio = 0.25;

private:
  /// Completes these sizes and sets them.
  bool FillSizes(double sizeMax, double sizeMid, double sizeMin);

  vtkAtriaGridAlgorithm(const vtkAtriaGridAlgorithm&) = delete;
  void operator=(const vtkAtriaGridAlgorithm&) = delete;
};

#endif
