// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/PartialMesh.h"

#include "Quality/Faces/Geometry.h"

#include <algorithm>
#include <map>

namespace atria {

namespace {

/// Returns the place of a number in a sorted list that has it.
std::size_t placeIn(const std::vector<Index>& ordered, Index number)
{
  return static_cast<std::size_t>(std::ranges::lower_bound(ordered, number) - ordered.begin());
}

class PartMaker
{
public:
  PartMaker(const DualMesh& whole, const std::vector<Index>& leftOut)
      : mesh_(whole), leftOut_(leftOut), walls_(wallsOf(whole, leftOut))
  {
  }

  PartialMesh make(const std::vector<Index>& elements)
  {
    for (const Index e : elements)
    {
      number(e);
    }
    for (const Index e : elements)
    {
      for (const std::int32_t next : mesh_.neighbors[e])
      {
        if (next >= 0 && !isLeftOut(static_cast<Index>(next)))
        {
          number(static_cast<Index>(next));
        }
      }
    }
    PartialMesh part;
    part.mesh.cellCount = elements_.size();
    for (const OrderedFace& face : facesInOrder())
    {
      append(part, face);
    }
    return part;
  }

private:
  void number(Index element)
  {
    if (cellOf_.emplace(element, static_cast<Index>(elements_.size())).second)
    {
      elements_.push_back(element);
    }
  }

  Index cellOf(std::int32_t code) const
  {
    const auto found = code >= 0 ? cellOf_.find(static_cast<Index>(code)) : cellOf_.end();
    return found == cellOf_.end() ? noIndex : found->second;
  }

  /// Returns all faces, numbered by cell and direction.
  std::vector<OrderedFace> facesInOrder() const
  {
    std::vector<OrderedFace> order;
    for (Index cell = 0; cell < elements_.size(); ++cell)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        const std::int32_t code = mesh_.neighbors[elements_[cell]][direction];
        const Index across = cellOf(code);
        if (code != DualMesh::noFace && (across == noIndex || cell < across))
        {
          order.push_back(orderFace(6 * cell + static_cast<Index>(direction), cell, across));
        }
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  void append(PartialMesh& part, const OrderedFace& face)
  {
    const Index element = elements_[face.owner];
    const auto direction = static_cast<int>(face.face % 6);
    std::vector<Index> loop;
    const ReducedFace reduced = faceOf(mesh_.corners[element], direction);
    for (const Index p : reduced.loop())
    {
      const auto [at, isNew] = pointOf_.emplace(p, static_cast<Index>(part.mesh.points.size()));
      if (isNew)
      {
        part.mesh.points.push_back(mesh_.points[p]);
      }
      loop.push_back(at->second);
    }
    appendFace(part.mesh, face, loop);
    if (face.onBoundary)
    {
      part.patchOf.push_back(beyond(mesh_.neighbors[element][direction]));
    }
  }

  bool isLeftOut(Index element) const { return std::ranges::binary_search(leftOut_, element); }

  /// Returns the patch beyond a face: one for each side of each surface, and one for each element outside.
  Index beyond(std::int32_t code) const
  {
    if (code >= 0 && !isLeftOut(static_cast<Index>(code)))
    {
      return noIndex - 1 - static_cast<Index>(code);
    }
    const Index wall = code < 0 ? DualMesh::boundaryFaceOf(code) : walls_[placeIn(leftOut_, static_cast<Index>(code))];
    const BoundaryFace& face = mesh_.boundaryFaces[wall];
    return 2 * face.tag + (face.side == SheetSide::back ? 1 : 0);
  }

  const DualMesh& mesh_;
  const std::vector<Index>& leftOut_;
  std::vector<Index> walls_;
  std::vector<Index> elements_;
  std::map<Index, Index> cellOf_;
  std::map<Index, Index> pointOf_;
};

} // namespace

PartialMesh makePartialMesh(const DualMesh& mesh, const std::vector<Index>& elements, const std::vector<Index>& leftOut)
{
  return PartMaker(mesh, leftOut).make(elements);
}

Index wallOf(const DualMesh& mesh, Index element)
{
  Index wall = noIndex;
  std::pair largest(false, 0.0); // on no side, area
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t code = mesh.neighbors[element][direction];
    if (!DualMesh::isBoundary(code))
    {
      continue;
    }
    const ReducedFace reduced = faceOf(mesh.corners[element], direction);
    const double area = measurePolygon(mesh.points, reduced.loop()).area.norm();
    const BoundaryFace& face = mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    if (const std::pair size(!face.onDomainSide, area); size > largest)
    {
      largest = size;
      wall = DualMesh::boundaryFaceOf(code);
    }
  }
  return wall;
}

std::vector<Index> wallsOf(const DualMesh& mesh, const std::vector<Index>& elements)
{
  std::vector<Index> own(elements.size());
  std::ranges::transform(elements, own.begin(), [&](Index e) { return wallOf(mesh, e); });
  std::vector<Index> walls(elements.size(), noIndex);
  std::vector<Index> reached; // places in `elements`
  std::size_t next = 0;
  // Sides of the domain come last, so that a wall goes around elements left out.
  for (const bool onSide : {false, true})
  {
    for (Index i = 0; i < elements.size(); ++i)
    {
      if (walls[i] == noIndex && own[i] != noIndex && mesh.boundaryFaces[own[i]].onDomainSide == onSide)
      {
        walls[i] = own[i];
        reached.push_back(i);
      }
    }
    for (; next < reached.size(); ++next)
    {
      for (const std::int32_t code : mesh.neighbors[elements[reached[next]]])
      {
        if (code < 0 || !std::ranges::binary_search(elements, static_cast<Index>(code)))
        {
          continue;
        }
        const std::size_t beside = placeIn(elements, static_cast<Index>(code));
        if (walls[beside] == noIndex)
        {
          walls[beside] = walls[reached[next]];
          reached.push_back(static_cast<Index>(beside));
        }
      }
    }
  }
  return walls;
}

} // namespace atria
