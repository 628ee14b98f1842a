// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/FlatElements.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <span>

namespace atria {

namespace {

Vec3 areaOf(const DualMesh& mesh, const ReducedFace& face)
{
  Vec3 twice = Vec3::Zero();
  const Vec3& first = mesh.points[face.points[0]];
  for (int i = 2; i < face.count; ++i)
  {
    twice += (mesh.points[face.points[i - 1]] - first).cross(mesh.points[face.points[i]] - first);
  }
  return 0.5 * twice;
}

double longestEdge(const DualMesh& mesh, Index element)
{
  double longest = 0.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const ReducedFace face = faceOf(mesh.corners[element], direction);
    for (int i = 0; i < face.count; ++i)
    {
      longest =
          std::max(longest, (mesh.points[face.points[i]] - mesh.points[face.points[(i + 1) % face.count]]).norm());
    }
  }
  return longest;
}

/// The boundary face with most area; noIndex for an element that has none.
Index largestBoundaryFace(const DualMesh& mesh, Index element)
{
  Index largest = noIndex;
  double most = -1.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbour = mesh.neighbours[element][direction];
    if (DualMesh::isBoundary(neighbour))
    {
      const double area = areaOf(mesh, faceOf(mesh.corners[element], direction)).norm();
      if (area > most)
      {
        most = area;
        largest = DualMesh::boundaryFaceOf(neighbour);
      }
    }
  }
  return largest;
}

bool isFlat(const DualMesh& mesh, Index element, const Flatness& flatness)
{
  const Index largest = largestBoundaryFace(mesh, element);
  if (largest == noIndex)
  {
    return false;
  }
  const ReducedFace base = faceOf(mesh.corners[element], mesh.boundaryFaces[largest].direction);
  const double reach = flatness.thickness * longestEdge(mesh, element);
  Vec3 normal = Vec3::Zero();
  double area = 0.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbour = mesh.neighbours[element][direction];
    if (neighbour != DualMesh::noFace)
    {
      const Vec3 a = areaOf(mesh, faceOf(mesh.corners[element], direction));
      normal += DualMesh::isBoundary(neighbour) ? a : Vec3(-a);
      area += a.norm();
    }
  }
  if (normal.norm() < 0.5 * area)
  {
    return false;
  }
  normal.normalize();
  const Vec3& origin = mesh.points[base.points[0]];
  if (std::ranges::any_of(mesh.corners[element],
                          [&](Index p) { return std::abs(normal.dot(mesh.points[p] - origin)) > reach; }))
  {
    return false;
  }
  // Else a part of the element would be left as a fold of no thickness.
  double folded = 0.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbour = mesh.neighbours[element][direction];
    if (neighbour != DualMesh::noFace)
    {
      const double sense = DualMesh::isBoundary(neighbour) ? 1.0 : -1.0;
      const double along = sense * normal.dot(areaOf(mesh, faceOf(mesh.corners[element], direction)));
      folded += std::max(0.0, -along);
    }
  }
  return folded <= flatness.fold * area;
}

/// New numbers for what is not marked.
std::vector<Index> renumber(const std::vector<char>& gone)
{
  std::vector<Index> numbers(gone.size(), noIndex);
  Index count = 0;
  for (std::size_t i = 0; i < gone.size(); ++i)
  {
    if (!gone[i])
    {
      numbers[i] = count++;
    }
  }
  return numbers;
}

template <typename T> void compact(std::vector<T>& values, const std::vector<Index>& numbers)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (numbers[i] != noIndex)
    {
      values[count++] = values[i];
    }
  }
  values.resize(count);
}

/// Gives the faces by which others touch the element to the boundary. Returns one of the others.
Index exposeNeighbours(DualMesh& mesh, Index element, const std::vector<char>& marked)
{
  Index beside = noIndex;
  const Index source = largestBoundaryFace(mesh, element);
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbour = mesh.neighbours[element][direction];
    if (neighbour < 0 || marked[neighbour])
    {
      continue;
    }
    BoundaryFace face = mesh.boundaryFaces[source];
    face.element = static_cast<Index>(neighbour);
    face.direction = static_cast<std::uint8_t>(opposite(direction));
    mesh.neighbours[neighbour][face.direction] = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
    mesh.boundaryFaces.push_back(face);
    beside = beside == noIndex ? face.element : beside;
  }
  return beside;
}

/// Leaves out the boundary faces of elements that are gone, and gives the others the new numbers. Faces across a sheet
/// from an element that is gone get the element in its stead.
void compactBoundary(DualMesh& mesh, const std::vector<Index>& elements, const std::vector<Index>& inStead)
{
  std::vector<BoundaryFace> kept;
  for (BoundaryFace face : mesh.boundaryFaces)
  {
    if (elements[face.element] == noIndex)
    {
      continue;
    }
    for (int step = 0; step < 4 && face.opposite != noIndex && elements[face.opposite] == noIndex; ++step)
    {
      face.opposite = inStead[face.opposite];
    }
    face.opposite = face.opposite == noIndex ? noIndex : elements[face.opposite];
    mesh.neighbours[face.element][face.direction] = ~static_cast<std::int32_t>(kept.size());
    face.element = elements[face.element];
    kept.push_back(face);
  }
  mesh.boundaryFaces = std::move(kept);
}

} // namespace

std::vector<char> findFlatElements(const DualMesh& mesh, const Flatness& flatness, const RunContext& context)
{
  std::vector<char> onBoundary(mesh.points.size(), 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      onBoundary[mesh.corners[face.element][c]] = 1;
    }
  }
  std::vector<char> flat(mesh.elementCount(), 0);
  context.executor.forEach(flat.size(), 4096, [&](std::size_t e) {
    flat[e] = std::ranges::all_of(mesh.corners[e], [&](Index p) { return onBoundary[p] != 0; }) &&
                      isFlat(mesh, static_cast<Index>(e), flatness)
                  ? 1
                  : 0;
  });
  return flat;
}

MeshRenumbering removeElements(DualMesh& mesh, const std::vector<char>& marked)
{
  MeshRenumbering result;
  if (std::find(marked.begin(), marked.end(), 1) == marked.end())
  {
    return result;
  }
  std::vector<Index> inStead(marked.size(), noIndex);
  for (Index e = 0; e < marked.size(); ++e)
  {
    if (marked[e])
    {
      inStead[e] = exposeNeighbours(mesh, e, marked);
    }
  }
  result.elements = renumber(marked);
  compactBoundary(mesh, result.elements, inStead);
  std::vector<char> unused(mesh.points.size(), 1);
  for (Index e = 0; e < marked.size(); ++e)
  {
    for (const Index p : marked[e] ? std::span<const Index>() : std::span<const Index>(mesh.corners[e]))
    {
      unused[p] = 0;
    }
  }
  result.points = renumber(unused);
  compact(mesh.points, result.points);
  compact(mesh.corners, result.elements);
  compact(mesh.neighbours, result.elements);
  compact(mesh.levels, result.elements);
  compact(mesh.zones, result.elements);
  for (auto& corners : mesh.corners)
  {
    std::ranges::transform(corners, corners.begin(), [&](Index p) { return result.points[p]; });
  }
  for (auto& neighbours : mesh.neighbours)
  {
    for (std::int32_t& neighbour : neighbours)
    {
      neighbour = neighbour >= 0 ? static_cast<std::int32_t>(result.elements[neighbour]) : neighbour;
    }
  }
  return result;
}

} // namespace atria
