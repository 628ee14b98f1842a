// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ImproverStages.h"

#include "Quality/Checks/CheckLimits.h"
#include "Support/Angles.h"

#include <cmath>

namespace atria {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cells below this share of the way to a target take part in coarse stages, and those below the second in later passes
/// over divided layers.
constexpr float coarseBelow = 0.5F;
constexpr float poorBelow = 0.3F;
/// Scaled Jacobian that hexahedra of a uniform mesh should have, and the least at curved walls while angles improve.
constexpr double goodJacobian = 0.6;
constexpr double leastCurvedJacobian = 0.5;
/// Cosine of 65 degrees, the largest non-orthogonality by which vertices go back: solvers need corrections beyond it.
constexpr double leastFaceCosine = 0.4226;
/// Corner volumes before layers are divided; 0.02 is enough for one layer.
constexpr double volumeToDivide = 0.15;
/// Share of the way to targets that divided layers aim at.
constexpr double soundShare = 0.6;
/// Slack of the first limits at curved walls, degrees and skewness; aims are better by as much.
constexpr CurvedWallTargets closeMargin{4.0, 0.1};
/// Limit of pyramid cosines while angles improve, a cell squish of 0.93: cells come below 0.9 then.
constexpr double leastPyramidCosine = 0.07;
/// Cosines of the largest non-orthogonality, 60 and 70 degrees, and of what is aimed at, 56.6 and 60 degrees.
constexpr QualityRange largestAngle{0.5, 0.55};
constexpr QualityRange largestAngleOfDivided{0.342, 0.5};
/// How far the last limit is inside the largest angle.
constexpr double angleMargin = 0.01;

/// Range of scaled Jacobians of meshes that have hexahedra only.
constexpr double leastOfHexahedra = 0.3;
constexpr double goodOfHexahedra = 0.5;
/// Scaled Jacobian of crease sheets. At a corner of three surfaces at right angles the most is 0.41.
constexpr QualityRange creaseJacobian{0.3, 0.31};
/// Cosine of their non-orthogonality: 60 degrees.
constexpr QualityRange creaseFaceCosine{0.5, 0.51};
/// The first limits are so far below these, each next one half of that. Aims are beyond them by `leastBeyond` at least.
constexpr double farthestBelow = 0.2;
constexpr double leastBeyond = 0.03;
/// Scaled Jacobian that the first stages of crease sheets aim at.
constexpr double goodCreaseJacobian = 0.45;

/// Returns the cosine; clamps negative angles to 0.
double cosineOf(double degrees) { return cosOfDegrees(std::max(degrees, 0.0)); }

/// Penalty of a measure within a tenth of its target.
constexpr double coarsePenalty = 0.01;
/// The same where all cells are near their targets.
constexpr double finePenalty = 0.001;
/// Least gain of a move, as a share of the penalty, where there are many cells to improve.
constexpr double coarseGain = 0.02;

/// Returns options for many cells: points take large steps, and do not creep.
OptimizerOptions coarse(double leastGain = coarseGain)
{
  OptimizerOptions options;
  options.leastPenalty = coarsePenalty;
  options.leastGain = leastGain;
  options.firstReach = 0.2;
  return options;
}

/// Returns options for few cells that are hard to improve.
OptimizerOptions thorough()
{
  OptimizerOptions options;
  options.patient = true;
  options.firstReach = 0.3;
  options.tries = 4;
  options.leastChange = 0.05;
  return options;
}

/// Targets and limits of layers with requested heights, as shares of their measures on flat walls. Elements of the next
/// size have half of the weights and volume ratios.
constexpr double flatTarget = 0.9;
constexpr double flatLimit = 0.8;
constexpr double flatLimitOfSizes = 0.4;

/// Lowers targets to what flat layers have.
void keepWithin(const FlatLayers& flat, QualityTargets& targets)
{
  const auto keep = [](QualityRange& range, double most, double limit = flatLimit) {
    range.target = std::min(range.target, flatTarget * most);
    range.limit = range.limit < range.target ? range.limit : limit * most;
  };
  keep(targets.convexity, flat.convexity);
  keep(targets.weight, flat.weight, flatLimitOfSizes);
  keep(targets.volumeRatio, flat.volumeRatio, flatLimitOfSizes);
  keep(targets.cornerVolume, flat.cornerVolume);
  keep(targets.determinantRoot, flat.determinantRoot);
}

/// Range that every measure is within.
constexpr QualityRange anything{0.0, 0.0};

/// Makes targets that cells meet by all measures but the determinant and the scaled Jacobian.
void takeAnyShape(QualityTargets& targets)
{
  targets.pyramidCosine = targets.faceCosine = targets.skewness = targets.weight = targets.volumeRatio = anything;
  targets.cornerVolume = targets.boundaryShape = targets.convexity = anything;
}

QualityRange largestAngleOf(const MeshTraits& traits) { return traits.divided ? largestAngleOfDivided : largestAngle; }

/// Returns the last limit of angles, and what is aimed at.
QualityRange lastAngles(const MeshTraits& traits)
{
  const QualityRange largest = largestAngleOf(traits);
  return {largest.limit + angleMargin, largest.target};
}

ImproverStage straighteningStage(const MeshTraits& traits, const QualityRange& faceCosine, bool byChains = false)
{
  ImproverStage stage;
  stage.below = traits.divided ? poorBelow : coarseBelow;
  stage.byChains = byChains;
  stage.options.leastWorst = otherMeasuresFloor;
  stage.options.patient = true;
  stage.options.leastPenalty = 0.1; // the cells miss their targets by more
  QualityTargets& targets = stage.options.targets;
  targets = baseTargets(traits);
  targets.pyramidCosine.limit = leastPyramidCosine;
  targets = traits.divided ? targets.within(soundShare) : targets;
  targets.faceCosine = faceCosine;
  targets.leastOfFaceCosine = otherMeasuresFloor;
  return stage;
}

/// Returns options at curved walls.
OptimizerOptions atCurved()
{
  OptimizerOptions options;
  options.rings = 1;
  options.leastPenalty = finePenalty;
  options.leastGain = coarseGain;
  options.leastWorst = otherMeasuresFloor;
  return options;
}

/// Returns a stage whose limits are worse than what is wanted by a share of `closeMargin`.
ImproverStage closeStage(const MeshTraits& traits, const CurvedWallTargets& wanted, double share)
{
  const auto cosineAt = [&](double part) {
    return cosineOf(wanted.nonOrthogonality + part * closeMargin.nonOrthogonality);
  };
  const auto skewnessAt = [&](double part) { return std::max(wanted.skewness + part * closeMargin.skewness, 0.0); };
  ImproverStage stage{atCurved(), coarseBelow};
  stage.options.patient = true;
  QualityTargets& targets = stage.options.targets;
  targets = baseTargets(traits);
  targets.faceCosine = {std::max(targets.faceCosine.limit, cosineAt(share)),
                        std::max(targets.faceCosine.target, cosineAt(-1.0))};
  targets.skewness = {std::min(targets.skewness.limit, skewnessAt(share)),
                      std::min(targets.skewness.target, skewnessAt(-1.0))};
  targets.jacobianLimit = std::min(leastCurvedJacobian, targets.scaledJacobian);
  targets.leastOfFaceCosine = targets.leastOfSkewness = otherMeasuresFloor;
  return stage;
}

QualityTargets targetsOfCreases(const MeshTraits& traits, const QualityRange& jacobian, const QualityRange& faceCosine)
{
  QualityTargets out = baseTargets(traits);
  out.jacobianLimit = jacobian.limit;
  out.scaledJacobian = jacobian.target;
  out.leastOfJacobian = -infinity;
  out.faceCosine = faceCosine;
  return out;
}

} // namespace

