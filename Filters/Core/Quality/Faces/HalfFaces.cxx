// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/HalfFaces.h"

#include "Quality/Faces/CellShapes.h"
#include "Support/Error.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <array>
#include <string>

namespace atria {

namespace {

/// Visits the faces of one cell after the other. Throws Error for a wrong cell.
class FaceReader
{
public:
  FaceReader(const CellArrays& source, std::size_t numberOfPoints) : cells(source), pointCount(numberOfPoints) {}

  /// Calls use(points) for each face of a cell, without repeated corners.
  template <typename F> void read(std::size_t ofCell, F&& use)
  {
    cell = ofCell;
    if (cells.types[cell] == polyhedronCell)
    {
      readPolyhedron(use);
    }
    else
    {
      readFixedShape(use);
    }
  }

private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw Error("cell " + std::to_string(cell) + " (type " + std::to_string(cells.types[cell]) + ") " + what);
  }

  Index pointOf(std::int64_t id) const
  {
    if (id < 0 || static_cast<std::size_t>(id) >= pointCount)
    {
      fail("has point " + std::to_string(id) + ", which the mesh does not have");
    }
    return static_cast<Index>(id);
  }

  void addPoint(Index point)
  {
    if (face.empty() || face.back() != point)
    {
      face.push_back(point);
    }
  }

  template <typename F> void closeFace(F&& use)
  {
    if (face.size() > 1 && face.back() == face.front())
    {
      face.pop_back();
    }
    if (face.size() > 2)
    {
      use(std::span<const Index>(face));
    }
    face.clear();
  }

  template <typename F> void readFixedShape(F&& use)
  {
    const CellShape shape = shapeOf(cells.types[cell]);
    if (shape.corners == 0)
    {
      fail("is of a type other than tetrahedron, voxel, hexahedron, wedge, pyramid and polyhedron");
    }
    const std::int64_t first = cells.offsets[cell];
    const std::int64_t last = cells.offsets[cell + 1];
    if (first < 0 || last - first != static_cast<std::int64_t>(shape.corners) ||
        last > static_cast<std::int64_t>(cells.connectivity.size()))
    {
      fail("has " + std::to_string(last - first) + " points instead of " + std::to_string(shape.corners));
    }
    std::array<Index, 8> corners{};
    for (std::size_t i = 0; i < shape.corners; ++i)
    {
      corners[i] = pointOf(cells.connectivity[first + i]);
    }
    for (const LocalFace& local : shape.faces)
    {
      std::array<Index, 4> points{};
      bool distinct = true;
      for (int i = 0; i < local.size; ++i)
      {
        points[i] = corners[local.corners[i]];
        distinct = distinct && (i == 0 || points[i] != points[i - 1]);
      }
      if (distinct && points[0] != points[local.size - 1])
      {
        use(std::span<const Index>(points.data(), local.size));
        continue;
      }
      for (int i = 0; i < local.size; ++i)
      {
        addPoint(points[i]);
      }
      closeFace(use);
    }
  }

  template <typename F> void readPolyhedron(F&& use)
  {
    const bool isComplete = cells.faces.each(cell, [&](const IdView& points) {
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        addPoint(pointOf(points[i]));
      }
      closeFace(use);
    });
    if (!isComplete)
    {
      fail("has no complete list of faces");
    }
  }

  const CellArrays& cells;
  std::size_t pointCount;
  std::size_t cell = 0;
  std::vector<Index> face;
};

/// Counts of faces and of their corners.
struct Size
{
  std::size_t faces = 0;
  std::size_t corners = 0;
  Size operator+(const Size& other) const { return {faces + other.faces, corners + other.corners}; }
};

void checkArrays(const CellArrays& cells)
{
  if (cells.types.size() >= noIndex || cells.offsets.size() != cells.types.size() + 1)
  {
    throw Error("the cell arrays do not fit together or hold more than 4294967294 cells");
  }
}

std::vector<Size> countFaces(const CellArrays& cells, std::size_t pointCount, const Executor& executor)
{
  const Pieces pieces(cells.types.size());
  std::vector<Size> sizes(pieces.count);
  FirstError error;
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    FaceReader reader(cells, pointCount);
    std::size_t cell = pieces.begin(piece);
    try
    {
      for (; cell < pieces.end(piece); ++cell)
      {
        reader.read(cell, [&](std::span<const Index> face) { sizes[piece] = sizes[piece] + Size{1, face.size()}; });
      }
    }
    catch (const Error& problem)
    {
      error.note(cell, problem.what());
    }
  });
  error.rethrow();
  return sizes;
}

} // namespace

HalfFaces takeApart(const CellArrays& cells, std::size_t pointCount, const Executor& executor)
{
  checkArrays(cells);
  const Pieces pieces(cells.types.size());
  std::vector<Size> starts = countFaces(cells, pointCount, executor);
  const Size all = scan(starts);
  if (all.corners >= noIndex)
  {
    throw Error("the mesh is too large: its cells have more than 4294967294 face corners");
  }
  HalfFaces out;
  out.cellOffsets.resize(cells.types.size() + 1);
  out.offsets.resize(all.faces + 1);
  out.cell.resize(all.faces);
  out.points.resize(all.corners);
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    FaceReader reader(cells, pointCount);
    Size at = starts[piece];
    for (std::size_t cell = pieces.begin(piece); cell < pieces.end(piece); ++cell)
    {
      reader.read(cell, [&](std::span<const Index> face) {
        copyPoints(face, out.points.data() + at.corners);
        out.cell[at.faces] = static_cast<Index>(cell);
        at = at + Size{1, face.size()};
        out.offsets[at.faces] = static_cast<Index>(at.corners);
      });
      out.cellOffsets[cell + 1] = static_cast<Index>(at.faces);
    }
  });
  return out;
}

bool samePoints(std::span<const Index> a, std::span<const Index> b)
{
  return a.size() == b.size() && std::is_permutation(a.begin(), a.end(), b.begin());
}

} // namespace atria
