// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Cracks.h"

#include "Dual/Zones/CrackClosing.h"
#include "Support/GlobalCount.h"
#include "Surface/Search/Distance.h"

#include <algorithm>

namespace atria {

namespace {

/// Distance in octants by which points that are left out of a line may be off it.
constexpr double straightness = 0.02;
/// Distance in octants within which two cracks are the same.
constexpr double sameDistance = 0.3;
/// Distance in octants, half of a diagonal, that the dual face of an edge that passes a gap reaches along it.
constexpr double dualFaceReach = 0.87;

/// A step along a boundary edge, at a place among the edge's `count` steps, and the gap there.
struct CrackStep
{
  enum Kind : std::uint8_t
  {
    none,
    closed,
    open
  };

  Kind kind = none;
  Index edge = noIndex;
  Index place = 0;
  Index count = 1;
  /// Ends of the step, moved halfway across the gap.
  Vec3 begin = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  double width = 0.0;
  double octantSize = 0.0;
  Index point = noIndex;

  double length() const { return (end - begin).norm(); }
};

/// Finds the steps of boundary edges that are gaps and have their middle in an own leaf.
class StepFinder
{
public:
  StepFinder(const BoundaryGaps& g, const Zones& z, const std::vector<char>& k, const GridPlaces& places,
             const GridPart& own)
      : gaps(g), zones(z), kept(k), grid(places), part(own), frame(places.octree().frame())
  {
  }

  /// Returns the steps of an edge that are gaps, from a to b.
  std::vector<CrackStep> stepsOf(Index edge, PassageFinder& passages) const
  {
    const auto count = static_cast<Index>(std::max<std::size_t>(gaps.stations[edge].size(), 1) - 1);
    std::vector<CrackStep> steps;
    for (Index i = 0; i < count; ++i)
    {
      CrackStep step = stepOf(edge, i, passages);
      if (step.kind != CrackStep::none)
      {
        step.count = count;
        steps.push_back(step);
      }
    }
    return steps;
  }

private:
  CrackStep stepOf(Index edge, Index i, PassageFinder& passages) const
  {
    const BoundaryStation& from = gaps.stations[edge][i];
    const BoundaryStation& to = gaps.stations[edge][i + 1];
    const std::vector<BridgeTriangle> bridge = gaps.bridge(edge, i, 1.0);
    const Vec3 begin = frame.toModel(from.at);
    const Vec3 end = frame.toModel(to.at);
    const LatticePoint middle = frame.toLattice(0.5 * (begin + end));
    const Index point = bridge.empty() || !frame.inDomain(middle) ? noIndex : keptCorner(grid.octree().leafAt(middle));
    if (point == noIndex)
    {
      return {};
    }
    const bool isOpen = std::ranges::any_of(bridge, [&](const BridgeTriangle& triangle) {
      return !passages.through(triangle, gaps.boundary.edges()[edge].triangle).empty();
    });
    const double unit = frame.latticeUnit();
    CrackStep step;
    step.kind = isOpen ? CrackStep::open : CrackStep::closed;
    step.edge = edge;
    step.place = i;
    step.begin = begin + 0.5 * unit * *from.across;
    step.end = end + 0.5 * unit * *to.across;
    step.width = unit * std::max(from.across->norm(), to.across->norm());
    step.octantSize = unit * std::max(from.octantSize, to.octantSize);
    step.point = point;
    return step;
  }

  Index keptCorner(Index leaf) const
  {
    if (!part.leaves().contains(leaf))
    {
      return noIndex;
    }
    const auto& corners = grid.points().atCorner[leaf];
    const auto found =
        std::ranges::find_if(corners, [&](Index point) { return point != noIndex && kept[zones.ofPoint[point]] != 0; });
    return found == corners.end() ? noIndex : *found;
  }