QualityTargets baseTargets(const MeshTraits& traits)
{
  QualityTargets targets;
  targets.convex = traits.layered;
  if (traits.layered && traits.hexahedral)
  {
    targets.scaledJacobian = goodJacobian;
    targets.leastOfJacobian = leastPutBack;
  }
  if (!traits.layered)
  {
    targets.leastOfDeterminant = infinity;
  }
  keepWithin(traits.flat, targets);
  return targets;
}

ImproverStage firstStage(const MeshTraits& traits)
{
  // Short steps keep more vertices on the model where no layer gives way to them, and make better hexahedra in uniform
  // meshes.
  ImproverStage stage;
  if (traits.layered && !traits.hexahedral)
  {
    stage = {coarse(0.05), coarseBelow};
  }
  stage.options.leastPenalty = coarsePenalty;
  stage.options.targets = baseTargets(traits);
  return stage;
}

QualityTargets targetsOfSupport(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  takeAnyShape(targets);
  return targets;
}

QualityTargets targetsBack(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  QualityRange& cosine = targets.faceCosine;
  cosine.limit = (leastFaceCosine - leastPutBack * cosine.target) / (1.0 - leastPutBack);
  return targets;
}

ImproverStage flatteningStage(const MeshTraits& traits)
{
  ImproverStage stage{coarse(), coarseBelow};
  stage.options.targets = baseTargets(traits);
  stage.options.targets.cornerVolume.target = std::min(volumeToDivide, flatTarget * traits.flat.cornerVolumeOfAll);
  stage.options.leastWorst = otherMeasuresFloor;
  stage.options.sweeps = 10;
  return stage;
}

