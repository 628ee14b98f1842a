// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that makes a conformal hexahedral-dominant mesh of the space around surfaces.
/**
 * @class   vtkAtriaDualMesher
 * @brief   conformal hexahedral-dominant mesh of the space around surfaces
 *
 * Meshes the air around, inside and between surfaces. These may be open sheets without thickness, sheets that meet or
 * cross, and closed solids, in any mixture. The model need not be watertight.
 *
 * The mesh is the dual of a 2:1 balanced octree: it has a vertex in each octant and an element around each grid point.
 * An octant whose edges are cut by surfaces has its vertex on these surfaces. A face whose octree edge is cut by a
 * surface belongs to that surface. The mesh is therefore conformal and has no hanging nodes.
 *
 * @par Input ports
 * - 0: surfaces, as vtkPolyData; see vtkAtriaGridAlgorithm. A surface that lies on a side of the domain becomes that
 *   side.
 * - 1, optional: an octree from vtkAtriaOctreeSource. Sizes and domain are then taken from it.
 *
 * @par Output port 0: the mesh
 * A vtkUnstructuredGrid of hexahedra, wedges, pyramids and polyhedra.
 * - Cell arrays: `ZoneId` (int; zones are numbered from the largest, omitted ones included) and `Level` (unsigned char,
 *   level of the finest octant around the element).
 * - Field arrays: `MaxLevel`; `PatchName`, `PatchFaceCount` and `PatchFace`, which record the patches of port 1, so
 * that a writer finds their names if the mesh is passed on alone.
 *
 * @par Output port 1: the patches
 * A vtkPartitionedDataSetCollection with one named vtkPolyData per patch. A surface with elements on its front and its
 * back is two patches, `<name>_front` and `<name>_back`, with points of their own except at boundary edges. Sides of
 * the domain without a surface are `xMin` … `zMax`, those of prisms `domainSide1` …. Every face is a face of its owner,
 * counter-clockwise seen from outside the mesh.
 * - Cell arrays: `SurfaceId` (int; -1 on sides of the domain without a surface), `OwnerCellId` (vtkIdType, cell of
 *   port 0), `Side` (int; 0 front, 1 back), `LayerCount` (int, layers at the face) and `LayerThickness` (double, of all
 *   of them).
 * - Point array: `VolumePointId` (vtkIdType, point of port 0).
 *
 * @par Output port 2: diagnostics
 * A vtkPolyData with a vertex or line for each place where the mesh could not follow the model, or where one should
 * look. The cell array `Diagnostic` (int) is the index of its kind in the field array `DiagnosticName`:
 * - `MergedSheets`: surfaces cut an octree edge more than once, and became one there. The line goes from the first to
 *   the last.
 * - `UnresolvedFeature`: parts of the model that do not meet share a vertex.
 * - `LeakPath`: the way from a sealed seed to the outside.
 * - `ClosedCrack`, `OpenCrack`: a gap beside a boundary edge, narrower than an octant, that the mesh closes or leaves
 *   open.
 * - `DetachedVertex`: a vertex that had to leave the model for elements to be valid. The line goes to its place there.
 * - `Cluster`: a vertex in an octant with more parts of the model than it can represent.
 * - `LeftOutElement`: the middle of an element that is not in the mesh because it could not be made valid.
 *
 * The other cell arrays are `CellId` (vtkIdType; -1 for a leak outside of the mesh) and `Width` (double, of leaks and
 * cracks; for elements left out, the edge of a cube of their volume). Field arrays hold results by surface, zone, room,
 * opening and leak, the audit of the mesh against the model, repairs and warnings. docs/arrays.md lists them.
 *
 * @par Layers
 * All surfaces get a layer of elements on each side, or several on top of each other (NumberOfLayers, layer rules).
 * Their elements come last in the mesh. Layers taper to nothing where there is no room. If all octants have one size
 * and edges of solids run across the grid, a single layer is in two halves on these solids, with a row of hexahedra
 * along the edges, and counts as one.
 *
 * @par Threads and ranks
 * The same input and properties give the same bits for any number of threads. With a BlockSize, MPI ranks make the mesh
 * together, again with the same bits. Without, the first rank makes it and deals it out.
 *
 * @warning
 * Elements may be inverted where the model is finer than the octants. vtkAtriaMeshQuality finds and counts them.
 *
 * @warning
 * Single-precision coordinates far from the origin lose centimeters. Readers can move the model (Recenter).
 *
 * @par References
 * - T. Ju, F. Losasso, S. Schaefer and J. Warren, Dual contouring of Hermite data, ACM Trans. Graphics 21 (2002).
 * - S. Schaefer and J. Warren, Dual marching cubes: primal contouring of dual grids, Pacific Graphics (2004).
 *
 * docs/algorithm.md describes the method.
 *
 * @sa
 * vtkAtriaOctreeSource vtkAtriaPreflight vtkAtriaMeshQuality vtkAtriaMeshOptimizer vtkAtriaOpenFOAMWriter
 */
