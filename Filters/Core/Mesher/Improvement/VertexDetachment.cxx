// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/VertexDetachment.h"

#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/SupportingLayer.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <iterator>

namespace atria {

VertexDetachment::VertexDetachment(ImproverState& state, const std::vector<DetachedVertex>& away)
    : state_(state), isOnSide_(state.vertexOf.size(), 0), isLeft_(state.vertexOf.size(), 0), detached_(away)
{
  for (const DetachedVertex& vertex : away)
  {
    isLeft_[vertex.point] = 1;
    left_.push_back({vertex.point, vertex.wanted});
  }
  for (const BoundaryFace& face : state.plain.boundaryFaces)
  {
    for (int i = 0; i < 4 && face.tag >= state.options.surfaceCount(); ++i)
    {
      isOnSide_[state.vertexOf[cornerOf(state.plain, face, i)]] = 1;
    }
  }
}

/// Calls visit(leader) for the points of cells, or those their copies stand on; more than once for some.
template <typename Visit> void VertexDetachment::eachLeaderOf(const std::vector<ShortCell>& cells, Visit&& visit) const
{
  for (const ShortCell& cell : cells)
  {
    for (const Index p : state_.layer.mesh.corners[cell.cell])
    {
      visit(state_.vertexOf[state_.layer.wallPointOf(p)]);
    }
  }
}

std::vector<ShortCell> VertexDetachment::improve(std::vector<ShortCell> cells)
{
  std::erase_if(cells, [&](const ShortCell& cell) { return cell.worst >= first_.below; });
  std::vector<ShortCell> left = state_.run(first_, cells);
  markPoints(state_.layer, left, state_.suspect);
  return left;
}

bool VertexDetachment::improveAndMend()
{
  const std::size_t before = left_.size();
  mend(improve(state_.findShort(first_.options.targets)));
  return left_.size() > before;
}

/// Returns the bad cells that room may help: not those with too few neighbors where layers stay as they are, which is
/// everywhere if they go round boundary edges, and else at cells with all vertices on bare sides of the domain.
std::vector<ShortCell> VertexDetachment::badAmong(const std::vector<ShortCell>& cells) const
{
  std::vector<ShortCell> bad = badOf(cells);
  std::vector<ShortCell> staying;
  std::ranges::copy_if(bad, std::back_inserter(staying), [&](const ShortCell& cell) {
    bool all = true;
    eachLeaderOf({cell}, [&](Index leader) { all = all && (state_.traits.wraps || isOnSide_[leader]); });
    return all;
  });
  if (staying.empty())
  {
    return bad;
  }
  QualityTargets targets = first_.options.targets;
  targets.leastOfDeterminant = std::numeric_limits<double>::infinity();
  const std::vector<ShortCell> otherwise = badOf(state_.findShort(targets));
  const auto contains = [](const std::vector<ShortCell>& list, const ShortCell& cell) {
    return std::ranges::binary_search(list, cell.cell, {}, &ShortCell::cell);
  };
  std::erase_if(bad, [&](const ShortCell& cell) { return contains(staying, cell) && !contains(otherwise, cell); });
  return bad;
}

void VertexDetachment::mend(const std::vector<ShortCell>& cells)
{
  std::vector<ShortCell> bad = badAmong(cells);
  for (const RoomStep step : roomSteps)
  {
    if (bad.empty())
    {
      return;
    }
    if (step == RoomStep::leaveSides && state_.classification.turnedSides.empty())
    {
      return;
    }
    make(step, bad);
    const bool mayMakeOthersBad = step >= RoomStep::goHalfway;
    bad = mayMakeOthersBad ? badOf(state_.findShort(first_.options.targets)) : bad;
    bad = badAmong(improve(bad));
  }
}

void VertexDetachment::make(RoomStep step, const std::vector<ShortCell>& bad)
{
  state_.context.progress.check();
  if (step == RoomStep::exclude)
  {
    if (!state_.traits.wraps) // layers then end nowhere
    {
      exclude(bad);
    }
    return;
  }
  if (step == RoomStep::leaveSides)
  {
    leaveSides();
    return;
  }
  eachLeaderOf(bad, [&](Index leader) {
    step == RoomStep::leaveCurves ? leaveCurve(leader)
                                  : leaveSurface(leader, step == RoomStep::leaveALittle ? smallReach : largeReach);
  });
  if (step == RoomStep::goHalfway || step == RoomStep::startAgain)
  {
    startAgain(bad, step == RoomStep::startAgain ? 1.0 : 0.5);
  }
}

/// Records that a vertex left. Vertices that did not get back may leave again. Vertices detached from the start belong
/// nowhere, and are not recorded.
void VertexDetachment::noteLeft(Index leader)
{
  if (!isLeft_[leader] && state_.wanted.classes[leader] != VertexClass::detached)
  {
    isLeft_[leader] = 1;
    left_.push_back({leader, state_.layer.mesh.points[leader]});
  }
}

void VertexDetachment::leaveCurve(Index leader)
{
  VertexClass& vertexClass = state_.classification.classes[leader];
  if (state_.mayLeave[leader] && vertexClass == VertexClass::curve)
  {
    noteLeft(leader);
    vertexClass = VertexClass::adjacent;
  }
}

/// Lets points of invalid cells leave the sides. Cells with small determinants only are at two sides, and stay.
void VertexDetachment::leaveSides()
{
  QualityTargets valid;
  valid.convex = valid.decomposed = false;
  valid.weight.limit = valid.volumeRatio.limit = 0.0;
  valid.leastOfFaceCosine = valid.leastOfSkewness = valid.leastOfDeterminant = std::numeric_limits<double>::infinity();
  eachLeaderOf(badOf(state_.findShort(valid)), [&](Index leader) {
    if (!state_.walls.settled.stays(leader))
    {
      state_.classification.turnedSides[leader] = 0;
      state_.mayLeave[leader] = 1;
    }
  });
}

/// Lets a vertex leave its surfaces by `reach` times the size of its octant.
void VertexDetachment::leaveSurface(Index leader, double reach)
{
  VertexClass& vertexClass = state_.classification.classes[leader];
  if (!state_.mayLeave[leader] || vertexClass == VertexClass::free)
  {
    return;
  }
  noteLeft(leader);
  vertexClass = VertexClass::detached;
  const Octree& octree = state_.context.octree;
  const double size = octree.frame().sizeOf(octree.level(state_.classification.leaves[leader]));
  double& limit = state_.classification.displacementLimits
                      .try_emplace(leader, DisplacementLimit{state_.layer.mesh.points[leader], 0.0})
                      .first->second.reach;
  // Vertices detached from the start keep their room.
  limit = state_.wanted.classes[leader] == VertexClass::detached ? std::max(limit, reach * size) : reach * size;
}

void VertexDetachment::detach(const std::vector<ShortCell>& cells, double reach)
{
  eachLeaderOf(cells, [&](Index leader) {
    leaveCurve(leader);
    leaveSurface(leader, reach);
  });
}

/// Moves the points of cells toward the centers of their octants by a share of the way.
void VertexDetachment::startAgain(const std::vector<ShortCell>& bad, double share)
{
  std::vector<char> leaders(state_.layer.plainPoints, 0);
  eachLeaderOf(bad, [&](Index leader) { leaders[leader] = 1; });
  std::vector<char> fresh(state_.layer.plainPoints, 0);
  const LayerFreedom freedom(state_);
  for (Index p = 0; p < fresh.size(); ++p)
  {
    const Index leader = state_.vertexOf[p];
    fresh[p] = leaders[leader] && state_.mayLeave[leader] ? 1 : 0;
    if (fresh[p])
    {
      const Vec3 center = freedom.model.centerOf(p);
      state_.layer.mesh.points[p] += share * (center - state_.layer.mesh.points[p]);
      if (const auto found = state_.classification.displacementLimits.find(leader);
          found != state_.classification.displacementLimits.end())
      {
        found->second.origin = center;
      }
    }
  }
  state_.outdateAt(fresh);
  state_.growAgain(fresh);
}

/// Takes the layer away at the points of cells that have it; returns it to cells that are bad without it.
void VertexDetachment::exclude(const std::vector<ShortCell>& bad)
{
  for (const ShortCell& cell : bad)
  {
    const auto& corners = state_.layer.mesh.corners[cell.cell];
    const bool has = std::ranges::any_of(corners, [&](Index p) { return state_.layer.isNew(p); });
    for (const Index p : corners)
    {
      if ((!has || state_.layer.isNew(p)) && !state_.walls.settled.stays(state_.layer.wallPointOf(p)))
      {
        state_.excluded[state_.layer.wallPointOf(p)] = has ? 1 : 0;
      }
    }
  }
  state_.growAgain(std::vector<char>(state_.layer.plainPoints, 0));
}

/// Returns the places where the model wants the vertices that left, as found from where they are.
std::vector<WantedPlace> VertexDetachment::findWantedPlaces()
{
  const std::vector<Vec3>& points = state_.layer.mesh.points;
  ModelConstraints constraints(state_.context, state_.wanted, points, state_.vertexOf);
  const auto isFixed = [&](Index p) { return state_.wanted.classes[state_.vertexOf[p]] == VertexClass::fixed; };
  std::vector<LeftVertex*> sought;
  std::vector<Index> ids;
  for (LeftVertex& vertex : left_)
  {
    if (!isFixed(vertex.point) && vertex.from != points[vertex.point])
    {
      sought.push_back(&vertex);
      ids.push_back(vertex.point);
    }
  }
  constraints.prepare(ids, state_.context);
  state_.context.executor.forEach(sought.size(), 64, [&](std::size_t i) {
    LeftVertex& vertex = *sought[i];
    vertex.from = points[vertex.point];
    vertex.wanted = constraints.nearest(vertex.point, vertex.from, vertex.wanted);
  });
  std::vector<WantedPlace> places(left_.size());
  std::ranges::transform(left_, places.begin(), [](const LeftVertex& vertex) {
    return WantedPlace{vertex.point, vertex.wanted};
  });
  return places;
}

void VertexDetachment::putBack()
{
  if (left_.empty())
  {
    return;
  }
  std::vector<LeftVertex> elsewhere; // outside of the focus
  std::ranges::copy_if(left_, std::back_inserter(elsewhere),
                       [&](const LeftVertex& vertex) { return !state_.focus.empty() && !state_.focus[vertex.point]; });
  std::erase_if(left_, [&](const LeftVertex& vertex) { return !state_.focus.empty() && !state_.focus[vertex.point]; });
  std::ranges::sort(left_, {}, &LeftVertex::point); // for approach()
  const QualityTargets targets = targetsBack(state_.traits);
  for (int round = 1; round <= roundsBack && !left_.empty(); ++round)
  {
    state_.context.progress.check();
    std::vector<Index> changed;
    const std::vector<ShortCell> cells =
        approach(DualSource(state_.layer.mesh), state_.layer.mesh.points, findWantedPlaces(),
                 LayerFreedom(state_).layer, leastPutBack, targets, state_.context, changed);
    state_.outdate(changed);
    const std::size_t before = left_.size();
    keepThoseAway();
    if (before == left_.size() || round == roundsBack)
    {
      break;
    }
    improve(cells);
  }
  left_.insert(left_.end(), elsewhere.begin(), elsewhere.end());
  mend(state_.findShort(first_.options.targets));
  keepThoseAway();
}

void VertexDetachment::keepThoseAway()
{
  std::vector<LeftVertex> away;
  detached_.clear();
  std::ranges::sort(left_, {}, &LeftVertex::point);
  const std::vector<WantedPlace> wanted = findWantedPlaces();
  for (std::size_t i = 0; i < left_.size(); ++i)
  {
    const Index p = left_[i].point;
    const Index vertex = state_.vertexOf[p];
    const Octree& octree = state_.context.octree;
    const double size = octree.frame().sizeOf(octree.level(state_.wanted.leaves[vertex]));
    const bool back = (state_.layer.mesh.points[p] - wanted[i].place).norm() <= coincidentRatio * size;
    state_.classification.classes[vertex] = back ? state_.wanted.classes[vertex] : VertexClass::fixed;
    isLeft_[p] = back ? 0 : 1;
    if (back && !state_.wanted.turnedSides.empty())
    {
      state_.classification.turnedSides[vertex] = state_.wanted.turnedSides[vertex];
    }
    if (!back)
    {
      away.push_back(left_[i]);
      detached_.push_back({p, wanted[i].place});
    }
  }
  left_ = std::move(away);
}

} // namespace atria
