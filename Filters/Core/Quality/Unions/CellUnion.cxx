// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/CellUnion.h"

#include "Quality/Checks/CheckLimits.h"
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Checks/Metrics.h"
#include "Quality/Unions/MergeFaces.h"
#include "Quality/Unions/SplitCells.h"
#include "Support/Angles.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atria {

namespace {

constexpr std::size_t fewestFaces = 4;
/// Share of the limits of skewness and non-orthogonality that unions may reach. The margin is needed because merging
/// their coplanar faces moves their centroids.
constexpr double greatestPenalty = 0.99;

/// Some cells and their neighbors as a separate mesh, in which the cells are merged into cell 0.
struct Surroundings
{
  FaceMesh mesh;
  std::vector<Index> patchOf; ///< as for mergeCoplanarFaces()
};

/// Returns the faces of the surroundings, sorted by the cell numbers of `localCell`.
std::vector<OrderedFace> facesAbout(const CellUnions& unions, const std::map<Index, Index>& localCell,
                                    std::span<const Index> cells)
{
  std::vector<Index> faces = unions.outerFaces(cells);
  for (const auto& [cell, local] : localCell)
  {
    if (local > 0)
    {
      const auto more = unions.facesOf(cell);
      faces.insert(faces.end(), more.begin(), more.end());
    }
  }
  sortUnique(faces);
  const auto local = [&](Index cell) {
    const auto found = cell == noIndex ? localCell.end() : localCell.find(cell);
    return found == localCell.end() ? noIndex : found->second;
  };
  std::vector<OrderedFace> order;
  for (const Index face : faces)
  {
    const auto [owner, neighbor] = unions.sidesOf(face);
    const Index a = local(owner);
    const Index b = local(neighbor);
    if (a != b)
    {
      order.push_back(orderFace(face, a, b));
    }
  }
  std::sort(order.begin(), order.end());
  return order;
}

/// Returns a number for the region beyond a boundary face of the surroundings: its patch, or a distinct number per
/// cell.
Index beyond(const CellUnions& unions, const OrderedFace& local)
{
  const auto [owner, neighbor] = unions.sidesOf(local.face);
  return neighbor == noIndex ? unions.patchOf(local.face) : noIndex - 1 - (local.turned ? owner : neighbor);
}

void split(Surroundings& about, std::span<const Index> cells)
{
  const std::size_t internalBefore = about.mesh.internalFaceCount();
  const SplitCells cut = splitIntoPyramids(about.mesh, cells);
  const std::size_t internal = about.mesh.internalFaceCount();
  const std::vector<Index> patchOf = about.patchOf;
  for (std::size_t i = 0; i < patchOf.size(); ++i)
  {
    about.patchOf[cut.faceOf[internalBefore + i] - internal] = patchOf[i];
  }
}

Surroundings surroundingsOf(const CellUnions& unions, std::span<const Index> cells)
{
  std::map<Index, Index> localCell;
  for (const Index cell : cells)
  {
    localCell[cell] = 0;
  }
  Index count = 1;
  std::vector<Index> cut;
  for (const Index cell : unions.neighborsOf(cells))
  {
    if (unions.isSplit(cell))
    {
      cut.push_back(count);
    }
    localCell.emplace(cell, count++);
  }
  Surroundings out;
  FaceMesh& mesh = out.mesh;
  mesh.cellCount = count;
  std::map<Index, Index> localPoint;
  std::vector<Index> loop;
  for (const OrderedFace& local : facesAbout(unions, localCell, cells))
  {
    loop.clear();
    for (const Index point : unions.mesh.face(local.face))
    {
      const auto [at, isNew] = localPoint.emplace(point, static_cast<Index>(mesh.points.size()));
      if (isNew)
      {
        mesh.points.push_back(unions.mesh.points[point]);
      }
      loop.push_back(at->second);
    }
    appendFace(mesh, local, loop);
    if (local.onBoundary)
    {
      out.patchOf.push_back(beyond(unions, local));
    }
  }
  if (!cut.empty())
  {
    split(out, cut);
  }
  return out;
}

/// True if each edge of the faces is used twice, once in each direction, and the faces are connected over edges and
/// form a sphere by Euler's formula. All faces point out of cell 0, which owns them.
bool isBall(const FaceMesh& mesh, std::span<const Index> faces)
{
  std::map<std::pair<Index, Index>, Index> faceOfEdge;
  std::vector<Index> points;
  for (Index i = 0; i < faces.size(); ++i)
  {
    const auto loop = mesh.face(faces[i]);
    points.insert(points.end(), loop.begin(), loop.end());
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      if (!faceOfEdge.emplace(std::pair(loop[k], loop[(k + 1) % loop.size()]), i).second)
      {
        return false;
      }
    }
  }
  UnionFind connected(faces.size());
  std::size_t parts = faces.size();
  for (const auto& [edge, face] : faceOfEdge)
  {
    const auto back = faceOfEdge.find({edge.second, edge.first});
    if (back == faceOfEdge.end())
    {
      return false;
    }
    parts -= connected.find(face) != connected.find(back->second) ? 1 : 0;
    connected.join(face, back->second);
  }
  sortUnique(points);
  return parts == 1 && points.size() + faces.size() == faceOfEdge.size() / 2 + 2;
}

