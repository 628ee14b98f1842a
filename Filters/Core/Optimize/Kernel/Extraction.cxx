// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/Extraction.h"

#include "Optimize/Kernel/CellMeasure.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/Buckets.h"

#include <algorithm>
#include <atomic>

namespace atria {

namespace {

constexpr std::size_t partLength = 1024;
constexpr std::size_t grain = 256;

} // namespace

Extraction::Extraction(const CellSource& mesh, std::vector<Index> cells, bool withNatives, Order orderOfNumbers)
    : source(mesh), natives(withNatives), order(orderOfNumbers), judged(cells.size())
{
  region.cellIds = std::move(cells);
}

Region Extraction::run(const RunContext& context)
{
  const std::size_t count = region.cellIds.size();
  for (Index local = 0; local < count; ++local)
  {
    judged.add(region.cellIds[local], local);
  }
  const std::size_t length = order == Order::any ? std::max<std::size_t>(count, 1) : partLength;
  parts.resize((count + length - 1) / length);
  context.executor.forEach(parts.size(), 1,
                           [&](std::size_t i) { number(parts[i], i * length, std::min(count, (i + 1) * length)); });
  context.progress.check();
  join(context);
  context.executor.forEach(parts.size(), 1, [&](std::size_t i) { makeFaces(parts[i]); });
  context.progress.check();
  joinFaces(context);
  addCellFaces(context);
  context.progress.check();
  measureGhosts(context);
  return std::move(region);
}

/// Lists points, ghosts and corners of the judged cells from `begin` to `end`. Points and ghosts are numbered as they
/// are met.
void Extraction::number(Part& part, std::size_t begin, std::size_t end) const
{
  const std::size_t cells = end - begin;
  const auto judgedCount = static_cast<Index>(region.cellIds.size());
  Numbering points(2 * cells);
  Numbering beside(cells);
  part.first = static_cast<Index>(begin);
  part.pointIds.reserve(2 * cells);
  part.ghosts.reserve(cells);
  part.cornerOffsets.reserve(cells + 1);
  part.corners.reserve(8 * cells);
  part.across.reserve(6 * cells);
  part.made.natives.reserve(natives ? cells : 0);
  std::vector<Index> some;
  for (std::size_t local = begin; local < end; ++local)
  {
    const Index cell = region.cellIds[local];
    source.neighborsOf(cell, some);
    for (const Index id : some)
    {
      const Index known = judged.of(id);
      part.across.push_back(known != noIndex ? known : judgedCount + beside.findOrAdd(id, part.ghosts));
    }
    source.cornersOf(cell, some);
    for (const Index id : some)
    {
      part.corners.push_back(points.findOrAdd(id, part.pointIds));
    }
    part.cornerOffsets.push_back(static_cast<Index>(part.corners.size()));
    if (natives)
    {
      NativeCell native = source.nativeOf(cell);
      for (std::size_t i = 0; i < shapeOf(native.type).corners; ++i)
      {
        native.corners[i] = points.of(native.corners[i]);
      }
      part.made.natives.push_back(native);
    }
  }
}

/// Gives points and ghosts their numbers in the region, and copies the points.
void Extraction::join(const RunContext& context)
{
  if (order == Order::ofMesh)
  {
    joinNumbers(context);
  }
  else if (!parts.empty())
  {
    region.pointIds = std::move(parts.front().pointIds);
    ghosts = std::move(parts.front().ghosts);
  }
  region.points.resize(region.pointIds.size());
  context.executor.forEach(region.points.size(), partLength,
                           [&](std::size_t p) { region.points[p] = source.points()[region.pointIds[p]]; });
}

/// Numbers points and ghosts in the order of the mesh.
void Extraction::joinNumbers(const RunContext& context)
{
  Buffer<Index> placeOf;
  const auto joined = [&](std::size_t count, std::vector<Index> Part::*list) {
    std::vector<char> has(count, 0);
    context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
      for (const Index number : parts[i].*list)
      {
        std::atomic_ref(has[number]).store(1, std::memory_order_relaxed);
      }
    });
    std::vector<Index> all = numbersOf(has, context.executor);
    placeOf.resize(count);
    context.executor.forEach(all.size(), grain,
                             [&](std::size_t place) { placeOf[all[place]] = static_cast<Index>(place); });
    context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
      std::ranges::transform(parts[i].*list, (parts[i].*list).begin(), [&](Index number) { return placeOf[number]; });
    });
    return all;
  };
  region.pointIds = joined(source.points().size(), &Part::pointIds);
  ghosts = joined(source.cellCount(), &Part::ghosts);
  const auto judgedCount = static_cast<Index>(region.cellIds.size());
  context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
    Part& part = parts[i];
    const auto rename = [&](Index corner) { return part.pointIds[corner]; };
    std::ranges::transform(part.corners, part.corners.begin(), rename);
    for (NativeCell& native : part.made.natives)
    {
      const auto end = native.corners.begin() + static_cast<std::ptrdiff_t>(shapeOf(native.type).corners);
      std::transform(native.corners.begin(), end, native.corners.begin(), rename);
    }
    for (Index& cell : part.across)
    {
      cell = cell < judgedCount ? cell : judgedCount + part.ghosts[cell - judgedCount];
    }
  });
}

