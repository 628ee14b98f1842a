// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/MergeFaces.h"

#include "Quality/Geometry.h"
#include "Quality/PolygonUnion.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>

namespace atria {

namespace {

constexpr std::size_t fewestFaces = 4;
/// Of leastTetrahedron(), by far more than rounding. What is less may not become less still, but for rounding.
constexpr double clearlyAbove = 1e-6;
constexpr double rounding = 1e-12;

class FaceMerger
{
public:
  FaceMerger(FaceMesh& faceMesh, std::span<const Index> patchOfFace, const MergeFacesOptions& mergeOptions)
      : mesh(faceMesh), patchOf(patchOfFace), options(mergeOptions), into(faceMesh.faceCount())
  {
    std::iota(into.begin(), into.end(), Index{0});
  }

  MergedFaces run(const RunContext& context)
  {
    context.progress.report(0.0, "Merging coplanar faces");
    const std::vector<Index> firstFaces = findCandidates();
    if (firstFaces.empty())
    {
      return {std::move(into), 0};
    }
    cellFaces = makeCellFaces(mesh);
    cellCentroids = computeGeometry(mesh, cellFaces, context.part(0.1, 0.7)).cellCentroids;
    uses.assign(mesh.points.size(), 0);
    count(mesh.facePoints, 1);
    for (const Index first : firstFaces)
    {
      context.progress.check();
      mergeRun(first, endOfRun(first));
    }
    context.progress.report(0.9, "Merging coplanar faces");
    return renumber();
  }

private:
  std::span<const Index> loopOf(Index face) const
  {
    const auto found = loops.find(face);
    return found == loops.end() ? mesh.face(face) : std::span<const Index>(found->second);
  }

  bool isInternal(Index face) const { return face < mesh.internalFaceCount(); }

  bool samePatch(Index a, Index b) const
  {
    const std::size_t internal = mesh.internalFaceCount();
    return isInternal(a) || patchOf.empty() || patchOf[a - internal] == patchOf[b - internal];
  }

  double sineOf(Index face) const { return isInternal(face) ? options.internalSine : options.planarSine; }

