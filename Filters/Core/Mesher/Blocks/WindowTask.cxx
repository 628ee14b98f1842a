// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/WindowTask.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Copies the states of a window's points to the improver's state.
void giveStates(const WindowTask& task, ImproverState& state)
{
  state.suspect = task.suspect;
  state.classification.classes = task.classes;
  for (Index v = 0; v < task.turnedSides.size(); ++v)
  {
    const bool hasLeft = task.window.classification.turnedSides[v] != 0 && task.turnedSides[v] == 0;
    state.mayLeave[v] = (state.mayLeave[v] || hasLeft) && !task.settled.stays(v);
  }
  state.classification.turnedSides = task.turnedSides;
  state.classification.displacementLimits = task.displacementLimits;
}

class WindowImprover
{
public:
  WindowImprover(WindowTask& windowTask, const WindowSettings& windowSettings, const MeshingContext& context)
      : task(windowTask), settings(windowSettings), walls(wallsOf(context)),
        state(context, task.window.classification, task.window.vertexOf, task.window.mesh, walls, settings.options,
              settings.traits)
  {
    giveStates(task, state);
  }

  WindowResult run()
  {
    LayerImprover improver(state, settings.curvedWalls, task.detached);
    task.part == ImproverPart::whole ? improver.improveWhole() : improver.finish();
    WindowResult result;
    for (Index p = 0; p < task.isOwn.size(); ++p)
    {
      if (isTaken(p))
      {
        addChange(p, result.changes);
      }
    }
    for (const DetachedVertex& vertex : improver.detached())
    {
      if (isTaken(vertex.point))
      {
        result.changes.detached.push_back({task.window.pointIds[vertex.point], vertex.wanted});
      }
    }
    if (task.part != ImproverPart::whole)
    {
      result.poor = findPoor();
    }
    return result;
  }

private:
  LayerWalls wallsOf(const MeshingContext& context) const
  {
    LayerWalls out = findLayerWalls(task.window.mesh, settings.options, context);
    out.counts = task.counts;
    out.settled = task.settled;
    out.settled.areDivided = task.part == ImproverPart::mend;
    return out;
  }

  bool isTaken(Index p) const { return task.isOwn[p] && !task.settled.stays(p); }

  void addChange(Index p, PointChanges& out) const
  {
    const LayerMesh& layer = state.layer;
    const Index copy = layer.copies[p];
    const Index count = copy == noIndex ? 0 : layer.places[copy - layer.plainPoints];
    const Index vertex = task.window.vertexOf[p];
    out.points.push_back(task.window.pointIds[p]);
    out.places.push_back(layer.mesh.points[p]);
    out.counts.push_back(count);
    for (Index i = count; i > 0; --i)
    {
      out.above.push_back(layer.mesh.points[copy + 1 - i]);
    }
    out.suspect.push_back(state.suspect[p]);
    out.classes.push_back(state.classification.classes[vertex]);
    if (!state.classification.turnedSides.empty())
    {
      out.turnedSides.push_back(state.classification.turnedSides[vertex]);
    }
    if (const auto found = state.classification.displacementLimits.find(p);
        found != state.classification.displacementLimits.end())
    {
      out.displacementLimits.emplace_back(task.window.pointIds[p], found->second);
    }
  }

  std::vector<PoorElement> findPoor()
  {
    const std::vector<Index> failing = findFailing(state);
    std::vector<Index> all = failing;
    std::ranges::transform(state.findShort(targetsOfLargestAngle(settings.traits), 0.0F), std::back_inserter(all),
                           &ShortCell::cell);
    sortUnique(all);
    std::erase_if(all, [&](Index e) { return !isJudged(e); });
    std::vector<PoorElement> poor;
    for (const Index e : all)
    {
      const Index prism = e - state.layer.plainElements;
      const bool fails = std::ranges::binary_search(failing, e);
      poor.push_back(e < state.layer.plainElements ? PoorElement{task.window.elementIds[e], noIndex, fails}
                                                   : PoorElement{task.window.faceIds[state.layer.wallFaces[prism]],
                                                                 state.layer.heights[prism], fails});
    }
    return poor;
  }

  /// True if an element has own points and all its other points are fixed, but none is at the cut.
  bool isJudged(Index element) const
  {
    bool hasOwn = false;
    for (const Index corner : state.layer.mesh.corners[element])
    {
      const Index p = state.layer.wallPointOf(corner);
      if (task.settled.isAtCut(p) || (!task.isOwn[p] && !task.settled.stays(p)))
      {
        return false;
      }
      hasOwn = hasOwn || task.isOwn[p];
    }
    return hasOwn;
  }

  WindowTask& task;
  const WindowSettings& settings;
  LayerWalls walls;
  ImproverState state;
};

} // namespace

WindowResult improveWindow(WindowTask task, const WindowSettings& settings, const MeshingContext& context)
{
  return task.window.elementIds.empty() ? WindowResult() : WindowImprover(task, settings, context).run();
}

void append(const PointChanges& more, PointChanges& changes)
{
  const auto add = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  add(more.points, changes.points);
  add(more.places, changes.places);
  add(more.counts, changes.counts);
  add(more.above, changes.above);
  add(more.classes, changes.classes);
  add(more.turnedSides, changes.turnedSides);
  add(more.suspect, changes.suspect);
  add(more.displacementLimits, changes.displacementLimits);
  add(more.detached, changes.detached);
}

} // namespace atria
