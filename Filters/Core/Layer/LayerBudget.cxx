// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerBudget.h"

#include "Layer/LayerHeights.h"
#include "Octree/Sizing/ElementBudget.h"
#include "Support/Sums.h"

#include <algorithm>
#include <bit>

namespace atria {

namespace {

/// Returns the sum of count(leaf) over the leaves in the domain for which `isCounted` is true, if it is given.
template <typename Count>
std::size_t sumOverLeaves(const Octree& octree, const std::function<bool(Index leaf)>& isCounted,
                          const RunContext& context, Count&& count)
{
  return sumOver(octree.leafCount(), context, [&](std::size_t i) {
    const auto leaf = static_cast<Index>(i);
    return octree.inDomain(leaf) && (!isCounted || isCounted(leaf)) ? count(leaf) : std::size_t{0};
  });
}

} // namespace

std::size_t countLayerElements(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                               bool hexahedra, const RunContext& context,
                               const std::function<bool(Index leaf)>& isCounted)
{
  const std::vector<WallLayers> layers = resolveLayerRules(rules, model.names);
  const GridFrame& frame = octree.frame();
  if (hexahedra)
  {
    const auto most = static_cast<std::size_t>(std::max(1, mostLayersOf(layers, frame.sizeOf(octree.maximumLevel()))));
    return sumOverLeaves(octree, isCounted, context, [&](Index leaf) {
      const int walls = octree.items(leaf, ModelItem::triangle).empty() ? 0 : 2;
      const int sides = std::popcount(frame.domainPlanes(octree.lowCorner(leaf), octree.highCorner(leaf)));
      return most * static_cast<std::size_t>(walls + sides);
    });
  }
  return sumOverLeaves(octree, isCounted, context, [&](Index leaf) {
    const double size = frame.sizeOf(octree.level(leaf));
    int most = 0;
    for (const ModelItem item : octree.items(leaf, ModelItem::triangle))
    {
      most = std::max(most, fitted(layers[model.surfaceIds[item.index]], size).layers);
    }
    return static_cast<std::size_t>(most);
  });
}

void checkLayerBudget(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                      bool hexahedra, std::size_t memoryLimit, const RunContext& context,
                      const std::function<bool(Index leaf)>& isOwn, RankExchange& exchange)
{
  const auto sum = [&](std::size_t own) { return sumAll(exchange, std::array{own})[0]; };
  if (memoryLimit == 0 || sum(octree.leafCount()) <= memoryLimit / bytesPerElement / std::size_t{1 + mostLayers})
  {
    return;
  }
  const std::size_t elements =
      sum(sumOverLeaves(octree, isOwn, context, [](Index /*leaf*/) { return std::size_t{1}; }) +
          countLayerElements(octree, model, rules, hexahedra, context, isOwn));
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