  /// Behind the last face of the same owner and, if there is one, of the same neighbour.
  Index endOfRun(Index first) const
  {
    Index end = first + 1;
    while (end < mesh.faceCount() && mesh.owner[end] == mesh.owner[first] && isInternal(end) == isInternal(first) &&
           (!isInternal(end) || mesh.neighbour[end] == mesh.neighbour[first]))
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

  /// The first face of each run with two coplanar ones. Most meshes have few, many have none.
  std::vector<Index> findCandidates() const
  {
    std::vector<Index> found;
    Index end = 0;
    for (Index first = 0; first < mesh.faceCount(); first = end)
    {
      end = endOfRun(first);
      bool any = false;
      for (Index a = first; a < end && !any; ++a)
      {
        for (Index b = a + 1; b < end && !any; ++b)
        {
          any = areCoplanar(a, b);
        }
      }
      if (any)
      {
        found.push_back(first);
      }
    }
    return found;
  }

  /// Larger unions first: about a point inside of three faces, two of them alone are not star-shaped.
  void mergeRun(Index first, Index end)
  {
    bool merged = true;
    while (merged)
    {
      merged = false;
      for (const std::vector<Index>& group : coplanarGroups(first, end))
      {
        merged = merged || merge(group) || mergeThree(group) || mergeTwo(group);
      }
    }
  }

  /// Faces that can be reached from each other over edges between coplanar ones, two or more.
  std::vector<std::vector<Index>> coplanarGroups(Index first, Index end) const
  {
    std::vector<Index> left;
    for (Index face = first; face < end; ++face)
    {
      if (into[face] == face)
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

  bool mergeTwo(const std::vector<Index>& group)
  {
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      for (std::size_t j = i + 1; j < group.size(); ++j)
      {
        if (merge({group[i], group[j]}))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// The union of all faces of a group; nothing where it is not one simple flat polygon.
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
    return loop;
  }

  /// Whether no face outside of the group has a point that the union leaves out.
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
    return std::all_of(own.begin(), own.end(), [&](const auto& left) { return uses[left.first] == left.second; });
  }

  /// A face as seen from outside of a cell.
  struct OutwardFace
  {
    std::vector<Index> loop;
    Index beyond; ///< the cell on the other side; noIndex on the boundary
  };

  OutwardFace outward(Index face, std::span<const Index> loop, Index cell) const
  {
    OutwardFace out{{loop.begin(), loop.end()}, isInternal(face) ? mesh.neighbour[face] : noIndex};
    if (mesh.owner[face] != cell)
    {
      std::reverse(out.loop.begin(), out.loop.end());
      out.beyond = mesh.owner[face];
    }
    return out;
  }

  Vec3 centroidOf(const std::vector<OutwardFace>& faces) const
  {
    std::vector<PolygonMeasure> measures;
    for (const OutwardFace& face : faces)
    {
      measures.push_back(measurePolygon(mesh.points, face.loop));
    }
    return measureCellInOrder(measures.size(), [&](std::size_t i) { return measures[i]; }).centroid;
  }

  /// Where a cell's centroid would be with the union in place of the group, if that fits in with the other faces and is
  /// star-shaped seen from the centroid, as it is and as it would be, and no face loses its sound tetrahedra.
  std::optional<Vec3> centroidIfFits(const std::vector<Index>& group, const std::vector<Index>& loop, Index cell) const
  {
    std::vector<OutwardFace> faces{outward(group[0], loop, cell)};
    for (const Index face : cellFaces.of(cell))
    {
      if (into[face] == face && std::find(group.begin(), group.end(), face) == group.end())
      {
        faces.push_back(outward(face, loopOf(face), cell));
        if (!shareOneRun(faces.front().loop, faces.back().loop))
        {
          return std::nullopt;
        }
      }
    }
    const Vec3 before = cellCentroids[cell];
    const Vec3 centroid = centroidOf(faces);
    const auto least = [&](const OutwardFace& face, const Vec3& from) {
      return leastTetrahedron(mesh.points, face.loop, from,
                              face.beyond == noIndex ? nullptr : &cellCentroids[face.beyond]);
    };
    const auto staysSound = [&](const OutwardFace& face) {
      return least(face, centroid) >= std::min(clearlyAbove, least(face, before) - rounding);
    };
    const std::vector<Index>& outline = faces.front().loop;
    const bool fits = faces.size() >= fewestFaces && isStarShaped(mesh.points, outline, before, options.planarSine) &&
                      isStarShaped(mesh.points, outline, centroid, options.planarSine) &&
                      std::all_of(faces.begin(), faces.end(), staysSound);
    return fits ? std::optional(centroid) : std::nullopt;
  }

  /// Takes the centroids of the group's cells to where they are with the union, if that fits in with both.
  bool moveCentroids(const std::vector<Index>& group, const std::vector<Index>& loop)
  {
    const Index owner = mesh.owner[group[0]];
    const Vec3 before = cellCentroids[owner];
    const std::optional<Vec3> own = centroidIfFits(group, loop, owner);
    if (!own)
    {
      return false;
    }
    cellCentroids[owner] = *own;
    if (!isInternal(group[0]))
    {
      return true;
    }
    const Index neighbour = mesh.neighbour[group[0]];
    const std::optional<Vec3> other = centroidIfFits(group, loop, neighbour);
    cellCentroids[other ? neighbour : owner] = other.value_or(before);
    return other.has_value();
  }

  bool merge(const std::vector<Index>& group)
  {
    std::optional<std::vector<Index>> loop = unionOf(group);
    if (!loop || !leavesOutOnlyOwnPoints(group, *loop) || !moveCentroids(group, *loop))
    {
      return false;
    }
    for (const Index face : group)
    {
      count(loopOf(face), -1);
      loops.erase(face);
      into[face] = group[0];
    }
    count(*loop, 1);
    loops[group[0]] = std::move(*loop);
    return true;
  }

  void count(std::span<const Index> loop, int change)
  {
    for (const Index point : loop)
    {
      uses[point] += static_cast<Index>(change);
    }
  }

  MergedFaces renumber()
  {
    const std::size_t before = mesh.faceCount();
    Index first = 0; // from which on numbers change
    while (first < before && !loops.contains(first))
    {
      ++first;
    }
    FaceMesh out;
    out.faceOffsets.assign(1, mesh.faceOffsets[first]);
    for (Index f = first; f < before; ++f)
    {
      if (into[f] != f)
      {
        into[f] = into[into[f]]; // a lower face, which has its new number already
        continue;
      }
      into[f] = static_cast<Index>(first + out.owner.size());
      const auto loop = loopOf(f);
      out.facePoints.insert(out.facePoints.end(), loop.begin(), loop.end());
      out.faceOffsets.push_back(out.faceOffsets.front() + static_cast<Index>(out.facePoints.size()));
      out.owner.push_back(mesh.owner[f]);
      if (isInternal(f))
      {
        out.neighbour.push_back(mesh.neighbour[f]);
      }
    }
    const auto replaceTail = [](Buffer<Index>& all, std::size_t kept, const Buffer<Index>& tail) {
      all.resize(kept);
      all.insert(all.end(), tail.begin(), tail.end());
    };
    replaceTail(mesh.facePoints, out.faceOffsets.front(), out.facePoints);
    replaceTail(mesh.faceOffsets, first, out.faceOffsets);
    replaceTail(mesh.owner, first, out.owner);
    replaceTail(mesh.neighbour, std::min<std::size_t>(first, mesh.neighbour.size()), out.neighbour);
    return {std::move(into), before - mesh.faceCount()};
  }

  FaceMesh& mesh;
  std::span<const Index> patchOf;
  const MergeFacesOptions& options;
  std::vector<Index> into; ///< the face each became a part of, itself where none
  CellFaces cellFaces;
  Buffer<Vec3> cellCentroids;
  std::vector<Index> uses;                   ///< how many faces have each point
  std::map<Index, std::vector<Index>> loops; ///< of faces that others became a part of
};

} // namespace

MergedFaces mergeCoplanarFaces(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                               const MergeFacesOptions& options)
{
  return FaceMerger(mesh, patchOf, options).run(context);
}

} // namespace atria