#ifndef vtkAtriaDualMesher_h
#define vtkAtriaDualMesher_h

#include "vtkAtriaGridAlgorithm.h"

#include <array>   // for seeds
#include <memory>  // for the cache
#include <string>  // for stages
#include <utility> // for stages
#include <vector>  // for seeds

namespace atria {
class StageCache;
}

class ATRIAFILTERSMESHING_EXPORT vtkAtriaDualMesher : public vtkAtriaGridAlgorithm
{
public:
  static vtkAtriaDualMesher* New();
  vtkTypeMacro(vtkAtriaDualMesher, vtkAtriaGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Which zones are meshed.
   */
  enum ZoneRules
  {
    /// Zones that reach the top of the domain. If none does, or if surfaces lie on all sides except the bottom: zones
    /// that reach any side except the bottom; if none does, zones that reach the bottom.
    Outside = 0,
    All = 1,
    Seeds = 2 ///< zones that hold a seed
  };

  ///@{
  /**
   * Which zones are meshed. A zone is a part of the space that surfaces separate from the rest: outdoors with the rooms
   * that are open to it, a closed room, the inside of a solid. Default Outside.
   */
  vtkAtriaSetInRangeMacro(ZoneRule, int, Outside, Seeds);
  vtkGetMacro(ZoneRule, int);
  void SetZoneRuleToOutside() { this->SetZoneRule(Outside); }
  void SetZoneRuleToAll() { this->SetZoneRule(All); }
  void SetZoneRuleToSeeds() { this->SetZoneRule(Seeds); }
  ///@}

  ///@{
  /**
   * Points inside the zones to mesh if ZoneRule is Seeds. SetSeed replaces seed `i`, and makes room for it.
   */
  void AddSeed(double x, double y, double z);
  void SetSeed(int i, double x, double y, double z);
  void SetNumberOfSeeds(int count);
  int GetNumberOfSeeds();
  void GetSeed(int i, double seed[3]);
  void RemoveAllSeeds();
  ///@}

  ///@{
  /**
   * Points in zones that should be closed, such as rooms with their doors shut. They do not select zones to mesh. If
   * such a zone reaches an open side of the domain other than its bottom, the path there is a LeakPath of output port
   * 2, and the field array `LeakMessage` names its narrowest place and the surfaces beside it.
   */
  void AddSealedSeed(double x, double y, double z);
  void SetSealedSeed(int i, double x, double y, double z);
  void SetNumberOfSealedSeeds(int count);
  int GetNumberOfSealedSeeds();
  void GetSealedSeed(int i, double seed[3]);
  void RemoveAllSealedSeeds();
  ///@}

  ///@{
  /**
   * Layers of elements along all surfaces. 1, the default, is the conforming layer alone, which allows convex elements
   * at creases and on sheets. More layers are made by dividing it; details smaller than an octant, such as leaves of
   * trees, have one layer in any case. 0 gives the plain dual, except for SupportElements. From 0 to 100.
   */
  vtkAtriaSetInRangeMacro(NumberOfLayers, int, 0, 100);
  vtkGetMacro(NumberOfLayers, int);
  ///@}

  ///@{
  /**
   * If on, surfaces without requested layers get one if an element there cannot be valid without it, wherever its
   * vertices are: it is concave at walls or has too few neighbors. The layer ends two faces beside such elements. The
   * upright sides of a domain that is turned against the grid get one everywhere. Default on.
   */
  vtkSetMacro(SupportElements, bool);
  vtkGetMacro(SupportElements, bool);
  vtkBooleanMacro(SupportElements, bool);
  ///@}

  ///@{
  /**
   * Height of the first layer on the wall, in model units. It is kept where elements stay sound; growth gives way
   * before it does, between 1 and 2. Default 0: all layers together are about a third as high as the elements beside
   * the wall, and up to half as high on curved walls. At least 0.
   */
  vtkAtriaSetInRangeMacro(FirstLayerHeight, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(FirstLayerHeight, double);
  ///@}

  ///@{
  /**
   * Returns the height of the first layer, in meters, whose middle is `yPlus` viscous lengths off the wall, and the
   * reverse. `speed` is that of the air that passes the wall, in m/s; a twentieth of it is taken as the friction
   * velocity. NaN if a number is not above 0.
   */
  static double ComputeFirstLayerHeight(double yPlus, double speed);
  static double ComputeYPlus(double firstLayerHeight, double speed);
  ///@}

  ///@{
  /**
   * Height of each further layer relative to the one below it. Default 1.2; from 0.5 to 5.
   */
  vtkAtriaSetInRangeMacro(LayerGrowth, double, 0.5, 5.0);
  vtkGetMacro(LayerGrowth, double);
  ///@}

  ///@{
  /**
   * Layers on the surfaces whose name matches `pattern` (`*` any text, `?` any one character) in place of
   * NumberOfLayers. Height and growth are FirstLayerHeight and LayerGrowth unless given. The last rule that matches
   * holds. A bare side of the domain has layers if a rule has exactly its name, `xMin` … `zMax`. Layers run up to
   * surfaces that have fewer or none, and taper on these within a row of elements. Without SupportElements they taper
   * before surfaces that have none.
   *
   * AddLayerRule takes a rule as text, `PATTERN LAYERS [FIRSTHEIGHT [GROWTH]]`, the pattern in double quotes if it
   * holds blanks; GetLayerRule returns this form. With a first height, LAYERS or GROWTH may be `auto`: as many layers,
   * or the growth from 1 to 2, at which the next layer would be as high as what is left of the elements beside them. A
   * pattern that matches nothing, or a number out of range, is an error of the run. None by default.
   */
  void AddLayerRule(const std::string& pattern, int layers);
  void AddLayerRule(const std::string& pattern, int layers, double firstHeight, double growth);
  void AddLayerRule(const char* rule);
  int GetNumberOfLayerRules();
  std::string GetLayerRule(int i);
  void RemoveAllLayerRules();
  ///@}

  ///@{
  /**
   * Target maximum of the non-orthogonality, in degrees, and of OpenFOAM's skewness for hexahedra at curved walls, away
   * from creases and boundary edges: elements above it are improved if possible. With 30 and 0.75 the layer of a sphere
   * takes half of the time or less. They apply to a single layer without a height. Defaults 20 and 0.5; from 1 to 89.9
   * and [0.01, 1000].
   */
  vtkAtriaSetInRangeMacro(TargetNonOrthogonality, double, 1.0, 89.9);
  vtkGetMacro(TargetNonOrthogonality, double);
  vtkAtriaSetInRangeMacro(TargetSkewness, double, 0.01, 1000.0);
  vtkGetMacro(TargetSkewness, double);
  ///@}

  ///@{
  /**
   * Gaps beside free edges of the surfaces are closed if they are no wider than this share of the octants there, and
   * listed as ClosedCrack on output port 2. Wider gaps, including windows and doors, are open where an edge of the grid
   * passes. 0 leaves all gaps as the grid has them. In [0, 0.9]; default 0.5.
   */
  vtkAtriaSetInRangeMacro(CrackTolerance, double, 0.0, 0.9);
  vtkGetMacro(CrackTolerance, double);
  ///@}

  ///@{
  /**
   * If on, stages before layers are kept for the next run, which reuses stages with the same input and properties:
   * after a change of layers all of them, after a change of zones or seeds the stages up to crossings. The mesh is the
   * same in any case. Stages take 150 to 200 bytes per element; off frees them at once. Default on.
   */
  void SetCacheStages(bool cache);
  vtkGetMacro(CacheStages, bool);
  vtkBooleanMacro(CacheStages, bool);
  ///@}

  ///@{
  /**
   * If on, each of several MPI ranks gets a piece of the mesh, with a ring of ghost cells, and the faces of each patch
   * whose owners are its own cells. If off, the first rank has everything and the others nothing. `OwnerCellId`,
   * `VolumePointId` and the field arrays keep the numbers of the whole mesh, which are the global ids of cells and
   * points. Default on.
   */
  vtkSetMacro(DistributeOutput, bool);
  vtkGetMacro(DistributeOutput, bool);
  vtkBooleanMacro(DistributeOutput, bool);
  ///@}

  ///@{
  /**
   * Largest number of octants in a block if the mesh is improved in blocks; 0 improves it as a whole. With blocks,
   * several MPI ranks make the mesh together, each its blocks from the octree on. Unless DistributeOutput is off, no
   * rank holds the whole mesh, which may be larger than the memory of one. The mesh is the same for any number of ranks
   * and threads, and slightly different for other block sizes; 20,000 to 100,000 are good values. One rank may take
   * twice as long with blocks. The first rank alone makes the whole mesh if sealed seeds leak, if there are fewer
   * blocks than ranks, or if port 1 has an octree; and, with a warning, if ranks disagree where their parts meet. Not
   * negative; default 0.
   */
  vtkAtriaSetInRangeMacro(BlockSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(BlockSize, int);
  ///@}

  ///@{
  /**
   * Name and wall time, in seconds, of the stages of the last completed run, except stages reused from the run before.
   * They are not in the output, which does not differ from run to run. An index out of range gives an empty name and 0.
   */
  int GetNumberOfStages();
  std::string GetStageName(int i);
  double GetStageSeconds(int i);
  ///@}

  /**
   * Returns the approximate number of elements that layers on walls add to those of vtkAtriaOctreeSource::Estimate,
   * over all zones; there are more where sheets have layers on both sides. Updates the input and builds the octree, but
   * no mesh. Negative if this is aborted or, with an error, fails.
   */
  vtkIdType EstimateLayerElements();

protected:
  vtkAtriaDualMesher();
  ~vtkAtriaDualMesher() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void CheckProperties() override;
  atria::DealtOutputs GetDealtOutputs() const override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  std::optional<int> RequestDataOnRanks(vtkMultiProcessController&, vtkInformationVector**,
                                        vtkInformationVector*) override;

  int ZoneRule = Outside;
  int NumberOfLayers = 1;
  bool SupportElements = true;
  double FirstLayerHeight = 0.0;
  double LayerGrowth = 1.2;
  std::vector<std::string> LayerRules;
  double TargetNonOrthogonality;
  double TargetSkewness;
  double CrackTolerance;
  std::vector<std::array<double, 3>> SeedPoints;
  std::vector<std::array<double, 3>> SealedSeedPoints;
  std::vector<std::pair<std::string, double>> Stages;
  bool CacheStages = true;
  bool DistributeOutput = true;
  int BlockSize = 0;

private:
  std::unique_ptr<atria::StageCache> Cache;
  vtkAtriaDualMesher(const vtkAtriaDualMesher&) = delete;
  void operator=(const vtkAtriaDualMesher&) = delete;
};

#endif
