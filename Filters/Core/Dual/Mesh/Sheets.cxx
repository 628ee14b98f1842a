// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Mesh/Sheets.h"

#include "Support/Buckets.h"
#include "Support/Pieces.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <span>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Points on the boundary, in order, and for each its elements, in order.
struct BoundaryStars
{
  std::vector<Index> points;
  Buckets elements;
};

/// Returns the stars of all boundary points. There can be several sectors only at sheets with both sides in the mesh
/// and where zones touch, but zones may touch at any boundary point.
BoundaryStars findStars(const DualMesh& mesh, const RunContext& context)
{
  const std::vector<char> marked = boundaryPoints(mesh, context.executor);
  BoundaryStars stars;
  stars.points = chosenNumbers(marked.size(), context.executor, [&](std::size_t p) { return marked[p] != 0; });
  Buffer<Index> slots(marked.size());
  context.executor.forEach(stars.points.size(), grain,
                           [&](std::size_t i) { slots[stars.points[i]] = static_cast<Index>(i); });
  const std::vector<Index> elements = chosenNumbers(mesh.elementCount(), context.executor,
                                                    [&](std::size_t e) { return hasMarked(mesh.corners[e], marked); });
  context.progress.check();
  stars.elements = fillInOrder(stars.points.size(), context.executor, [&](auto&& use) {
    context.executor.forEach(elements.size(), grain, [&](std::size_t i) {
      const auto& corners = mesh.corners[elements[i]];
      for (auto p = corners.begin(); p != corners.end(); ++p)
      {
        if (marked[*p] && std::find(corners.begin(), p, *p) == p)
        {
          use(slots[*p], elements[i]);
        }
      }
    });
  });
  return stars;
}

/// Returns the sector number of each element around a point; sectors are numbered by first element.
std::vector<Index> sectorsOf(const DualMesh& mesh, Index point, std::span<const Index> star)
{
  UnionFind sets(star.size());
  for (Index i = 0; i < star.size(); ++i)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const std::int32_t neighbor = mesh.neighbors[star[i]][direction];
      const auto& face = hexahedronFace[direction];
      const bool here =
          std::any_of(face.begin(), face.end(), [&](std::uint8_t c) { return mesh.corners[star[i]][c] == point; });
      if (neighbor < 0 || !here)
      {
        continue;
      }
      const auto found = std::lower_bound(star.begin(), star.end(), static_cast<Index>(neighbor));
      if (found != star.end() && *found == static_cast<Index>(neighbor))
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
  Buffer<Index> sectors(stars.elements.entries.size());
  std::vector<Index> copies(stars.points.size());
  context.executor.forEach(stars.points.size(), 1024, [&](std::size_t i) {
    const std::vector<Index> own = sectorsOf(mesh, stars.points[i], stars.elements.of(i));
    std::ranges::copy(own, sectors.begin() + stars.elements.offsets[i]);
    copies[i] = std::ranges::max(own);
  });
  const std::vector<Index> split =
      chosenNumbers(copies.size(), context.executor, [&](std::size_t i) { return copies[i] > 0; });
  const Index count = scan(copies);
  context.progress.check();
  const auto before = static_cast<Index>(mesh.points.size());
  mesh.points.reserve(before + count); // else the list would grow to twice its size
  mesh.points.resize(before + count);
  std::vector<Index> sources(count);
  for (const Index i : split)
  {
    const Index point = stars.points[i];
    const auto star = stars.elements.of(i);
    for (std::size_t s = 0; s < star.size(); ++s)
    {
      const Index sector = sectors[stars.elements.offsets[i] + s];
      if (sector == 0)
      {
        continue;
      }
      const Index copy = before + copies[i] + sector - 1;
      mesh.points[copy] = mesh.points[point];
      sources[copy - before] = point;
      std::ranges::replace(mesh.corners[star[s]], point, copy);
    }
  }
  return sources;
}

} // namespace atria
