// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/MergeCells.h"

#include "Quality/Unions/CellUnion.h"
#include "Quality/Unions/SplitCells.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

namespace atria {

namespace {

using Mat3 = Eigen::Matrix3d;

/// A cell has too few neighbors if it has fewer than three internal faces, or three and its determinant (see
/// CheckQuantity::Determinant) is below this, checkMesh's limit. Thin cells of boundary layers have small determinants
/// too, but more faces.
constexpr double leastDeterminant = 1e-3;
/// Largest number of cells in a union.
constexpr std::size_t mostCells = 6;
/// Number of rejected groups that are tried with one more cell.
constexpr std::size_t mostTried = 12;

/// Sums over the internal faces of a cell.
struct Directions
{
  Mat3 areas = Mat3::Zero(); ///< sum of A A^T
  double area = 0.0;         ///< sum of |A|
  int count = 0;

  void add(const Vec3& face)
  {
    const double size = face.norm();
    areas += face * face.transpose();
    area += size;
    count += size > 0.0 ? 1 : 0;
  }

  /// True if the faces do not determine a gradient. Four or more faces of a thin cell also have a small determinant,
  /// but point in all directions.
  bool areFew() const
  {
    if (count != 3 || area <= 0.0)
    {
      return count < 3;
    }
    const double mean = area / count;
    return std::abs((areas / (mean * mean)).determinant()) / 8.0 < leastDeterminant;
  }
};

/// True if the normals of all internal faces lie in one plane, as in a mesh that is one cell thick: no union of cells
/// helps then. `areas` is the sum over all cells at the boundary.
bool areInOnePlane(const Mat3& areas)
{
  constexpr double flat = 1e-12;
  const double mean = areas.trace() / 3.0;
  return mean <= 0.0 || std::abs((areas / mean).determinant()) < flat;
}

std::array<double, 9> valuesOf(const Mat3& matrix)
{
  std::array<double, 9> values{};
  std::copy_n(matrix.data(), values.size(), values.begin());
  return values;
}

class CellMerger
{
public:
  CellMerger(FaceMesh& faceMesh, std::span<const Index> patchOfFace, const RunContext& within,
             const KeptParts& keptParts)
      : mesh(faceMesh), patchOf(patchOfFace), context(within), kept(keptParts)
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
    CellUnions unions(mesh, patchOf, context.executor, kept.zoneOf);
    bool any = false;
    for (const Index cell : candidates)
    {
      context.progress.check();
      any = (!isKept(cell) && resolve(unions, cell)) || any;
    }
    context.progress.report(0.8, "Merging cells");
    return any ? renumber(unions) : MergedCells();
  }

private:
  bool isKept(Index cell) const { return std::binary_search(kept.cells.begin(), kept.cells.end(), cell); }

  /// Returns cells at the boundary whose internal faces do not point in all directions; rising.
  std::vector<Index> findCandidates() const
  {
    std::vector<Index> cells(mesh.owner.begin() + static_cast<std::ptrdiff_t>(mesh.internalFaceCount()),
                             mesh.owner.end());
    sortUnique(cells);
    const std::vector<Directions> directions = directionsOf(cells);
    std::vector<Index> found;
    if (areInOnePlane(sumOf(cells, directions)))
    {
      return found;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (directions[i].areFew())
      {
        found.push_back(cells[i]);
      }
    }
    return found;
  }

  Mat3 sumOf(const std::vector<Index>& cells, const std::vector<Directions>& directions) const
  {
    Mat3 own = Mat3::Zero();
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (!kept.part || kept.part->isOwn[cells[i]])
      {
        own += directions[i].areas;
      }
    }
    if (!kept.part)
    {
      return own;
    }
    Mat3 sum = Mat3::Zero();
    for (const std::array<double, 9>& some : gatherAll(kept.part->exchange, valuesOf(own)))
    {
      sum += Eigen::Map<const Mat3>(some.data());
    }
    return sum;
  }

