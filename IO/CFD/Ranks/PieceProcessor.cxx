// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PieceProcessor.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace atria {

namespace {

using Label = std::int32_t;

class ProcessorMaker
{
public:
  ProcessorMaker(const UnitedPiece& unitedPiece, std::size_t number)
      : piece(unitedPiece), mesh(unitedPiece.now.mesh), self(number), localCell(mesh.cellCount, noIndex),
        localPoint(mesh.points.size(), noIndex)
  {
    Index next = 0;
    for (std::size_t cell = 0; cell < localCell.size(); ++cell)
    {
      localCell[cell] = isOwn(cell) ? next++ : noIndex;
    }
    out.mesh.cellCount = next;
    sortFaces();
  }

  ProcessorMesh run(const PieceNumbers& numbers, const FaceNumbers& faceNumbers)
  {
    addPoints();
    addFaces();
    addFaceZones();
    addCellZones();
    constexpr std::int64_t most = std::numeric_limits<Label>::max();
    if (faceNumbers.faceCount < most && numbers.pointCount <= most)
    {
      addNumbers(numbers, faceNumbers);
    }
    return std::move(out);
  }

private:
  bool isOwn(std::size_t cell) const { return piece.cells.isOwn[cell] != 0; }

  /// Sorts faces into the order of the file.
  void sortFaces()
  {
    const std::size_t internalFaces = mesh.internalFaceCount();
    std::vector<std::vector<Index>> ofPatch(piece.patches.size());
    std::map<Index, std::vector<Index>> shared; // keyed by the other rank
    for (Index f = 0; f < mesh.faceCount(); ++f)
    {
      const Index owner = mesh.owner[f];
      if (f >= internalFaces)
      {
        if (isOwn(owner))
        {
          ofPatch[piece.patchOf[f - internalFaces]].push_back(f);
        }
        continue;
      }
      const Index neighbor = mesh.neighbor[f];
      if (isOwn(owner) && isOwn(neighbor))
      {
        faces.push_back(f);
      }
      else if (isOwn(owner) || isOwn(neighbor))
      {
        shared[piece.cells.ranks[isOwn(owner) ? neighbor : owner]].push_back(f);
      }
    }
    internal = faces.size();
    for (std::size_t p = 0; p < ofPatch.size(); ++p)
    {
      addPatch(piece.patches[p], ofPatch[p], static_cast<Label>(p));
    }
    for (const auto& [other, its] : shared)
    {
      addPatch(processorPatch(self, other), its, -1);
    }
  }

  void addPatch(const PatchEntry& patch, const std::vector<Index>& its, Label number)
  {
    out.patches.push_back({patch.name, patch.entries, faces.size(), its.size()});
    out.ofPatches.push_back(number);
    faces.insert(faces.end(), its.begin(), its.end());
  }

  void addPoints()
  {
    for (const Index face : faces)
    {
      std::ranges::for_each(mesh.face(face), [&](Index point) { localPoint[point] = 0; });
    }
    for (Index point = 0; point < localPoint.size(); ++point)
    {
      if (localPoint[point] != noIndex)
      {
        localPoint[point] = static_cast<Index>(out.mesh.points.size());
        out.mesh.points.push_back(mesh.points[point]);
        points.push_back(point);
      }
    }
  }

  /// True if the rank has only the neighbor of a face.
  bool isTurned(Index face) const { return !isOwn(mesh.owner[face]); }

  void addFaces()
  {
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      const Index face = faces[i];
      const auto corners = mesh.face(face);
      for (std::size_t c = 0; c < corners.size(); ++c) // turned around, the first stays the first
      {
        out.mesh.facePoints.push_back(localPoint[corners[isTurned(face) && c > 0 ? corners.size() - c : c]]);
      }
      out.mesh.faceOffsets.push_back(static_cast<Index>(out.mesh.facePoints.size()));
      out.mesh.owner.push_back(localCell[isTurned(face) ? mesh.neighbor[face] : mesh.owner[face]]);
      if (i < internal)
      {
        out.mesh.neighbor.push_back(localCell[mesh.neighbor[face]]);
      }
    }
  }

  void addFaceZones()
  {
    std::vector<Index> placeOf(mesh.faceCount(), noIndex);
    for (Index i = 0; i < faces.size(); ++i)
    {
      placeOf[faces[i]] = i;
    }
    for (const FaceZone& zone : piece.faceZones)
    {
      std::vector<std::pair<Index, char>> its;
      for (std::size_t i = 0; i < zone.faces.size(); ++i)
      {
        const Index face = zone.faces[i];
        if (placeOf[face] != noIndex)
        {
          its.emplace_back(placeOf[face], (zone.flips[i] != 0) != isTurned(face) ? 1 : 0);
        }
      }
      std::ranges::sort(its);
      FaceZone& own = out.faceZones.emplace_back(FaceZone{zone.name, {}, {}});
      for (const auto& [place, flip] : its)
      {
        own.faces.push_back(place);
        own.flips.push_back(flip);
      }
    }
  }

  void addCellZones()
  {
    for (const CellZone& zone : piece.cellZones)
    {
      CellZone& own = out.cellZones.emplace_back(CellZone{zone.name, {}});
      for (const Index cell : zone.cells)
      {
        if (isOwn(cell))
        {
          own.cells.push_back(localCell[cell]);
        }
      }
    }
  }

  void addNumbers(const PieceNumbers& numbers, const FaceNumbers& faceNumbers)
  {
    for (std::size_t cell = 0; cell < localCell.size(); ++cell)
    {
      if (isOwn(cell))
      {
        out.cells.push_back(static_cast<Label>(numbers.cells[cell]));
      }
    }
    for (const Index point : points)
    {
      out.points.push_back(static_cast<Label>(numbers.points[point]));
    }
    for (const Index face : faces)
    {
      const auto number = static_cast<Label>(faceNumbers.faces[face] + 1);
      out.faces.push_back(isTurned(face) ? -number : number);
    }
  }

  const UnitedPiece& piece;
  const FaceMesh& mesh;
  std::size_t self;
  std::vector<Index> localCell;
  std::vector<Index> localPoint;
  std::vector<Index> faces; ///< in the order of the file
  std::size_t internal = 0;
  std::vector<Index> points; ///< in the order of the file
  ProcessorMesh out;
};

} // namespace

ProcessorMesh makeProcessor(const UnitedPiece& piece, const PieceNumbers& numbers, const FaceNumbers& faceNumbers,
                            std::size_t self)
{
  return ProcessorMaker(piece, self).run(numbers, faceNumbers);
}

} // namespace atria
