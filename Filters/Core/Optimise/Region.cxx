// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/Region.h"

#include "Optimise/CellMeasure.h"
#include "Quality/CellShapes.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// The place of a number in a rising list, or noIndex.
Index numberIn(const std::vector<Index>& list, Index number)
{
  const auto found = std::ranges::lower_bound(list, number);
  return found != list.end() && *found == number ? static_cast<Index>(found - list.begin()) : noIndex;
}

/// Numbers by identity, in a hash table with linear probing.
class Numbering
{
public:
  explicit Numbering(std::size_t expected) { makeRoom(expected); }

  /// Whether it was not known; it then has this number.
  bool add(Index id, Index number)
  {
    if (2 * (count + 1) > slots.size())
    {
      makeRoom(2 * count);
    }
    Slot& slot = slotOf(id);
    if (slot.id == id)
    {
      return false;
    }
    slot = {id, number};
    ++count;
    return true;
  }
  /// Of one that is known.
  void change(Index id, Index number) { slotOf(id).number = number; }
  Index of(Index id) const { return slotOf(id).number; }

private:
  struct Slot
  {
    Index id = noIndex;
    Index number = noIndex;
  };

  const Slot& slotOf(Index id) const
  {
    const std::size_t mask = slots.size() - 1;
    std::size_t at = (id * std::uint64_t{0x9E3779B97F4A7C15} >> 32) & mask;
    while (slots[at].id != id && slots[at].id != noIndex)
    {
      at = (at + 1) & mask;
    }
    return slots[at];
  }
  Slot& slotOf(Index id) { return const_cast<Slot&>(std::as_const(*this).slotOf(id)); }

  void makeRoom(std::size_t expected)
  {
    const std::vector<Slot> before = std::exchange(slots, std::vector<Slot>(std::bit_ceil(2 * expected + 16)));
    for (const Slot& slot : before)
    {
      if (slot.id != noIndex)
      {
        slotOf(slot.id) = slot;
      }
    }
  }

  std::vector<Slot> slots;
  std::size_t count = 0;
};

/// Builds the arrays of a region cell by cell.
class Extraction
{
public:
  Extraction(const CellSource& mesh, std::vector<Index> cells, bool withNatives)
      : source(mesh), natives(withNatives), numberOfPoint(2 * cells.size()), numberOfCell(2 * cells.size())
  {
    region.cellIds = std::move(cells);
  }

  Region run(const RunContext& context)
  {
    findNumbers();
    makeRoom();
    for (Index local = 0; local < region.cellIds.size(); ++local)
    {
      if (local % grain == 0)
      {
        context.progress.check();
      }
      addFaces(local);
    }
    addCellFaces();
    context.progress.check();
    measureGhosts();
    return std::move(region);
  }

private:
  /// Of points and of cells beside, in the order of the mesh.
  void findNumbers()
  {
    for (Index local = 0; local < region.cellIds.size(); ++local)
    {
      numberOfCell.add(region.cellIds[local], local);
    }
    std::vector<Index> some;
    region.pointIds.reserve(2 * region.cellIds.size());
    ghosts.reserve(region.cellIds.size());
    for (const Index cell : region.cellIds)
    {
      source.cornersOf(cell, some);
      for (const Index point : some)
      {
        if (numberOfPoint.add(point, noIndex))
        {
          region.pointIds.push_back(point);
        }
      }
      source.neighboursOf(cell, some);
      for (const Index across : some)
      {
        if (numberOfCell.add(across, noIndex))
        {
          ghosts.push_back(across);
        }
      }
    }
    std::ranges::sort(region.pointIds);
    std::ranges::sort(ghosts);
    region.points.reserve(region.pointIds.size());
    for (Index p = 0; p < region.pointIds.size(); ++p)
    {
      numberOfPoint.change(region.pointIds[p], p);
      region.points.push_back(source.points()[region.pointIds[p]]);
    }
    for (Index i = 0; i < ghosts.size(); ++i)
    {
      numberOfCell.change(ghosts[i], static_cast<Index>(region.cellIds.size()) + i);
    }
  }

  /// As for hexahedra, most of whose faces are between two of them.
  void makeRoom()
  {
    const std::size_t cells = region.cellIds.size();
    const std::size_t faces = 3 * cells + cells / 2;
    region.owner.reserve(faces);
    region.neighbour.reserve(faces);
    region.faceOffsets.reserve(faces + 1);
    region.facePoints.reserve(4 * faces);
    region.natives.reserve(natives ? cells : 0);
  }

