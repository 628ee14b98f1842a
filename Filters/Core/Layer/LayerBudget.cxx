// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerBudget.h"

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
    int most = 0;
    for (const ModelItem item : octree.items(leaf))
    {
      most = item.kind == ModelItem::triangle ? std::max(most, layers[model.surfaceIds[item.index]].layers) : most;
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

void checkLayerBudget(std::size_t elements, std::size_t memoryLimit)
{
  if (memoryLimit > 0 && elements > memoryLimit / bytesPerElement)
  {
    throw Error("with the layers on walls there are about " + inWords(static_cast<double>(elements)) +
                " elements or more, which take " + inGigabytes(static_cast<double>(elements) * bytesPerElement) +
                " of memory; there are " + inGigabytes(static_cast<double>(memoryLimit)) +
                ": ask for fewer layers (NumberOfLayers, LayerRules; --layers), or raise the sizes at surfaces. "
                "MemoryLimit (--memory-limit) says that there is more memory");
  }
}

void checkLayerBudget(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                      std::size_t memoryLimit, const RunContext& context)
{
  constexpr std::size_t mostLayers = 100;
  if (memoryLimit > 0 && octree.leafCount() > memoryLimit / bytesPerElement / (1 + mostLayers))
  {
    checkLayerBudget(elementsWithLayers(octree, model, rules, context), memoryLimit);
  }
}

} // namespace atria
