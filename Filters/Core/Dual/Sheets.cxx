// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Sheets.h"

#include "Support/Pieces.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace atria {

namespace {

/// Points on the boundary, and the elements about each of them, sorted.
struct BoundaryStars
{
  std::vector<Index> points;
  std::vector<Index> offsets;
  std::vector<Index> elements;
};

/// Elements with points on the boundary: each such point's place among `slots` with the element, by elements.
using Uses = std::vector<std::pair<Index, Index>>;

std::vector<Uses> findUses(const DualMesh& mesh, const std::vector<Index>& slots, const RunContext& context)
{
  const Pieces pieces(mesh.elementCount());
  std::vector<Uses> uses(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    for (std::size_t e = pieces.begin(piece); e < pieces.end(piece); ++e)
    {
      const auto& corners = mesh.corners[e];
      for (auto p = corners.begin(); p != corners.end(); ++p)
      {
        if (slots[*p] != noIndex && std::find(corners.begin(), p, *p) == p)
        {
          uses[piece].emplace_back(slots[*p], static_cast<Index>(e));
        }
      }
    }
  });
  return uses;
}

/// Only where both sides of some sheet are in the mesh, or zones touch, can there be more than one sector; all boundary
/// points are looked at nevertheless, as zones may touch at a point.
BoundaryStars findStars(const DualMesh& mesh, const RunContext& context)
{
  const std::vector<char> marked = boundaryPoints(mesh);
  BoundaryStars stars;
  std::vector<Index> slots(marked.size(), noIndex);
  for (Index p = 0; p < marked.size(); ++p)
  {
    if (marked[p])
    {
      slots[p] = static_cast<Index>(stars.points.size());
      stars.points.push_back(p);
    }
  }
  const std::vector<Uses> uses = findUses(mesh, slots, context);
  // Counted two places up and summed one place up, an offset serves as its point's cursor, and ends as its begin.
  stars.offsets.assign(stars.points.size() + 2, 0);
  for (const Uses& piece : uses)
  {
    for (const auto& [slot, element] : piece)
    {
      ++stars.offsets[slot + 2];
    }
  }
  std::partial_sum(stars.offsets.begin(), stars.offsets.end(), stars.offsets.begin());
  stars.elements.resize(stars.offsets.back());
  for (const Uses& piece : uses)
  {
    for (const auto& [slot, element] : piece)
    {
      stars.elements[stars.offsets[slot + 1]++] = element;
    }
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
  const BoundaryStars stars = findStars(mesh, context);
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
