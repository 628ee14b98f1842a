// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/MergeCells.h"

#include "Quality/CellUnion.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace atria {

namespace {

using Mat3 = Eigen::Matrix3d;

/// Sums over the internal faces of a cell.
struct Directions
{
  Mat3 areas = Mat3::Zero(); ///< of A AT
  double area = 0.0;         ///< of |A|
  int count = 0;

  /// Four or more faces of a thin cell have a small determinant as well, but look all ways.
  bool areFew(double leastDeterminant) const
  {
    if (count != 3 || area <= 0.0)
    {
      return count < 3;
    }
    const double mean = area / count;
    return std::abs((areas / (mean * mean)).determinant()) / 8.0 < leastDeterminant;
  }
};

/// Whether all faces within the mesh look along one plane, as where it is one cell thick: no union of cells helps then.
bool areInOnePlane(const std::vector<Directions>& all)
{
  constexpr double flat = 1e-12;
  Mat3 areas = Mat3::Zero();
  for (const Directions& one : all)
  {
    areas += one.areas;
  }
  const double mean = areas.trace() / 3.0;
  return mean <= 0.0 || std::abs((areas / mean).determinant()) < flat;
}

class CellMerger
{
public:
  CellMerger(FaceMesh& faceMesh, std::span<const Index> patchOfFace, const RunContext& within,
             const MergeCellsOptions& mergeOptions)
      : mesh(faceMesh), patchOf(patchOfFace), context(within), options(mergeOptions)
  {
  }

