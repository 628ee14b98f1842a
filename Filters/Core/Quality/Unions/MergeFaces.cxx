// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/MergeFaces.h"

#include "Quality/Unions/FaceUnion.h"
#include "Quality/Unions/PolygonUnion.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace atria {

namespace {

/// Like mergedPlanarSine, but for internal faces. If two cells share two faces, one of them is concave wherever its
/// points are; only slightly if it is otherwise well-shaped. Such faces do not change a patch, so they may be less
/// flat.
constexpr double internalSine = 0.05;

std::vector<Index> without(std::span<const Index> loop, Index point)
{
  std::vector<Index> out(loop.begin(), loop.end());
  std::erase(out, point);
  return out;
}

/// Returns the points before and after a point of a loop, the lower one first.
std::pair<Index, Index> besideIn(std::span<const Index> loop, Index point)
{
  const auto at = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), point) - loop.begin());
  return std::minmax({loop[(at + loop.size() - 1) % loop.size()], loop[(at + 1) % loop.size()]});
}

class FaceMerger
{
public:
  FaceMerger(FaceMesh& faceMesh, std::span<const Index> patchOfFace, const KeptParts& keptParts)
      : mesh(faceMesh), patchOf(patchOfFace), kept(keptParts)
  {
  }

  MergedFaces run(const RunContext& context)
  {
    context.progress.report(0.0, "Merging coplanar faces");
    const std::vector<Index> firstFaces = findCandidates(context.executor);
    if (firstFaces.empty())
    {
      return {};
    }
    unions.emplace(mesh, context.part(0.1, 0.7));
    for (const Index first : firstFaces)
    {
      context.progress.check();
      mergeRun(first, endOfRun(first));
    }
    context.progress.report(0.9, "Merging coplanar faces");
    MergedFaces merged = unions->writeFaces();
    return merged.count > 0 ? merged : MergedFaces();
  }

private:
  std::span<const Index> loopOf(Index face) const { return unions ? unions->loopOf(face) : mesh.face(face); }

  bool isInternal(Index face) const { return face < mesh.internalFaceCount(); }

  bool samePatch(Index a, Index b) const
  {
    const std::size_t internal = mesh.internalFaceCount();
    return isInternal(a) ? kept.zoneOf.empty() || kept.zoneOf[a] == kept.zoneOf[b]
                         : patchOf.empty() || patchOf[a - internal] == patchOf[b - internal];
  }

  bool isKept(Index cell) const { return std::binary_search(kept.cells.begin(), kept.cells.end(), cell); }

  bool hasKeptCell(Index face) const
  {
    return isKept(mesh.owner[face]) || (isInternal(face) && isKept(mesh.neighbor[face]));
  }

  bool isOfZone(Index face) const { return face < kept.zoneOf.size() && kept.zoneOf[face] != noIndex; }

  double sineOf(Index face) const { return isInternal(face) ? internalSine : mergedPlanarSine; }

  /// True if both faces have the same owner and, if there is one, the same neighbor.
  bool areOfOneRun(Index a, Index b) const
  {
    return mesh.owner[a] == mesh.owner[b] && isInternal(a) == isInternal(b) &&
           (!isInternal(a) || mesh.neighbor[a] == mesh.neighbor[b]);
  }

  /// Returns the end of a run, one past its last face.
  Index endOfRun(Index first) const
  {
    Index end = first + 1;
    while (end < mesh.faceCount() && areOfOneRun(first, end))
    {
      ++end;
    }
    return end;
  }

  bool areCoplanar(Index a, Index b) const
  {
    return samePatch(a, b) && shareAnEdge(loopOf(a), loopOf(b)) &&
           coplanar(mesh.points, loopOf(a), loopOf(b), sineOf(a));
  }

  /// Returns the first face of each run with two coplanar faces. Most meshes have few, many have none.
  std::vector<Index> findCandidates(const Executor& executor) const
  {
    return chosenNumbers(mesh.faceCount(), executor, [&](std::size_t f) {
      const auto face = static_cast<Index>(f);
      return !(face > 0 && areOfOneRun(face - 1, face)) && hasCoplanar(face, endOfRun(face)) && !hasKeptCell(face);
    });
  }

