// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerBudget.h"

#include "Layer/LayerHeights.h"
#include "Octree/Sizing/ElementBudget.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <numeric>

namespace atria {

std::size_t elementsWithLayers(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                               const RunContext& context, const std::function<bool(Index leaf)>& isCounted)
{
  const std::vector<WallLayers> layers = resolveLayerRules(rules, model.names);
  const auto elementsAt = [&](Index leaf) {
    const double size = octree.frame().sizeOf(octree.level(leaf));
    int most = 0;
    for (const ModelItem item : octree.items(leaf, ModelItem::triangle))
    {
      most = std::max(most, fitted(layers[model.surfaceIds[item.index]], size).layers);
    }
    return std::size_t{1} + static_cast<std::size_t>(most);
  };
  const Pieces pieces(octree.leafCount());
  std::vector<std::size_t> counts(pieces.count, 0);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    for (std::size_t leaf = pieces.begin(piece); leaf < pieces.end(piece); ++leaf)
    {
      const auto i = static_cast<Index>(leaf);
      counts[piece] += octree.inDomain(i) && (!isCounted || isCounted(i)) ? elementsAt(i) : 0;
    }
  });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

void checkLayerBudget(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                      std::size_t memoryLimit, const RunContext& context, const std::function<bool(Index leaf)>& isOwn,
                      RankExchange& exchange)
{
  constexpr std::size_t mostLayers = 100;
  const auto sum = [&](std::size_t own) { return sumAll(exchange, std::array{own})[0]; };
  if (memoryLimit == 0 || sum(octree.leafCount()) <= memoryLimit / bytesPerElement / (1 + mostLayers))
  {
    return;
  }
  const std::size_t elements = sum(elementsWithLayers(octree, model, rules, context, isOwn));
  if (elements > memoryLimit / bytesPerElement)
  {
    throw Error("with the layers on walls there are about " + inWords(static_cast<double>(elements)) +
                " elements or more, which take " + inGigabytes(static_cast<double>(elements) * bytesPerElement) +
                " of memory; there are " + inGigabytes(static_cast<double>(memoryLimit)) +
                ": ask for fewer layers (NumberOfLayers or LayerRules), or raise the sizes at surfaces. "
                "MemoryLimit says that there is more memory");
  }
}

} // namespace atria