  void addNative(Index cell)
  {
    NativeCell native = source.nativeOf(cell);
    for (std::size_t i = 0; i < shapeOf(native.type).corners; ++i)
    {
      native.corners[i] = numberOfPoint.of(native.corners[i]);
    }
    region.natives.push_back(native);
  }

  /// The faces between two judged cells are added by the first of them.
  void addFaces(Index local)
  {
    const Index cell = region.cellIds[local];
    source.cornersOf(cell, scratch.corners);
    for (Index& corner : scratch.corners)
    {
      corner = numberOfPoint.of(corner);
    }
    source.facesOf(cell, scratch.corners, scratch);
    if (natives)
    {
      addNative(cell);
    }
    for (const CellFace& face : scratch.faces)
    {
      Index across = face.across;
      if (across != noIndex)
      {
        across = numberOfCell.of(across);
        if (across < local)
        {
          continue;
        }
      }
      region.owner.push_back(local);
      region.neighbour.push_back(across);
      for (const Index p : face.points)
      {
        region.facePoints.push_back(p);
      }
      region.faceOffsets.push_back(static_cast<Index>(region.facePoints.size()));
    }
  }

  void addCellFaces()
  {
    const auto cells = static_cast<Index>(region.cellIds.size());
    region.cellOffsets.assign(cells + 1, 0);
    const auto eachUse = [&](auto&& use) {
      for (Index f = 0; f < region.faceCount(); ++f)
      {
        use(region.owner[f], f);
        if (region.neighbour[f] < cells)
        {
          use(region.neighbour[f], f);
        }
      }
    };
    eachUse([&](Index cell, Index) { ++region.cellOffsets[cell + 1]; });
    for (Index c = 0; c < cells; ++c)
    {
      region.cellOffsets[c + 1] += region.cellOffsets[c];
    }
    region.cellFaces.resize(region.cellOffsets.back());
    std::vector<Index> next(region.cellOffsets.begin(), region.cellOffsets.end() - 1);
    eachUse([&](Index cell, Index f) { region.cellFaces[next[cell]++] = f; });
  }

  void measureGhosts()
  {
    region.ghostCentroids.reserve(ghosts.size());
    region.ghostVolumes.reserve(ghosts.size());
    std::vector<FaceMeasure> faces;
    for (const Index cell : ghosts)
    {
      const CellMeasure ghost = measureCell(source, cell, scratch, faces);
      region.ghostCentroids.push_back(ghost.centroid);
      region.ghostVolumes.push_back(ghost.volume);
    }
  }

  const CellSource& source;
  bool natives;
  Region region;
  std::vector<Index> ghosts;
  Numbering numberOfPoint;
  Numbering numberOfCell;
  CellSource::Scratch scratch;
};

/// Calls use(leader, cell) once for each judged cell and leader of its points, by cells.
template <typename Use> void eachCellOf(const Region& region, const std::vector<Index>& leaders, Use&& use)
{
  std::vector<Index> last(leaders.size(), noIndex);
  for (Index cell = 0; cell < region.cellIds.size(); ++cell)
  {
    for (Index i = region.cellOffsets[cell]; i < region.cellOffsets[cell + 1]; ++i)
    {
      const Index f = region.cellFaces[i];
      for (Index k = region.faceOffsets[f]; k < region.faceOffsets[f + 1]; ++k)
      {
        const Index leader = leaders[region.facePoints[k]];
        if (leader != noIndex && last[leader] != cell)
        {
          last[leader] = cell;
          use(leader, cell);
        }
      }
    }
  }
}

/// For each leader of marked points, in order: the judged cells that have one of its points, and these points.
void addStars(Region& region, const std::vector<char>& marked, const VertexGuide& guide)
{
  const std::size_t points = region.pointIds.size();
  std::vector<Index> leaders(points, noIndex);
  std::vector<Index> cells(points, 0);
  std::vector<Index> members(points, 0);
  for (Index p = 0; p < points; ++p)
  {
    if (marked[region.pointIds[p]])
    {
      leaders[p] = numberIn(region.pointIds, guide.leaderOf(region.pointIds[p]));
      ++members[leaders[p]];
    }
  }
  eachCellOf(region, leaders, [&](Index leader, Index) { ++cells[leader]; });
  // Counts become the places where a leader's next entry goes.
  for (Index p = 0; p < leaders.size(); ++p)
  {
    if (cells[p] > 0)
    {
      region.movable.push_back(p);
      region.aboutOffsets.push_back(region.aboutOffsets.back() + cells[p]);
      region.memberOffsets.push_back(region.memberOffsets.back() + members[p]);
      cells[p] = *(region.aboutOffsets.end() - 2);
      members[p] = *(region.memberOffsets.end() - 2);
    }
  }
  region.about.resize(region.aboutOffsets.back());
  region.members.resize(region.memberOffsets.back());
  eachCellOf(region, leaders, [&](Index leader, Index cell) { region.about[cells[leader]++] = cell; });
  for (Index p = 0; p < leaders.size(); ++p)
  {
    if (leaders[p] != noIndex)
    {
      region.members[members[leaders[p]]++] = p;
    }
  }
}

} // namespace

