// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/SupportingLayer.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/Straightening.h"

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
        chosen[p] = state.excluded[p] && state.walls.counts[p] > 0 && !state.walls.settled.stays(p) ? 1 : 0;
      }
    }
  }
  return chosen;
}

/// Marks all points that can have a layer of the surfaces that have a face of which all points are marked, but for
/// those of surfaces that have it already: where they have none there is no room.
void markWholeSurfaces(const ImproverState& state, std::vector<char>& points)
{
  std::vector<char> wanted(state.options.surfaceCount(), 0);
  std::vector<char> given(wanted);
  const auto mayHave = [&](Index p) { return state.walls.counts[p] > 0 && !state.walls.settled.stays(p); };
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
    wanted[face.tag] |= std::ranges::all_of(corners, [&](Index p) { return points[p] != 0; }) ? 1 : 0;
    given[face.tag] |= std::ranges::all_of(corners, [&](Index p) { return mayHave(p) && !state.excluded[p]; }) ? 1 : 0;
  });
  eachFace([&](const BoundaryFace& face, const auto& corners) {
    for (const Index p : corners)
    {
      points[p] |= wanted[face.tag] && !given[face.tag] && state.excluded[p] && mayHave(p) ? 1 : 0;
    }
  });
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
  for (Index p = 0; p < points.size(); ++p)
  {
    state.excluded[p] = points[p] ? 0 : state.excluded[p];
  }
  state.growAgain(std::vector<char>(state.layer.plainPoints, 0));
}

void supportMore(ImproverState& state, VertexDetachment& detachment)
{
  const auto count = [](const std::vector<char>& points) { return std::ranges::count(points, 1); };
  std::ptrdiff_t last = std::numeric_limits<std::ptrdiff_t>::max();
  for (std::vector<char> points = pointsToSupport(state); count(points) > 0 && count(points) < last;
       points = pointsToSupport(state))
  {
    last = count(points);
    addSupport(state, points);
    if (detachment.improveAndMend())
    {
      detachment.putBack();
    }
    straightenWhereNeeded(state, detachment);
    state.focus.clear();
  }
}

} // namespace atria