/// Makes the faces of a part's cells. A face between two judged cells is made by the first of them. Memory is reserved
/// as for hexahedra, most of whose faces lie between two judged cells.
void Extraction::makeFaces(Part& part) const
{
  const std::size_t faces = 3 * part.size() + part.size() / 2;
  part.made.owner.reserve(faces);
  part.made.neighbor.reserve(faces);
  part.made.faceOffsets.reserve(faces + 1);
  part.made.facePoints.reserve(4 * faces);
  CellSource::Scratch scratch;
  const Index* next = part.across.data();
  for (Index c = 0; c < part.size(); ++c)
  {
    const Index local = part.first + c;
    source.facesOf(region.cellIds[local], part.cornersOf(c), scratch);
    for (const CellFace& face : scratch.faces)
    {
      const Index across = face.across == noIndex ? noIndex : *next++;
      if (across < local)
      {
        continue;
      }
      part.made.owner.push_back(local);
      part.made.neighbor.push_back(across);
      part.made.facePoints.insert(part.made.facePoints.end(), face.points.begin(), face.points.end());
      part.made.faceOffsets.push_back(static_cast<Index>(part.made.facePoints.size()));
    }
  }
  std::vector<Index>().swap(part.across);
}

void Extraction::joinFaces(const RunContext& context)
{
  if (parts.size() == 1)
  {
    static_cast<RegionCells&>(region) = std::move(parts.front().made);
    return;
  }
  std::vector<std::size_t> faces{0};
  std::vector<std::size_t> points{0};
  for (const Part& part : parts)
  {
    faces.push_back(faces.back() + part.made.owner.size());
    points.push_back(points.back() + part.made.facePoints.size());
  }
  region.owner.resize(faces.back());
  region.neighbor.resize(faces.back());
  region.faceOffsets.resize(faces.back() + 1);
  region.facePoints.resize(points.back());
  region.natives.resize(natives ? region.cellIds.size() : 0);
  context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
    Part& part = parts[i];
    const auto copyTo = [](auto& to, std::size_t at, const auto& from) {
      std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(at));
    };
    copyTo(region.owner, faces[i], part.made.owner);
    copyTo(region.neighbor, faces[i], part.made.neighbor);
    copyTo(region.facePoints, points[i], part.made.facePoints);
    copyTo(region.natives, part.first, part.made.natives);
    std::transform(part.made.faceOffsets.begin() + 1, part.made.faceOffsets.end(),
                   region.faceOffsets.begin() + static_cast<std::ptrdiff_t>(faces[i]) + 1,
                   [&](Index offset) { return static_cast<Index>(points[i]) + offset; });
    part.made = {};
  });
}

void Extraction::addCellFaces(const RunContext& context)
{
  const std::size_t cells = region.cellIds.size();
  Buckets faces = fillInOrder(cells, context.executor, [&](auto&& use) {
    context.executor.forEach(region.faceCount(), partLength, [&](std::size_t f) {
      use(region.owner[f], static_cast<Index>(f));
      if (region.neighbor[f] < cells)
      {
        use(region.neighbor[f], static_cast<Index>(f));
      }
    });
  });
  region.cellOffsets = std::move(faces.offsets);
  region.cellFaces = std::move(faces.entries);
}

void Extraction::measureGhosts(const RunContext& context)
{
  region.ghosts.resize(ghosts.size());
  context.executor.forRanges(ghosts.size(), grain, [&](std::size_t begin, std::size_t end) {
    CellSource::Scratch scratch;
    std::vector<FaceMeasure> faces;
    for (std::size_t i = begin; i < end; ++i)
    {
      region.ghosts[i] = measureCell(source, ghosts[i], scratch, faces);
    }
  });
}

} // namespace atria
