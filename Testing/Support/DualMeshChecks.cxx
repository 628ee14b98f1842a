// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/DualMeshChecks.h"

#include "Quality/Checks/ScaledJacobian.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

namespace atria::testing {

namespace {

using Edge = std::pair<Index, Index>;

std::vector<Index> sorted(const ReducedFace& face)
{
  std::vector<Index> points(face.points.begin(), face.points.begin() + face.count);
  std::sort(points.begin(), points.end());
  return points;
}

template <typename F> void eachEdge(const ReducedFace& face, F&& f)
{
  for (int i = 0; face.count >= 3 && i < face.count; ++i)
  {
    f(face.points[i], face.points[(i + 1) % face.count]);
  }
}

template <typename Array> bool sameBits(const Array& a, const Array& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

bool sameFaces(const std::vector<BoundaryFace>& a, const std::vector<BoundaryFace>& b)
{
  const auto key = [](const BoundaryFace& f) {
    return std::tuple(f.element, f.tag, f.opposite, f.direction, f.side, f.onDomainSide);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const BoundaryFace& l, const BoundaryFace& r) { return key(l) == key(r); });
}

bool sameZones(const std::vector<ZoneFace>& a, const std::vector<ZoneFace>& b)
{
  const auto key = [](const ZoneFace& f) { return std::tuple(f.element, f.tag, f.direction, f.side); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const ZoneFace& l, const ZoneFace& r) { return key(l) == key(r); });
}

} // namespace

