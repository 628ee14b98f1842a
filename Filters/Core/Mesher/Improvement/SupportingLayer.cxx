// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/SupportingLayer.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/Straightening.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Width, in wall faces, of the layer around an element that needs one. The layer tapers to nothing in the last.
constexpr int supportRings = 2;

/// True if a point has no layer, but may have one.
bool mayHaveOne(const ImproverState& state, Index p)
{
  return state.excluded[p] && state.walls.counts[p] > 0 && !state.walls.settled.stays(p);
}

/// Marks the points of the plain mesh at which elements get a layer.
std::vector<char> pointsToDouble(const ImproverState& state, const std::vector<Index>& elements)
{
  std::vector<char> chosen(state.layer.plainPoints, 0);
  for (const Index e : elements)
  {
    for (const Index p : state.layer.mesh.corners[e])
    {
      if (!state.layer.isNew(p))
      {
        chosen[p] = mayHaveOne(state, p) ? 1 : 0;
      }
    }
  }
  return chosen;
}

/// Marks the points of faces without requested layers that have a marked one, where they may have a layer.
void widen(const ImproverState& state, std::vector<char>& points)
{
  const std::vector<char> given = points;
  for (const BoundaryFace& face : state.plain.boundaryFaces)
  {
    const std::array<Index, 4> corners = cornersOf(state.plain, face);
    const bool isBeside =
        state.options.isSupporting(face.tag) && std::ranges::any_of(corners, [&](Index p) { return given[p] != 0; });
    for (const Index p : corners)
    {
      points[p] |= isBeside && mayHaveOne(state, p) ? 1 : 0;
    }
  }
}

} // namespace

std::vector<char> pointsToSupport(ImproverState& state)
{
  std::vector<Index> elements = findConcaveAtWalls(state.layer.mesh, state.context);
  std::ranges::transform(badOf(state.findShort(targetsOfSupport(state.traits))), std::back_inserter(elements),
                         &ShortCell::cell);
  std::vector<char> points = pointsToDouble(state, elements);
  if (std::ranges::find(points, 1) == points.end())
  {
    return {};
  }
  for (int ring = 0; ring < supportRings; ++ring)
  {
    widen(state, points);
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
