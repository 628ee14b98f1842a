// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/HalfFaces.h"

#include "Quality/CellShapes.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <string>

namespace atria {

namespace {

class Collector
{
public:
  Collector(const CellArrays& source, std::size_t numberOfPoints) : cells(source), pointCount(numberOfPoints) {}

  HalfFaces run()
  {
    reserve();
    for (cell = 0; cell < cells.types.size(); ++cell)
    {
      if (cells.types[cell] == polyhedronCell)
      {
        addPolyhedron();
      }
      else
      {
        addFixedShape();
      }
      out.cellOffsets.push_back(static_cast<Index>(out.cell.size()));
    }
    return std::move(out);
  }

private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw Error("cell " + std::to_string(cell) + " (type " + std::to_string(cells.types[cell]) + ") " + what);
  }

  void reserve()
  {
    if (cells.types.size() >= noIndex || cells.offsets.size() != cells.types.size() + 1)
    {
      throw Error("the cell arrays do not fit together or hold more than 4294967294 cells");
    }
    std::size_t faces = 0;
    std::size_t corners = 0;
    for (const unsigned char type : cells.types)
    {
      const CellShape shape = shapeOf(type);
      faces += shape.faces.size();
      for (const LocalFace& face : shape.faces)
      {
        corners += face.size;
      }
    }
    corners += cells.faceStream.size();
    if (corners >= noIndex)
    {
      throw Error("the mesh is too large: its cells have more than 4294967294 face corners");
    }
    out.cellOffsets.reserve(cells.types.size() + 1);
    out.offsets.reserve(faces + 1);
    out.cell.reserve(faces);
    out.points.reserve(corners);
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
    if (out.points.size() == out.offsets.back() || out.points.back() != point)
    {
      out.points.push_back(point);
    }
  }

  void closeFace()
  {
    const std::size_t first = out.offsets.back();
    if (out.points.size() > first + 1 && out.points.back() == out.points[first])
    {
      out.points.pop_back();
    }
    if (out.points.size() < first + 3)
    {
      out.points.resize(first);
      return;
    }
    out.offsets.push_back(static_cast<Index>(out.points.size()));
    out.cell.push_back(static_cast<Index>(cell));
  }

  void addFixedShape()
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
    for (const LocalFace& face : shape.faces)
    {
      for (int i = 0; i < face.size; ++i)
      {
        addPoint(corners[face.corners[i]]);
      }
      closeFace();
    }
  }

  void addPolyhedron()
  {
    const auto streamSize = static_cast<std::int64_t>(cells.faceStream.size());
    std::int64_t at = cell < cells.faceLocations.size() ? cells.faceLocations[cell] : -1;
    const auto next = [&] {
      if (at < 0 || at >= streamSize)
      {
        fail("has no complete list of faces");
      }
      return cells.faceStream[at++];
    };
    const std::int64_t faces = next();
    for (std::int64_t f = 0; f < faces; ++f)
    {
      const std::int64_t size = next();
      for (std::int64_t i = 0; i < size; ++i)
      {
        addPoint(pointOf(next()));
      }
      closeFace();
    }
  }

  const CellArrays& cells;
  std::size_t pointCount;
  std::size_t cell = 0;
  HalfFaces out;
};

} // namespace

HalfFaces takeApart(const CellArrays& cells, std::size_t pointCount) { return Collector(cells, pointCount).run(); }

bool samePoints(std::span<const Index> a, std::span<const Index> b)
{
  return a.size() == b.size() && std::is_permutation(a.begin(), a.end(), b.begin());
}

} // namespace atria
