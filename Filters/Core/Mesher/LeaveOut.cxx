// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/LeaveOut.h"

#include "Mesher/Improvement/PartialMesh.h"
#include "Support/Numbering.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Gives the neighbors of elements boundary faces in their place.
void closeBeside(const std::vector<Index>& elements, ImprovedMesh& improved)
{
  DualMesh& mesh = improved.mesh;
  const std::vector<Index> walls = wallsOf(mesh, elements);
  for (std::size_t i = 0; i < elements.size(); ++i)
  {
    const Index e = elements[i];
    const BoundaryFace wall = mesh.boundaryFaces[walls[i]];
    for (const std::int32_t code : mesh.neighbors[e])
    {
      if (code < 0 || std::ranges::binary_search(elements, static_cast<Index>(code)))
      {
        continue;
      }
      std::array<std::int32_t, 6>& beside = mesh.neighbors[code];
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        if (beside[direction] == static_cast<std::int32_t>(e))
        {
          beside[direction] = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
          mesh.boundaryFaces.push_back(
              {static_cast<Index>(code), wall.tag, noIndex, direction, wall.side, false, wall.chart});
          improved.layers.counts.push_back(0);
          improved.layers.thicknesses.push_back(0.0);
        }
      }
    }
  }
}

void compactFaces(const std::vector<Index>& elementNumbers, ImprovedMesh& improved)
{
  DualMesh& mesh = improved.mesh;
  std::vector<char> stays(mesh.boundaryFaces.size());
  std::ranges::transform(mesh.boundaryFaces, stays.begin(),
                         [&](const BoundaryFace& face) { return elementNumbers[face.element] != noIndex ? 1 : 0; });
  const std::vector<Index> numbers = numbersOfKept(stays);
  compact(mesh.boundaryFaces, numbers);
  compact(improved.layers.counts, numbers);
  compact(improved.layers.thicknesses, numbers);
  for (BoundaryFace& face : mesh.boundaryFaces)
  {
    face.element = elementNumbers[face.element];
    face.opposite = face.opposite == noIndex ? noIndex : elementNumbers[face.opposite];
  }
  for (ZoneFace& face : mesh.zoneFaces)
  {
    face.element = elementNumbers[face.element];
  }
  for (std::array<std::int32_t, 6>& neighbors : mesh.neighbors)
  {
    for (std::int32_t& code : neighbors)
    {
      if (code >= 0)
      {
        code = static_cast<std::int32_t>(elementNumbers[code]);
      }
      else if (DualMesh::isBoundary(code))
      {
        code = ~static_cast<std::int32_t>(numbers[DualMesh::boundaryFaceOf(code)]);
      }
    }
  }
}

void compactPoints(ImprovedMesh& improved)
{
  DualMesh& mesh = improved.mesh;
  std::vector<char> stays(mesh.points.size(), 0);
  for (const auto& corners : mesh.corners)
  {
    for (const Index p : corners)
    {
      stays[p] = 1;
    }
  }
  const std::vector<Index> numbers = numbersOfKept(stays);
  compact(mesh.points, numbers);
  for (auto& corners : mesh.corners)
  {
    std::ranges::transform(corners, corners.begin(), [&](Index p) { return numbers[p]; });
  }
  for (DetachedVertex& vertex : improved.detached)
  {
    vertex.point = numbers[vertex.point];
  }
  std::erase_if(improved.detached, [](const DetachedVertex& vertex) { return vertex.point == noIndex; });
  improved.pointNumbers = numbers;
}

/// Returns the volume of an element whose faces are triangles around the mean of their points.
double volumeOf(const DualMesh& mesh, Index element, const Vec3& origin)
{
  double volume = 0.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const ReducedFace face = faceOf(mesh.corners[element], direction);
    Vec3 center = Vec3::Zero();
    for (const Index p : face.loop())
    {
      center += (mesh.points[p] - origin) / face.count;
    }
    for (int i = 0; face.count > 2 && i < face.count; ++i)
    {
      const Vec3 to = mesh.points[face.points[i]] - origin;
      const Vec3 next = mesh.points[face.points[(i + 1) % face.count]] - origin;
      volume += center.dot(to.cross(next)) / 6.0;
    }
  }
  return volume;
}

LeftOutElement describe(const DualMesh& mesh, Index element, const std::vector<Index>& numbers)
{
  LeftOutElement out{Vec3::Zero(), 0.0, noIndex, element, noIndex};
  for (const Index p : mesh.corners[element])
  {
    out.middle += mesh.points[p] / 8.0;
  }
  out.size = std::cbrt(std::max(0.0, volumeOf(mesh, element, out.middle)));
  for (const std::int32_t code : mesh.neighbors[element])
  {
    if (code >= 0 && out.beside == noIndex)
    {
      out.beside = numbers[code];
      out.besideBefore = static_cast<Index>(code);
    }
  }
  return out;
}

} // namespace

void leaveOut(const std::vector<Index>& elements, ImprovedMesh& improved)
{
  if (elements.empty())
  {
    return;
  }
  DualMesh& mesh = improved.mesh;
  std::vector<char> stays(mesh.elementCount(), 1);
  for (const Index e : elements)
  {
    stays[e] = 0;
  }
  const std::vector<Index> numbers = numbersOfKept(stays);
  for (const Index e : elements)
  {
    improved.leftOut.push_back(describe(mesh, e, numbers));
  }
  closeBeside(elements, improved);
  compact(mesh.corners, numbers);
  compact(mesh.neighbors, numbers);
  compact(mesh.levels, numbers);
  compact(mesh.zones, numbers);
  compact(mesh.rooms, numbers);
  compact(mesh.cellZones, numbers);
  compactFaces(numbers, improved);
  compactPoints(improved);
  improved.numbers = numbers;
}

} // namespace atria
