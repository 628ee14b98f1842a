// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/FaceUnion.h"

#include "Quality/Unions/PolygonUnion.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t fewestFaces = 4;
/// Value of leastTetrahedron() that is positive beyond all rounding. A smaller value may not decrease further, except
/// by rounding.
constexpr double clearlyAbove = 1e-6;
constexpr double rounding = 1e-12;

/// Counts the pairs of a cell's faces in which one sees the other from behind or from within its plane. This is how
/// checkMesh finds concave cells. `faces` point outward.
std::size_t concavePairs(const std::vector<PolygonMeasure>& faces)
{
  std::size_t pairs = 0;
  for (const PolygonMeasure& a : faces)
  {
    for (const PolygonMeasure& b : faces)
    {
      const Vec3 way = b.centroid - a.centroid;
      pairs += &a != &b && way.dot(a.area) > -mergedPlanarSine * way.norm() * a.area.norm() ? 1 : 0;
    }
  }
  return pairs;
}

} // namespace

FaceUnions::FaceUnions(FaceMesh& faceMesh, const RunContext& context)
    : mesh(faceMesh), into(faceMesh.faceCount()), cellFaces(makeCellFaces(faceMesh, context.executor)),
      cellCentroids(computeGeometry(faceMesh, cellFaces, context).cellCentroids), uses(faceMesh.points.size(), 0)
{
  std::iota(into.begin(), into.end(), Index{0});
  count(mesh.facePoints, 1);
}

std::span<const Index> FaceUnions::loopOf(Index face) const
{
  const auto found = loops.find(face);
  return found == loops.end() ? mesh.face(face) : std::span<const Index>(found->second);
}

std::span<const Index> FaceUnions::loopIn(const FaceUnion& change, Index face) const
{
  const auto found = change.loops.find(face);
  return found == change.loops.end() ? loopOf(face) : std::span<const Index>(found->second);
}

const Vec3& FaceUnions::centroidIn(const FaceUnion& change, Index cell) const
{
  const auto found = change.centroids.find(cell);
  return found == change.centroids.end() ? cellCentroids[cell] : found->second;
}

std::vector<Index> FaceUnions::facesIn(const FaceUnion& change, Index cell) const
{
  const auto own = cellFaces.of(cell);
  std::vector<Index> faces(own.begin(), own.end());
  std::erase_if(faces, [&](Index face) {
    const bool joins = contains(change.group, face) && face != change.group.front();
    return into[face] != face || joins;
  });
  return faces;
}

std::vector<Index> FaceUnions::outwardLoopIn(const FaceUnion& change, Index face, Index cell) const
{
  const auto loop = loopIn(change, face);
  std::vector<Index> outward(loop.begin(), loop.end());
  if (mesh.owner[face] != cell)
  {
    std::reverse(outward.begin(), outward.end());
  }
  return outward;
}

std::vector<PolygonMeasure> FaceUnions::measuresIn(const FaceUnion& change, Index cell) const
{
  std::vector<PolygonMeasure> measures;
  for (const Index face : facesIn(change, cell))
  {
    measures.push_back(measurePolygon(mesh.points, outwardLoopIn(change, face, cell)));
  }
  return measures;
}

std::vector<Index> FaceUnions::cellsOf(Index face) const
{
  return isInternal(face) ? std::vector<Index>{mesh.owner[face], mesh.neighbor[face]}
                          : std::vector<Index>{mesh.owner[face]};
}

void FaceUnions::findCentroids(FaceUnion& change) const
{
  for (const auto& [face, loop] : change.loops)
  {
    for (const Index cell : cellsOf(face))
    {
      if (change.centroids.contains(cell))
      {
        continue;
      }
      const std::vector<PolygonMeasure> faces = measuresIn(change, cell);
      change.centroids[cell] = measureCellInOrder(faces.size(), [&](std::size_t i) { return faces[i]; }).centroid;
    }
  }
}

double FaceUnions::leastIn(const FaceUnion& change, Index face) const
{
  const Vec3* beyond = isInternal(face) ? &centroidIn(change, mesh.neighbor[face]) : nullptr;
  return leastTetrahedron(mesh.points, loopIn(change, face), centroidIn(change, mesh.owner[face]), beyond);
}