  std::vector<Directions> directionsOf(const std::vector<Index>& cells) const
  {
    std::vector<Index> slotOf(mesh.cellCount, noIndex);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      slotOf[cells[i]] = static_cast<Index>(i);
    }
    const std::vector<Index> faces = chosenNumbers(mesh.internalFaceCount(), context.executor, [&](std::size_t f) {
      return slotOf[mesh.owner[f]] != noIndex || slotOf[mesh.neighbor[f]] != noIndex;
    });
    std::vector<Directions> directions(cells.size());
    for (const Index f : faces)
    {
      const Vec3 area = measurePolygon(mesh.points, mesh.face(f)).area;
      for (const Index slot : {slotOf[mesh.owner[f]], slotOf[mesh.neighbor[f]]})
      {
        if (slot != noIndex)
        {
          directions[slot].add(area);
        }
      }
    }
    return directions;
  }

  struct Group
  {
    std::vector<Index> cells; ///< rising
    UnionVerdict verdict;

    auto rank() const { return std::tuple(!serves(), verdict.concave, verdict.penalty, cells); }
    bool serves() const { return verdict.sound && verdict.determined; }
  };

  /// Merges a cell with others or marks it for cutting if that helps. Returns true if it did.
  bool resolve(CellUnions& unions, Index cell) const
  {
    const Index alone[] = {unions.cellOf(cell)};
    const UnionVerdict verdict = judgeUnion(unions, alone, context.executor);
    if (verdict.determined)
    {
      return false; // another cell was merged with it
    }
    const std::optional<Group> group = findGroup(unions, {{alone[0]}, verdict});
    const std::optional<double> split =
        unions.isUnited(alone[0]) ? std::nullopt : splitPenalty(unions, alone[0], context.executor);
    if (split && (!group || group->verdict.concave || *split < group->verdict.penalty))
    {
      unions.split(alone[0]);
      return true;
    }
    if (group)
    {
      unions.unite(group->cells);
    }
    return group.has_value();
  }

  /// Returns the best accepted group among those with the fewest cells. The best rejected groups are tried with one
  /// more cell.
  std::optional<Group> findGroup(const CellUnions& unions, const Group& alone) const
  {
    std::vector<Group> groups{alone};
    for (std::size_t size = 2; size <= mostCells && !groups.empty(); ++size)
    {
      groups = withOneMore(unions, groups);
      if (!groups.empty() && groups[0].serves())
      {
        return groups[0];
      }
    }
    return std::nullopt;
  }

  /// Returns the groups extended by one neighbor that are closed balls, best first.
  std::vector<Group> withOneMore(const CellUnions& unions, const std::vector<Group>& groups) const
  {
    std::set<std::vector<Index>> larger;
    for (const Group& group : groups)
    {
      for (const Index next : unions.neighborsOf(group.cells))
      {
        if (unions.isSplit(next) || isKept(next))
        {
          continue;
        }
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
    found.resize(std::min(found.size(), mostTried));
    return found;
  }

  /// Rewrites the mesh with the new cells.
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
    for (const OrderedFace& face : orderOfFaces(merged.cellOf))
    {
      merged.faceOf[face.face] = static_cast<Index>(out.owner.size());
      appendFace(out, face, mesh.face(face.face));
    }
    out.points = std::move(mesh.points);
    mesh = std::move(out);
    if (!unions.splitCells().empty())
    {
      split(unions.splitCells(), merged);
    }
    return merged;
  }

  /// Cuts cells into pyramids. `cells` has their old numbers.
  void split(const std::set<Index>& cells, MergedCells& merged)
  {
    std::vector<Index> now;
    now.reserve(cells.size());
    for (const Index cell : cells)
    {
      now.push_back(merged.cellOf[cell]);
    }
    SplitCells cut = splitIntoPyramids(mesh, now);
    for (Index& face : merged.faceOf)
    {
      face = face == noIndex ? noIndex : cut.faceOf[face];
    }
    merged.added = std::move(cut.cellOf);
  }

  std::vector<OrderedFace> orderOfFaces(const std::vector<Index>& cellOf) const
  {
    std::vector<OrderedFace> order;
    order.reserve(mesh.faceCount());
    for (Index face = 0; face < mesh.faceCount(); ++face)
    {
      const Index owner = cellOf[mesh.owner[face]];
      const Index neighbor = face < mesh.internalFaceCount() ? cellOf[mesh.neighbor[face]] : noIndex;
      if (owner != neighbor)
      {
        order.push_back(orderFace(face, owner, neighbor));
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  FaceMesh& mesh;
  std::span<const Index> patchOf;
  const RunContext& context;
  const KeptParts& kept;
};

} // namespace

MergedCells mergeUnderdeterminedCells(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                                      const KeptParts& kept)
{
  return CellMerger(mesh, patchOf, context, kept).run();
}

} // namespace atria
