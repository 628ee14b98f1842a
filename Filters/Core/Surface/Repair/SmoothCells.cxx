// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/SmoothCells.h"

#include "Grid/Morton.h"
#include "Support/Angles.h"
#include "Support/UnionFind.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Triangles/EachEdge.h"

#include <Eigen/Geometry>

#include <bit>
#include <optional>
#include <unordered_map>

namespace atria {

namespace {

/// True if an edge has two triangles of one surface that bend by no more than the angle.
bool isSmooth(std::span<const SoupEdgeUse> uses, const TriangleSoup& soup, const std::vector<Vec3>& normals,
              double cosine)
{
  if (uses.size() != 2)
  {
    return false;
  }
  const Index s = uses[0].triangle;
  const Index t = uses[1].triangle;
  const double orientation = uses[0].forward != uses[1].forward ? 1.0 : -1.0;
  return soup.surfaceIds[s] == soup.surfaceIds[t] && orientation * normals[s].dot(normals[t]) >= cosine;
}

class Cells
{
public:
  Cells(const TriangleSoup& soup_, const SmoothPieces& smooth_, std::int64_t cellSize, std::int64_t reach_)
      : soup(soup_), smooth(smooth_), reach(reach_), origin(soup.points.front())
  {
    constexpr int keyBits = 21;
    LatticePoint high = origin;
    for (const LatticePoint& p : soup.points)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        origin[axis] = std::min(origin[axis], p[axis] - reach);
        high[axis] = std::max(high[axis], p[axis] + reach);
      }
    }
    shift = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(cellSize))) - 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto length = static_cast<std::uint64_t>(high[axis] - origin[axis]);
      shift = std::max(shift, static_cast<int>(std::bit_width(length)) - keyBits);
    }
  }

  std::vector<char> findLone(std::span<const SoupEdgeUse> uses)
  {
    placeTriangles();
    findPatches(uses);
    lookAcrossBorders();
    std::optional<BoxRaster> raster;
    if (!large.empty())
    {
      raster.emplace(large);
    }
    std::vector<char> isLone(soup.triangles.size(), 0);
    for (Index t = 0; t < isLone.size(); ++t)
    {
      bool lone = cellOf[t] != noIndex;
      eachCell(t, [&](Index cell) { lone = lone && cell != noIndex && cells[cell].isSimple; });
      isLone[t] = lone && !(raster && raster->mayTouch(boxOf(soup, t, reach))) ? 1 : 0;
    }
    return isLone;
  }

