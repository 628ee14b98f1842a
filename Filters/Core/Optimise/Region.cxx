// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/Region.h"

#include "Optimise/CellMeasure.h"
#include "Quality/CellShapes.h"

#include <algorithm>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Builds the arrays of a region cell by cell.
class Extraction
{
public:
  Extraction(const CellSource& mesh, const std::vector<char>& mayMove, const VertexGuide& vertexGuide)
      : source(mesh), marked(mayMove), guide(vertexGuide)
  {
  }

  Region run(const RunContext& context)
  {
    findJudged(context);
    numberPoints();
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
    addStars();
    context.progress.check();
    return std::move(region);
  }

private:
  void findJudged(const RunContext& context)
  {
    std::vector<char> judged(source.cellCount(), 0);
    context.executor.forRanges(judged.size(), grain, [&](std::size_t begin, std::size_t end) {
      context.progress.check();
      for (std::size_t c = begin; c < end; ++c)
      {
        judged[c] = source.hasMarked(static_cast<Index>(c), marked) ? 1 : 0;
      }
    });
    localCell.assign(judged.size(), noIndex);
    for (Index c = 0; c < judged.size(); ++c)
    {
      if (judged[c])
      {
        localCell[c] = static_cast<Index>(region.cellIds.size());
        region.cellIds.push_back(c);
      }
    }
  }

  void numberPoints()
  {
    localPoint.assign(source.points().size(), noIndex);
    for (const Index cell : region.cellIds)
    {
      source.facesOf(cell, scratch);
      for (const Index p : scratch.points)
      {
        localPoint[p] = 0;
      }
    }
    for (Index p = 0; p < localPoint.size(); ++p)
    {
      if (localPoint[p] != noIndex)
      {
        localPoint[p] = static_cast<Index>(region.pointIds.size());
        region.pointIds.push_back(p);
        region.points.push_back(source.points()[p]);
      }
    }
  }

  /// The faces between two judged cells are added by the first of them.
  void addFaces(Index local)
  {
    const Index cell = region.cellIds[local];
    source.facesOf(cell, scratch);
    NativeCell native = source.nativeOf(cell);
    for (std::size_t i = 0; i < shapeOf(native.type).corners; ++i)
    {
      native.corners[i] = localPoint[native.corners[i]];
    }
    region.natives.push_back(native);
    for (const CellFace& face : scratch.faces)
    {
      Index across = face.across;
      if (across != noIndex)
      {
        if (localCell[across] == noIndex)
        {
          localCell[across] = static_cast<Index>(region.cellIds.size() + ghosts.size());
          ghosts.push_back(across);
        }
        across = localCell[across];
        if (across < local)
        {
          continue;
        }
      }
      region.owner.push_back(local);
      region.neighbour.push_back(across);
      for (const Index p : face.points)
      {
        region.facePoints.push_back(localPoint[p]);
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
    for (const Index cell : ghosts)
    {
      const CellMeasure ghost = measureCell(source, cell, scratch);
      region.ghostCentroids.push_back(ghost.centroid);
      region.ghostVolumes.push_back(ghost.volume);
    }
  }

  /// For each leader of marked points, in order: the judged cells that have one of its points, and these points.
  void addStars()
  {
    std::vector<Index> leaders(region.pointIds.size(), noIndex);
    std::vector<Index> cells(leaders.size(), 0);
    std::vector<Index> members(leaders.size(), 0);
    for (Index p = 0; p < leaders.size(); ++p)
    {
      if (marked[region.pointIds[p]])
      {
        leaders[p] = localPoint[guide.leaderOf(region.pointIds[p])];
        ++members[leaders[p]];
      }
    }
    eachCellOf(leaders, [&](Index leader, Index) { ++cells[leader]; });
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
    eachCellOf(leaders, [&](Index leader, Index cell) { region.about[cells[leader]++] = cell; });
    for (Index p = 0; p < leaders.size(); ++p)
    {
      if (leaders[p] != noIndex)
      {
        region.members[members[leaders[p]]++] = p;
      }
    }
  }

  /// Calls use(leader, cell) once for each judged cell and leader of its points, by cells.
  template <typename Use> void eachCellOf(const std::vector<Index>& leaders, Use&& use) const
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

  const CellSource& source;
  const std::vector<char>& marked;
  const VertexGuide& guide;
  Region region;
  std::vector<Index> localCell;
  std::vector<Index> localPoint;
  std::vector<Index> ghosts;
  CellSource::Scratch scratch;
};

} // namespace

void DualSource::facesOf(Index cell, Scratch& out) const
{
  out.faces.clear();
  out.points.clear();
  out.points.reserve(24);
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t neighbour = mesh_.neighbours[cell][direction];
    if (neighbour == DualMesh::noFace)
    {
      continue;
    }
    const ReducedFace face = faceOf(mesh_.corners[cell], direction);
    const std::size_t begin = out.points.size();
    out.points.insert(out.points.end(), face.points.begin(), face.points.begin() + face.count);
    out.faces.push_back({std::span(out.points.data() + begin, static_cast<std::size_t>(face.count)),
                         neighbour >= 0 ? static_cast<Index>(neighbour) : noIndex});
  }
}

bool DualSource::hasMarked(Index cell, const std::vector<char>& marked) const
{
  return std::ranges::any_of(mesh_.corners[cell], [&](Index p) { return marked[p] != 0; });
}

void FaceMeshSource::facesOf(Index cell, Scratch& out) const
{
  out.faces.clear();
  out.points.clear();
  std::size_t corners = 0;
  for (const Index f : cellFaces_.of(cell))
  {
    corners += mesh_.face(f).size();
  }
  out.points.reserve(corners);
  for (const Index f : cellFaces_.of(cell))
  {
    const auto points = mesh_.face(f);
    const std::size_t begin = out.points.size();
    const bool owned = mesh_.owner[f] == cell;
    out.points.insert(out.points.end(), points.begin(), points.end());
    if (!owned)
    {
      std::reverse(out.points.begin() + static_cast<std::ptrdiff_t>(begin), out.points.end());
    }
    const Index across = f >= mesh_.internalFaceCount() ? noIndex : owned ? mesh_.neighbour[f] : mesh_.owner[f];
    out.faces.push_back({std::span(out.points.data() + begin, points.size()), across});
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

Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexGuide& guide,
                     const RunContext& context)
{
  return Extraction(source, marked, guide).run(context);
}

} // namespace atria
