// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/RegularBoxes.h"

#include "Quality/Faces/CellShapes.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Place of each corner of VTK's hexahedron, in bits: x 1, y 2, z 4.
constexpr std::array<unsigned, 8> placeOfCorner{0, 1, 3, 2, 4, 5, 7, 6};
/// The corners of its faces.
constexpr std::array<std::array<int, 4>, 6> facesOfBox{
    {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};

class Finder
{
public:
  Finder(std::span<const Vec3> pointsOfMesh, const CellArrays& cellsOfMesh, const Executor& threads)
      : points(pointsOfMesh), cells(cellsOfMesh), executor(threads), isAlone(threads.threads() == 1),
        places(points.size()), isApart(points.size())
  {
    out.isRegular.resize(cells.types.size());
    out.volumes.resize(cells.types.size());
    out.aspectRatios.resize(cells.types.size());
    out.isTouched.resize(points.size());
    executor.forEach(points.size(), grain, [&](std::size_t p) { places[p] = isApart[p] = out.isTouched[p] = 0; });
  }

  RegularBoxes run(std::span<const std::int64_t> apart)
  {
    std::ranges::for_each(apart, [&](std::int64_t p) { mark(p, isApart); });
    executor.forEach(cells.types.size(), grain, [&](std::size_t c) { out.isRegular[c] = takePlaces(c) ? 1 : 0; });
    executor.forEach(cells.types.size(), grain, [&](std::size_t c) {
      if (out.isRegular[c] && !isAmongBoxes(cornersOf(c)))
      {
        out.isRegular[c] = 0;
      }
      if (!out.isRegular[c])
      {
        forPoints(c, [&](std::int64_t p) { mark(p, out.isTouched); });
      }
    });
    chooseMeasured();
    return std::move(out);
  }

private:
  using Corners = std::array<Index, 8>;

  bool exists(std::int64_t point) const { return point >= 0 && static_cast<std::size_t>(point) < points.size(); }

  void mark(std::int64_t point, Buffer<char>& marks) const
  {
    if (exists(point))
    {
      std::atomic_ref(marks[static_cast<std::size_t>(point)]).store(1, std::memory_order_relaxed);
    }
  }

  /// Calls use(point) for the points of a cell that exist, even if the cell is wrong.
  template <typename F> void forPoints(std::size_t cell, F&& use) const
  {
    const auto size = static_cast<std::int64_t>(cells.connectivity.size());
    const std::int64_t last = std::min(cells.offsets[cell + 1], size);
    for (std::int64_t i = std::max<std::int64_t>(cells.offsets[cell], 0); i < last; ++i)
    {
      use(cells.connectivity[static_cast<std::size_t>(i)]);
    }
  }

  Corners cornersOf(std::size_t cell) const
  {
    const auto first = static_cast<std::size_t>(cells.offsets[cell]);
    Corners corners;
    for (std::size_t i = 0; i < 8; ++i)
    {
      corners[i] = static_cast<Index>(cells.connectivity[first + i]);
    }
    return corners;
  }

  bool isHexahedron(std::size_t cell) const
  {
    const std::int64_t first = cells.offsets[cell];
    const std::int64_t last = cells.offsets[cell + 1];
    if (cells.types[cell] != hexahedronCell || first < 0 || last - first != 8 ||
        last > static_cast<std::int64_t>(cells.connectivity.size()))
    {
      return false;
    }
    bool allExist = true;
    forPoints(cell, [&](std::int64_t p) { allExist = allExist && exists(p); });
    return allExist;
  }

  bool isBox(const Corners& corners) const
  {
    const Vec3& low = points[corners[0]];
    const Vec3& high = points[corners[6]];
    bool same = low[0] < high[0] && low[1] < high[1] && low[2] < high[2];
    for (std::size_t i = 1; i < 8 && same; ++i)
    {
      const Vec3& p = points[corners[i]];
      const unsigned place = placeOfCorner[i];
      same = p[0] == ((place & 1U) != 0 ? high : low)[0] && p[1] == ((place & 2U) != 0 ? high : low)[1] &&
             p[2] == ((place & 4U) != 0 ? high : low)[2];
    }
    return same;
  }

  /// Takes one of the eight places at each corner of a box. A cell that takes a taken place, or that is no box, marks
  /// its corners so that no cell there is regular. Returns true if the cell is a box.
  bool takePlaces(std::size_t cell)
  {
    if (!isHexahedron(cell))
    {
      forPoints(cell, [&](std::int64_t p) { mark(p, isApart); });
      return false;
    }
    const Corners corners = cornersOf(cell);
    const bool box = isBox(corners);
    if (box)
    {
      const Vec3 size = points[corners[6]] - points[corners[0]];
      out.volumes[cell] = size.prod();
      out.aspectRatios[cell] = size.norm() / size.minCoeff();
    }
    for (std::size_t i = 0; i < 8; ++i)
    {
      const auto bit = static_cast<unsigned char>(1U << placeOfCorner[i]);
      if (!box || (setBit(places[corners[i]], bit) & bit) != 0)
      {
        mark(corners[i], isApart);
      }
    }
    return box;
  }

  /// Sets a bit. Returns the previous value.
  unsigned char setBit(unsigned char& to, unsigned char bit) const
  {
    if (isAlone)
    {
      const unsigned char before = to;
      to |= bit;
      return before;
    }
    return std::atomic_ref(to).fetch_or(bit, std::memory_order_relaxed);
  }

  bool isAmongBoxes(const Corners& corners) const
  {
    return std::ranges::all_of(corners, [&](Index p) { return places[p] == 0xFF && !isApart[p]; });
  }

  int touchedFaces(const Corners& corners) const
  {
    unsigned touched = 0;
    for (std::size_t i = 0; i < 8; ++i)
    {
      touched |= out.isTouched[corners[i]] ? 1U << i : 0U;
    }
    return touched == 0 ? 0 : static_cast<int>(std::ranges::count_if(facesOfBox, [&](const auto& face) {
      return std::ranges::all_of(face, [&](int i) { return (touched >> i & 1U) != 0; });
    }));
  }

  void chooseMeasured()
  {
    const Pieces pieces(cells.types.size());
    std::vector<std::size_t> halfFaces(pieces.count, 0);
    out.measured =
        collectInOrder(cells.types.size(), executor, [&](std::size_t begin, std::size_t end, std::vector<Index>& some) {
          for (std::size_t c = begin; c < end; ++c)
          {
            const int touched = out.isRegular[c] ? touchedFaces(cornersOf(c)) : 0;
            halfFaces[begin / Pieces::length] += out.isRegular[c] ? 6 - touched : 0;
            if (!out.isRegular[c] || touched > 0)
            {
              some.push_back(static_cast<Index>(c));
            }
          }
        });
    out.idealFaces = std::accumulate(halfFaces.begin(), halfFaces.end(), std::size_t{0}) / 2;
  }

  std::span<const Vec3> points;
  const CellArrays& cells;
  const Executor& executor;
  bool isAlone;
  Buffer<unsigned char> places; ///< one entry per point: bits of the places that boxes have taken
  Buffer<char> isApart;
  RegularBoxes out;
};

} // namespace

RegularBoxes findRegularBoxes(std::span<const Vec3> points, const CellArrays& cells,
                              std::span<const std::int64_t> apart, const Executor& executor)
{
  return Finder(points, cells, executor).run(apart);
}

} // namespace atria
