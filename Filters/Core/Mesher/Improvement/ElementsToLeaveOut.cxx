// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ElementsToLeaveOut.h"

#include "Mesher/Improvement/PartialMesh.h"
#include "Quality/Unions/JudgedUnions.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace atria {

namespace {

/// Rows of elements around those that fail: unions reach one row, and the cells they are judged by one more.
constexpr int judgedRows = 2;
constexpr int rows = judgedRows + 1;
/// Largest number of rounds, in each of which elements that fail beside those left out are left out, too: rows of
/// elements along an edge go one after the other.
constexpr int mostRounds = 12;

/// Adds elements to a sorted list.
void add(const std::vector<Index>& elements, std::vector<Index>& list)
{
  list.insert(list.end(), elements.begin(), elements.end());
  sortUnique(list);
}

/// Distance of elements from some others, in rows.
using Rows = std::map<Index, int>;

Rows rowsAbout(const DualMesh& mesh, const std::vector<Index>& elements)
{
  Rows rowOf;
  std::vector<Index> last = elements;
  for (const Index e : elements)
  {
    rowOf.emplace(e, 0);
  }
  for (int row = 1; row <= rows; ++row)
  {
    std::vector<Index> next;
    for (const Index e : last)
    {
      for (const std::int32_t code : mesh.neighbors[e])
      {
        if (code >= 0 && rowOf.emplace(static_cast<Index>(code), row).second)
        {
          next.push_back(static_cast<Index>(code));
        }
      }
    }
    last = std::move(next);
  }
  return rowOf;
}

/// Returns groups of elements that are near each other, each sorted.
std::vector<std::vector<Index>> placesOf(const DualMesh& mesh, const std::vector<Index>& elements)
{
  UnionFind sets(elements.size());
  std::map<Index, Index> holders;
  for (Index i = 0; i < elements.size(); ++i)
  {
    for (const auto& [element, row] : rowsAbout(mesh, {elements[i]}))
    {
      sets.join(holders.emplace(element, i).first->second, i);
    }
  }
  std::map<Index, std::vector<Index>> byRoot;
  for (Index i = 0; i < elements.size(); ++i)
  {
    byRoot[sets.find(i)].push_back(elements[i]);
  }
  std::vector<std::vector<Index>> places;
  std::ranges::transform(byRoot, std::back_inserter(places), [](const auto& entry) { return entry.second; });
  return places;
}

std::set<Index> elementsAtZoneFaces(const DualMesh& mesh)
{
  std::set<Index> elements;
  for (const ZoneFace& face : mesh.zoneFaces)
  {
    elements.insert(face.element);
    if (const std::int32_t code = mesh.neighbors[face.element][face.direction]; code >= 0)
    {
      elements.insert(static_cast<Index>(code));
    }
  }
  return elements;
}

/// Returns elements with several faces on one side of a surface. Faces in one plane are written as one.
std::vector<Index> elementsWithUnions(const DualMesh& mesh)
{
  std::vector<std::tuple<Index, Index, SheetSide>> patches; // one of each face, sorted by element
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    patches.emplace_back(face.element, face.tag, face.side);
  }
  std::ranges::sort(patches);
  std::vector<Index> elements;
  for (std::size_t i = 1; i < patches.size(); ++i)
  {
    if (patches[i] == patches[i - 1])
    {
      elements.push_back(std::get<0>(patches[i]));
    }
  }
  return elements;
}

/// Failures in a part of a mesh as it is written.
struct JudgedPart
{
  std::size_t count = 0;      ///< number of written cells that fail
  std::vector<Index> firsts;  ///< the first element in each of these
  std::vector<Index> failing; ///< all elements in these, sorted
  std::vector<Index> alone;   ///< elements in these that also fail before cells are merged
};

/// Judges elements as they are written without some of them.
class PartJudge
{
public:
  PartJudge(const DualMesh& whole, const RunContext& within) : mesh(whole), context(within) {}

