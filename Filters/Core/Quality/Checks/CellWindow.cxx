// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/CellWindow.h"

#include "Quality/Faces/CellShapes.h"
#include "Support/Error.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Calls use(point) for the points of a cell. Throws Error if a point does not exist.
template <typename F> void forPoints(const CellArrays& cells, std::size_t cell, std::size_t pointCount, F&& use)
{
  for (std::int64_t i = cells.offsets[cell]; i < cells.offsets[cell + 1]; ++i)
  {
    const std::int64_t point = cells.connectivity[static_cast<std::size_t>(i)];
    if (point < 0 || static_cast<std::size_t>(point) >= pointCount)
    {
      throw Error("a cell has a point that the mesh does not have");
    }
    use(static_cast<Index>(point));
  }
}

Index indexOf(std::span<const Index> sorted, Index value)
{
  const auto found = std::ranges::lower_bound(sorted, value);
  return found != sorted.end() && *found == value ? static_cast<Index>(found - sorted.begin()) : noIndex;
}

Buckets byCell(std::span<const BoundaryFaceKey> faces, std::size_t cellCount)
{
  return fillInOrder(cellCount, SerialExecutor(), [&](auto&& use) {
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      if (faces[i].cell >= cellCount)
      {
        throw Error("a face belongs to a cell that the mesh does not have");
      }
      use(faces[i].cell, static_cast<Index>(i));
    }
  });
}

/// True if all faces of own cells were found, and no face twice.
bool haveAll(const CellWindow& window, std::span<const Index> cells, std::vector<Index> found)
{
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (found[i] == noIndex && window.isOwn(cells[i]))
    {
      return false;
    }
  }
  std::erase(found, noIndex);
  std::ranges::sort(found);
  return std::ranges::adjacent_find(found) == found.end();
}

} // namespace

std::vector<BoundaryFaceKey> CellWindow::Faces::keys() const
{
  std::vector<BoundaryFaceKey> out;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    out.push_back({cells[i], std::span(points).subspan(offsets[i], offsets[i + 1] - offsets[i])});
  }
  return out;
}

bool CellWindow::hasAskedFaces() const
{
  return haveAll(*this, patches_.cells, findBoundaryFaces(mesh_, patches_.keys())) &&
         haveAll(*this, zones_.cells, findInternalFaces(mesh_, zones_.keys(), zones_.neighbors));
}

CellWindows::CellWindows(std::span<const Vec3> points, const CellArrays& cells, std::span<const Index> chosen,
                         const AskedFaces& asked, std::size_t length, const Executor& executor)
    : points_(points), cells_(cells), chosen_(chosen), asked_(asked),
      count_(chosen.empty() ? 0 : std::max<std::size_t>(chosen.size() / length, 1)),
      patchesOf_(byCell(asked.patches, cells.types.size())), zonesOf_(byCell(asked.zones, cells.types.size()))
{
  if (count_ > 1)
  {
    cellsAt_ = fillBuckets(points.size(), executor, [&](auto&& use) {
      executor.forEach(chosen.size(), grain, [&](std::size_t i) {
        forPoints(cells, chosen[i], points.size(), [&](Index p) { use(p, chosen[i]); });
      });
    });
  }
}

CellWindow CellWindows::window(std::size_t number) const
{
  CellWindow out;
  gatherCells(number, out);
  Numbering numbers(2 * out.cells_.size());
  copyCells(out, numbers);
  takeFaces(patchesOf_, asked_.patches, {}, out.patches_, out, numbers);
  takeFaces(zonesOf_, asked_.zones, asked_.neighbors, out.zones_, out, numbers);
  std::vector<Vec3> points(out.points_.size());
  std::ranges::transform(out.points_, points.begin(), [&](Index p) { return points_[p]; });
  out.mesh_ = makeFaceMesh(std::move(points), out.arrays(), out.patches_.keys());
  return out;
}

/// Collects the window's own cells and the cells around them.
void CellWindows::gatherCells(std::size_t number, CellWindow& out) const
{
  const std::size_t first = number * chosen_.size() / count_;
  const std::span<const Index> own = chosen_.subspan(first, (number + 1) * chosen_.size() / count_ - first);
  out.firstOwn_ = own.front();
  out.lastOwn_ = own.back();
  std::vector<Index> about;
  Numbering found(own.size());
  const auto take = [&](Index cell) {
    if (cell < out.firstOwn_ || cell > out.lastOwn_)
    {
      found.findOrAdd(cell, about);
    }
  };
  for (std::size_t i = 0; i < own.size() && count_ > 1; ++i)
  {
    forPoints(cells_, own[i], points_.size(), [&](Index p) { std::ranges::for_each(cellsAt_.of(p), take); });
  }
  std::ranges::sort(about);
  out.cells_.resize(own.size() + about.size());
  std::ranges::merge(own, about, out.cells_.begin());
}

/// Copies the arrays of the cells, and numbers their points in the order in which they come.
void CellWindows::copyCells(CellWindow& out, Numbering& numbers) const
{
  const auto numberOf = [&](std::int64_t point) {
    if (point < 0 || static_cast<std::size_t>(point) >= points_.size())
    {
      throw Error("a cell has a point that the mesh does not have");
    }
    return static_cast<std::int64_t>(numbers.findOrAdd(static_cast<Index>(point), out.points_));
  };
  for (const Index c : out.cells_)
  {
    out.types_.push_back(cells_.types[c]);
    forPoints(cells_, c, points_.size(),
              [&](Index p) { out.connectivity_.push_back(static_cast<std::int32_t>(numberOf(p))); });
    out.offsets_.push_back(static_cast<std::int64_t>(out.connectivity_.size()));
    out.faceLocations_.push_back(static_cast<std::int64_t>(out.faceStream_.size()));
    if (cells_.types[c] == polyhedronCell && !appendFaces(cells_.faces, c, numberOf, out.faceStream_))
    {
      throw Error("a polyhedron has no complete list of faces");
    }
  }
}

/// Takes the faces of a window's cells. Points that the window does not have get the number after its last point.
void CellWindows::takeFaces(const Buckets& ofCell, std::span<const BoundaryFaceKey> faces,
                            std::span<const Index> neighbors, CellWindow::Faces& to, const CellWindow& window,
                            const Numbering& numbers) const
{
  for (std::size_t cell = 0; cell < window.cells_.size(); ++cell)
  {
    for (const Index f : ofCell.of(window.cells_[cell]))
    {
      to.cells.push_back(static_cast<Index>(cell));
      for (const std::int64_t p : faces[f].points)
      {
        const bool exists = p >= 0 && static_cast<std::size_t>(p) < points_.size();
        const Index number = exists ? numbers.of(static_cast<Index>(p)) : noIndex;
        to.points.push_back(number == noIndex ? static_cast<std::int64_t>(window.points_.size()) : number);
      }
      to.offsets.push_back(to.points.size());
      if (!neighbors.empty())
      {
        to.neighbors.push_back(indexOf(window.cells_, neighbors[f]));
      }
    }
  }
}

} // namespace atria