/// True if the face does not lose its valid tetrahedra.
bool FaceUnions::staysSound(const FaceUnion& change, Index face) const
{
  double before = leastIn({}, face);
  for (const Index part : face == change.group.front() ? change.group : std::vector<Index>())
  {
    before = std::min(before, leastIn({}, part));
  }
  return leastIn(change, face) >= std::min(clearlyAbove, before - rounding);
}

/// True if changed outlines fit the cell's other faces.
bool FaceUnions::outlinesFit(const FaceUnion& change, const std::vector<Index>& faces) const
{
  return std::all_of(change.loops.begin(), change.loops.end(), [&](const auto& changed) {
    return !contains(faces, changed.first) || std::all_of(faces.begin(), faces.end(), [&](Index face) {
      return face == changed.first || shareOneRun(changed.second, loopIn(change, face));
    });
  });
}

bool FaceUnions::fits(const FaceUnion& change) const
{
  const Index merged = change.group.front();
  for (const auto& [cell, centroid] : change.centroids)
  {
    const std::vector<Index> faces = facesIn(change, cell);
    if (faces.size() < fewestFaces || !outlinesFit(change, faces))
    {
      return false;
    }
    const auto seesAll = [&, within = cell](const Vec3& from) {
      return isStarShaped(mesh.points, outwardLoopIn(change, merged, within), from, mergedPlanarSine);
    };
    if (contains(faces, merged) && (!seesAll(cellCentroids[cell]) || !seesAll(centroid)))
    {
      return false;
    }
    if (!std::all_of(faces.begin(), faces.end(), [&](Index face) { return staysSound(change, face); }))
    {
      return false;
    }
  }
  return true;
}

void FaceUnions::apply(FaceUnion change)
{
  for (const Index face : change.group)
  {
    count(loopOf(face), -1);
    loops.erase(face);
    into[face] = change.group.front();
  }
  for (auto& [face, loop] : change.loops)
  {
    if (face != change.group.front())
    {
      count(loopOf(face), -1);
    }
    count(loop, 1);
    loops[face] = std::move(loop);
  }
  for (const auto& [cell, centroid] : change.centroids)
  {
    cellCentroids[cell] = centroid;
  }
}

bool FaceUnions::isLessConcave(const FaceUnion& change) const
{
  std::size_t before = 0;
  std::size_t after = 0;
  for (const auto& [cell, centroid] : change.centroids)
  {
    const std::size_t were = concavePairs(measuresIn({}, cell));
    const std::size_t are = concavePairs(measuresIn(change, cell));
    if (are > were)
    {
      return false;
    }
    before += were;
    after += are;
  }
  return after < before;
}

void FaceUnions::count(std::span<const Index> loop, int change)
{
  for (const Index point : loop)
  {
    uses[point] += static_cast<Index>(change);
  }
}

MergedFaces FaceUnions::writeFaces()
{
  const std::size_t before = mesh.faceCount();
  Index first = 0; // numbers change from this face on
  while (first < before && !loops.contains(first))
  {
    ++first;
  }
  FaceMesh out;
  out.faceOffsets.assign(1, mesh.faceOffsets[first]);
  for (Index f = first; f < before; ++f)
  {
    if (into[f] != f)
    {
      into[f] = into[into[f]]; // a lower face, which has its new number already
      continue;
    }
    into[f] = static_cast<Index>(first + out.owner.size());
    const auto loop = loopOf(f);
    out.facePoints.insert(out.facePoints.end(), loop.begin(), loop.end());
    out.faceOffsets.push_back(out.faceOffsets.front() + static_cast<Index>(out.facePoints.size()));
    out.owner.push_back(mesh.owner[f]);
    if (isInternal(f))
    {
      out.neighbor.push_back(mesh.neighbor[f]);
    }
  }
  const auto replaceTail = [](Buffer<Index>& all, std::size_t kept, const Buffer<Index>& tail) {
    all.resize(kept);
    all.insert(all.end(), tail.begin(), tail.end());
  };
  replaceTail(mesh.facePoints, out.faceOffsets.front(), out.facePoints);
  replaceTail(mesh.faceOffsets, first, out.faceOffsets);
  replaceTail(mesh.owner, first, out.owner);
  replaceTail(mesh.neighbor, std::min<std::size_t>(first, mesh.neighbor.size()), out.neighbor);
  return {std::move(into), before - mesh.faceCount()};
}

} // namespace atria
