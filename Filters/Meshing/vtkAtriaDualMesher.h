// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaDualMesher
 * @brief   conformal hexahedral-dominant mesh of the space about surfaces
 *
 * The mesh is the dual of a 2:1 balanced octree: a vertex in each octant, an element about each grid point. Octants
 * whose edges surfaces cut have their vertex on them, and a face whose octree edge a surface cuts is a piece of that
 * surface, so that open sheets without thickness, T-junctions and closed solids are all the same. The mesh is conformal
 * by construction.
 *
 * Input port 0: surfaces; see vtkAtriaGridAlgorithm. Input port 1 (optional): an octree from vtkAtriaOctreeSource;
 * sizes and domain are then taken from it. A surface that lies on a side of the domain is that side: it refines it and
 * names it.
 *
 * Output port 0: vtkUnstructuredGrid of hexahedra, wedges, pyramids and polyhedra. Cell arrays: `ZoneId` (int; zones
 * are numbered from the largest, those left out included), `Level` (unsigned char, of the finest octant about the
 * element). Field arrays: `MaxLevel`; `PatchName`, `PatchFaceCount` and `PatchFace`, the patches of port 1, which so
 * keep their names where the mesh goes alone. The same input and properties give the same bits, whatever the number of
 * threads.
 *
 * With layers, a layer of elements lies about all walls (surfaces), one prism on each side of every wall, or several on
 * top of each other; prisms are the last elements. They taper to nothing where there is no room. If all octants are of
 * one size, and edges of solids run across the grid, a single layer is in two halves on these solids, with a row of
 * hexahedra along the edges: without it some have an angle of 180 degrees there. It counts as one layer.
 *
 * Output port 1: vtkPartitionedDataSetCollection, one named vtkPolyData a patch. A surface with elements on its front
 * and its back is two patches, `<name>_front` and `<name>_back`; the two sides have points of their own, but at
 * boundary edges. Bare domain sides are `xMin` … `zMax`, of prisms also `domainSide1` …. Cell arrays: `SurfaceId` (int;
 * -1 on bare domain sides), `OwnerCellId` (vtkIdType, cell of port 0), `Side` (int; 0 front, 1 back), `LayerCount`
 * (int) and `LayerThickness` (double): layers at the face. Point array: `VolumePointId` (vtkIdType, point of port 0).
 * Every face is a face of its owner, seen counter-clockwise from outside of the mesh.
 *
 * Output port 2: vtkPolyData with a line or vertex for each place where the mesh could not follow the model, or where
 * one should look: MergedSheets, where an octree edge is cut more than once and the sheets became one (line from the
 * first to the last); UnresolvedFeature, where pieces that do not meet share a vertex; LeakPath, the way by which a
 * sealed seed reaches the outside; ClosedCrack, a gap beside a boundary edge, narrower than an octant, that the mesh
 * closes; OpenCrack, one that stays open; DetachedVertex, a vertex that had to leave the model for elements to be
 * valid, with the way to where it should be; Cluster, a vertex in an octant with more pieces of the model than it can
 * show; LeftOutElement, the middle of an element at a wall or a side of the domain that is not in the mesh, as it could
 * not be made valid. Cell arrays: `Diagnostic` (int, index into the field array `DiagnosticName`), `CellId` (vtkIdType;
 * -1 for a leak that is not in the mesh), `Width` (double, of leaks and cracks; of elements left out, the edge of a
 * cube of their volume). Field array `SurfaceWithoutFaces`: names of surfaces that got no face. Field arrays `Zone...`
 * have an entry for each zone, those left out included, by ZoneId; `Leak...` one for each leak: see docs/arrays.md.
 * Field arrays `LayerSurface`, `LayersAsked`, `LayerArea`, `LayerCoverage`, `LayerFullCoverage`, `LayerThicknessRatio`:
 * what became of layers, an entry for each surface that was to have some. Field array `SizingWarning`: what MaxElements
 * left out, if anything. Field arrays `RepairName` and `RepairValue`: what was changed to make the surfaces sound, and
 * `HiddenDetailSurface` with what of which surfaces is too fine for the mesh; see docs/arrays.md.
 *
 * Elements may still be inverted where the model is finer than the octants: vtkAtriaMeshQuality tells which.
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
    /// Those that reach the top of the domain; if none does, or if surfaces lie on all of its sides but the bottom,
    /// those that reach any side but the bottom; if none does, the bottom.
    Outside = 0,
    All = 1,
    Seeds = 2 ///< those that hold a seed
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
   * Points inside the zones to mesh if ZoneRule is Seeds. SetSeed takes the place of seed `i`, and makes room for it.
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
   * Points in zones that should be closed, such as rooms with their doors shut. They do not choose what is meshed.
   * Where such a zone reaches an open side of the domain other than its bottom, the way there is a LeakPath of output
   * port 2, and the field array `LeakMessage` names its narrowest place and the surfaces beside it.
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
   * Layers of elements along all surfaces. 1, the default, is the conforming layer alone, which lets elements at
   * creases and on sheets be convex; more are made by dividing it, but for details smaller than an octant, as leaves
   * of trees, which have one; 0 gives the plain dual, but for SupportElements. From 0 to 100.
   */
  vtkAtriaSetInRangeMacro(NumberOfLayers, int, 0, 100);
  vtkGetMacro(NumberOfLayers, int);
  ///@}

  ///@{
  /**
   * Whether surfaces for which no layers are asked have one if an element there cannot be valid without, wherever its
   * vertices are: one that is concave at walls, or has too few neighbors. It is on the whole surface; on the domain's
   * bottom beside a site, only at such elements. So have the upright sides of a domain that is turned against the grid,
   * everywhere. Default on.
   */
  vtkSetMacro(SupportElements, bool);
  vtkGetMacro(SupportElements, bool);
  vtkBooleanMacro(SupportElements, bool);
  ///@}

  ///@{
  /**
   * Height of the first layer on the wall; it and all others are less where there is no room. Default 0: all layers
   * together are about a third of the elements beside the wall, and up to half on curved ones; at least 0.
   */
  vtkAtriaSetInRangeMacro(FirstLayerHeight, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(FirstLayerHeight, double);
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
   * NumberOfLayers: 0 for none, which the layers beside them taper to. Height and growth are FirstLayerHeight and
   * LayerGrowth where not given. The last rule that matches holds; where surfaces meet, the least. A bare side of the
   * domain has layers if a rule has its very name, `xMin` … `zMax`. AddLayerRule takes a rule as text, `PATTERN LAYERS
   * [FIRSTHEIGHT [GROWTH]]`, the pattern in double quotes where it holds blanks; GetLayerRule gives it so. A pattern
   * that matches nothing, or a number out of range, is an error of the run. None by default.
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
   * Greatest non-orthogonality, in degrees, and OpenFOAM's skewness that hexahedra at curved walls are to have, away
   * from creases and boundary edges, if they can: those that have more are improved. With 30 and 0.75 the layer of a
   * sphere takes half of the time or less. They count for a single layer without a height. Defaults 20 and 0.5; from 1
   * to 89.9 and [0.01, 1000].
   */
  vtkAtriaSetInRangeMacro(TargetNonOrthogonality, double, 1.0, 89.9);
  vtkGetMacro(TargetNonOrthogonality, double);
  vtkAtriaSetInRangeMacro(TargetSkewness, double, 0.01, 1000.0);
  vtkGetMacro(TargetSkewness, double);
  ///@}

  ///@{
  /**
   * Gaps beside free edges of the surfaces that are no wider than this part of the octants there are closed, and listed
   * as ClosedCrack on output port 2. Wider ones, and windows and doors with them, are open where an edge of the grid
   * passes. 0 leaves all as the grid has them. In [0, 0.9]; default 0.5.
   */
  vtkAtriaSetInRangeMacro(CrackTolerance, double, 0.0, 0.9);
  vtkGetMacro(CrackTolerance, double);
  ///@}

  ///@{
  /**
   * Whether stages before layers are kept for the next run, which takes those whose input and properties are the same:
   * after a change of layers all of them, after one of zones or seeds those up to crossings. The mesh is the same in
   * any case. They take 150 to 200 bytes an element; off frees them at once. Default on.
   */
  void SetCacheStages(bool cache);
  vtkGetMacro(CacheStages, bool);
  vtkBooleanMacro(CacheStages, bool);
  ///@}

  ///@{
  /**
   * On several MPI ranks, whether each gets a piece of the mesh, with a ring of ghost cells, and of each patch the
   * faces whose owners are its own; else the first one has it all and the others nothing. `OwnerCellId`,
   * `VolumePointId` and the field arrays keep the numbers of the whole mesh, which are the global ids of cells and
   * points. Default on.
   */
  vtkSetMacro(DistributeOutput, bool);
  vtkGetMacro(DistributeOutput, bool);
  vtkBooleanMacro(DistributeOutput, bool);
  ///@}

  ///@{
  /**
   * How many octants a block has at most, where the mesh is improved in blocks; 0 improves it as a whole. Several MPI
   * ranks then make the mesh together, each its blocks from the octree on: no rank holds the whole, which may be larger
   * than the memory of one, unless DistributeOutput is off. The mesh is the same for any number of ranks and threads,
   * and a little different from that of other block sizes; 20,000 to 100,000 are good. One rank may take twice as long
   * with blocks. The first rank alone makes, as a whole, what has leaks of sealed seeds, fewer blocks than there are
   * ranks, or the octree of port 1; and, with a warning, a mesh of which ranks find something else where their parts
   * meet. Not negative; default 0.
   */
  vtkAtriaSetInRangeMacro(BlockSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(BlockSize, int);
  ///@}

  ///@{
  /**
   * Name and wall time, in seconds, of the stages of the last run that came to its end, but for those that it took from
   * the run before. They are not in the output, which does not differ from run to run. An index out of range gives an
   * empty name and 0.
   */
  int GetNumberOfStages();
  std::string GetStageName(int i);
  double GetStageSeconds(int i);
  ///@}

  /**
   * About how many elements the layers on walls add to those that vtkAtriaOctreeSource::Estimate tells, all zones
   * counted; there are more where sheets have layers on both sides. Brings the input up to date and builds the octree,
   * but no mesh. Negative where that is aborted or, with an error, fails.
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
