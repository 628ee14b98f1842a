// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/SupportingLayer.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/LayerCells.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// The points of the plain mesh at which these elements get a layer now.
std::vector<char> pointsToDouble(const ImproverState& state, const std::vector<Index>& elements)
{
  std::vector<char> chosen(state.layer.plainPoints, 0);
  for (const Index e : elements)
  {
    for (const Index p : state.layer.mesh.corners[e])
    {
      if (!state.layer.isNew(p))
      {
        chosen[p] = state.excluded[p] && state.walls.counts[p] > 0 ? 1 : 0;
      }
    }
  }
  return chosen;
}

/// Marks all points that can have a layer of the surfaces that have a face with marked points only.
void markWholeSurfaces(const ImproverState& state, std::vector<char>& points)
{
  std::vector<char> surfaces(state.options.surfaceCount(), 0);
  const auto eachFace = [&](auto&& visit) {
    for (const BoundaryFace& face : state.plain.boundaryFaces)
    {
      if (face.tag < state.options.surfaceCount() && state.options.isSupporting(face.tag))
      {
        visit(face, cornersOf(state.plain, face));
      }
    }
  };
  eachFace([&](const BoundaryFace& face, const auto& corners) {
    surfaces[face.tag] |= std::ranges::all_of(corners, [&](Index p) { return points[p] != 0; }) ? 1 : 0;
  });
  eachFace([&](const BoundaryFace& face, const auto& corners) {
    for (const Index p : corners)
    {
      points[p] |= surfaces[face.tag] && state.excluded[p] && state.walls.counts[p] > 0 ? 1 : 0;
    }
  });
}

/// Points of the plain mesh that are marked get a copy where they had none.
void doublePoints(ImproverState& state, const std::vector<char>& points)
{
  for (Index p = 0; p < points.size(); ++p)
  {
    state.excluded[p] = points[p] ? 0 : state.excluded[p];
  }
  state.growAgain(std::vector<char>(state.layer.plainPoints, 0));
}

} // namespace

std::vector<char> pointsToSupport(ImproverState& state)
{
  std::vector<Index> elements = findConcaveAtWalls(state.layer.mesh, state.context);
  std::ranges::transform(badOf(state.findShort(targetsOfSupport(state.traits))), std::back_inserter(elements),
                         &ShortCell::cell);
  std::vector<char> points = pointsToDouble(state, elements);
  markWholeSurfaces(state, points);
  if (std::ranges::find(points, 1) == points.end())
  {
    points.clear();
  }
  return points;
}

void addSupport(ImproverState& state, const std::vector<char>& points)
{
  if (points.empty())
  {
    return;
  }
  state.focus.assign(state.layer.plainPoints, 0);
  doublePoints(state, points);
}

void widenSupport(ImproverState& state, const std::vector<ShortCell>& cells)
{
  std::vector<char> marked(state.layer.plainPoints, 0);
  markPoints(state.layer, cells, marked);
  std::vector<Index> about;
  for (Index e = 0; e < state.layer.mesh.elementCount(); ++e)
  {
    const auto& corners = state.layer.mesh.corners[e];
    if (std::ranges::any_of(corners, [&](Index p) { return marked[state.layer.wallPointOf(p)] != 0; }))
    {
      about.push_back(e);
    }
  }
  doublePoints(state, pointsToDouble(state, about));
}

} // namespace atria
