// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CrackRuns.h"

#include "Surface/Search/Distance.h"

#include <algorithm>
#include <map>

namespace atria {

namespace {

/// Against the octants: how far points left out of a line may be off it; how near another crack is the same.
constexpr double straightRatio = 0.02;
constexpr double sameRatio = 0.3;

/// Steps [begin, end) that follow each other along one edge.
struct Run
{
  std::size_t begin;
  std::size_t end;
  /// The runs that go on from its ends, beyond points of the model.
  std::array<Index, 2> next{noIndex, noIndex};
};

std::vector<Run> findRuns(const std::vector<CrackStep>& steps)
{
  std::vector<Run> runs;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const bool follows =
        i > 0 && steps[i].featureEdge == steps[i - 1].featureEdge && steps[i].step == steps[i - 1].step + 1;
    if (!follows)
    {
      runs.push_back({i, i});
    }
    runs.back().end = i + 1;
  }
  return runs;
}

/// Links runs that reach the same point of the model, where just two do.
void linkRuns(std::vector<Run>& runs, const std::vector<CrackStep>& steps, const SurfaceModel& model)
{
  std::map<Index, std::vector<std::pair<Index, int>>> ends;
  for (Index r = 0; r < runs.size(); ++r)
  {
    const CrackStep& first = steps[runs[r].begin];
    const CrackStep& last = steps[runs[r].end - 1];
    if (first.step == 0)
    {
      ends[model.featureEdges[first.featureEdge].a].emplace_back(r, 0);
    }
    if (last.last)
    {
      ends[model.featureEdges[last.featureEdge].b].emplace_back(r, 1);
    }
  }
  for (const auto& [point, here] : ends)
  {
    if (here.size() == 2)
    {
      runs[here[0].first].next[here[0].second] = here[1].first;
      runs[here[1].first].next[here[1].second] = here[0].first;
    }
  }
}

/// Steps in the order in which they follow each other along boundary edges.
struct Chain
{
  struct Link
  {
    std::size_t step;
    bool forwards;
  };
  std::vector<Link> links;
  bool ring = false;
};

std::vector<Chain> chainRuns(const std::vector<Run>& runs, const std::vector<CrackStep>& steps)
{
  std::vector<Chain> chains;
  std::vector<char> used(runs.size(), 0);
  const auto follow = [&](Index start, int from) {
    Chain& chain = chains.emplace_back();
    Index run = start;
    while (run != noIndex && !used[run])
    {
      used[run] = 1;
      for (std::size_t k = 0; k < runs[run].end - runs[run].begin; ++k)
      {
        chain.links.push_back({from == 0 ? runs[run].begin + k : runs[run].end - 1 - k, from == 0});
      }
      const Index next = runs[run].next[1 - from];
      from = next != noIndex && runs[next].next[0] == run ? 0 : 1;
      run = next;
    }
    chain.ring = run == start;
  };
  // Those with a free end first; what then is left are rings.
  for (Index r = 0; r < runs.size(); ++r)
  {
    if (!used[r] && (runs[r].next[0] == noIndex || runs[r].next[1] == noIndex))
    {
      follow(r, runs[r].next[0] == noIndex ? 0 : 1);
    }
  }
  for (Index r = 0; r < runs.size(); ++r)
  {
    if (!used[r])
    {
      follow(r, 0);
    }
  }
  // A ring begins where it is open.
  for (Chain& chain : chains)
  {
    const auto open = std::find_if(chain.links.begin(), chain.links.end(), [&](auto l) { return steps[l.step].open; });
    if (chain.ring && open != chain.links.end())
    {
      std::rotate(chain.links.begin(), open, chain.links.end());
      chain.links.push_back(chain.links.front());
    }
  }
  return chains;
}

/// Which steps of a chain are open, or so near to one that is that the same dual face covers them.
std::vector<char> openLinks(const Chain& chain, const std::vector<CrackStep>& steps)
{
  constexpr double reachRatio = 0.87; // half of an octant's diagonal
  const std::size_t count = chain.links.size();
  std::vector<char> open(count, 0);
  for (const bool backwards : {false, true})
  {
    double sinceOpen = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::size_t i = backwards ? count - 1 - k : k;
      const CrackStep& step = steps[chain.links[i].step];
      sinceOpen = step.open ? 0.0 : sinceOpen + (step.end - step.begin).norm();
      open[i] |= sinceOpen <= reachRatio * step.size ? 1 : 0;
    }
  }
  return open;
}

/// A crack before its line is thinned out.
struct LongCrack
{
  Crack crack;
  double size = 0.0;
  double length = 0.0;
};

/// The parts of a chain that are open, or those that are closed.
std::vector<LongCrack> partsOf(const Chain& chain, bool wanted, const std::vector<CrackStep>& steps)
{
  const std::vector<char> open = openLinks(chain, steps);
  std::vector<LongCrack> parts;
  for (std::size_t i = 0; i < chain.links.size(); ++i)
  {
    if ((open[i] != 0) != wanted)
    {
      continue;
    }
    const CrackStep& step = steps[chain.links[i].step];
    const bool forwards = chain.links[i].forwards;
    if (i == 0 || open[i - 1] != open[i])
    {
      parts.push_back({{{forwards ? step.begin : step.end}, step.width, step.point, wanted}});
    }
    LongCrack& part = parts.back();
    part.crack.path.push_back(forwards ? step.end : step.begin);
    part.crack.width = std::max(part.crack.width, step.width);
    part.size = std::max(part.size, step.size);
    part.length += (step.end - step.begin).norm();
  }
  return parts;
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
      return (nearestOnSegment(p, all[from], all[to]) - p).norm() <= straightRatio * chain.size;
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

/// Whether every point of a crack lies near one that is told already.
class ToldCracks
{
public:
  bool covers(const LongCrack& chain) const
  {
    const double near = sameRatio * chain.size;
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

} // namespace

std::vector<Crack> joinSteps(const std::vector<CrackStep>& steps, const SurfaceModel& model)
{
  std::vector<Run> runs = findRuns(steps);
  linkRuns(runs, steps, model);
  const std::vector<Chain> chains = chainRuns(runs, steps);
  std::vector<Crack> cracks;
  for (const bool open : {false, true})
  {
    std::vector<LongCrack> found;
    for (const Chain& chain : chains)
    {
      const std::vector<LongCrack> parts = partsOf(chain, open, steps);
      found.insert(found.end(), parts.begin(), parts.end());
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const LongCrack& l, const LongCrack& r) { return l.length > r.length; });
    ToldCracks told;
    for (LongCrack& part : found)
    {
      if (!told.covers(part))
      {
        straighten(part);
        told.add(part.crack.path);
        cracks.push_back(std::move(part.crack));
      }
    }
  }
  return cracks;
}

} // namespace atria
