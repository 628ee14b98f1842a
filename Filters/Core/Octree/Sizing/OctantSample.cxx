// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/OctantSample.h"

#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/SizeSources.h"
#include "Support/IndexTable.h"

#include <algorithm>

namespace atria {

namespace {

/// Continues from only a part of a level's octants if there are many.
class SampledSets final : public OctantSink
{
public:
  explicit SampledSets(const GridFrame& frame) : frame_(frame) {}

  const GridFrame& frame() const override { return frame_; }
  bool takes(int level, OctantNeed need) const override
  {
    return level < (need == OctantNeed::open ? std::max(frame_.topLevel, frame_.startLevel) : frame_.depth);
  }
  bool isLimited() const override { return false; }

  void add(int level, const std::vector<MortonKey>& keys, const std::vector<OctantNeed>& /*needs*/,
           const RunContext& context) override
  {
    // With four thousand kept, chance changes the counts below by less than two parts in a hundred.
    constexpr std::size_t most = 16384;
    constexpr double kept = 4096.0;
    counts_.refined.push_back(weight * static_cast<double>(keys.size()));
    counts_.children.push_back(weight * static_cast<double>(childrenInDomain(keys, level, frame_, context)));
    shares.push_back(keys.size() > most ? kept / static_cast<double>(keys.size()) : 1.0);
    const auto followed = std::count_if(keys.begin(), keys.end(), [&](MortonKey key) { return goesOn(level, key); });
    weight *= followed > 0 ? static_cast<double>(keys.size()) / static_cast<double>(followed) : 0.0;
  }

  bool goesOn(int level, MortonKey key) const override
  {
    constexpr std::uint64_t oddConstant = 0x9e3779b97f4a7c15ull;
    const double place = static_cast<double>(mixed((key + 1) * oddConstant + static_cast<std::uint64_t>(level)));
    return place <= shares[static_cast<std::size_t>(level)] * 0x1p64;
  }

  const OctantCounts& counts() const { return counts_; }

private:
  GridFrame frame_;
  OctantCounts counts_;
  /// Fraction of the octants of each level whose children are sampled.
  std::vector<double> shares;
  /// Number of octants of the next level that each one stands for.
  double weight = 1.0;
};

/// Takes the larger numbers of octants of each level. Sums would count octants twice that two sources refine.
void takeLarger(OctantCounts& all, const OctantCounts& one)
{
  for (std::size_t l = 0; l < one.refined.size(); ++l)
  {
    if (l == all.refined.size())
    {
      all.refined.push_back(0.0);
      all.children.push_back(0.0);
    }
    if (one.refined[l] > all.refined[l])
    {
      all.refined[l] = one.refined[l];
      all.children[l] = one.children[l];
    }
  }
}

} // namespace

double OctantCounts::leavesAt(std::size_t level) const
{
  const double made = level == 0 ? 1.0 : level <= children.size() ? children[level - 1] : 0.0;
  return std::max(0.0, made - (level < refined.size() ? refined[level] : 0.0));
}

double OctantCounts::leavesDownTo(std::size_t depth) const
{
  double count = 1.0;
  for (std::size_t l = 0; l < std::min(depth, refined.size()); ++l)
  {
    count += children[l] - refined[l];
  }
  return count;
}

OctantCounts sampleOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                           const RunContext& context)
{
  SizingOptions withoutGaps = options;
  withoutGaps.cellsAcrossGap = 0;
  const ModelLevels levels = modelLevels(model, frame, options);
  OctantCounts counts;
  const auto sample = [&](auto&& source) {
    SampledSets sets(frame);
    source(sets);
    takeLarger(counts, sets.counts());
  };
  sample([&](OctantSink& sets) { sizeForModel(sets, model, levels, withoutGaps, context); });
  sample([&](OctantSink& sets) { sizeForBoxes(sets, model, options, context); });
  sample([&](OctantSink& sets) { sizeForDistances(sets, model, options, context); });
  return counts;
}

} // namespace atria
