// SPDX-License-Identifier: GPL-3.0-or-later
/// What the stages of the improver aim at and how they go there, in the order in which they run.
#pragma once

#include "Layer/FlatLayers.h"
#include "Optimize/Kernel/CurvedWallTargets.h"
#include "Optimize/Kernel/Optimizer.h"

#include <array>
#include <vector>

namespace atria {

/// Cells below this share of a target are no better than not valid.
inline constexpr float soundEnough = 0.02F;
/// What no cell falls below by other measures for the good of angles, where the limit of these rises.
inline constexpr double leastOfOthers = 0.1;

/// A pass of the optimizer over the cells whose least measure is below `below`.
struct ImproverStage
{
  OptimizerOptions options;
  float below = 1.0F;
  bool byChains = false; ///< whether chains of divided layers move as a whole
};

/// What a mesh is like, as far as targets depend on it.
struct MeshTraits
{
  bool layered;         ///< whether there may be layers somewhere
  bool asked;           ///< whether a layer is asked for somewhere
  bool supported;       ///< whether layers are somewhere only where elements cannot be valid without
  bool hasHeights;      ///< whether a height of layers is asked for somewhere
  bool divided;         ///< whether several layers are asked for somewhere
  bool uniform;         ///< whether all octants at elements are of one size, so that these are hexahedra
  FlatLayers flat = {}; ///< what layers of given heights have at best

  /// Single layers of a height left to the mesh.
  bool isSingle() const { return asked && !hasHeights && !divided; }
};

/// What all elements are to be.
QualityTargets baseTargets(const MeshTraits& traits);

/// 1. All that falls short becomes sound. Under layers of a mesh with several sizes those that are clearly short do:
/// the others are good enough, and there are many.
ImproverStage firstStage(const MeshTraits& traits);

/// Where no layers are asked for, elements that fall short of these have one too few neighbors wherever their points
/// are: they get a layer, as those do that are concave at walls. Some more do once points have moved.
QualityTargets targetsOfSupport(const MeshTraits& traits);

/// 2. What stays bad gets more room, step by step.
enum class RoomStep : std::uint8_t
{
  leaveCurves,
  leaveALittle,
  leaveSurfaces,
  goHalfway,
  startAgain,
  exclude,
  leaveSides ///< the sides of a turned domain: before, vertices stay in their planes
};
inline constexpr std::array roomSteps{RoomStep::leaveCurves, RoomStep::leaveALittle,  RoomStep::leaveSurfaces,
                                      RoomStep::goHalfway,   RoomStep::startAgain,    RoomStep::exclude,
                                      RoomStep::leaveSides,  RoomStep::leaveSurfaces, RoomStep::goHalfway,
                                      RoomStep::startAgain,  RoomStep::exclude,       RoomStep::leaveSurfaces};
/// How far, in octants, vertices leave their surfaces by `leaveALittle` and by `leaveSurfaces`.
inline constexpr double aLittle = 0.2;
inline constexpr double anOctant = 0.75;

/// 3. Those that left go back, in so many rounds, as far as elements keep this share of the targets.
inline constexpr int roundsBack = 6;
inline constexpr double leastPutBack = 0.3;
QualityTargets targetsBack(const MeshTraits& traits);

/// 4. Before layers are divided, the copies about each face are brought nearer to a plane: slices are so thin that half
/// of a bent face would leave them no room, and it takes a fifth of the time to do it at once.
ImproverStage flatteningStage(const MeshTraits& traits);

/// 5. Divided layers are improved in passes, as many rounds as these; cells that are bad after the last pass of a round
/// lose layers. It is enough that they are sound: there are many. Those that stay bad or beyond the largest angle once
/// all are straightened lose layers, too, and what is about them is improved again, so often.
inline constexpr int mostDivisionRounds = 24;
inline constexpr int mostGivenWay = 6;
std::vector<ImproverStage> divisionStages(const MeshTraits& traits);

/// 6. At curved walls, hexahedra are brought to what is asked for: all at smooth walls that fall short, but not for
/// long; then in stages the few elements of any shape that are far from it, where all walls are smooth.
QualityTargets targetsAtCurved(const MeshTraits& traits, const CurvedWallTargets& wanted);
ImproverStage curvedStage(const MeshTraits& traits, const CurvedWallTargets& wanted);
/// By the last one cells are moved that have two degrees less than what is asked for. What is just at a limit is hard
/// to move on, as what is above may not fall below: so it is first a lower one, in turn as long as that wins a good
/// part.
std::array<ImproverStage, 2> closeStages(const MeshTraits& traits, const CurvedWallTargets& wanted);

/// 7. What is valid is brought within the angles that solvers do well with. The limit rises in two stages: held to the
/// last one at once, cells that are far from it find no way there.
std::vector<ImproverStage> straighteningStages(const MeshTraits& traits);
/// Where faces stay beyond the largest angle, below its limit, vertices leave their surfaces by so many octants.
QualityTargets targetsOfLargestAngle(const MeshTraits& traits);
inline constexpr std::array reachesForAngles{aLittle, anOctant};

/// 8. Points of layers go back to heights that were asked for, as far as elements keep to these.
QualityTargets targetsOfHeights(const MeshTraits& traits);

/// 9. Crease sheets begin flat; what does not come right at once gets more room. Then limits rise, as cells far from
/// the last ones find no way there. The stages after the first few are for what is still short of
/// `wantedOfCreaseSheets`.
std::vector<ImproverStage> soundCreaseStages(const MeshTraits& traits);
std::vector<ImproverStage> creaseStages(const MeshTraits& traits);
inline constexpr std::size_t firstCreaseStages = 4;
QualityTargets wantedOfCreaseSheets(const MeshTraits& traits);
/// Widths of crease sheets, tried in turn until one comes to what is wanted.
inline constexpr std::array creaseWidths{0.35, 0.25, 0.45, 0.3, 0.4};

/// What falls short of these in the end checkMesh objects to by its own limits, unless it is made one with others.
QualityTargets targetsOfChecks(const MeshTraits& traits);

/// What no stage from here on asks more than: before layers are divided, and after.
QualityTargets strictestTargets(const MeshTraits& traits, const CurvedWallTargets* curvedWalls);
QualityTargets strictestOfDivided(const MeshTraits& traits);

} // namespace atria