double worstPenalty(const MeasuredMesh& m, std::span<const Index> faces)
{
  constexpr double severeDegrees = 70.0;
  double worst = 0.0;
  for (const Index f : faces)
  {
    worst = std::max(worst, faceSkewness(m, f) / checkLimits::skewness);
    if (f < m.mesh.internalFaceCount())
    {
      worst = std::max(worst, degreesOfCosine(faceCosine(m, f)) / severeDegrees);
    }
  }
  return worst;
}

/// Judges cell 0.
UnionVerdict judgeFirst(const FaceMesh& mesh, const RunContext& context)
{
  const MeasuredMesh measured = measureMesh(mesh, context);
  const auto faces = measured.cellFaces.of(0);
  if (faces.size() < fewestFaces || !isBall(mesh, faces))
  {
    return {};
  }
  const MeshVerdict checks = checkMesh(measured, context);
  const std::uint32_t failed = failedChecksOfCells(measured, checks)[0];
  UnionVerdict verdict{true, true, true, false, worstPenalty(measured, faces)};
  verdict.sound = verdict.penalty <= greatestPenalty;
  for (std::size_t i = 0; i < checks.checks.size(); ++i)
  {
    if ((failed >> i & 1U) == 0)
    {
      continue;
    }
    const std::string_view name = checks.checks[i].name;
    verdict.concave = verdict.concave || name == "Concavity";
    verdict.determined = verdict.determined && name != "Determinant";
    verdict.sound = verdict.sound && (!checks.checks[i].isError || name == "Concavity" || name == "Determinant");
  }
  return verdict;
}

} // namespace

CellUnions::CellUnions(const FaceMesh& faceMesh, std::span<const Index> patchOf, const Executor& executor,
                       std::span<const Index> zoneOf)
    : mesh(faceMesh), patches(patchOf), zones(zoneOf), faces(makeCellFaces(faceMesh, executor)),
      into(faceMesh.cellCount)
{
  std::iota(into.begin(), into.end(), Index{0});
}

std::pair<Index, Index> CellUnions::sidesOf(Index face) const
{
  return {into[mesh.owner[face]], face < mesh.internalFaceCount() ? into[mesh.neighbor[face]] : noIndex};
}

std::span<const Index> CellUnions::facesOf(Index cell) const
{
  const auto found = united.find(cell);
  return found == united.end() ? faces.of(cell) : std::span<const Index>(found->second);
}