  const BoundaryGaps& gaps;
  const Zones& zones;
  const std::vector<char>& kept;
  const GridPlaces& grid;
  const GridPart& part;
  const GridFrame& frame;
};

/// Opens closed steps that are so near to an open one that the same dual face covers them.
void spreadOpenness(std::vector<CrackStep>& steps, bool isRing)
{
  std::vector<char> isNear(steps.size(), 0);
  const std::size_t turns = (isRing ? 2 : 1) * steps.size();
  for (const bool backwards : {false, true})
  {
    double sinceOpen = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < turns; ++k)
    {
      const std::size_t i = backwards ? steps.size() - 1 - k % steps.size() : k % steps.size();
      const CrackStep& step = steps[i];
      sinceOpen = step.kind == CrackStep::open ? 0.0 : sinceOpen + step.length();
      sinceOpen = step.kind == CrackStep::none ? std::numeric_limits<double>::infinity() : sinceOpen;
      isNear[i] |= sinceOpen <= dualFaceReach * step.octantSize ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    steps[i].kind = isNear[i] ? CrackStep::open : steps[i].kind;
  }
}

/// A crack before its line is thinned out.
struct LongCrack
{
  Crack crack;
  double octantSize = 0.0;
  double length = 0.0;

  void add(const CrackStep& step)
  {
    crack.path.push_back(step.end);
    crack.width = std::max(crack.width, step.width);
    octantSize = std::max(octantSize, step.octantSize);
    length += step.length();
  }
};

/// Adds the cracks along a run of boundary edges.
void addCracks(const BoundaryEdges::Run& run, const std::vector<std::vector<CrackStep>>& stepsOfEdge,
               std::vector<LongCrack>& cracks)
{
  std::vector<CrackStep> steps;
  for (const auto& [edge, forward] : run.links)
  {
    const std::size_t first = steps.size();
    steps.insert(steps.end(), stepsOfEdge[edge].begin(), stepsOfEdge[edge].end());
    if (!forward)
    {
      std::reverse(steps.begin() + first, steps.end());
      std::for_each(steps.begin() + first, steps.end(), [](CrackStep& step) { std::swap(step.begin, step.end); });
    }
  }
  spreadOpenness(steps, run.isRing);
  if (run.isRing)
  {
    // A ring begins where its kind changes.
    const auto change = std::ranges::adjacent_find(steps, std::ranges::not_equal_to(), &CrackStep::kind);
    // Clang 14 cannot compile std::ranges::rotate of this library.
    std::rotate(steps.begin(), change == steps.end() ? steps.begin() : std::next(change), steps.end());
  }
  CrackStep::Kind last = CrackStep::none;
  for (const CrackStep& step : steps)
  {
    if (step.kind != CrackStep::none)
    {
      if (step.kind != last)
      {
        cracks.push_back({{{step.begin}, step.width, step.point, step.kind == CrackStep::open}});
      }
      cracks.back().add(step);
    }
    last = step.kind;
  }
}

/// Leaves out points that lie on the line between their neighbors.
void straighten(LongCrack& chain)
{
  const std::vector<Vec3>& all = chain.crack.path;
  std::vector<Vec3> out{all.front()};
  std::size_t from = 0;
  for (std::size_t to = 2; to < all.size(); ++to)
  {
    const bool straight = std::all_of(all.begin() + from + 1, all.begin() + to, [&](const Vec3& p) {
      return (nearestOnSegment(p, all[from], all[to]) - p).norm() <= straightness * chain.octantSize;
    });
    if (!straight)
    {
      from = to - 1;
      out.push_back(all[from]);
    }
  }
  out.push_back(all.back());
  chain.crack.path = std::move(out);
}

/// Cracks reported so far, to skip those whose every point lies near one of them.
class ToldCracks
{
public:
  bool covers(const LongCrack& chain) const
  {
    const double near = sameDistance * chain.octantSize;
    Box3 box;
    for (const Vec3& p : chain.crack.path)
    {
      box.extend(p);
    }
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      if ((boxes[i].min.array() <= box.max.array() + near).all() &&
          (boxes[i].max.array() >= box.min.array() - near).all())
      {
        candidates.push_back(i);
      }
    }
    return std::all_of(chain.crack.path.begin(), chain.crack.path.end(), [&](const Vec3& p) {
      return std::any_of(candidates.begin(), candidates.end(),
                         [&](std::size_t i) { return isNear(p, lines[i], near); });
    });
  }