  /// Judges the surroundings of some elements when these are left out.
  JudgedPart judge(const std::vector<Index>& about, const std::vector<Index>& leftOut) const
  {
    const Rows rowOf = rowsAbout(mesh, about);
    std::vector<Index> elements;
    for (const auto& [element, row] : rowOf)
    {
      if (!std::ranges::binary_search(leftOut, element))
      {
        elements.push_back(element);
      }
    }
    const PartialMesh part = makePartialMesh(mesh, elements, leftOut);
    // Cells beyond the part are not whole.
    std::vector<Index> beyond(part.mesh.cellCount - elements.size());
    std::iota(beyond.begin(), beyond.end(), static_cast<Index>(elements.size()));
    const std::vector<Index> written = failingCells(part, {.keptCells = beyond});
    if (std::ranges::all_of(written, [](Index cell) { return cell == noIndex; }))
    {
      return {};
    }
    const std::vector<Index> single = failingCells(part, {.mergeCells = false});
    JudgedPart judged;
    std::set<Index> cells;
    for (Index i = 0; i < elements.size(); ++i)
    {
      if (written[i] != noIndex && rowOf.at(elements[i]) <= judgedRows)
      {
        judged.failing.push_back(elements[i]);
        if (cells.insert(written[i]).second)
        {
          judged.firsts.push_back(elements[i]);
        }
        if (single[i] != noIndex)
        {
          judged.alone.push_back(elements[i]);
        }
      }
    }
    judged.count = cells.size();
    return judged;
  }

private:
  /// Returns for each element of a part the written cell that it is in if that fails; else noIndex.
  std::vector<Index> failingCells(const PartialMesh& part, const UnionOptions& options) const
  {
    SilentMonitor silent;
    const RunContext quiet{context.executor, ProgressRange(silent)};
    const JudgedMesh written = uniteAndJudge([&] { return part.mesh; }, part.patchOf, options, quiet);
    context.progress.check();
    std::vector<std::uint32_t> fails = failedErrorsOfCells(measureMesh(written.mesh, quiet), written.verdict);
    for (std::size_t i = 0; i < written.added.size(); ++i)
    {
      fails[written.added[i]] |= fails[written.pyramid(i)];
    }
    std::vector<Index> cells(part.mesh.cellCount);
    for (Index i = 0; i < cells.size(); ++i)
    {
      const Index cell = written.cellOf.empty() ? i : written.cellOf[i];
      cells[i] = fails[cell] != 0 ? cell : noIndex;
    }
    return cells;
  }

  const DualMesh& mesh;
  const RunContext& context;
};

/// Elements that fail near each other, and the search for what to leave out among them.
class Place
{
public:
  /// Elements in `leftOut` are left out already. Elements in `zones` stay: face zones need elements on both sides.
  Place(const DualMesh& mesh, const std::vector<Index>& failing, const std::vector<Index>& leftOut,
        const std::set<Index>& zones, const PartJudge& judge)
      : mesh_(mesh), failing_(failing), leftOutBefore_(leftOut), zones_(zones), judge_(judge)
  {
  }

  /// Returns the elements to leave out, sorted. Elements at sides of the domain go only if others do not help.
  std::vector<Index> leaveOut(bool sidesToo)
  {
    Found best;
    for (const bool atSides : {false, true})
    {
      for (const bool wholeUnions : {false, true})
      {
        const bool isAllowed = !atSides || (sidesToo && best.isAtSides);
        if (best.fails == 0 || !isAllowed)
        {
          return best.elements;
        }
        Found found = search(atSides, wholeUnions);
        best.isAtSides = best.isAtSides || found.isAtSides;
        if (found.fails < best.fails)
        {
          std::swap(found.elements, best.elements);
          best.fails = found.fails;
        }
      }
    }
    return best.elements;
  }

private:
  struct Found
  {
    std::vector<Index> elements;
    std::size_t fails = noIndex; ///< number of written cells that still fail
    bool isAtSides = false;      ///< true if elements at sides of the domain failed by themselves
  };

  /// Leaves out elements that fail, and in further rounds those that fail because of that. From unions it takes all
  /// elements, or those that fail by themselves.
  Found search(bool atSides, bool wholeUnions)
  {
    atSides_ = atSides;
    Found best;
    std::vector<Index> leftOut = leftOutBefore_;
    std::vector<Index> about = failing_;
    for (int round = 0; round <= mostRounds; ++round)
    {
      const JudgedPart judged = judge_.judge(about, leftOut);
      best.isAtSides = best.isAtSides || std::ranges::any_of(judged.alone, [&](Index e) { return isAtSide(e); });
      if (judged.count < best.fails)
      {
        best.elements = leftOut;
        best.fails = judged.count;
      }
      const std::vector<Index> next = toLeaveOut(judged, wholeUnions, leftOut);
      if (next.empty())
      {
        break;
      }
      add(next, leftOut);
      add(next, about);
    }
    return best;
  }

