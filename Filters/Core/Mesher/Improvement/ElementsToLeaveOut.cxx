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
/// How often what comes to fail beside elements that are left out is left out, too.
constexpr int mostRounds = 4;

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
      : mesh_(mesh), failing_(failing), zones_(zones), rowOf_(rowsAbout(mesh, failing)), context_(context)
  {
  }

  std::vector<Index> leaveOut()
  {
    std::vector<Index> leftOut;
    std::vector<Index> best;
    std::size_t fewest = noIndex;
    for (int round = 0; round <= mostRounds; ++round)
    {
      const Judged judged = judge(leftOut);
      if (judged.count < fewest)
      {
        fewest = judged.count;
        best = leftOut;
      }
      const std::vector<Index> next = toLeaveOut(judged.failing, leftOut);
      if (next.empty())
      {
        break;
      }
      leftOut.insert(leftOut.end(), next.begin(), next.end());
      sortUnique(leftOut);
    }
    return best;
  }

private:
  struct Judged
  {
    std::size_t count = 0;      ///< of written cells that fail
    std::vector<Index> failing; ///< elements in these
  };

  /// As the elements are written without some of them.
  Judged judge(const std::vector<Index>& leftOut) const
  {
    std::vector<Index> elements;
    for (const auto& [element, row] : rowOf_)
    {
      if (!std::ranges::binary_search(leftOut, element))
      {
        elements.push_back(element);
      }
    }
    const PartialMesh part = makePartialMesh(mesh_, elements, leftOut);
    SilentMonitor silent;
    const RunContext quiet{context_.executor, ProgressRange(silent)};
    const JudgedMesh written = uniteAndJudge([&] { return part.mesh; }, part.patchOf, {}, quiet);
    context_.progress.check();
    const MeasuredMesh measured = measureMesh(written.mesh, quiet);
    std::vector<std::uint32_t> fails = failedErrorsOfCells(measured, written.verdict);
    for (std::size_t i = 0; i < written.added.size(); ++i)
    {
      fails[written.added[i]] |= fails[written.pyramid(i)];
    }
    Judged judged;
    std::set<Index> cells;
    for (Index i = 0; i < elements.size(); ++i)
    {
      const Index cell = written.cellOf.empty() ? i : written.cellOf[i];
      if (fails[cell] != 0 && rowOf_.at(elements[i]) <= judgedRows)
      {
        judged.failing.push_back(elements[i]);
        cells.insert(cell);
      }
    }
    judged.count = cells.size();
    return judged;
  }

  /// Those of them that fail by themselves; where there are none, all that are at a wall.
  std::vector<Index> toLeaveOut(const std::vector<Index>& failing, const std::vector<Index>& leftOut) const
  {
    std::vector<Index> own;
    std::vector<Index> others;
    for (const Index e : failing)
    {
      if (canBeLeftOut(e, leftOut))
      {
        (std::ranges::binary_search(failing_, e) ? own : others).push_back(e);
      }
    }
    std::erase_if(others, [&](Index e) { return !isBeside(e, leftOut); });
    return own.empty() ? others : own;
  }

  bool isBeside(Index element, const std::vector<Index>& leftOut) const
  {
    return std::ranges::any_of(mesh_.neighbors[element], [&](std::int32_t code) {
      return code >= 0 && std::ranges::binary_search(leftOut, static_cast<Index>(code));
    });
  }

  /// At a wall, or at what is the wall without these.
  bool canBeLeftOut(Index element, const std::vector<Index>& leftOut) const
  {
    return !zones_.contains(element) && (wallOf(mesh_, element) != noIndex || isBeside(element, leftOut));
  }

  const DualMesh& mesh_;
  const std::vector<Index>& failing_;
  const std::set<Index>& zones_;
  Rows rowOf_;
  const RunContext& context_;
};

} // namespace

std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing,
                                          const RunContext& context)
{
  std::vector<Index> found;
  const std::set<Index> zones = failing.empty() ? std::set<Index>() : elementsAtZoneFaces(mesh);
  for (const std::vector<Index>& place : placesOf(mesh, failing))
  {
    const std::vector<Index> leftOut = Place(mesh, place, zones, context).leaveOut();
    found.insert(found.end(), leftOut.begin(), leftOut.end());
  }
  sortUnique(found);
  return found;
}

} // namespace atria
