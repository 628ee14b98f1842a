// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/GapSizing.h"
#include "Octree/Sizing/SizeSources.h"
#include "Support/Angles.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace atria {

namespace {

/// Result of the rules for one octant.
struct Decision
{
  bool refine = false;
  OctantNeed need = OctantNeed::open;
  std::vector<GapLine> gaps;
};

/// True if two of the unit normals differ by more than the angle, whatever their sense.
bool differ(std::span<const Vec3> normals, double angle)
{
  const double minimumCosine = std::cos(angle);
  // No two normals within half the angle of one axis differ by more, which settles most octants without pairs.
  Vec3 axis = Vec3::Zero();
  for (const Vec3& n : normals)
  {
    axis += n.dot(normals[0]) < 0.0 ? Vec3(-n) : n;
  }
  axis.normalize();
  const double inCone = std::cos(0.5 * angle);
  if (std::all_of(normals.begin(), normals.end(), [&](const Vec3& n) { return std::abs(n.dot(axis)) >= inCone; }))
  {
    return false;
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    for (std::size_t j = i + 1; j < normals.size(); ++j)
    {
      if (std::abs(normals[i].dot(normals[j])) < minimumCosine)
      {
        return true;
      }
    }
  }
  return false;
}

/// The rules for octants that hold pieces of the model.
class ModelRules
{
public:
  ModelRules(const SurfaceModel& model, const GridFrame& frame, const ModelLevels& levels, const SizingOptions& options)
      : model_(model), frame_(frame), levels_(levels), curvature(radians(options.curvatureAngle))
  {
    finestFeature = frame.featureLevel;
    for (const int level : levels.featureOfSurface)
    {
      finestFeature = std::max(finestFeature, level);
    }
    if (options.cellsAcrossGap > 0)
    {
      gaps.emplace(model, frame, levels, options.cellsAcrossGap);
    }
  }

  /// Decides about an octant. If `limited`, also decides its need, and notes gaps even if octants get finer.
  Decision decide(MortonKey key, int level, std::span<const ModelItem> pieces, bool limited) const
  {
    Decision decision;
    const bool always = level < frame_.startLevel || level < frame_.topLevel;
    const bool passesHere = (limited || !always) && passesThrough(pieces, level);
    const bool passed = always || passesHere;
    const bool early = passed && !limited;
    if (pieces.empty() || early)
    {
      decision.refine = passed;
      return decision;
    }
    const LatticeBox box = domainBoxOf(frame_, level, key);
    decision.need = hasFeature(box, pieces, level)       ? OctantNeed::feature
                    : passesHere || turns(pieces, level) ? OctantNeed::surface
                                                         : OctantNeed::open;
    decision.refine = passed || decision.need != OctantNeed::open;
    if (gaps && !passed && level <= finestFeature)
    {
      if (gaps->find(box, pieces, decision.gaps) > level)
      {
        decision.refine = true;
        decision.need = std::max(decision.need, OctantNeed::surface);
      }
      if (decision.refine && level < finestFeature && !limited)
      {
        decision.gaps.clear(); // its children find them again
      }
    }
    return decision;
  }

private:
  bool passesThrough(std::span<const ModelItem> pieces, int level) const
  {
    return std::any_of(pieces.begin(), pieces.end(), [&](ModelItem piece) {
      return piece.kind == ModelItem::triangle && level < levels_.of(piece, model_);
    });
  }

  /// True if a curve, a corner or several surfaces request finer octants.
  bool hasFeature(const LatticeBox& box, std::span<const ModelItem> pieces, int level) const
  {
    int finest = 0;
    for (const ModelItem piece : pieces)
    {
      if (piece.kind != ModelItem::triangle)
      {
        if (level < levels_.of(piece, model_))
        {
          return true;
        }
        continue;
      }
      finest = std::max(finest, levels_.featureOfSurface[model_.surfaceIds[piece.index]]);
    }
    return level < finest && severalSurfaces(box, pieces, model_);
  }

  /// True if normals of one smooth piece differ by more than the curvature angle.
  bool turns(std::span<const ModelItem> pieces, int level) const
  {
    if (curvature <= 0.0)
    {
      return false;
    }
    std::vector<std::pair<Index, Index>> triangles; // pairs of chart and triangle
    for (const ModelItem piece : pieces)
    {
      if (piece.kind == ModelItem::triangle && level < levels_.featureOfSurface[model_.surfaceIds[piece.index]])
      {
        triangles.emplace_back(model_.charts[piece.index], piece.index);
      }
    }
    std::sort(triangles.begin(), triangles.end());
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      normals.push_back(model_.normal(triangles[i].second).normalized());
      if (i + 1 == triangles.size() || triangles[i + 1].first != triangles[i].first)
      {
        if (differ(normals, curvature))
        {
          return true;
        }
        normals.clear();
      }
    }
    return false;
  }

  const SurfaceModel& model_;
  const GridFrame& frame_;
  const ModelLevels& levels_;
  double curvature;
  int finestFeature;
  std::optional<GapSizer> gaps;
};

} // namespace

std::vector<GapLine> sizeForModel(OctantSink& sets, const SurfaceModel& model, const ModelLevels& levels,
                                  const SizingOptions& options, const RunContext& context)
{
  const GridFrame& frame = sets.frame();
  const ModelRules rules(model, frame, levels, options);
  std::vector<GapLine> gaps;
  GeometryLists lists = sizingLists(model, frame);
  // Octants of the finest level are looked at for gaps only.
  const int last = options.cellsAcrossGap > 0 ? frame.depth : frame.depth - 1;
  for (int level = 0; lists.size() > 0 && level <= last; ++level)
  {
    context.progress.report(static_cast<double>(level) / (frame.depth + 1), "Sizing octants");
    std::vector<Decision> decisions(lists.size());
    context.executor.forEach(lists.size(), 1024, [&](std::size_t i) {
      decisions[i] = rules.decide(lists.keys[i], level, lists.of(i), sets.isLimited());
    });
    std::vector<char> chosen(lists.size());
    std::vector<MortonKey> keys;
    std::vector<OctantNeed> needs;
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      chosen[i] = decisions[i].refine;
      gaps.insert(gaps.end(), decisions[i].gaps.begin(), decisions[i].gaps.end());
      if (chosen[i])
      {
        keys.push_back(lists.keys[i]);
        needs.push_back(decisions[i].need);
      }
    }
    if (keys.empty() || !takesAny(sets, level))
    {
      break;
    }
    sets.add(level, keys, needs, context);
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      const bool isTaken = !sets.isLimited() || sets.takes(level, decisions[i].need);
      chosen[i] = chosen[i] != 0 && isTaken && sets.goesOn(level, lists.keys[i]) ? 1 : 0;
    }
    const bool onlyOccupied = !sets.takes(level + 1, OctantNeed::open);
    lists = level == last ? GeometryLists{} : childLists(lists, level, chosen, onlyOccupied, model, frame, context);
  }
  return gaps;
}

} // namespace atria