  bool hasCoplanar(Index first, Index end) const
  {
    for (Index a = first; a < end; ++a)
    {
      for (Index b = a + 1; b < end; ++b)
      {
        if (areCoplanar(a, b))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Merges the faces of a run, larger unions first: two of three faces around a point are not star-shaped alone.
  void mergeRun(Index first, Index end)
  {
    bool merged = true;
    while (merged)
    {
      merged = false;
      for (const std::vector<Index>& group : coplanarGroups(first, end))
      {
        merged = merged || merge(group) || mergeThree(group) ||
                 mergeTwo(group, [&](const std::vector<Index>& pair) { return merge(pair); }) ||
                 mergeTwo(group, [&](const std::vector<Index>& pair) { return mergeWithoutPoint(pair); });
      }
    }
  }

  /// Returns groups of two or more faces that are connected over edges between coplanar faces.
  std::vector<std::vector<Index>> coplanarGroups(Index first, Index end) const
  {
    std::vector<Index> left;
    for (Index face = first; face < end; ++face)
    {
      if (unions->isLeft(face))
      {
        left.push_back(face);
      }
    }
    std::vector<std::vector<Index>> groups;
    while (!left.empty())
    {
      std::vector<Index> group{left.front()};
      left.erase(left.begin());
      for (std::size_t i = 0; i < group.size(); ++i)
      {
        const auto joins = [&](Index face) { return areCoplanar(group[i], face); };
        std::copy_if(left.begin(), left.end(), std::back_inserter(group), joins);
        std::erase_if(left, joins);
      }
      if (group.size() > 1)
      {
        std::sort(group.begin(), group.end());
        groups.push_back(std::move(group));
      }
    }
    return groups;
  }

  bool mergeThree(const std::vector<Index>& group)
  {
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      for (std::size_t j = i + 1; j < group.size(); ++j)
      {
        for (std::size_t k = j + 1; k < group.size(); ++k)
        {
          if (merge({group[i], group[j], group[k]}))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  template <typename TryPair> static bool mergeTwo(const std::vector<Index>& group, TryPair&& tryPair)
  {
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      for (std::size_t j = i + 1; j < group.size(); ++j)
      {
        if (tryPair({group[i], group[j]}))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Returns the union of all faces of a group; nullopt if it is not one simple flat polygon, or if it omits a point of
  /// another face.
  std::optional<std::vector<Index>> unionOf(const std::vector<Index>& group) const
  {
    const auto firstLoop = loopOf(group[0]);
    std::optional<std::vector<Index>> loop{std::in_place, firstLoop.begin(), firstLoop.end()};
    std::vector<bool> joined(group.size(), false);
    joined[0] = true;
    for (std::size_t count = 1; count < group.size() && loop; ++count)
    {
      std::optional<std::vector<Index>> more;
      for (std::size_t i = 1; i < group.size() && !more; ++i)
      {
        if (!joined[i] && coplanar(mesh.points, *loop, loopOf(group[i]), sineOf(group[i])))
        {
          more = unite(*loop, loopOf(group[i]));
          joined[i] = more.has_value();
        }
      }
      loop = std::move(more);
    }
    return loop && leavesOutOnlyOwnPoints(group, *loop) ? loop : std::nullopt;
  }

  /// True if no face outside of the group has a point that the union omits.
  bool leavesOutOnlyOwnPoints(const std::vector<Index>& group, const std::vector<Index>& loop) const
  {
    std::map<Index, Index> own;
    for (const Index face : group)
    {
      for (const Index point : loopOf(face))
      {
        ++own[point];
      }
    }
    for (const Index point : loop)
    {
      own.erase(point);
    }
    return std::all_of(own.begin(), own.end(),
                       [&](const auto& left) { return unions->usesOf(left.first) == left.second; });
  }

  bool merge(const std::vector<Index>& group)
  {
    const std::optional<std::vector<Index>> loop = unionOf(group);
    if (!loop)
    {
      return false;
    }
    FaceUnion change{group, {{group.front(), *loop}}, {}};
    unions->findCentroids(change);
    if (!unions->fits(change))
    {
      return false;
    }
    unions->apply(std::move(change));
    return true;
  }

  /// Merges two internal faces without a point of their common edge, if their union is not possible with it.
  bool mergeWithoutPoint(const std::vector<Index>& pair)
  {
    const std::optional<std::vector<Index>> loop = unionOf(pair);
    if (!isInternal(pair.front()) || isOfZone(pair.front()) || !loop || loop->size() < 4)
    {
      return false;
    }
    return std::any_of(loop->begin(), loop->end(), [&](Index point) {
      std::optional<FaceUnion> change = unionWithout(pair, *loop, point);
      if (!change || !unions->fits(*change) || !unions->isLessConcave(*change))
      {
        return false;
      }
      unions->apply(std::move(*change));
      return true;
    });
  }

  /// Removes the point from all faces that have it. Returns nullopt if one of them is not between a cell of the pair
  /// and another cell, or has other points beside it.
  std::optional<FaceUnion> unionWithout(const std::vector<Index>& pair, const std::vector<Index>& loop,
                                        Index point) const
  {
    FaceUnion change{pair, {{pair.front(), without(loop, point)}}, {}};
    const auto beside = besideIn(loop, point);
    for (const Index cell : unions->cellsOf(pair.front()))
    {
      for (const Index face : unions->facesOf(cell))
      {
        const auto own = loopOf(face);
        if (!contains(pair, face) && contains(own, point))
        {
          if (!isInternal(face) || isOfZone(face) || hasKeptCell(face) || own.size() < 4 ||
              besideIn(own, point) != beside)
          {
            return std::nullopt;
          }
          change.loops[face] = without(own, point);
        }
      }
    }
    const bool isOfBoth = contains(loopOf(pair[0]), point) && contains(loopOf(pair[1]), point);
    if (!isOfBoth || unions->usesOf(point) != change.loops.size() + 1)
    {
      return std::nullopt;
    }
    unions->findCentroids(change);
    return change;
  }

  FaceMesh& mesh;
  std::span<const Index> patchOf;
  const KeptParts& kept;
  std::optional<FaceUnions> unions; ///< once there is something to merge
};

} // namespace

MergedFaces mergeCoplanarFaces(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                               const KeptParts& kept)
{
  return FaceMerger(mesh, patchOf, kept).run(context);
}

} // namespace atria
