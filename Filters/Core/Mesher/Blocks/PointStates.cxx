// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/PointStates.h"

#include <algorithm>

namespace atria {

PointStates statesOf(std::vector<Vec3> points, const VertexClassification& classification)
{
  PointStates out;
  out.points = std::move(points);
  out.layers.open(out.points.size());
  out.classes = classification.classes;
  out.turnedSides = classification.turnedSides;
  out.displacementLimits = classification.displacementLimits;
  out.suspect.assign(out.points.size(), 0);
  return out;
}

void giveStates(const PointStates& states, const std::vector<char>& done, Index cutTag, WindowTask& task)
{
  const std::vector<Index>& ids = task.window.pointIds;
  SettledPoints& settled = task.settled;
  settled.open(ids.size());
  settled.atCut = settled.fixed = pointsAtCut(task.window, cutTag);
  task.suspect.resize(ids.size());
  for (Index p = 0; p < ids.size(); ++p)
  {
    task.suspect[p] = states.suspect[ids[p]];
    if (settled.isAtCut(p))
    {
      settled.settle(p, {});
    }
    else if (states.layers.has(ids[p]))
    {
      settled.settle(p, states.layers.aboveOf(ids[p]));
      settled.fixed[p] = done[ids[p]];
    }
  }
  for (Index v = 0; v < task.window.vertexCount(); ++v)
  {
    task.classes.push_back(states.classes[ids[v]]);
    if (!states.turnedSides.empty())
    {
      task.turnedSides.push_back(states.turnedSides[ids[v]]);
    }
    if (const auto found = states.displacementLimits.find(ids[v]); found != states.displacementLimits.end())
    {
      task.displacementLimits.emplace(v, found->second);
    }
    if (const auto found = states.detached.find(ids[v]); found != states.detached.end() && !settled.stays(v))
    {
      task.detached.push_back({v, found->second});
    }
  }
}

PointChanges copyStates(const PointStates& states, const std::vector<Index>& points, const std::vector<Index>& vertexOf)
{
  PointChanges out;
  out.points = points;
  for (const Index p : points)
  {
    const auto above = states.layers.aboveOf(p);
    out.places.push_back(states.points[p]);
    out.counts.push_back(static_cast<Index>(above.size()));
    out.above.insert(out.above.end(), above.begin(), above.end());
    out.suspect.push_back(states.suspect[p]);
    out.classes.push_back(states.classes[vertexOf[p]]);
    if (!states.turnedSides.empty())
    {
      out.turnedSides.push_back(states.turnedSides[vertexOf[p]]);
    }
    if (const auto found = states.displacementLimits.find(p); found != states.displacementLimits.end())
    {
      out.displacementLimits.emplace_back(*found);
    }
    if (const auto found = states.detached.find(p); found != states.detached.end())
    {
      out.detached.push_back({p, found->second});
    }
  }
  return out;
}

void apply(const PointChanges& changes, PointStates& states)
{
  std::size_t first = 0;
  for (std::size_t i = 0; i < changes.points.size(); ++i)
  {
    const Index p = changes.points[i];
    states.points[p] = changes.places[i];
    states.layers.settle(p, std::span(changes.above).subspan(first, changes.counts[i]));
    first += changes.counts[i];
    states.suspect[p] = changes.suspect[i];
    states.detached.erase(p);
    states.displacementLimits.erase(p);
    if (p < states.classes.size())
    {
      states.classes[p] = changes.classes[i];
    }
    if (p < states.turnedSides.size())
    {
      states.turnedSides[p] = changes.turnedSides[i];
    }
  }
  for (const DetachedVertex& vertex : changes.detached)
  {
    states.detached[vertex.point] = vertex.wanted;
  }
  for (const auto& [vertex, limit] : changes.displacementLimits)
  {
    states.displacementLimits[vertex] = limit;
  }
}

} // namespace atria
