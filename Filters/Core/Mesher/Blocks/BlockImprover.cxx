// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/BlockImprover.h"

#include "Mesher/Blocks/ElementRows.h"
#include "Mesher/Blocks/PointStates.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <map>

namespace atria {

namespace {

/// Rows about elements that fail where blocks meet that are opened and improved again, one try after the other; and
/// rows about these, where all points stay.
constexpr std::array openedRows{4, 6, 8};
constexpr int rowsBesideOpened = 3;

/// Some vertices, and the elements they are improved among, in order.
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

  ImprovedLayer run()
  {
    settleOthers();
    improveAll(ImproverPart::whole, context.part(0.0, 0.45));
    between = states;
    improveAll(ImproverPart::finish, context.part(0.45, 0.9));
    poor = exchange.allPoor(poor);
    improvePoor();
    plain.points = states.points;
    ImprovedLayer out{assembleLayer(), {}, {}};
    std::ranges::transform(states.detached, std::back_inserter(out.detached), [](const auto& entry) {
      return DetachedVertex{entry.first, entry.second};
    });
    out.failing = failingIn(out.layer);
    return out;
  }

private:
  /// Points away from the boundary stay.
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

  /// Of a class, those improved here.
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

  /// One after the other where there are not many blocks for each thread, else side by side.
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

  std::vector<Index> wallPointsOf(const PoorElement& element) const
  {
    if (element.isPlain())
    {
      return {plain.corners[element.place].begin(), plain.corners[element.place].end()};
    }
    const std::array<Index, 4> corners = cornersOf(plain, plain.boundaryFaces[element.place]);
    return {corners.begin(), corners.end()};
  }

  Index plainElementOf(const PoorElement& element) const
  {
    return element.isPlain() ? element.place : plain.boundaryFaces[element.place].element;
  }
  Index blockAt(Index element) const { return blocks.ofVertex[vertexOf[plain.corners[element][0]]]; }

  /// What is about poor elements where blocks meet is opened and improved again, each place by itself.
  void improvePoor()
  {
    std::vector<char> isNear(plain.elementCount());
    for (Index e = 0; e < isNear.size(); ++e)
    {
      isNear[e] = blocks.near.isNear(e) ? 1 : 0;
    }
    ElementRows rows(plain, isNear);
    for (const int reach : openedRows)
    {
      for (const std::vector<Index>& members : classes)
      {
        std::vector<Index> changed;
        std::vector<PoorElement> gone;
        std::vector<PoorElement> found;
        for (const Index block : ownOf(members))
        {
          for (const std::vector<Index>& place : placesOf(poorWhereBlocksMeet(block, reach, rows), reach, rows))
          {
            improvePlace(block, place, reach, rows, changed, gone, found);
          }
        }
        sortUnique(changed); // places of a block may have points of each other
        take(exchange.allChanges(copyStates(states, changed, vertexOf)));
        const std::vector<PoorElement> allGone = exchange.allPoor(gone);
        replacePoor(allGone, exchange.allPoor(found));
      }
    }
  }

  void replacePoor(const std::vector<PoorElement>& gone, const std::vector<PoorElement>& found)
  {
    std::erase_if(poor, [&](const PoorElement& one) { return std::ranges::find(gone, one) != gone.end(); });
    std::ranges::copy_if(found, std::back_inserter(poor),
                         [&](const PoorElement& one) { return std::ranges::find(poor, one) == poor.end(); });
  }

  /// Elements of a block that are poor, or have such on them, in order.
  std::vector<Index> poorWhereBlocksMeet(Index block, int reach, ElementRows& rows) const
  {
    std::vector<Index> elements;
    std::ranges::transform(poor, std::back_inserter(elements),
                           [&](const PoorElement& one) { return plainElementOf(one); });
    sortUnique(elements);
    std::erase_if(elements, [&](Index e) { return blockAt(e) != block || !isWhereBlocksMeet(rows.grow({e}, reach)); });
    return elements;
  }

  bool isWhereBlocksMeet(const std::vector<Index>& elements) const
  {
    const Index first = blockAt(elements.front());
    return std::ranges::any_of(elements, [&](Index e) {
      return std::ranges::any_of(plain.corners[e], [&](Index p) { return blocks.ofVertex[vertexOf[p]] != first; });
    });
  }

  /// Elements that are near each other.
  static std::vector<std::vector<Index>> placesOf(const std::vector<Index>& elements, int reach, ElementRows& rows)
  {
    UnionFind sets(elements.size());
    std::map<Index, Index> holders;
    for (Index i = 0; i < elements.size(); ++i)
    {
      for (const Index e : rows.grow({elements[i]}, reach))
      {
        sets.join(holders.emplace(e, i).first->second, i);
      }
    }
    std::map<Index, std::vector<Index>> places;
    for (Index i = 0; i < elements.size(); ++i)
    {
      places[sets.find(i)].push_back(elements[i]);
    }
    std::vector<std::vector<Index>> out;
    std::ranges::transform(places, std::back_inserter(out), [](const auto& entry) { return entry.second; });
    return out;
  }