  void add(const std::vector<Vec3>& line)
  {
    Box3& box = boxes.emplace_back();
    for (const Vec3& p : line)
    {
      box.extend(p);
    }
    lines.push_back(line);
  }

private:
  static bool isNear(const Vec3& p, const std::vector<Vec3>& line, double near)
  {
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      if ((nearestOnSegment(p, line[i - 1], line[i]) - p).norm() <= near)
      {
        return true;
      }
    }
    return false;
  }

  std::vector<Box3> boxes;
  std::vector<std::vector<Vec3>> lines;
};

/// Returns the steps that are gaps in zones that are kept.
std::vector<CrackStep> findSteps(const BoundaryGaps& gaps, const StepFinder& finder, const Crossings& crossings,
                                 const GridPlaces& grid, const MeshingContext& context)
{
  std::vector<std::vector<CrackStep>> stepsOfEdge(gaps.stations.size());
  forBoundaryEdges(gaps, crossings, grid, context,
                   [&](Index edge, PassageFinder& passages) { stepsOfEdge[edge] = finder.stepsOf(edge, passages); });
  std::vector<CrackStep> steps;
  for (const std::vector<CrackStep>& some : stepsOfEdge)
  {
    steps.insert(steps.end(), some.begin(), some.end());
  }
  return steps;
}

/// Joins steps, which may be in any order, to cracks. Points are those of the steps.
std::vector<Crack> joinSteps(const BoundaryEdges& boundary, const std::vector<CrackStep>& steps)
{
  std::vector<std::vector<CrackStep>> stepsOfEdge(boundary.edges().size(), std::vector<CrackStep>(1));
  for (const CrackStep& step : steps)
  {
    stepsOfEdge[step.edge].resize(step.count);
    stepsOfEdge[step.edge][step.place] = step;
  }
  std::vector<LongCrack> found;
  for (const BoundaryEdges::Run& run : boundary.runs())
  {
    addCracks(run, stepsOfEdge, found);
  }
  std::ranges::stable_sort(found, [](const LongCrack& l, const LongCrack& r) {
    return std::tuple(l.crack.open, -l.length) < std::tuple(r.crack.open, -r.length);
  });
  std::vector<Crack> cracks;
  std::array<ToldCracks, 2> told;
  for (LongCrack& chain : found)
  {
    ToldCracks& alike = told[chain.crack.open ? 1 : 0];
    if (!alike.covers(chain))
    {
      straighten(chain);
      alike.add(chain.crack.path);
      cracks.push_back(std::move(chain.crack));
    }
  }
  return cracks;
}

} // namespace

std::vector<Crack> findCracks(const BoundaryGaps& gaps, const Zones& zones, const std::vector<char>& kept,
                              const Crossings& crossings, const GridPlaces& grid, const GridPart& part,
                              const MeshingContext& context)
{
  std::vector<CrackStep> steps = findSteps(gaps, StepFinder(gaps, zones, kept, grid, part), crossings, grid, context);
  std::vector<Index> points(steps.size());
  std::ranges::transform(steps, points.begin(), &CrackStep::point);
  // A step has its number among those of all processes in place of its point, until the point's owner sets it.
  const auto first = static_cast<Index>(countBefore(steps.size(), part.exchange()).before);
  for (Index i = 0; i < steps.size(); ++i)
  {
    steps[i].point = first + i;
  }
  std::vector<Crack> cracks = joinSteps(gaps.boundary, joinAll(part.exchange(), std::move(steps)));
  std::vector<AtPoint<Index>> own;
  for (Index i = 0; i < cracks.size(); ++i)
  {
    const Index step = std::exchange(cracks[i].point, noIndex);
    if (step >= first && step - first < points.size())
    {
      own.push_back({points[step - first], i});
    }
  }
  for (const auto& [point, crack] : part.send(own))
  {
    cracks[crack].point = point;
  }
  return cracks;
}

} // namespace atria
