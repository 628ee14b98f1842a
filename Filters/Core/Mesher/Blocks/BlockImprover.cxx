// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/BlockImprover.h"

#include "Mesher/Blocks/PointStates.h"
#include "Mesher/Blocks/PoorPlaces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <utility>

namespace atria {

namespace {

/// Numbers of rows around poor elements where blocks meet that are opened and improved again, one try after the other.
constexpr std::array openedRows{4, 6, 8};

/// Vertices to improve, and the elements of their window, in order.
struct Block
{
  const std::vector<Index>& elements;
  std::function<bool(Index vertex)> isOwn;
};

class BlockImprover
{
public:
  BlockImprover(const MeshingContext& surroundings, const VertexClassification& wanted,
                const std::vector<Index>& vertices, DualMesh& mesh, const LayerWalls& layerWalls,
                const LayerOptions& layerOptions, const CurvedWallTargets& targets, const MeshTraits& traits,
                const MeshBlocks& meshBlocks, BlockExchange& blockExchange)
      : context(surroundings), classification(wanted), vertexOf(vertices), plain(mesh),
        walls(layerWalls), settings{optionsOfWindows(layerOptions), targets, traits},
        cutTag(settings.options.surfaceCount() - 1), blocks(meshBlocks), exchange(blockExchange),
        windows(findWindows(mesh, vertices, blocks, context)),
        classes(findClasses(exchange.allTouching(windows.touching))), states(statesOf(std::move(mesh.points), wanted))
  {
  }

  ImprovedBlocks run()
  {
    settleOthers();
    improveAll(ImproverPart::whole, context.part(0.0, 0.45));
    improveAll(ImproverPart::finish, context.part(0.45, 0.9));
    poor = exchange.allPoor(poor);
    improvePoor();
    plain.points = std::move(states.points);
    ImprovedBlocks out{std::move(states.layers), {}, std::move(poor)};
    std::ranges::transform(states.detached, std::back_inserter(out.detached), [](const auto& entry) {
      return DetachedVertex{entry.first, entry.second};
    });
    return out;
  }

private:
  /// Settles points away from the boundary where they are.
  void settleOthers()
  {
    for (Index p = 0; p < vertexOf.size(); ++p)
    {
      if (!blocks.near.mayMove[vertexOf[p]])
      {
        states.layers.settle(p, {});
      }
    }
  }

  /// Returns the members of a class that are improved here.
  std::vector<Index> ownOf(const std::vector<Index>& members) const
  {
    std::vector<Index> own;
    std::ranges::copy_if(members, std::back_inserter(own), [&](Index block) { return blocks.isOwn(block); });
    return own;
  }

  void improveAll(ImproverPart part, const MeshingContext& within)
  {
    done.resize(vertexOf.size());
    std::ranges::transform(vertexOf, done.begin(), [&](Index vertex) { return blocks.near.mayMove[vertex] ? 0 : 1; });
    const auto count = static_cast<double>(classes.size());
    for (std::size_t i = 0; i < classes.size(); ++i)
    {
      const MeshingContext own = within.part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
      own.progress.report(0.0, part == ImproverPart::whole ? "Improving elements at walls" : "Straightening elements");
      PointChanges changes;
      for (WindowResult& result : improveClass(ownOf(classes[i]), part, own))
      {
        append(result.changes, changes);
        poor.insert(poor.end(), result.poor.begin(), result.poor.end());
      }
      take(exchange.allChanges(changes));
    }
  }

  /// Improves blocks side by side, or one after the other if there are fewer than two for each thread.
  std::vector<WindowResult> improveClass(const std::vector<Index>& members, ImproverPart part,
                                         const MeshingContext& within) const
  {
    std::vector<WindowResult> results(members.size());
    StopMonitor monitor(within.progress);
    const auto improveOne = [&](std::size_t i, const Executor& executor) {
      results[i] = improveWindow(taskOf(blockOf(members[i]), part), settings,
                                 {{executor, ProgressRange(monitor)}, within.octree, within.model, within.tree});
    };
    if (members.size() < 2 * static_cast<std::size_t>(within.executor.threads()))
    {
      for (std::size_t i = 0; i < members.size(); ++i)
      {
        improveOne(i, within.executor);
      }
      return results;
    }
    const SerialExecutor alone;
    within.executor.forEach(members.size(), 1, [&](std::size_t i) { improveOne(i, alone); });
    return results;
  }

  Block blockOf(Index number) const
  {
    return {windows.elements[number - blocks.first],
            [this, number](Index vertex) { return blocks.ofVertex[vertex] == number; }};
  }

  WindowTask taskOf(const Block& block, ImproverPart part) const
  {
    WindowTask task;
    task.part = part;
    if (block.elements.empty())
    {
      return task;
    }
    task.window = extractWindow(plain, states.points, classification, vertexOf, block.elements, cutTag);
    giveStates(states, done, cutTag, task);
    for (Index p = 0; p < task.window.pointIds.size(); ++p)
    {
      const Index point = task.window.pointIds[p];
      task.counts.push_back(task.settled.isAtCut(p) ? 0 : walls.counts[point]);
      task.isOwn.push_back(block.isOwn(vertexOf[point]) ? 1 : 0);
    }
    return task;
  }

  void take(const PointChanges& changes)
  {
    apply(changes, states);
    std::ranges::for_each(changes.points, [&](Index p) { done[p] = 1; });
  }

  /// Opens and improves again the surroundings of poor elements where blocks meet, each place by itself.
  void improvePoor()
  {
    PoorPlaces places(plain, vertexOf, blocks);
    for (const int reach : openedRows)
    {
      for (const std::vector<Index>& members : classes)
      {
        std::vector<Index> own;
        std::ranges::set_intersection(ownOf(members), places.blocksOf(poor), std::back_inserter(own));
        if (exchange.isAny(!own.empty()))
        {
          improvePlaces(own, reach, places);
        }
      }
    }
  }