std::vector<ImproverStage> divisionStages(const MeshTraits& traits)
{
  const auto stage = [&](float below, int sweeps, bool byChains) {
    ImproverStage out{coarse(), below, byChains};
    out.options.targets = baseTargets(traits).within(soundShare);
    out.options.sweeps = sweeps;
    return out;
  };
  // Chains first: that brings most cells to their targets with few moves.
  return {stage(coarseBelow, 10, true), stage(poorBelow, 12, false), stage(badBelow, 20, false)};
}

QualityTargets targetsAtCurved(const MeshTraits& traits, const CurvedWallTargets& wanted)
{
  QualityTargets targets = baseTargets(traits);
  targets.faceCosine.target = std::max(targets.faceCosine.target, cosineOf(wanted.nonOrthogonality));
  targets.skewness.target = std::min(targets.skewness.target, wanted.skewness);
  return targets;
}

ImproverStage curvedStage(const MeshTraits& traits, const CurvedWallTargets& wanted)
{
  ImproverStage stage{atCurved()};
  stage.options.targets = targetsAtCurved(traits, wanted);
  return stage;
}

std::array<ImproverStage, 2> closeStages(const MeshTraits& traits, const CurvedWallTargets& wanted)
{
  return {closeStage(traits, wanted, 1.0), closeStage(traits, wanted, 0.0)};
}

std::vector<ImproverStage> straighteningStages(const MeshTraits& traits)
{
  const QualityRange last = lastAngles(traits);
  if (!traits.divided)
  {
    // From 72.5 degrees: cells far from the last limit find no way there at once.
    return {straighteningStage(traits, {0.3, last.target}), straighteningStage(traits, last)};
  }
  // From 78.5 degrees; a limit as high as with one layer would take long.
  constexpr QualityRange first{0.2, 0.4};
  return {straighteningStage(traits, first, true), straighteningStage(traits, first),
          straighteningStage(traits, last, true), straighteningStage(traits, last)};
}

QualityTargets targetsOfHeights(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  targets.faceCosine = lastAngles(traits);
  return targets;
}

QualityTargets targetsOfLargestAngle(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  targets.faceCosine = largestAngleOf(traits);
  return targets;
}

