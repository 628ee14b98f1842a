// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ElementsToLeaveOut.h"

#include "Mesher/Improvement/PartialMesh.h"
#include "Quality/Unions/JudgedUnions.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace atria {

namespace {

/// Rows of elements about those that fail: unions reach one row, and what they are judged by another one.
constexpr int judgedRows = 2;
constexpr int rows = judgedRows + 1;
/// How often what comes to fail beside elements that are left out is left out, too: rows of elements along an edge go
/// one after the other.
constexpr int mostRounds = 12;

/// By element, how many rows away from some elements it is.
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

/// Elements that are near each other, each time in order.
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

/// Elements of a place at which something is to be left out.
class Place
{
public:
  /// Elements at `zones` have a face of a face zone, which has elements on both sides.
  Place(const DualMesh& mesh, const std::vector<Index>& failing, const std::set<Index>& zones,
        const RunContext& context)
      : mesh_(mesh), failing_(failing), zones_(zones), context_(context)
  {
  }

  /// Those at sides of the domain go only where others do not help, if at all.
  std::vector<Index> leaveOut(bool sidesToo)
  {
    Found found = search(false);
    if (found.fails > 0 && found.isAtSides && sidesToo)
    {
      Found more = search(true);
      if (more.fails < found.fails)
      {
        return more.elements;
      }
    }
    return found.elements;
  }

private:
  struct Found
  {
    std::vector<Index> elements;
    std::size_t fails = noIndex; ///< written cells that still do
    bool isAtSides = false;      ///< whether elements at sides of the domain failed by themselves
  };

  Found search(bool atSides)
  {
    atSides_ = atSides;
    Found best;
    std::vector<Index> leftOut;
    for (int round = 0; round <= mostRounds; ++round)
    {
      const Judged judged = judge(leftOut);
      best.isAtSides = best.isAtSides || std::ranges::any_of(judged.alone, [&](Index e) { return isAtSide(e); });
      if (judged.count < best.fails)
      {
        best.elements = leftOut;
        best.fails = judged.count;
      }
      const std::vector<Index> next = toLeaveOut(judged, leftOut);
      if (next.empty())
      {
        break;
      }
      leftOut.insert(leftOut.end(), next.begin(), next.end());
      sortUnique(leftOut);
    }
    return best;
  }

  struct Judged
  {
    std::size_t count = 0;      ///< of written cells that fail
    std::vector<Index> failing; ///< elements in these, in order
    std::vector<Index> alone;   ///< those of them that fail by themselves, too
  };

  /// As the elements are written without some of them.
  Judged judge(const std::vector<Index>& leftOut) const
  {
    std::vector<Index> changed = failing_;
    changed.insert(changed.end(), leftOut.begin(), leftOut.end());
    const Rows rowOf = rowsAbout(mesh_, changed);
    std::vector<Index> elements;
    for (const auto& [element, row] : rowOf)
    {
      if (!std::ranges::binary_search(leftOut, element))
      {
        elements.push_back(element);
      }
    }
    const PartialMesh part = makePartialMesh(mesh_, elements, leftOut);
    const std::vector<Index> written = failingCells(part, {});
    if (std::ranges::all_of(written, [](Index cell) { return cell == noIndex; }))
    {
      return {};
    }
    const std::vector<Index> single = failingCells(part, {.mergeCells = false, .mergeFaces = true});
    Judged judged;
    std::set<Index> cells;
    for (Index i = 0; i < elements.size(); ++i)
    {
      if (written[i] != noIndex && rowOf.at(elements[i]) <= judgedRows)
      {
        judged.failing.push_back(elements[i]);
        cells.insert(written[i]);
        if (single[i] != noIndex)
        {
          judged.alone.push_back(elements[i]);
        }
      }
    }
    judged.count = cells.size();
    return judged;
  }

  /// By element of a part, the written cell it is in where that fails; noIndex where it does not.
  std::vector<Index> failingCells(const PartialMesh& part, const UnionOptions& options) const
  {
    SilentMonitor silent;
    const RunContext quiet{context_.executor, ProgressRange(silent)};
    const JudgedMesh written = uniteAndJudge([&] { return part.mesh; }, part.patchOf, options, quiet);
    context_.progress.check();
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

  /// Those that fail by themselves; where there are none at a wall, all that are beside what is left out; and where
  /// there are none of these, what is at a wall beside those that fail: then these are at it.
  std::vector<Index> toLeaveOut(const Judged& judged, const std::vector<Index>& leftOut) const
  {
    const auto onlyThat = [&](std::vector<Index> elements, auto&& isWanted) {
      std::erase_if(elements, [&](Index e) { return !canBeLeftOut(e, leftOut) || !isWanted(e); });
      return elements;
    };
    std::vector<Index> found = onlyThat(judged.alone, [](Index) { return true; });
    if (found.empty())
    {
      found = onlyThat(judged.failing, [&](Index e) { return isBeside(e, leftOut); });
    }
    if (found.empty())
    {
      // Unions that fail where nothing is left out are the writer's to undo.
      found = onlyThat(neighborsOf(leftOut.empty() ? judged.alone : judged.failing),
                       [&](Index e) { return !std::ranges::binary_search(leftOut, e); });
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

  /// At no wall, but at a side of the domain.
  bool isAtSide(Index element) const
  {
    const Index wall = wallOf(mesh_, element);
    return wall != noIndex && mesh_.boundaryFaces[wall].onDomainSide;
  }

  /// At a wall, or at what is the wall without these.
  bool canBeLeftOut(Index element, const std::vector<Index>& leftOut) const
  {
    const bool isAtWall = wallOf(mesh_, element) != noIndex && (atSides_ || !isAtSide(element));
    return !zones_.contains(element) && (isAtWall || isBeside(element, leftOut));
  }

  const DualMesh& mesh_;
  const std::vector<Index>& failing_;
  const std::set<Index>& zones_;
  const RunContext& context_;
  bool atSides_ = false;
};

} // namespace

std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          const RunContext& context)
{
  std::vector<Index> found;
  const std::set<Index> zones = failing.empty() ? std::set<Index>() : elementsAtZoneFaces(mesh);
  for (const std::vector<Index>& place : placesOf(mesh, failing))
  {
    const std::vector<Index> leftOut = Place(mesh, place, zones, context).leaveOut(sidesToo);
    found.insert(found.end(), leftOut.begin(), leftOut.end());
  }
  sortUnique(found);
  return found;
}

} // namespace atria
