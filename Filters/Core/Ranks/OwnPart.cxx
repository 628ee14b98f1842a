// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/OwnPart.h"

#include "Support/Numbering.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

class OwnPartTaker
{
public:
  OwnPartTaker(PlainShare own, NearBoundary near, Index tagOfCut)
      : first(own.firstOwn), end(own.endOwn),
        cutTag(tagOfCut), part{std::move(own.plain), std::move(own.keys), std::move(own.points), std::move(near), {}},
        mesh(part.plain.mesh)
  {
  }

  WindowPart run()
  {
    keepFaces();
    cut();
    keepOwn(part.elementKeys);
    keepOwn(part.near.rows);
    keepOwn(mesh.corners);
    keepOwn(mesh.neighbors);
    keepOwn(mesh.levels);
    keepOwn(mesh.zones);
    keepOwn(mesh.rooms);
    keepOwn(mesh.cellZones);
    keepPoints();
    return std::move(part);
  }

private:
  bool isOwn(Index element) const { return element >= first && element < end; }

  template <typename List> void keepOwn(List& list) const
  {
    if (!list.empty())
    {
      list.erase(list.begin() + end, list.end());
      list.erase(list.begin(), list.begin() + first);
    }
  }

  void keepFaces()
  {
    std::vector<BoundaryFace>& faces = mesh.boundaryFaces;
    faceNumbers.assign(faces.size(), noIndex);
    for (Index f = 0; f < faces.size(); ++f)
    {
      BoundaryFace& face = faces[f];
      if (isOwn(face.element))
      {
        faceNumbers[f] = static_cast<Index>(part.beyond.size());
        part.beyond.push_back(face.opposite == noIndex ? noKey : part.elementKeys[face.opposite]);
        face.element -= first;
        face.opposite = isOwn(face.opposite) ? face.opposite - first : noIndex;
        face.tag += face.tag < cutTag ? 0 : 1;
      }
    }
    compact(faces, faceNumbers);
    std::erase_if(mesh.zoneFaces, [&](const ZoneFace& face) { return !isOwn(face.element); });
    std::ranges::for_each(mesh.zoneFaces, [&](ZoneFace& face) { face.element -= first; });
  }

  /// Gives own elements the new numbers of their neighbors, and boundary faces where neighbors are not own ones.
  void cut()
  {
    for (Index e = first; e < end; ++e)
    {
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        std::int32_t& code = mesh.neighbors[e][direction];
        if (DualMesh::isBoundary(code))
        {
          code = ~static_cast<std::int32_t>(faceNumbers[DualMesh::boundaryFaceOf(code)]);
        }
        else if (code != DualMesh::noFace && isOwn(static_cast<Index>(code)))
        {
          code -= static_cast<std::int32_t>(first);
        }
        else if (code != DualMesh::noFace)
        {
          part.beyond.push_back(part.elementKeys[static_cast<std::size_t>(code)]);
          mesh.boundaryFaces.push_back({e - first, cutTag, noIndex, direction, SheetSide::front, false});
          code = ~static_cast<std::int32_t>(mesh.boundaryFaces.size() - 1);
        }
      }
    }
  }

  /// Keeps the points of own elements, and their vertices.
  void keepPoints()
  {
    std::vector<Index>& vertexOf = part.plain.vertexOf;
    std::vector<char> stays(mesh.points.size(), 0);
    for (const std::array<Index, 8>& corners : mesh.corners)
    {
      std::ranges::for_each(corners, [&](Index p) { stays[p] = stays[vertexOf[p]] = 1; });
    }
    const std::vector<Index> numbers = numbersOfKept(stays);
    for (std::array<Index, 8>& corners : mesh.corners)
    {
      std::ranges::transform(corners, corners.begin(), [&](Index p) { return numbers[p]; });
    }
    compact(mesh.points, numbers);
    compact(part.points, numbers);
    std::ranges::transform(vertexOf, vertexOf.begin(), [&](Index vertex) { return numbers[vertex]; });
    compact(vertexOf, numbers);
    compact(part.near.mayMove, numbers);
    keepClassification(numbers);
  }

  void keepClassification(const std::vector<Index>& numbers)
  {
    VertexClassification& of = part.plain.classification;
    Index begin = 0;
    Index to = 0;
    for (Index v = 0; v < of.classes.size(); ++v)
    {
      const Index endOfOld = of.offsets[v + 1];
      if (numbers[v] != noIndex)
      {
        to = static_cast<Index>(
            std::copy(of.pieces.begin() + begin, of.pieces.begin() + endOfOld, of.pieces.begin() + to) -
            of.pieces.begin());
        of.offsets[numbers[v] + 1] = to;
      }
      begin = endOfOld;
    }
    of.pieces.resize(to);
    compact(of.classes, numbers);
    compact(of.leaves, numbers);
    compact(of.turnedSides, numbers);
    of.offsets.resize(of.classes.size() + 1);
    std::unordered_map<Index, DisplacementLimit> limits;
    for (const auto& [vertex, limit] : of.displacementLimits)
    {
      if (numbers[vertex] != noIndex)
      {
        limits.emplace(numbers[vertex], limit);
      }
    }
    of.displacementLimits = std::move(limits);
  }

  Index first;
  Index end;
  Index cutTag;
  WindowPart part;
  DualMesh& mesh; ///< refers to the mesh of `part`
  /// One entry per boundary face before: its number in the part.
  std::vector<Index> faceNumbers;
};

} // namespace

WindowPart ownPart(PlainShare own, NearBoundary near, Index cutTag)
{
  return OwnPartTaker(std::move(own), std::move(near), cutTag).run();
}

} // namespace atria