std::vector<Index> CellUnions::outerFaces(std::span<const Index> cells) const
{
  const auto isIn = [&](Index cell) { return std::find(cells.begin(), cells.end(), cell) != cells.end(); };
  std::vector<Index> outer;
  for (const Index cell : cells)
  {
    for (const Index face : facesOf(cell))
    {
      const auto [owner, neighbor] = sidesOf(face);
      if (!isIn(owner) || !isIn(neighbor))
      {
        outer.push_back(face);
      }
    }
  }
  std::sort(outer.begin(), outer.end());
  return outer;
}

std::vector<Index> CellUnions::neighborsOf(std::span<const Index> cells) const
{
  const auto isIn = [&](Index cell) { return std::find(cells.begin(), cells.end(), cell) != cells.end(); };
  std::vector<Index> beyond;
  std::vector<Index> barred;
  for (const Index face : outerFaces(cells))
  {
    const auto [owner, neighbor] = sidesOf(face);
    if (neighbor != noIndex)
    {
      (isOfZone(face) ? barred : beyond).push_back(isIn(owner) ? neighbor : owner);
    }
  }
  sortUnique(beyond);
  std::erase_if(beyond, [&](Index cell) { return std::ranges::find(barred, cell) != barred.end(); });
  return beyond;
}

void CellUnions::unite(std::span<const Index> cells)
{
  std::vector<Index> outer = outerFaces(cells);
  std::vector<Index> members;
  for (const Index cell : cells)
  {
    const auto found = membersOf.find(cell);
    if (found == membersOf.end())
    {
      members.push_back(cell);
      continue;
    }
    members.insert(members.end(), found->second.begin(), found->second.end());
    membersOf.erase(found);
    united.erase(cell);
  }
  const Index lowest = *std::min_element(cells.begin(), cells.end());
  for (const Index cell : members)
  {
    into[cell] = lowest;
  }
  united[lowest] = std::move(outer);
  membersOf[lowest] = std::move(members);
}

std::optional<double> splitPenalty(const CellUnions& unions, Index cell, const Executor& executor)
{
  SilentMonitor silent;
  const RunContext context{executor, ProgressRange(silent)};
  const Index cells[] = {cell};
  Surroundings whole = surroundingsOf(unions, cells);
  Surroundings cut = whole;
  const Index first[] = {0};
  split(cut, first);
  const auto errorsOf = [&](const MeasuredMesh& mesh) { return failedErrorsOfCells(mesh, checkMesh(mesh, context)); };
  for (Surroundings* about : {&whole, &cut})
  {
    mergeCoplanarFaces(about->mesh, about->patchOf, context);
  }
  const std::vector<std::uint32_t> before = errorsOf(measureMesh(whole.mesh, context));
  const MeasuredMesh measured = measureMesh(cut.mesh, context);
  const std::vector<std::uint32_t> after = errorsOf(measured);
  double worst = 0.0;
  for (Index c = 0; c < after.size(); ++c)
  {
    const bool isPyramid = c == 0 || c >= before.size();
    if ((after[c] & ~(isPyramid ? 0U : before[c])) != 0)
    {
      return std::nullopt;
    }
    worst = isPyramid ? std::max(worst, worstPenalty(measured, measured.cellFaces.of(c))) : worst;
  }
  return worst <= greatestPenalty ? std::optional(worst) : std::nullopt;
}

UnionVerdict judgeUnion(const CellUnions& unions, std::span<const Index> cells, const Executor& executor)
{
  SilentMonitor silent;
  const RunContext context{executor, ProgressRange(silent)};
  Surroundings about = surroundingsOf(unions, cells);
  const UnionVerdict verdict = judgeFirst(about.mesh, context);
  if (!verdict.sound || !verdict.determined || mergeCoplanarFaces(about.mesh, about.patchOf, context).count == 0)
  {
    return verdict;
  }
  UnionVerdict merged = judgeFirst(about.mesh, context);
  merged.isBall = true;
  return merged;
}

} // namespace atria