QualityTargets targetsOfChecks(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  targets.pyramidCosine.limit = targets.faceCosine.limit = 0.0;
  targets.convexity.limit = checkLimits::concaveSine;
  targets.skewness.limit = checkLimits::skewness;
  targets.weight.limit = std::min(targets.weight.limit, checkLimits::faceWeight);
  targets.volumeRatio.limit = std::min(targets.volumeRatio.limit, checkLimits::volumeRatio);
  targets.determinantRoot.limit =
      std::min(targets.determinantRoot.limit, std::sqrt(std::sqrt(checkLimits::determinant)));
  return targets;
}

QualityTargets targetsOfHexahedra()
{
  QualityTargets targets;
  takeAnyShape(targets);
  targets.determinantRoot = anything;
  targets.scaledJacobian = goodOfHexahedra;
  return targets;
}

ImproverStage hexahedraStage(const MeshTraits& traits)
{
  ImproverStage stage = straighteningStage(traits, lastAngles(traits));
  QualityTargets& targets = stage.options.targets;
  targets.jacobianLimit = leastOfHexahedra;
  targets.scaledJacobian = goodOfHexahedra;
  targets.leastOfJacobian = otherMeasuresFloor;
  stage.options.leastPenalty = finePenalty;
  stage.options.rings = 1;
  return stage;
}

std::vector<ImproverStage> soundCreaseStages(const MeshTraits& traits)
{
  std::vector<ImproverStage> stages(6);
  for (std::size_t i = 0; i < stages.size(); ++i)
  {
    const bool isLater = i > 1;
    stages[i].below = i == 0 ? 1.0F : badBelow;
    OptimizerOptions& options = stages[i].options = thorough();
    options.targets = targetsOfCreases(traits, {0.0, goodCreaseJacobian}, baseTargets(traits).faceCosine);
    options.rings = isLater ? 3 : 2;
    options.tryMiddle = isLater;
    options.firstReach = i % 2 == 0 ? options.firstReach : OptimizerOptions().firstReach;
  }
  return stages;
}

std::vector<ImproverStage> creaseStages(const MeshTraits& traits)
{
  const auto stage = [&](double below, bool isFirst) {
    const auto about = [&](const QualityRange& wanted, double above) {
      return QualityRange{wanted.limit - below, wanted.limit + std::max(leastBeyond, above)};
    };
    ImproverStage out{thorough()};
    OptimizerOptions& options = out.options;
    options.targets = targetsOfCreases(traits, about(creaseJacobian, below), about(creaseFaceCosine, 0.0));
    options.targets.leastOfJacobian = options.targets.leastOfFaceCosine = options.leastWorst = otherMeasuresFloor;
    options.rings = isFirst ? 2 : 3;
    options.sweeps = isFirst ? 20 : 60;
    options.leastGain = isFirst ? 0.01 : 0.001;
    return out;
  };
  std::vector<ImproverStage> stages;
  double below = farthestBelow;
  for (std::size_t i = 0; i < firstCreaseStages; ++i, below *= 0.5)
  {
    stages.push_back(stage(below, true));
  }
  // A cell just above a limit may not fall below it, and holds others back: in the last stages limits go down and up.
  for (int i = 0; i < 4; ++i)
  {
    stages.push_back(stage(2.0 * below, false));
    stages.push_back(stage(below, false));
  }
  return stages;
}

QualityTargets wantedOfCreaseSheets(const MeshTraits& traits)
{
  return targetsOfCreases(traits, creaseJacobian, creaseFaceCosine);
}

QualityTargets strictestTargets(const MeshTraits& traits, const CurvedWallTargets* curvedWalls)
{
  QualityTargets targets = curvedWalls ? targetsAtCurved(traits, *curvedWalls) : baseTargets(traits);
  targets.faceCosine.target = std::max(targets.faceCosine.target, largestAngle.target);
  return targets;
}

QualityTargets strictestOfDivided(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits).within(soundShare);
  targets.faceCosine.target = std::max(targets.faceCosine.target, lastAngles(traits).target);
  return targets;
}

} // namespace atria
