// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Sheets.h"

#include "Support/UnionFind.h"

#include <algorithm>
#include <span>

namespace atria {

namespace {

/// Points on the boundary, and the elements about each of them, sorted.
struct BoundaryStars
{
  std::vector<Index> points;
  std::vector<Index> offsets{0};
  std::vector<Index> elements;
};

/// Only where both sides of some sheet are in the mesh, or zones touch, can there be more than one sector; all boundary
/// points are looked at nevertheless, as zones may touch at a point.
BoundaryStars findStars(const DualMesh& mesh)
{
  std::vector<char> marked(mesh.points.size(), 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      marked[mesh.corners[face.element][c]] = 1;
    }
  }
  std::vector<std::pair<Index, Index>> pairs;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (const Index p : mesh.corners[e])
    {
      if (marked[p])
      {
        pairs.emplace_back(p, e);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  BoundaryStars stars;
  for (const auto& [p, e] : pairs)
  {
    if (stars.points.empty() || stars.points.back() != p)
    {
      stars.points.push_back(p);
      stars.offsets.push_back(stars.offsets.back());
    }
    stars.elements.push_back(e);
    ++stars.offsets.back();
  }
  return stars;
}

/// For each element about a point, the number of its sector; numbered by first element.
std::vector<Index> sectorsOf(const DualMesh& mesh, Index point, std::span<const Index> star)
{
  UnionFind sets(star.size());
  for (Index i = 0; i < star.size(); ++i)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const std::int32_t neighbour = mesh.neighbours[star[i]][direction];
      const auto& face = hexahedronFace[direction];
      const bool here =
          std::any_of(face.begin(), face.end(), [&](std::uint8_t c) { return mesh.corners[star[i]][c] == point; });
      if (neighbour < 0 || !here)
      {
        continue;
      }
      const auto found = std::lower_bound(star.begin(), star.end(), static_cast<Index>(neighbour));
      if (found != star.end() && *found == static_cast<Index>(neighbour))
      {
        sets.join(i, static_cast<Index>(found - star.begin()));
      }
    }
  }
  std::vector<Index> sectors(star.size());
  Index count = 0;
  for (Index i = 0; i < star.size(); ++i)
  {
    const Index root = sets.find(i);
    sectors[i] = root == i ? count++ : sectors[root];
  }
  return sectors;
}

} // namespace

std::vector<Index> splitSheets(DualMesh& mesh, const RunContext& context)
{
  const BoundaryStars stars = findStars(mesh);
  std::vector<Index> sectors(stars.elements.size());
  std::vector<Index> copies(stars.points.size() + 1, 0);
  context.executor.forEach(stars.points.size(), 1024, [&](std::size_t i) {
    const auto star = std::span(stars.elements).subspan(stars.offsets[i], stars.offsets[i + 1] - stars.offsets[i]);
    const std::vector<Index> own = sectorsOf(mesh, stars.points[i], star);
    std::copy(own.begin(), own.end(), sectors.begin() + stars.offsets[i]);
    copies[i + 1] = *std::max_element(own.begin(), own.end());
  });
  for (std::size_t i = 1; i < copies.size(); ++i)
  {
    copies[i] += copies[i - 1];
  }
  context.progress.check();
  const auto before = static_cast<Index>(mesh.points.size());
  mesh.points.resize(before + copies.back());
  std::vector<Index> sources(copies.back());
  for (std::size_t i = 0; i < stars.points.size(); ++i)
  {
    const Index point = stars.points[i];
    for (Index s = stars.offsets[i]; s < stars.offsets[i + 1]; ++s)
    {
      if (sectors[s] == 0)
      {
        continue;
      }
      const Index copy = before + copies[i] + sectors[s] - 1;
      mesh.points[copy] = mesh.points[point];
      sources[copy - before] = point;
      auto& corners = mesh.corners[stars.elements[s]];
      std::replace(corners.begin(), corners.end(), point, copy);
    }
  }
  return sources;
}

} // namespace atria
