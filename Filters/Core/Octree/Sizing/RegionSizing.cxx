// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/BoxDistance.h"
#include "Octree/Sizing/SizeSources.h"
#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"
#include "Surface/Model/TriangleTree.h"
#include "Surface/Search/Slabs.h"

#include <algorithm>

namespace atria {

namespace {

/// Part of an octant that an ask fills. An ask is a box or a triangle's surroundings for which a size is requested.
enum class Reach : std::uint8_t
{
  none,
  part,
  all
};

/// Octants of one level, sorted by key, each with the indices of the asks that reach it.
struct AskLists
{
  std::vector<MortonKey> keys;
  std::vector<std::size_t> offsets{0};
  std::vector<Index> asks;
  /// Need of each octant.
  std::vector<OctantNeed> needs;

  std::span<const Index> of(std::size_t i) const
  {
    return std::span(asks).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  void append(const AskLists& other)
  {
    const std::size_t shift = asks.size();
    keys.insert(keys.end(), other.keys.begin(), other.keys.end());
    asks.insert(asks.end(), other.asks.begin(), other.asks.end());
    needs.insert(needs.end(), other.needs.begin(), other.needs.end());
    std::transform(other.offsets.begin() + 1, other.offsets.end(), std::back_inserter(offsets),
                   [&](std::size_t offset) { return offset + shift; });
  }
};

/// Finds the octants that triangles touch.
class SurfaceSearch
{
public:
  explicit SurfaceSearch(const SurfaceModel& model) : model_(model), tree_(model) {}

  bool touches(const LatticeBox& box) const
  {
    return std::ranges::any_of(tree_.get().touching(box), [&](Index t) {
      return !model_.isTurnedSide(t) &&
             atria::touches(box, model_.corner(t, 0), model_.corner(t, 1), model_.corner(t, 2));
    });
  }

private:
  const SurfaceModel& model_;
  TriangleTreeOnDemand tree_;
};

/// Refines the octants that asks reach. `levelOf(ask)` returns the level down to which an ask refines, and
/// `reachOf(ask, box)` its reach in an octant, cut to the domain. If the sink is limited, octants with triangles that
/// `surfaces` finds are refined for a surface; all others are refined for a region.
template <typename LevelOf, typename ReachOf> class AskDescent
{
public:
  AskDescent(OctantSink& sets, LevelOf levelOf, ReachOf reachOf, const SurfaceSearch* surfaces)
      : sets_(sets), levelOf_(levelOf), reachOf_(reachOf), surfaces_(sets.isLimited() ? surfaces : nullptr)
  {
  }

  void run(std::size_t count, const RunContext& context)
  {
    AskLists root;
    root.keys = {0};
    root.asks.resize(count);
    for (Index i = 0; i < count; ++i)
    {
      root.asks[i] = i;
    }
    root.offsets = {0, count};
    AskLists lists;
    appendOctant(lists, 0, 0, root.of(0), surfaces_ ? OctantNeed::surface : OctantNeed::region);
    for (int level = 0; !lists.keys.empty() && takesAny(sets_, level); ++level)
    {
      sets_.add(level, lists.keys, lists.needs, context);
      lists = takesAny(sets_, level + 1) ? childrenOf(lists, level, context) : AskLists{};
    }
  }

private:
  /// Adds an octant if an ask that reaches it goes below its level. An ask that fills the octant stands for all asks of
  /// no finer level. `parentNeed` is what its parent is refined for.
  void appendOctant(AskLists& out, MortonKey key, int level, std::span<const Index> asks, OctantNeed parentNeed) const
  {
    const LatticeBox box = domainBoxOf(sets_.frame(), level, key);
    if (box.empty())
    {
      return;
    }
    const std::size_t begin = out.asks.size();
    Index filling = noIndex;
    for (const Index ask : asks)
    {
      if (levelOf_(ask) <= level || (filling != noIndex && levelOf_(ask) <= levelOf_(filling)))
      {
        continue;
      }
      const Reach reach = reachOf_(ask, box);
      if (reach == Reach::all)
      {
        filling = ask;
      }
      else if (reach == Reach::part)
      {
        out.asks.push_back(ask);
      }
    }
    if (filling != noIndex)
    {
      const auto weaker = [&](Index ask) { return levelOf_(ask) <= levelOf_(filling); };
      out.asks.erase(std::remove_if(out.asks.begin() + static_cast<std::ptrdiff_t>(begin), out.asks.end(), weaker),
                     out.asks.end());
      out.asks.push_back(filling);
    }
    if (out.asks.size() > begin)
    {
      out.keys.push_back(key);
      out.offsets.push_back(out.asks.size());
      const bool atSurface = parentNeed == OctantNeed::surface && surfaces_->touches(box);
      out.needs.push_back(atSurface ? OctantNeed::surface : OctantNeed::region);
    }
  }

  AskLists childrenOf(const AskLists& parents, int level, const RunContext& context) const
  {
    // Pieces have a fixed length and are joined in order, so that lists do not depend on threads.
    constexpr std::size_t grain = 128;
    std::vector<AskLists> parts((parents.keys.size() + grain - 1) / grain);
    context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
      context.progress.check();
      for (std::size_t i = part * grain; i < std::min((part + 1) * grain, parents.keys.size()); ++i)
      {
        const OctantNeed need = parents.needs[i];
        const bool goesOn = sets_.takes(level, need) && sets_.goesOn(level, parents.keys[i]);
        for (MortonKey k = 0; k < 8 && goesOn; ++k)
        {
          appendOctant(parts[part], parents.keys[i] << 3 | k, level + 1, parents.of(i), need);
        }
      }
    });
    AskLists children;
    for (AskLists& part : parts)
    {
      children.append(part);
      part = {};
    }
    return children;
  }