void DualSource::neighboursOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const std::int32_t neighbour : mesh_.neighbours[cell])
  {
    if (neighbour >= 0)
    {
      out.push_back(static_cast<Index>(neighbour));
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
    const std::int32_t neighbour = mesh_.neighbours[cell][direction];
    if (neighbour == DualMesh::noFace)
    {
      continue;
    }
    const ReducedFace face = faceOf(corners, direction);
    const std::span points(out.points.data() + begin, static_cast<std::size_t>(face.count));
    for (const Index p : std::span(face.points).first(points.size()))
    {
      out.points[begin++] = p;
    }
    out.faces.push_back({points, neighbour >= 0 ? static_cast<Index>(neighbour) : noIndex});
  }
  out.points.resize(begin);
}

/// Of those that are hexahedra.
NativeCell DualSource::nativeOf(Index cell) const
{
  std::array<Index, 8> sorted = mesh_.corners[cell];
  std::ranges::sort(sorted);
  const bool isHexahedron = std::ranges::adjacent_find(sorted) == sorted.end();
  return isHexahedron ? NativeCell{hexahedronCell, mesh_.corners[cell]} : NativeCell{};
}

bool DualSource::hasMarked(Index cell, const std::vector<char>& marked) const
{
  return std::ranges::any_of(mesh_.corners[cell], [&](Index p) { return marked[p] != 0; });
}

void FaceMeshSource::neighboursOf(Index cell, std::vector<Index>& out) const
{
  out.clear();
  for (const Index f : cellFaces_.of(cell))
  {
    if (f < mesh_.internalFaceCount())
    {
      out.push_back(mesh_.owner[f] == cell ? mesh_.neighbour[f] : mesh_.owner[f]);
    }
  }
}

/// Face by face, each with its normal outwards.
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
    const Index across = f >= mesh_.internalFaceCount() ? noIndex : owned ? mesh_.neighbour[f] : mesh_.owner[f];
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
    std::ranges::transform(cells_.connectivity.subspan(first, corners), out.corners.begin(),
                           [](std::int64_t point) { return static_cast<Index>(point); });
  }
  return out;
}

bool FaceMeshSource::hasMarked(Index cell, const std::vector<char>& marked) const
{
  return std::ranges::any_of(cellFaces_.of(cell), [&](Index f) {
    return std::ranges::any_of(mesh_.face(f), [&](Index p) { return marked[p] != 0; });
  });
}

std::vector<Index> cellsWithMarked(const CellSource& source, const std::vector<char>& marked, const RunContext& context)
{
  std::vector<char> has(source.cellCount(), 0);
  context.executor.forRanges(has.size(), grain, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    for (std::size_t c = begin; c < end; ++c)
    {
      has[c] = source.hasMarked(static_cast<Index>(c), marked) ? 1 : 0;
    }
  });
  std::vector<Index> cells;
  for (Index c = 0; c < has.size(); ++c)
  {
    if (has[c])
    {
      cells.push_back(c);
    }
  }
  return cells;
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
    source.neighboursOf(cell, beside);
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

std::vector<Index> withNeighbours(const CellSource& source, const std::vector<Index>& cells)
{
  std::vector<Index> out = cells;
  std::vector<Index> beside;
  for (const Index cell : cells)
  {
    source.neighboursOf(cell, beside);
    out.insert(out.end(), beside.begin(), beside.end());
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Region extractCells(const CellSource& source, std::vector<Index> cells, bool withNatives, const RunContext& context)
{
  return Extraction(source, std::move(cells), withNatives).run(context);
}

Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexGuide& guide,
                     bool withNatives, const RunContext& context)
{
  Region region = extractCells(source, cellsWithMarked(source, marked, context), withNatives, context);
  addStars(region, marked, guide);
  context.progress.check();
  return region;
}

} // namespace atria
