// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/DividedMesh.h"

#include "Quality/Faces/CellShapes.h"

#include <algorithm>
#include <map>
#include <random>

namespace atria::testing {

namespace {

std::span<const std::int64_t> cornersOf(const SampleMesh& mesh, std::size_t cell)
{
  return std::span(mesh.connectivity)
      .subspan(static_cast<std::size_t>(mesh.offsets[cell]),
               static_cast<std::size_t>(mesh.offsets[cell + 1] - mesh.offsets[cell]));
}

std::vector<std::vector<std::int64_t>> polygonsOf(const SampleMesh& mesh, std::size_t cell)
{
  std::vector<std::vector<std::int64_t>> polygons;
  auto next = mesh.faceStream.begin() + mesh.faceLocations[cell];
  for (std::int64_t count = *next++; count > 0; --count)
  {
    const std::int64_t size = *next++;
    polygons.emplace_back(next, next + size);
    next += size;
  }
  return polygons;
}

template <typename PointOf> void addCell(const SampleMesh& from, std::size_t cell, SampleMesh& to, PointOf&& pointOf)
{
  const auto renumber = [&](std::vector<std::int64_t> ids) {
    std::ranges::transform(ids, ids.begin(), pointOf);
    return ids;
  };
  if (from.types[cell] == polyhedronCell)
  {
    std::vector<std::vector<std::int64_t>> polygons = polygonsOf(from, cell);
    std::ranges::transform(polygons, polygons.begin(), renumber);
    to.addPolyhedron(polygons);
    return;
  }
  const auto corners = cornersOf(from, cell);
  to.addCell(from.types[cell], renumber({corners.begin(), corners.end()}));
}

} // namespace

DividedSample::DividedSample(unsigned seed, std::size_t ranks, std::array<int, 3> size, double distance)
{
  std::mt19937 random(seed);
  const auto oneIn = [&](int n) { return std::uniform_int_distribution(1, n)(random) == 1; };
  mesh = mixedCells(size, seed, distance);
  const SampleMesh above = hexahedra({size[0], size[1], 4});
  const auto firstPoint = static_cast<std::int64_t>(mesh.points.size());
  const std::size_t firstCube = mesh.types.size();
  for (const Vec3& point : above.points)
  {
    mesh.points.push_back(point + Vec3(0.0, 0.0, size[2]));
  }
  for (std::size_t cell = 0; cell < above.types.size(); ++cell)
  {
    addCell(above, cell, mesh, [&](std::int64_t p) { return p + firstPoint; });
  }
  std::map<std::vector<std::int64_t>, Index> first; ///< of a face's points, sorted, the first of its cells
  for (std::size_t cell = firstCube; cell < mesh.types.size(); ++cell)
  {
    const auto corners = cornersOf(mesh, cell);
    for (const LocalFace& face : shapeOf(hexahedronCell).faces)
    {
      std::vector<std::int64_t> points;
      std::transform(face.corners, face.corners + face.size, std::back_inserter(points),
                     [&](int corner) { return corners[static_cast<std::size_t>(corner)]; });
      std::vector<std::int64_t> sorted = points;
      std::ranges::sort(sorted);
      const auto [other, isFirst] = first.emplace(sorted, static_cast<Index>(cell));
      if (!isFirst && oneIn(20))
      {
        for (const Index side : {other->second, static_cast<Index>(cell)})
        {
          faceCells.push_back(side);
          facePoints.push_back(points);
          patchOf.push_back(random() % 3);
        }
      }
    }
  }
  const std::size_t run = seed % 2 == 0 ? 1 + (mesh.types.size() - 1) / ranks : 9;
  for (std::size_t cell = 0; cell < mesh.types.size(); ++cell)
  {
    labels.push_back(static_cast<std::int64_t>(random() % 4));
    const bool isFirstEmpty = seed % 3 == 0 && ranks > 1;
    rankOf.push_back(static_cast<Index>(isFirstEmpty ? 1 + cell / run % (ranks - 1) : cell / run % ranks));
  }
}

std::vector<BoundaryFaceKey> DividedSample::faces() const
{
  std::vector<BoundaryFaceKey> keys;
  for (std::size_t f = 0; f < faceCells.size(); ++f)
  {
    keys.push_back({faceCells[f], facePoints[f]});
  }
  return keys;
}

std::vector<Index> ringsAbout(const DividedSample& sample, Index rank)
{
  const SampleMesh& mesh = sample.mesh;
  std::vector<Index> ringOf(mesh.types.size(), noIndex);
  std::vector<char> isNear(mesh.points.size(), 0);
  for (Index ring = 0;; ++ring)
  {
    std::vector<std::size_t> added;
    for (std::size_t cell = 0; cell < ringOf.size(); ++cell)
    {
      const auto corners = cornersOf(mesh, cell);
      const auto isNearPoint = [&](std::int64_t p) { return isNear[static_cast<std::size_t>(p)] != 0; };
      const bool isIn = ring == 0 ? sample.rankOf[cell] == rank : std::ranges::any_of(corners, isNearPoint);
      if (isIn && ringOf[cell] == noIndex)
      {
        ringOf[cell] = ring;
        added.push_back(cell);
      }
    }
    if (added.empty())
    {
      return ringOf;
    }
    for (const std::size_t cell : added)
    {
      std::ranges::for_each(cornersOf(mesh, cell), [&](std::int64_t p) { isNear[static_cast<std::size_t>(p)] = 1; });
    }
  }
}

PieceOfSample::PieceOfSample(const DividedSample& sample, Index rank)
{
  const std::vector<Index> ringOf = ringsAbout(sample, rank);
  std::map<std::int64_t, std::int64_t> newPoint;
  std::map<Index, Index> newCell;
  const auto pointOf = [&](std::int64_t p) {
    const auto [place, isNew] = newPoint.emplace(p, static_cast<std::int64_t>(pointIds.size()));
    if (isNew)
    {
      pointIds.push_back(p);
      mesh.points.push_back(sample.mesh.points[static_cast<std::size_t>(p)]);
    }
    return place->second;
  };
  for (std::size_t i = ringOf.size(); i-- > 0;) // the other way round
  {
    if (ringOf[i] <= 1)
    {
      newCell[static_cast<Index>(i)] = static_cast<Index>(mesh.types.size());
      addCell(sample.mesh, i, mesh, pointOf);
      cellIds.push_back(static_cast<std::int64_t>(i));
      isOwn.push_back(ringOf[i] == 0 ? 1 : 0);
      labels.push_back(sample.labels[i]);
    }
  }
  for (std::size_t f = 0; f < sample.faceCells.size(); ++f)
  {
    if (ringOf[sample.faceCells[f]] <= 1)
    {
      std::vector<std::int64_t>& points = facePoints.emplace_back(sample.facePoints[f]);
      std::ranges::transform(points, points.begin(), pointOf);
      patchOf.push_back(sample.patchOf[f]);
      faces.push_back({newCell.at(sample.faceCells[f]), points});
    }
  }
}

NarrowPiece PieceOfSample::view() const
{
  return {mesh.points, mesh.view(), cellIds, pointIds, isOwn, faces, patchOf, {IdView(labels)}};
}

} // namespace atria::testing