  /// Returns the elements to leave out next, the first of these sets that is not empty:
  /// - elements at walls that fail by themselves, or all that fail;
  /// - failing elements beside others that are left out;
  /// - the elements at a wall that are nearest to failing ones, which brings these to the wall.
  std::vector<Index> toLeaveOut(const JudgedPart& judged, bool wholeUnions, const std::vector<Index>& leftOut) const
  {
    const auto onlyThat = [&](std::vector<Index> elements, auto&& isWanted) {
      std::erase_if(elements, [&](Index e) { return !canBeLeftOut(e, leftOut) || !isWanted(e); });
      return elements;
    };
    std::vector<Index> found = onlyThat(wholeUnions ? judged.failing : judged.alone, [](Index) { return true; });
    if (found.empty())
    {
      found = onlyThat(judged.failing, [&](Index e) { return isBeside(e, leftOut); });
    }
    std::vector<Index> ring = judged.failing;
    for (int row = 1; row <= judgedRows && found.empty(); ++row)
    {
      ring = neighborsOf(ring);
      found = onlyThat(ring, [&](Index e) { return !std::ranges::binary_search(leftOut, e); });
      // One way to the failing elements is enough from farther away.
      found.resize(row == 1 ? found.size() : std::min<std::size_t>(found.size(), 1));
    }
    return found;
  }

  std::vector<Index> neighborsOf(const std::vector<Index>& elements) const
  {
    std::vector<Index> neighbors;
    for (const Index e : elements)
    {
      std::ranges::copy_if(mesh_.neighbors[e], std::back_inserter(neighbors),
                           [](std::int32_t code) { return code >= 0; });
    }
    sortUnique(neighbors);
    return neighbors;
  }

  bool isBeside(Index element, const std::vector<Index>& leftOut) const
  {
    return std::ranges::any_of(mesh_.neighbors[element], [&](std::int32_t code) {
      return code >= 0 && std::ranges::binary_search(leftOut, static_cast<Index>(code));
    });
  }

  /// True if an element is at a side of the domain, but at no wall.
  bool isAtSide(Index element) const
  {
    const Index wall = wallOf(mesh_, element);
    return wall != noIndex && mesh_.boundaryFaces[wall].onDomainSide;
  }

  /// True if an element is at a wall, or beside elements that are left out.
  bool canBeLeftOut(Index element, const std::vector<Index>& leftOut) const
  {
    const bool isAtWall = wallOf(mesh_, element) != noIndex && (atSides_ || !isAtSide(element));
    return !zones_.contains(element) && (isAtWall || isBeside(element, leftOut));
  }

  const DualMesh& mesh_;
  const std::vector<Index>& failing_;
  const std::vector<Index>& leftOutBefore_;
  const std::set<Index>& zones_;
  const PartJudge& judge_;
  bool atSides_ = false;
};

} // namespace

std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          const RunContext& context)
{
  LeaveOutExchange whole;
  return findElementsToLeaveOut(mesh, failing, sidesToo, whole, context);
}

std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          LeaveOutExchange& exchange, const RunContext& context)
{
  const PartJudge judge(mesh, context);
  std::vector<Index> about = failing;
  add(elementsWithUnions(mesh), about);
  std::erase_if(about, [&](Index e) { return !exchange.isSeen(e); });
  std::vector<Index> best;
  if (exchange.sum(about.size()) == 0)
  {
    return best;
  }
  const std::set<Index> zones = elementsAtZoneFaces(mesh);
  std::size_t least = noIndex;
  for (std::vector<Index> leftOut;;)
  {
    const JudgedPart judged = judge.judge(about, leftOut);
    const std::size_t count = exchange.sum(
        static_cast<std::size_t>(std::ranges::count_if(judged.firsts, [&](Index e) { return exchange.isOwn(e); })));
    if (count >= least)
    {
      return best;
    }
    best = leftOut;
    least = count;
    // Places are searched one by one. Elements left out at two of them may make others between fail.
    for (const std::vector<Index>& place : placesOf(mesh, judged.failing))
    {
      add(Place(mesh, place, best, zones, judge).leaveOut(sidesToo), leftOut);
    }
    std::erase_if(leftOut, [&](Index e) { return !exchange.isOwn(e); });
    leftOut = exchange.all(leftOut);
    add(leftOut, about);
  }
}

} // namespace atria