  MergedCells run()
  {
    context.progress.report(0.0, "Merging cells");
    const std::vector<Index> candidates = findCandidates();
    if (candidates.empty())
    {
      return {};
    }
    context.progress.report(0.3, "Merging cells");
    CellUnions unions(mesh, patchOf, context.executor);
    bool any = false;
    for (const Index cell : candidates)
    {
      context.progress.check();
      any = resolve(unions, cell) || any;
    }
    context.progress.report(0.8, "Merging cells");
    return any ? renumber(unions) : MergedCells();
  }

private:
  /// Cells at walls whose internal faces do not look all ways; rising.
  std::vector<Index> findCandidates() const
  {
    std::vector<Index> slotOf(mesh.cellCount, noIndex);
    std::vector<Index> cells;
    for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
    {
      Index& slot = slotOf[mesh.owner[f]];
      if (slot == noIndex)
      {
        slot = static_cast<Index>(cells.size());
        cells.push_back(mesh.owner[f]);
      }
    }
    std::vector<Directions> directions(cells.size());
    for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
    {
      const Index slots[] = {slotOf[mesh.owner[f]], slotOf[mesh.neighbour[f]]};
      if (slots[0] == noIndex && slots[1] == noIndex)
      {
        continue;
      }
      const Vec3 area = measurePolygon(mesh.points, mesh.face(f)).area;
      const double size = area.norm();
      for (const Index slot : slots)
      {
        if (slot != noIndex && size > 0.0)
        {
          Directions& sums = directions[slot];
          sums.areas += area * area.transpose();
          sums.area += size;
          ++sums.count;
        }
      }
    }
    std::vector<Index> found;
    if (areInOnePlane(directions))
    {
      return found;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (directions[i].areFew(options.determinant))
      {
        found.push_back(cells[i]);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  struct Group
  {
    std::vector<Index> cells; ///< rising
    UnionVerdict verdict;

    auto rank() const { return std::tuple(!serves(), verdict.concave, verdict.penalty, cells); }
    bool serves() const { return verdict.sound && verdict.determined; }
  };

  /// Makes a cell one with others where that helps; whether it did. Of groups that do not serve the best are kept and
  /// tried with one cell more.
  bool resolve(CellUnions& unions, Index cell) const
  {
    const Index alone[] = {unions.cellOf(cell)};
    std::vector<Group> groups{{{alone[0]}, judgeUnion(unions, alone, context.executor)}};
    if (groups[0].verdict.determined)
    {
      return false; // another cell has become one with it
    }
    for (std::size_t size = 2; size <= options.most && !groups.empty(); ++size)
    {
      groups = withOneMore(unions, groups);
      if (!groups.empty() && groups[0].serves())
      {
        unions.unite(groups[0].cells);
        return true;
      }
    }
    return false;
  }

  /// The groups with a neighbour each that are closed balls, the best ones first.
  std::vector<Group> withOneMore(const CellUnions& unions, const std::vector<Group>& groups) const
  {
    std::set<std::vector<Index>> larger;
    for (const Group& group : groups)
    {
      for (const Index next : unions.neighboursOf(group.cells))
      {
        std::vector<Index> cells = group.cells;
        cells.insert(std::lower_bound(cells.begin(), cells.end(), next), next);
        larger.insert(std::move(cells));
      }
    }
    std::vector<Group> found;
    for (const std::vector<Index>& cells : larger)
    {
      const UnionVerdict verdict = judgeUnion(unions, cells, context.executor);
      if (verdict.isBall)
      {
        found.push_back({cells, verdict});
      }
    }
    std::sort(found.begin(), found.end(), [](const Group& a, const Group& b) { return a.rank() < b.rank(); });
    found.resize(std::min(found.size(), options.kept));
    return found;
  }

  /// Writes the mesh anew with the cells as they are now.
  MergedCells renumber(const CellUnions& unions)
  {
    MergedCells merged;
    merged.cellOf.resize(mesh.cellCount);
    Index cells = 0;
    for (Index cell = 0; cell < mesh.cellCount; ++cell)
    {
      const Index stands = unions.cellOf(cell); // the lowest, which has its new number already
      merged.cellOf[cell] = stands == cell ? cells++ : merged.cellOf[stands];
    }
    merged.count = mesh.cellCount - cells;
    FaceMesh out;
    out.cellCount = cells;
    out.faceOffsets.reserve(mesh.faceOffsets.size());
    out.facePoints.reserve(mesh.facePoints.size());
    merged.faceOf.assign(mesh.faceCount(), noIndex);
    for (const auto& [onBoundary, owner, neighbour, face, turned] : orderOfFaces(merged.cellOf))
    {
      merged.faceOf[face] = static_cast<Index>(out.owner.size());
      const auto loop = mesh.face(face);
      if (turned)
      {
        out.facePoints.insert(out.facePoints.end(), std::make_reverse_iterator(loop.end()),
                              std::make_reverse_iterator(loop.begin()));
      }
      else
      {
        out.facePoints.insert(out.facePoints.end(), loop.begin(), loop.end());
      }
      out.faceOffsets.push_back(static_cast<Index>(out.facePoints.size()));
      out.owner.push_back(owner);
      if (!onBoundary)
      {
        out.neighbour.push_back(neighbour);
      }
    }
    out.points = std::move(mesh.points);
    mesh = std::move(out);
    return merged;
  }

  using OrderedFace = std::tuple<bool, Index, Index, Index, bool>; ///< on the boundary, owner, neighbour, face, turned

  std::vector<OrderedFace> orderOfFaces(const std::vector<Index>& cellOf) const
  {
    std::vector<OrderedFace> order;
    order.reserve(mesh.faceCount());
    for (Index face = 0; face < mesh.faceCount(); ++face)
    {
      const bool onBoundary = face >= mesh.internalFaceCount();
      const Index a = cellOf[mesh.owner[face]];
      const Index b = onBoundary ? noIndex : cellOf[mesh.neighbour[face]];
      if (a != b)
      {
        order.emplace_back(onBoundary, std::min(a, b), std::max(a, b), face, a > b);
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  FaceMesh& mesh;
  std::span<const Index> patchOf;
  const RunContext& context;
  const MergeCellsOptions& options;
};

} // namespace

MergedCells mergeUnderdeterminedCells(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                                      const MergeCellsOptions& options)
{
  return CellMerger(mesh, patchOf, context, options).run();
}

} // namespace atria