  /// Those of the elements' points that may move, in order.
  std::vector<Index> movingPointsOf(const std::vector<Index>& elements) const
  {
    std::vector<Index> points;
    for (const Index e : elements)
    {
      std::ranges::copy_if(plain.corners[e], std::back_inserter(points),
                           [&](Index p) { return blocks.near.mayMove[vertexOf[p]] != 0; });
    }
    sortUnique(points);
    return points;
  }

  /// Within the window of the block, so that those of other blocks of its class may be improved at the same time.
  void improvePlace(Index block, const std::vector<Index>& elements, int reach, ElementRows& rows,
                    std::vector<Index>& changed, std::vector<PoorElement>& gone, std::vector<PoorElement>& found)
  {
    const std::vector<Index> opened = rows.grow(elements, reach);
    std::vector<Index> window;
    std::ranges::set_intersection(rows.grow(opened, rowsBesideOpened), windows.elements[block - blocks.first],
                                  std::back_inserter(window));
    std::vector<Index> vertices;
    const std::vector<Index> all = movingPointsOf(opened);
    const std::vector<char> isAtCut = pointsWhereCut(window);
    std::ranges::transform(all, std::back_inserter(vertices), [&](Index p) { return vertexOf[p]; });
    std::erase_if(vertices, [&](Index vertex) { return isAtCut[vertex] != 0; });
    sortUnique(vertices);
    const auto isOwn = [&](Index vertex) { return std::ranges::binary_search(vertices, vertex); };
    std::vector<Index> points;
    std::ranges::copy_if(all, std::back_inserter(points), [&](Index p) { return isOwn(vertexOf[p]); });
    const PointChanges before = copyStates(states, points, vertexOf);
    apply(copyStates(between, points, vertexOf), states);
    std::ranges::for_each(points, [&](Index p) { done[p] = 0; });
    StopMonitor monitor(context.progress);
    WindowResult result =
        improveWindow(taskOf({window, isOwn}, ImproverPart::finish), settings,
                      {{context.executor, ProgressRange(monitor)}, context.octree, context.model, context.tree});
    std::vector<PoorElement> poorBefore;
    std::ranges::copy_if(poor, std::back_inserter(poorBefore), [&](const PoorElement& one) {
      return std::ranges::any_of(wallPointsOf(one), [&](Index p) { return isOwn(vertexOf[p]); });
    });
    if (result.changes.points.size() == points.size() && result.poor.size() < poorBefore.size())
    {
      take(result.changes);
      changed.insert(changed.end(), points.begin(), points.end());
      gone.insert(gone.end(), poorBefore.begin(), poorBefore.end());
      found.insert(found.end(), result.poor.begin(), result.poor.end());
      replacePoor(poorBefore, result.poor);
    }
    else
    {
      apply(before, states);
    }
    std::ranges::for_each(points, [&](Index p) { done[p] = 1; });
  }

  /// Marks the vertices of some elements that have others, too.
  std::vector<char> pointsWhereCut(const std::vector<Index>& window) const
  {
    std::vector<char> isAtCut(classification.classes.size(), 0);
    for (const Index e : window)
    {
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        const std::int32_t code = plain.neighbors[e][direction];
        for (int i = 0; i < 4 && code >= 0 && !std::ranges::binary_search(window, static_cast<Index>(code)); ++i)
        {
          isAtCut[vertexOf[plain.corners[e][hexahedronFace[direction][i]]]] = 1;
        }
      }
    }
    return isAtCut;
  }

  LayerMesh assembleLayer()
  {
    if (!settings.traits.layered)
    {
      return withoutLayer(std::move(plain));
    }
    std::vector<Index> counts(plain.points.size());
    for (Index p = 0; p < counts.size(); ++p)
    {
      // Where this part of a mesh ends walls may have none.
      counts[p] = states.layers.has(p) ? std::min(states.layers.counts[p], walls.counts[p]) : 0;
    }
    LayerMesh layer = buildLayer(plain, walls, counts, context.executor);
    for (std::size_t i = 0; i < layer.wallPoints.size(); ++i)
    {
      layer.mesh.points[layer.plainPoints + i] = states.layers.aboveOf(layer.wallPoints[i])[layer.places[i] - 1];
    }
    return layer;
  }

  std::vector<Index> failingIn(const LayerMesh& layer) const
  {
    std::vector<Index> failing;
    for (const PoorElement& element : poor)
    {
      // Where this part of a mesh ends stacks may be lower.
      const Index e = element.isPlain() ? element.place : layer.prismOn(element.place, element.height);
      if (element.fails && e != noIndex)
      {
        failing.push_back(e);
      }
    }
    sortUnique(failing);
    return failing;
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
  /// After the first part.
  PointStates between;
  /// By point, whether it was an own one of a block that has taken this part.
  std::vector<char> done;
  std::vector<PoorElement> poor;
};

} // namespace

ImprovedLayer improveBlocks(const MeshingContext& context, const VertexClassification& classification,
                            const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                            const LayerOptions& options, const CurvedWallTargets& curvedWalls, const MeshTraits& traits,
                            const MeshBlocks& blocks, BlockExchange& exchange)
{
  return BlockImprover(context, classification, vertexOf, plain, walls, options, curvedWalls, traits, blocks, exchange)
      .run();
}

} // namespace atria
