// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the stages of the improver in the order in which they run: what each aims at, and how it searches.
#pragma once

#include "Layer/FlatLayers.h"
#include "Optimize/Kernel/CurvedWallTargets.h"
#include "Optimize/Kernel/Optimizer.h"

#include <array>
#include <vector>

namespace atria {

/// A cell is bad if its least measure (ShortCell::worst) is below this.
inline constexpr float badBelow = 0.02F;
/// Floor of all other measures while the limit of angles rises.
inline constexpr double otherMeasuresFloor = 0.1;

/// A pass of the optimizer over cells.
struct ImproverStage
{
  OptimizerOptions options;
  float below = 1.0F;    ///< cells take part if their least measure is below this
  bool byChains = false; ///< true to move chains of divided layers as a whole
};

/// Properties of a mesh that targets depend on.
struct MeshTraits
{
  bool layered;         ///< there may be layers somewhere
  bool asked;           ///< a layer is requested somewhere
  bool supported;       ///< layers may be added where elements cannot be valid without
  bool hasHeights;      ///< a height of layers is requested somewhere
  bool divided;         ///< several layers are requested somewhere
  bool hexahedral;      ///< all elements are hexahedra, as where all octants at elements have one size
  bool wraps = false;   ///< layers go round boundary edges (LayerOptions::wraps)
  FlatLayers flat = {}; ///< the best measures of layers with the requested heights

  /// True for single layers whose height is left to the mesh.
  bool isSingle() const { return asked && !hasHeights && !divided; }
};

/// Targets of all elements.
QualityTargets baseTargets(const MeshTraits& traits);

/// 1. First stage: cells that fall short become sound. Under layers of a mesh with several sizes only cells below half
/// of a target take part: the others are good enough, and there are many.
ImproverStage firstStage(const MeshTraits& traits);

/// Cells that fall short of these have too few neighbors, at any places of their points. If no layer is requested, they
/// get one, as do cells that are concave at walls.
QualityTargets targetsOfSupport(const MeshTraits& traits);

/// 2. Mending: bad cells get more room, step by step. The second half of the list is for meshes with turned sides.
enum class RoomStep : std::uint8_t
{
  leaveCurves,   ///< vertices leave curves for the surfaces that meet there
  leaveALittle,  ///< vertices leave surfaces and corners by the small reach
  leaveSurfaces, ///< the same by the large reach
  goHalfway,     ///< the same, and points go half of the way to the centers of their octants
  startAgain,    ///< the same, all of the way, and the layer grows anew
  exclude,       ///< cells lose the layer, or get it back
  leaveSides     ///< vertices of invalid cells leave the sides of a turned domain
};
inline constexpr std::array roomSteps{RoomStep::leaveCurves, RoomStep::leaveALittle,  RoomStep::leaveSurfaces,
                                      RoomStep::goHalfway,   RoomStep::startAgain,    RoomStep::exclude,
                                      RoomStep::leaveSides,  RoomStep::leaveSurfaces, RoomStep::goHalfway,
                                      RoomStep::startAgain,  RoomStep::exclude,       RoomStep::leaveSurfaces};
/// Distances, in octants, that vertices may leave their surfaces by.
inline constexpr double smallReach = 0.2;
inline constexpr double largeReach = 0.75;

/// 3. Vertices that left go back, in at most so many rounds, as far as cells keep this share of `targetsBack`.
inline constexpr int roundsBack = 6;
inline constexpr double leastPutBack = 0.3;
QualityTargets targetsBack(const MeshTraits& traits);

/// 4. Before layers are divided, the outer faces of prisms are flattened: slices are so thin that a bent face leaves
/// them no room. It takes a fifth of the time that it takes afterwards.
ImproverStage flatteningStage(const MeshTraits& traits);

/// 5. Division: divided layers are improved in these passes. Cells that are bad after the last pass lose layers, and
/// the next round begins. Cells that stay bad or beyond the largest angle after straightening lose layers, too.
inline constexpr int mostDivisionRounds = 24;
inline constexpr int mostGivenWay = 6;
std::vector<ImproverStage> divisionStages(const MeshTraits& traits);

/// 6. Curved walls: first all hexahedra at smooth walls that fall short; then, where all walls are smooth, the few
/// cells of any shape that are far from the targets.
QualityTargets targetsAtCurved(const MeshTraits& traits, const CurvedWallTargets& wanted);
ImproverStage curvedStage(const MeshTraits& traits, const CurvedWallTargets& wanted);
/// Stages for these few, with a looser limit first. A cell just above a limit may not fall below it, and hold others
/// back. The last stage takes cells that miss the targets by two degrees.
std::array<ImproverStage, 2> closeStages(const MeshTraits& traits, const CurvedWallTargets& wanted);

/// 7. Straightening: valid cells are brought within the angles that solvers do well with. The limit rises in two
/// stages, as cells far from the last one find no way there at once.
std::vector<ImproverStage> straighteningStages(const MeshTraits& traits);
/// The limit is the largest angle: 60 degrees, 70 with several layers. At faces beyond it vertices leave their surfaces
/// by these distances, in octants.
QualityTargets targetsOfLargestAngle(const MeshTraits& traits);
inline constexpr std::array reachesForAngles{smallReach, largeReach};

/// In meshes of hexahedra only, those that fall short of these targets are improved after that, in so many rounds.
inline constexpr int roundsOfHexahedra = 3;
QualityTargets targetsOfHexahedra();
ImproverStage hexahedraStage(const MeshTraits& traits);

/// 8. Points of layers go to requested heights, as far as cells keep to these targets.
QualityTargets targetsOfHeights(const MeshTraits& traits);

/// 9. Crease sheets begin flat. These stages make them sound; the later ones give more room.
std::vector<ImproverStage> soundCreaseStages(const MeshTraits& traits);
/// Then limits rise in `firstCreaseStages` stages. The others are for meshes that still miss `wantedOfCreaseSheets`.
std::vector<ImproverStage> creaseStages(const MeshTraits& traits);
inline constexpr std::size_t firstCreaseStages = 4;
QualityTargets wantedOfCreaseSheets(const MeshTraits& traits);
/// Widths of crease sheets, as shares of the layer, tried in turn until one reaches these targets.
inline constexpr std::array creaseWidths{0.35, 0.25, 0.45, 0.3, 0.4};

/// Cells that fall short of these in the end fail checkMesh, unless they are merged with others.
QualityTargets targetsOfChecks(const MeshTraits& traits);

/// The strictest targets of all stages: before layers are divided, and from then on.
QualityTargets strictestTargets(const MeshTraits& traits, const CurvedWallTargets* curvedWalls);
QualityTargets strictestOfDivided(const MeshTraits& traits);

} // namespace atria