private:
  struct Cell
  {
    Vec3 mean = Vec3::Zero();
    Index patch = noIndex;
    Index piece = noIndex;
    bool isSimple = true;
  };

  GridCell gridCellOf(const LatticePoint& p) const
  {
    return {static_cast<std::uint32_t>((p[0] - origin[0]) >> shift),
            static_cast<std::uint32_t>((p[1] - origin[1]) >> shift),
            static_cast<std::uint32_t>((p[2] - origin[2]) >> shift)};
  }

  /// Puts each triangle in the cell that holds the middle of its box, unless it is larger than a cell.
  void placeTriangles()
  {
    cellOf.assign(soup.triangles.size(), noIndex);
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      const NumberedBox box = boxOf(soup, t, reach);
      LatticePoint middle;
      bool isLarge = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] = box.low[axis] + (box.high[axis] - box.low[axis]) / 2;
        isLarge = isLarge || (box.high[axis] - box.low[axis]) >> shift > 0;
      }
      if (isLarge)
      {
        large.push_back(box);
        continue;
      }
      const auto [found, isNew] = numbers.try_emplace(mortonKey(gridCellOf(middle)), static_cast<Index>(cells.size()));
      if (isNew)
      {
        cells.emplace_back();
      }
      cellOf[t] = found->second;
      cells[found->second].mean += smooth.unitNormals[t];
    }
    for (Cell& cell : cells)
    {
      cell.mean.normalize();
    }
  }

  /// Marks cells with two patches, or with one that bends, as not simple.
  void findPatches(std::span<const SoupEdgeUse> uses)
  {
    UnionFind patches(soup.triangles.size());
    eachEdge(uses, [&](std::span<const SoupEdgeUse> of) {
      const Index s = of.front().triangle;
      const Index t = of.back().triangle;
      if (cellOf[s] == cellOf[t] && smooth.pieces[s] == smooth.pieces[t] &&
          isSmooth(of, soup, smooth.unitNormals, alongCosine))
      {
        patches.join(s, t);
      }
    });
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (cellOf[t] != noIndex)
      {
        Cell& cell = cells[cellOf[t]];
        const Index patch = patches.find(t);
        cell.isSimple = cell.isSimple && (cell.patch == noIndex || cell.patch == patch) && isAlong(cell, t);
        cell.patch = patch;
        cell.piece = smooth.pieces[t];
      }
    }
  }

  bool isAlong(const Cell& cell, Index t) const { return cell.mean.dot(smooth.unitNormals[t]) >= alongCosine; }

  /// Marks cells that another patch reaches into from beside them as not simple.
  void lookAcrossBorders()
  {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      eachCell(t, [&](Index number) {
        if (number != noIndex)
        {
          Cell& cell = cells[number];
          cell.isSimple = cell.isSimple && cell.piece == smooth.pieces[t] && isAlong(cell, t);
        }
      });
    }
  }

  /// Calls visit(cell) for the cells that a small triangle may reach, with noIndex for cells without triangles of their
  /// own.
  template <typename Visit> void eachCell(Index t, Visit&& visit) const
  {
    if (cellOf[t] == noIndex)
    {
      return;
    }
    const LatticeBox box = boxOf(soup, t, reach);
    const GridCell low = gridCellOf(box.low);
    const GridCell high = gridCellOf(box.high);
    if (low == high)
    {
      visit(cellOf[t]);
      return;
    }
    for (std::uint32_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::uint32_t x = low[0]; x <= high[0]; ++x)
        {
          const auto found = numbers.find(mortonKey({x, y, z}));
          visit(found == numbers.end() ? noIndex : found->second);
        }
      }
    }
  }

  const TriangleSoup& soup;
  const SmoothPieces& smooth;
  std::int64_t reach;
  LatticePoint origin;
  int shift = 0;
  /// One entry per triangle: its cell; noIndex for large triangles.
  std::vector<Index> cellOf;
  std::vector<NumberedBox> large;
  std::unordered_map<MortonKey, Index> numbers;
  std::vector<Cell> cells;
};

} // namespace

SmoothPieces::SmoothPieces(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses, double degrees,
                           const Executor& executor)
    : unitNormals(soup.triangles.size()), pieces(soup.triangles.size())
{
  constexpr std::size_t grain = 4096;
  executor.forEach(unitNormals.size(), grain, [&](std::size_t i) {
    const auto t = static_cast<Index>(i);
    unitNormals[t] =
        between(soup.corner(t, 0), soup.corner(t, 1)).cross(between(soup.corner(t, 0), soup.corner(t, 2))).normalized();
  });
  const double cosine = cosOfDegrees(degrees);
  UnionFind sets(soup.triangles.size());
  eachEdge(uses, [&](std::span<const SoupEdgeUse> of) {
    if (isSmooth(of, soup, unitNormals, cosine))
    {
      sets.join(of.front().triangle, of.back().triangle);
    }
  });
  for (Index t = 0; t < pieces.size(); ++t)
  {
    pieces[t] = sets.find(t);
  }
}

std::vector<char> findLoneTriangles(const TriangleSoup& soup, std::span<const SoupEdgeUse> uses,
                                    const SmoothPieces& smooth, std::int64_t cellSize, std::int64_t reach)
{
  if (soup.triangles.empty())
  {
    return {};
  }
  return Cells(soup, smooth, cellSize, reach).findLone(uses);
}

} // namespace atria
