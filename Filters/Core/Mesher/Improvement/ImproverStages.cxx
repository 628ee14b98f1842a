// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ImproverStages.h"

#include "Quality/Checks/CheckLimits.h"
#include "Support/Angles.h"

#include <cmath>

namespace atria {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cells with less than this share of the way to a target are improved.
constexpr float clearlyShort = 0.5F;
/// What hexahedra of a uniform mesh should have, and what they keep at curved walls where angles are made better.
constexpr double goodJacobian = 0.6;
constexpr double leastCurvedJacobian = 0.5;
/// The least cosine of non-orthogonality of what vertices go back by, 65 degrees: solvers need corrections beyond it.
constexpr double leastFaceCosine = 0.4226;
/// What corner volumes are to be before layers are divided, where 0.02 is enough for one.
constexpr double volumeToDivide = 0.15;
/// Of divided layers, the share of the way to targets that is aimed at.
constexpr double soundShare = 0.6;
/// How far beyond what is asked for there the first limits are, and how much better aims are.
constexpr CurvedWallTargets beyond{4.0, 0.1};
/// Limit of pyramid cosines, a cell squish of 0.93: well above what is valid, so that cells come below 0.9.
constexpr double leastPyramidCosine = 0.07;
/// Degrees of non-orthogonality: 60, beyond which vertices leave where the model wants them, to 56.6.
constexpr QualityRange acceptable{0.5, 0.55};
/// 69.5 to 60.
constexpr QualityRange lastOfDivided{0.35, 0.5};
/// 71.9 to 66.4.
constexpr QualityRange acceptableOfDivided{0.31, 0.4};

/// The scaled Jacobian that crease sheets are to have. At a corner of three surfaces at right angles 0.41 is the most
/// there is.
constexpr QualityRange creaseJacobian{0.3, 0.31};
/// And the cosine of non-orthogonality: 60 degrees.
constexpr QualityRange creaseFaceCosine{0.5, 0.51};
/// How far below these the first limits are, each next one half of that; and how far beyond them aims are at least.
constexpr double farthestBelow = 0.2;
constexpr double leastBeyond = 0.03;
/// What is aimed at first.
constexpr double goodCreaseJacobian = 0.45;

/// What is asked for beyond 0 degrees is 0.
double cosineOf(double degrees) { return cosOfDegrees(std::max(degrees, 0.0)); }

/// What is within a tenth of a target stays.
constexpr double quickPenalty = 0.01;
/// What a move has to win of a penalty where there are many cells to improve.
constexpr double quickGain = 0.02;

/// What falls short is made sound quickly: points do not creep.
OptimizerOptions quick(double leastGain = quickGain)
{
  OptimizerOptions options;
  options.leastPenalty = quickPenalty;
  options.leastGain = leastGain;
  options.firstReach = 0.2;
  return options;
}

/// For few cells that are hard to improve: nothing is left untried.
OptimizerOptions thorough()
{
  OptimizerOptions options;
  options.patient = true;
  options.firstReach = 0.3;
  options.tries = 4;
  options.leastChange = 0.05;
  return options;
}

/// Cells should have this part of what layers of given heights have on flat walls. Where that is not valid, they must
/// have at least that one; elements of the next size have half of the weights and volume ratios.
constexpr double flatTarget = 0.9;
constexpr double flatLimit = 0.8;
constexpr double flatLimitOfSizes = 0.4;

/// Asks for no more than flat layers have.
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

ImproverStage straighteningStage(const MeshTraits& traits, const QualityRange& faceCosine, bool byChains = false)
{
  ImproverStage stage;
  stage.below = traits.divided ? 0.3F : 0.5F;
  stage.byChains = byChains;
  stage.options.leastWorst = leastOfOthers;
  stage.options.patient = true;
  stage.options.leastPenalty = 0.1; // cells looked at are short by more
  QualityTargets& targets = stage.options.targets;
  targets = baseTargets(traits);
  targets.pyramidCosine.limit = leastPyramidCosine;
  targets = traits.divided ? targets.within(soundShare) : targets;
  targets.faceCosine = faceCosine;
  targets.leastOfFaceCosine = leastOfOthers;
  return stage;
}

/// At curved walls.
OptimizerOptions atCurved()
{
  OptimizerOptions options;
  options.rings = 1;
  options.leastPenalty = 0.001;
  options.leastGain = quickGain;
  options.leastWorst = leastOfOthers;
  return options;
}

/// Limits are a share of `beyond` worse than what is asked for.
ImproverStage closeStage(const MeshTraits& traits, const CurvedWallTargets& wanted, double share)
{
  const auto cosineAt = [&](double part) { return cosineOf(wanted.nonOrthogonality + part * beyond.nonOrthogonality); };
  const auto skewnessAt = [&](double part) { return std::max(wanted.skewness + part * beyond.skewness, 0.0); };
  ImproverStage stage{atCurved(), clearlyShort};
  stage.options.patient = true;
  QualityTargets& targets = stage.options.targets;
  targets = baseTargets(traits);
  targets.faceCosine = {std::max(targets.faceCosine.limit, cosineAt(share)),
                        std::max(targets.faceCosine.target, cosineAt(-1.0))};
  targets.skewness = {std::min(targets.skewness.limit, skewnessAt(share)),
                      std::min(targets.skewness.target, skewnessAt(-1.0))};
  targets.jacobianLimit = std::min(leastCurvedJacobian, targets.scaledJacobian);
  targets.leastOfFaceCosine = targets.leastOfSkewness = leastOfOthers;
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
  if (traits.layered && traits.uniform)
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
  // By short ways more vertices stay where the model wants them where no layer gives way to them, and hexahedra of
  // uniform meshes come to be better.
  ImproverStage stage;
  if (traits.layered && !traits.uniform)
  {
    stage = {quick(0.05), clearlyShort};
  }
  stage.options.leastPenalty = quickPenalty;
  stage.options.targets = baseTargets(traits);
  return stage;
}

QualityTargets targetsOfSupport(const MeshTraits& traits)
{
  constexpr QualityRange anything{0.0, 0.0};
  QualityTargets targets = baseTargets(traits);
  targets.pyramidCosine = targets.faceCosine = targets.skewness = targets.weight = targets.volumeRatio = anything;
  targets.cornerVolume = targets.boundaryShape = targets.convexity = anything;
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
  ImproverStage stage{quick(), clearlyShort};
  stage.options.targets = baseTargets(traits);
  stage.options.targets.cornerVolume.target = std::min(volumeToDivide, flatTarget * traits.flat.cornerVolumeOfAll);
  stage.options.leastWorst = leastOfOthers;
  stage.options.sweeps = 10;
  return stage;
}

std::vector<ImproverStage> divisionStages(const MeshTraits& traits)
{
  const auto stage = [&](float below, int sweeps, bool byChains) {
    ImproverStage out{quick(), below, byChains};
    out.options.targets = baseTargets(traits).within(soundShare);
    out.options.sweeps = sweeps;
    return out;
  };
  // Chains first: that brings most cells where they are to be with few moves.
  return {stage(0.5F, 10, true), stage(0.3F, 12, false), stage(soundEnough, 20, false)};
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
  if (traits.divided)
  {
    // Degrees of non-orthogonality: 78.5 to 66.4, 69.5 to 60. A limit as high as with one layer would take long.
    constexpr QualityRange first{0.2, 0.4};
    return {straighteningStage(traits, first, true), straighteningStage(traits, first),
            straighteningStage(traits, lastOfDivided, true), straighteningStage(traits, lastOfDivided)};
  }
  // 72.5 and 59.3 to 56.6.
  return {straighteningStage(traits, {0.3, acceptable.target}), straighteningStage(traits, {0.51, acceptable.target})};
}

QualityTargets targetsOfHeights(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  targets.faceCosine = lastOfDivided;
  return targets;
}

QualityTargets targetsOfLargestAngle(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits);
  targets.faceCosine = traits.divided ? acceptableOfDivided : acceptable;
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

std::vector<ImproverStage> soundCreaseStages(const MeshTraits& traits)
{
  std::vector<ImproverStage> stages(6);
  for (std::size_t i = 0; i < stages.size(); ++i)
  {
    const bool isLater = i > 1;
    stages[i].below = i == 0 ? 1.0F : soundEnough;
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
    options.targets.leastOfJacobian = options.targets.leastOfFaceCosine = options.leastWorst = leastOfOthers;
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
  // What is just above a limit may not fall below it, and holds others back: in the last ones limits go down and up.
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
  targets.faceCosine.target = std::max(targets.faceCosine.target, acceptable.target);
  return targets;
}

QualityTargets strictestOfDivided(const MeshTraits& traits)
{
  QualityTargets targets = baseTargets(traits).within(soundShare);
  targets.faceCosine.target =
      std::max(targets.faceCosine.target, straighteningStages(traits).back().options.targets.faceCosine.target);
  return targets;
}

} // namespace atria