  void improvePlaces(const std::vector<Index>& members, int reach, PoorPlaces& places)
  {
    std::vector<Index> changed;
    std::vector<PoorElement> gone;
    std::vector<PoorElement> found;
    for (const Index block : members)
    {
      // Places stay in the window of their block, as ranks improve other blocks of its class at the same time.
      const std::vector<Index>& window = windows.elements[block - blocks.first];
      for (const std::vector<Index>& elements : places.find(block, poor, reach, window))
      {
        const OpenedPlace place = places.open(elements, reach, window);
        std::vector<PoorElement> before;
        std::ranges::copy_if(poor, std::back_inserter(before), [&](const PoorElement& one) {
          return std::ranges::any_of(places.wallPointsOf(one), [&](Index p) { return place.hasVertex(vertexOf[p]); });
        });
        WindowResult result = mend(place);
        if (countPoor(result.poor) < countPoor(before))
        {
          take(result.changes);
          changed.insert(changed.end(), place.points.begin(), place.points.end());
          gone.insert(gone.end(), before.begin(), before.end());
          std::erase_if(found, [&](const PoorElement& one) { return std::ranges::find(before, one) != before.end(); });
          found.insert(found.end(), result.poor.begin(), result.poor.end());
          replacePoor(before, result.poor);
        }
      }
    }
    sortUnique(changed); // places of a block may share points
    take(exchange.allChanges(copyStates(states, changed, vertexOf)));
    const std::vector<PoorElement> allGone = exchange.allPoor(gone);
    replacePoor(allGone, exchange.allPoor(found));
  }

  /// Returns how many elements fail, and how many there are.
  static std::pair<std::ptrdiff_t, std::size_t> countPoor(const std::vector<PoorElement>& some)
  {
    return {std::ranges::count(some, true, &PoorElement::fails), some.size()};
  }

  void replacePoor(const std::vector<PoorElement>& gone, const std::vector<PoorElement>& found)
  {
    std::erase_if(poor, [&](const PoorElement& one) { return std::ranges::find(gone, one) != gone.end(); });
    std::ranges::copy_if(found, std::back_inserter(poor),
                         [&](const PoorElement& one) { return std::ranges::find(poor, one) == poor.end(); });
  }

  WindowResult mend(const OpenedPlace& place)
  {
    std::ranges::for_each(place.points, [&](Index p) { done[p] = 0; });
    const Block block{place.window, [&](Index vertex) { return place.hasVertex(vertex); }};
    StopMonitor monitor(context.progress);
    WindowResult result =
        improveWindow(taskOf(block, ImproverPart::mend), settings,
                      {{context.executor, ProgressRange(monitor)}, context.octree, context.model, context.tree});
    std::ranges::for_each(place.points, [&](Index p) { done[p] = 1; });
    return result;
  }

  const MeshingContext& context;
  const VertexClassification& classification;
  const std::vector<Index>& vertexOf;
  /// Its points are in `states` until the end.
  DualMesh& plain;
  const LayerWalls& walls;
  WindowSettings settings;
  Index cutTag;
  const MeshBlocks& blocks;
  BlockExchange& exchange;
  BlockWindows windows;
  std::vector<std::vector<Index>> classes;
  PointStates states;
  /// One entry per point: 1 if its block has taken the present part, or if it never moves.
  std::vector<char> done;
  std::vector<PoorElement> poor;
};

LayerMesh assembleLayer(const SettledPoints& layers, DualMesh& plain, const LayerWalls& walls, const Executor& executor)
{
  std::vector<Index> counts(plain.points.size());
  for (Index p = 0; p < counts.size(); ++p)
  {
    // Walls at the end of this part of the mesh may have no layers.
    counts[p] = layers.has(p) ? std::min(layers.counts[p], walls.counts[p]) : 0;
  }
  LayerMesh layer = takeLayer(plain, walls, counts, executor);
  for (std::size_t i = 0; i < layer.wallPoints.size(); ++i)
  {
    layer.mesh.points[layer.plainPoints + i] = layers.aboveOf(layer.wallPoints[i])[layer.places[i] - 1];
  }
  return layer;
}

std::vector<Index> failingIn(const LayerMesh& layer, const std::vector<PoorElement>& poor)
{
  std::vector<Index> failing;
  for (const PoorElement& element : poor)
  {
    // Stacks at the end of this part of the mesh may be lower.
    const Index e = element.isPlain() ? element.place : layer.prismOn(element.place, element.height);
    if (element.fails && e != noIndex)
    {
      failing.push_back(e);
    }
  }
  sortUnique(failing);
  return failing;
}

} // namespace

ImprovedBlocks improveBlocks(const MeshingContext& context, const VertexClassification& classification,
                             const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                             const LayerOptions& options, const CurvedWallTargets& curvedWalls,
                             const MeshTraits& traits, const MeshBlocks& blocks, BlockExchange& exchange)
{
  return BlockImprover(context, classification, vertexOf, plain, walls, options, curvedWalls, traits, blocks, exchange)
      .run();
}

ImprovedLayer layersOfBlocks(const ImprovedBlocks& improved, DualMesh& plain, const LayerWalls& walls,
                             const MeshTraits& traits, const RunContext& context)
{
  std::vector<double> sizes = sizesBesideWalls(plain, walls, context);
  LayerMesh layer =
      traits.layered ? assembleLayer(improved.layers, plain, walls, context.executor) : withoutLayer(std::move(plain));
  std::vector<Index> failing = failingIn(layer, improved.poor);
  return {std::move(layer), improved.detached, std::move(failing), std::move(sizes)};
}

} // namespace atria
