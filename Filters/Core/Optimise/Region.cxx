// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/Region.h"

#include "Optimise/CellMeasure.h"
#include "Quality/CellShapes.h"

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