  OctantSink& sets_;
  LevelOf levelOf_;
  ReachOf reachOf_;
  const SurfaceSearch* surfaces_;
};

struct LevelledBox
{
  LatticeBox box;
  int level;
};

Reach reachOf(const LatticeBox& region, const LatticeBox& octant)
{
  Reach reach = Reach::all;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (region.low[axis] >= octant.high[axis] || region.high[axis] <= octant.low[axis])
    {
      return Reach::none;
    }
    reach = region.low[axis] > octant.low[axis] || region.high[axis] < octant.high[axis] ? Reach::part : reach;
  }
  return reach;
}

/// A triangle around which octants are refined.
struct NearTriangle
{
  Index triangle;
  /// In lattice units.
  double distance;
  int level;
};

Reach reachOf(const NearTriangle& near, const LatticeBox& box, const SurfaceModel& model)
{
  const TriangleDistance distance(box, model.corner(near.triangle, 0), model.corner(near.triangle, 1),
                                  model.corner(near.triangle, 2));
  return distance.allWithin(near.distance) ? Reach::all
                                           : (distance.anyWithin(near.distance) ? Reach::part : Reach::none);
}

} // namespace

void sizeForBoxes(OctantSink& sets, const SurfaceModel& model, const SizingOptions& options, const RunContext& context)
{
  const GridFrame& frame = sets.frame();
  std::vector<LevelledBox> boxes;
  for (std::size_t i = 0; i < options.boxes.size(); ++i)
  {
    const RefinementBox& asked = options.boxes[i];
    const std::string which = "refinement box " + std::to_string(i + 1);
    if (!asked.bounds.min.allFinite() || !asked.bounds.max.allFinite() || !(asked.bounds.size().minCoeff() > 0.0))
    {
      throw Error(which + " is empty: give bounds with min < max on every axis");
    }
    // Parts of a box far outside of the domain do not fit the lattice.
    const Vec3 low = asked.bounds.min.cwiseMax(frame.domain.min);
    const Vec3 high = asked.bounds.max.cwiseMin(frame.domain.max);
    if (!((high - low).minCoeff() > 0.0))
    {
      throw Error(which + " lies outside of the domain: move it, or leave it out");
    }
    boxes.push_back({{frame.toLattice(low), frame.toLattice(high)}, levelNotAbove(asked.size, frame)});
  }
  const SurfaceSearch surfaces(model);
  AskDescent(
      sets, [&](Index i) { return boxes[i].level; },
      [&](Index i, const LatticeBox& octant) { return reachOf(boxes[i].box, octant); }, &surfaces)
      .run(boxes.size(), context);
}

void sizeForDistances(OctantSink& sets, const SurfaceModel& model, const SizingOptions& options,
                      const RunContext& context)
{
  std::vector<NearTriangle> near;
  for (const DistanceSize& rule : options.distanceSizes)
  {
    if (!(rule.distance >= 0.0))
    {
      throw Error("the distance " + std::to_string(rule.distance) + " from surfaces '" + rule.pattern +
                  "' must not be negative");
    }
    const std::vector<char> matching = sizedSurfaces(rule.pattern, model.names);
    const double distance = rule.distance / sets.frame().latticeUnit();
    const int level = levelNotAbove(rule.size, sets.frame());
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      if (!model.isTurnedSide(t) && matching[model.surfaceIds[t]])
      {
        near.push_back({t, distance, level});
      }
    }
  }
  const SurfaceSearch surfaces(model);
  AskDescent(
      sets, [&](Index i) { return near[i].level; },
      [&](Index i, const LatticeBox& octant) { return reachOf(near[i], octant, model); }, &surfaces)
      .run(near.size(), context);
}

void sizeForGaps(OctantSink& sets, const std::vector<GapLine>& lines, const RunContext& context)
{
  AskDescent(
      sets, [&](Index i) { return lines[i].level; },
      [&](Index i, const LatticeBox& octant) {
        const GapLine& line = lines[i];
        const Vec3 low = toVector(octant.low) - line.half - line.from;
        const Vec3 high = toVector(octant.high) + line.half - line.from;
        return clipLine(low, high, line.to - line.from, 1.0).empty() ? Reach::none : Reach::part;
      },
      nullptr)
      .run(lines.size(), context);
}

} // namespace atria
