// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/CellSource.h"

#include "Quality/Faces/CellShapes.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace atria {

namespace {

constexpr std::size_t grain = 2048;

} // namespace

void DualSource::neighborsOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const std::int32_t neighbor : mesh_.neighbors[cell])
  {
    if (neighbor >= 0)
    {
      out.push_back(static_cast<Index>(neighbor));
    }
  }
}

void DualSource::cornersOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const Index corner : mesh_.corners[cell])
  {
    out.push_back(corner);
  }
}

void DualSource::facesOf(Index cell, std::span<const Index> names, Scratch& out) const
{
  std::array<Index, 8> corners;
  std::ranges::copy(names, corners.begin());
  out.faces.clear();
  out.points.resize(24);
  std::size_t begin = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbor = mesh_.neighbors[cell][direction];
    if (neighbor == DualMesh::noFace)
    {
      continue;
    }
    const ReducedFace face = faceOf(corners, direction);
    const std::span points(out.points.data() + begin, static_cast<std::size_t>(face.count));
    for (const Index p : std::span(face.points).first(points.size()))
    {
      out.points[begin++] = p;
    }
    out.faces.push_back({points, neighbor >= 0 ? static_cast<Index>(neighbor) : noIndex});
  }
  out.points.resize(begin);
}

/// Elements with eight different corners are hexahedra.
NativeCell DualSource::nativeOf(Index cell) const
{
  std::array<Index, 8> sorted = mesh_.corners[cell];
  std::ranges::sort(sorted);
  const bool isHexahedron = std::ranges::adjacent_find(sorted) == sorted.end();
  return isHexahedron ? NativeCell{hexahedronCell, mesh_.corners[cell]} : NativeCell{};
}

bool DualSource::boxOf(Index cell, CellBox& out) const
{
  constexpr double square = 1e-7; // tolerance as a share of the shortest side
  const auto& corners = mesh_.corners[cell];
  const Vec3& low = mesh_.points[corners[hexahedronCorner[0]]];
  out.lengths = mesh_.points[corners[hexahedronCorner[7]]] - low;
  const double tolerance = square * out.lengths.minCoeff();
  if (!(tolerance > 0.0))
  {
    return false;
  }
  for (unsigned i = 1; i < 7; ++i)
  {
    const Vec3 offset = mesh_.points[corners[hexahedronCorner[i]]] - low;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (std::abs(offset[axis] - (i >> axis & 1 ? out.lengths[axis] : 0.0)) > tolerance)
      {
        return false;
      }
    }
  }
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbor = mesh_.neighbors[cell][direction];
    if (neighbor == DualMesh::noFace)
    {
      return false;
    }
    out.across[direction] = neighbor >= 0 ? static_cast<Index>(neighbor) : noIndex;
  }
  return true;
}

bool DualSource::hasMarked(Index cell, const std::vector<char>& marked) const
{
  return atria::hasMarked(mesh_.corners[cell], marked);
}

/// Avoids a virtual call for each cell.
void DualSource::appendMarked(std::size_t begin, std::size_t end, const std::vector<char>& marked,
                              std::vector<Index>& out) const
{
  for (std::size_t cell = begin; cell < end; ++cell)
  {
    if (atria::hasMarked(mesh_.corners[cell], marked))
    {
      out.push_back(static_cast<Index>(cell));
    }
  }
}

void FaceMeshSource::neighborsOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const Index f : cellFaces_.of(cell))
  {
    if (f < mesh_.internalFaceCount())
    {
      out.push_back(mesh_.owner[f] == cell ? mesh_.neighbor[f] : mesh_.owner[f]);
    }
  }
}

/// Lists the points face by face, normals outward.
void FaceMeshSource::cornersOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const Index f : cellFaces_.of(cell))
  {
    const auto points = mesh_.face(f);
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    out.insert(out.end(), points.begin(), points.end());
    if (mesh_.owner[f] != cell)
    {
      std::reverse(out.begin() + begin, out.end());
    }
  }
}

void FaceMeshSource::facesOf(Index cell, std::span<const Index> names, Scratch& out) const
{
  out.faces.clear();
  out.points.assign(names.begin(), names.end());
  const Index* next = out.points.data();
  for (const Index f : cellFaces_.of(cell))
  {
    const std::size_t size = mesh_.face(f).size();
    const bool owned = mesh_.owner[f] == cell;
    const Index across = f >= mesh_.internalFaceCount() ? noIndex : owned ? mesh_.neighbor[f] : mesh_.owner[f];
    out.faces.push_back({{next, size}, across});
    next += size;
  }
}

NativeCell FaceMeshSource::nativeOf(Index cell) const
{
  NativeCell out;
  const std::size_t corners = shapeOf(cells_.types[cell]).corners;
  if (corners > 0)
  {
    out.type = cells_.types[cell];
    const auto first = static_cast<std::size_t>(cells_.offsets[cell]);
    for (std::size_t i = 0; i < corners; ++i)
    {
      out.corners[i] = static_cast<Index>(cells_.connectivity[first + i]);
    }
  }
  return out;
}

bool FaceMeshSource::hasMarked(Index cell, const std::vector<char>& marked) const
{
  return std::ranges::any_of(cellFaces_.of(cell), [&](Index f) {
    return std::ranges::any_of(mesh_.face(f), [&](Index p) { return marked[p] != 0; });
  });
}

std::vector<Index> numbersOf(const std::vector<char>& marked, const Executor& executor)
{
  return chosenNumbers(marked.size(), executor, [&](std::size_t i) { return marked[i] != 0; });
}

std::vector<Index> cellsWithMarked(const CellSource& source, const std::vector<char>& marked, const RunContext& context)
{
  return collectInOrder(source.cellCount(), context.executor,
                        [&](std::size_t begin, std::size_t end, std::vector<Index>& out) {
                          context.progress.check();
                          source.appendMarked(begin, end, marked, out);
                        });
}

std::vector<std::vector<Index>> inPieces(const CellSource& source, const std::vector<Index>& cells)
{
  std::vector<char> waits(source.cellCount(), 0);
  for (const Index cell : cells)
  {
    waits[cell] = 1;
  }
  std::vector<std::vector<Index>> pieces;
  const auto take = [&](Index cell) {
    waits[cell] = 0;
    pieces.back().push_back(cell);
  };
  std::vector<Index> beside;
  for (const Index cell : cells)
  {
    if (!waits[cell])
    {
      continue;
    }
    if (pieces.empty() || pieces.back().size() >= Pieces::length)
    {
      pieces.emplace_back().reserve(Pieces::length + 8);
    }
    take(cell);
    source.neighborsOf(cell, beside);
    for (const Index other : beside)
    {
      if (waits[other] && other > cell + Pieces::length)
      {
        take(other);
      }
    }
  }
  return pieces;
}

std::vector<Index> withNeighbors(const CellSource& source, const std::vector<Index>& cells, const RunContext& context)
{
  std::vector<char> marked(source.cellCount(), 0);
  const auto mark = [&](Index cell) { std::atomic_ref(marked[cell]).store(1, std::memory_order_relaxed); };
  context.executor.forRanges(cells.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> beside;
    for (std::size_t i = begin; i < end; ++i)
    {
      mark(cells[i]);
      source.neighborsOf(cells[i], beside);
      std::ranges::for_each(beside, mark);
    }
  });
  return numbersOf(marked, context.executor);
}

} // namespace atria