::testing::AssertionResult isConformal(const DualMesh& mesh, Index plainElements)
{
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (int d = 0; d < 6; ++d)
    {
      const std::int32_t neighbor = mesh.neighbors[e][d];
      const ReducedFace face = faceOf(mesh.corners[e], d);
      const auto fail = [&](const char* why) {
        return ::testing::AssertionFailure() << "element " << e << ", direction " << d << ": " << why;
      };
      if ((face.count < 3) != (neighbor == DualMesh::noFace))
      {
        return fail("a face without area, or an area without face");
      }
      if (DualMesh::isBoundary(neighbor))
      {
        const BoundaryFace& boundary = mesh.boundaryFaces.at(DualMesh::boundaryFaceOf(neighbor));
        if (boundary.element != e || boundary.direction != d)
        {
          return fail("its boundary face belongs to another");
        }
      }
      else if (neighbor >= 0)
      {
        const bool along = std::max(e, static_cast<Index>(neighbor)) < plainElements;
        int found = 0;
        for (int back = 0; back < 6; ++back)
        {
          found += (back == opposite(d) || !along) &&
                           mesh.neighbors.at(neighbor)[back] == static_cast<std::int32_t>(e) &&
                           sorted(face) == sorted(faceOf(mesh.corners[neighbor], back))
                       ? 1
                       : 0;
        }
        if (found != 1)
        {
          return fail("its neighbor has another neighbor or another face");
        }
      }
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult facesAreUnique(const DualMesh& mesh)
{
  std::map<std::vector<Index>, std::vector<std::pair<Index, int>>> users;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (int d = 0; d < 6; ++d)
    {
      const ReducedFace face = faceOf(mesh.corners[e], d);
      if (face.count >= 3)
      {
        users[sorted(face)].push_back({e, d});
      }
    }
  }
  for (const auto& [points, at] : users)
  {
    const auto [e, d] = at.front();
    const std::int32_t code = mesh.neighbors[e][d];
    const bool alone = at.size() == 1 && DualMesh::isBoundary(code);
    const bool pair = at.size() == 2 && code == static_cast<std::int32_t>(at.back().first);
    const bool sheet = at.size() == 2 && DualMesh::isBoundary(code) &&
                       mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite == at.back().first;
    if (!alone && !pair && !sheet)
    {
      return ::testing::AssertionFailure()
             << "a face of element " << e << ", direction " << d << ", has " << at.size() << " users";
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult elementsAreClosed(const DualMesh& mesh)
{
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    std::map<Edge, int> edges;
    int faces = 0;
    for (int d = 0; d < 6; ++d)
    {
      const ReducedFace face = faceOf(mesh.corners[e], d);
      faces += face.count >= 3 ? 1 : 0;
      eachEdge(face, [&](Index a, Index b) { ++edges[{a, b}]; });
    }
    for (const auto& [edge, uses] : edges)
    {
      const auto back = edges.find({edge.second, edge.first});
      if (uses != 1 || back == edges.end() || back->second != 1)
      {
        return ::testing::AssertionFailure() << "element " << e << " is not closed";
      }
    }
    const std::set<Index> points(mesh.corners[e].begin(), mesh.corners[e].end());
    if (static_cast<int>(points.size()) - static_cast<int>(edges.size() / 2) + faces != 2)
    {
      return ::testing::AssertionFailure() << "element " << e << " is no ball";
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult boundaryIsWatertight(const DualMesh& mesh)
{
  std::map<Edge, int> balance;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    eachEdge(faceOf(mesh.corners[face.element], face.direction),
             [&](Index a, Index b) { balance[std::minmax(a, b)] += a < b ? 1 : -1; });
  }
  for (const auto& [edge, sum] : balance)
  {
    if (sum != 0)
    {
      return ::testing::AssertionFailure() << "the boundary is open at the edge " << edge.first << ", " << edge.second;
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult isSound(const DualMesh& mesh, Index plainElements)
{
  for (const ::testing::AssertionResult& found :
       {isConformal(mesh, plainElements), elementsAreClosed(mesh), boundaryIsWatertight(mesh)})
  {
    if (!found)
    {
      return found;
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult isValid(const DualMesh& mesh, Index plainElements)
{
  const std::vector<double> all = volumes(mesh);
  const auto least = std::ranges::min_element(all);
  if (least != all.end() && !(*least > 0.0))
  {
    return ::testing::AssertionFailure() << "element " << least - all.begin() << " has the volume " << *least;
  }
  return isSound(mesh, plainElements);
}

std::vector<double> volumes(const DualMesh& mesh)
{
  std::vector<double> out(mesh.elementCount(), 0.0);
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    const Vec3 origin = mesh.points[mesh.corners[e][0]];
    for (int d = 0; d < 6; ++d)
    {
      const ReducedFace face = faceOf(mesh.corners[e], d);
      Vec3 center = Vec3::Zero();
      for (int i = 0; i < face.count; ++i)
      {
        center += mesh.points[face.points[i]] - origin;
      }
      center /= face.count;
      eachEdge(face, [&](Index a, Index b) {
        out[e] += center.dot((mesh.points[a] - origin).cross(mesh.points[b] - origin)) / 6.0;
      });
    }
  }
  return out;
}

double totalVolume(const DualMesh& mesh)
{
  const std::vector<double> all = volumes(mesh);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

bool identical(const DualMesh& a, const DualMesh& b)
{
  return sameBits(a.points, b.points) && sameBits(a.corners, b.corners) && sameBits(a.neighbors, b.neighbors) &&
         sameBits(a.levels, b.levels) && sameBits(a.zones, b.zones) && sameBits(a.rooms, b.rooms) &&
         sameBits(a.cellZones, b.cellZones) && sameFaces(a.boundaryFaces, b.boundaryFaces) &&
         sameZones(a.zoneFaces, b.zoneFaces);
}

FaceCounts faceCounts(const DualMesh& mesh, Index element)
{
  FaceCounts counts;
  for (int d = 0; d < 6; ++d)
  {
    const ReducedFace face = faceOf(mesh.corners[element], d);
    counts.quads += face.count == 4 ? 1 : 0;
    counts.triangles += face.count == 3 ? 1 : 0;
  }
  return counts;
}

ElementCounts countElements(const DualMesh& mesh, const std::vector<Index>& elements)
{
  ElementCounts counts;
  for (const Index e : elements)
  {
    const FaceCounts faces = faceCounts(mesh, e);
    std::size_t& kind = faces == FaceCounts{6, 0}   ? counts.hexahedra
                        : faces == FaceCounts{3, 2} ? counts.wedges
                        : faces == FaceCounts{1, 4} ? counts.pyramids
                                                    : counts.polyhedra;
    ++kind;
  }
  return counts;
}

double leastScaledJacobian(const DualMesh& mesh)
{
  constexpr unsigned char hexahedron = 12;
  double least = 1.0;
  for (const auto& element : mesh.corners)
  {
    std::array<Vec3, 8> corners;
    std::ranges::transform(element, corners.begin(), [&](Index p) { return mesh.points[p]; });
    std::array<Index, 8> sorted = element;
    std::ranges::sort(sorted);
    const bool isHexahedron = std::ranges::adjacent_find(sorted) == sorted.end();
    least = isHexahedron ? std::min(least, scaledJacobian(hexahedron, corners)) : least;
  }
  return least;
}

} // namespace atria::testing
