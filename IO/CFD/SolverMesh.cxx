// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverMesh.h"

#include "Grid/Prism.h"
#include "Support/Error.h"
#include "Support/Pieces.h"
#include "VtkFaceMesh.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <utility>

namespace atria {

namespace {

const char* const defaultPatchName = "defaultFaces";

/// Returns the boundary faces that are in no patch.
std::vector<Index> unclaimedFaces(const FaceMesh& mesh, std::span<const BoundaryPatch> patches)
{
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<bool> claimed(mesh.faceCount() - internal, false);
  for (const BoundaryPatch& patch : patches)
  {
    for (const Index face : patch.faces)
    {
      if (face < internal || face >= mesh.faceCount() || claimed[face - internal])
      {
        throw Error("face " + std::to_string(face) + " of patch '" + patch.name +
                    "' is not on the boundary or in another patch too");
      }
      claimed[face - internal] = true;
    }
  }
  std::vector<Index> rest;
  for (std::size_t f = internal; f < mesh.faceCount(); ++f)
  {
    if (!claimed[f - internal])
    {
      rest.push_back(static_cast<Index>(f));
    }
  }
  return rest;
}

/// Gives the boundary faces, which are all but the internal ones, a new order.
void orderBoundary(FaceMesh& mesh, const std::vector<Index>& order)
{
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<Index> owners;
  std::vector<Index> points;
  std::vector<Index> sizes;
  for (const Index f : order)
  {
    const auto loop = mesh.face(f);
    owners.push_back(mesh.owner[f]);
    points.insert(points.end(), loop.begin(), loop.end());
    sizes.push_back(static_cast<Index>(loop.size()));
  }
  std::ranges::copy(owners, mesh.owner.begin() + static_cast<std::ptrdiff_t>(internal));
  std::ranges::copy(points, mesh.facePoints.begin() + static_cast<std::ptrdiff_t>(mesh.faceOffsets[internal]));
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    mesh.faceOffsets[internal + i + 1] = mesh.faceOffsets[internal + i] + sizes[i];
  }
}

void layOutPatches(SolverMesh& out, std::span<const BoundaryPatch> patches)
{
  std::vector<Index> order;
  const auto add = [&](std::vector<Index> faces, SolverPatch patch) {
    std::ranges::sort(faces);
    patch.firstFace = out.mesh.internalFaceCount() + order.size();
    patch.faceCount = faces.size();
    out.patches.push_back(std::move(patch));
    order.insert(order.end(), faces.begin(), faces.end());
  };
  std::vector<Index> rest = unclaimedFaces(out.mesh, patches);
  for (const BoundaryPatch& patch : patches)
  {
    add(patch.faces, solverPatch(patch.name));
  }
  if (!rest.empty())
  {
    add(std::move(rest), unclaimedPatch());
  }
  orderBoundary(out.mesh, order);
}

/// Returns SolverMesh::newPoint.
std::vector<Index> dropUnusedPoints(FaceMesh& mesh, const Executor& executor)
{
  std::vector<char> isUsed(mesh.points.size(), 0);
  executor.forEach(mesh.facePoints.size(), 65536, [&](std::size_t i) {
    std::atomic_ref(isUsed[mesh.facePoints[i]]).store(1, std::memory_order_relaxed);
  });
  const std::vector<Index> kept = chosenNumbers(isUsed.size(), executor, [&](std::size_t p) { return isUsed[p] != 0; });
  if (kept.size() == mesh.points.size())
  {
    return {};
  }
  std::vector<Index> newPoint(mesh.points.size(), noIndex);
  std::vector<Vec3> points(kept.size());
  executor.forEach(kept.size(), 65536, [&](std::size_t i) {
    newPoint[kept[i]] = static_cast<Index>(i);
    points[i] = mesh.points[kept[i]];
  });
  executor.forEach(mesh.facePoints.size(), 65536,
                   [&](std::size_t i) { mesh.facePoints[i] = newPoint[mesh.facePoints[i]]; });
  mesh.points = std::move(points);
  return newPoint;
}

std::vector<CellZone> numberedZones(std::span<const std::int64_t> zoneIds)
{
  if (std::ranges::adjacent_find(zoneIds, std::not_equal_to()) == zoneIds.end())
  {
    return {}; // one or none: nothing to distinguish
  }
  std::map<std::int64_t, std::vector<Index>> cellsOf;
  std::vector<Index>* cells = nullptr;
  for (std::size_t cell = 0; cell < zoneIds.size(); ++cell)
  {
    if (cell == 0 || zoneIds[cell] != zoneIds[cell - 1])
    {
      cells = &cellsOf[zoneIds[cell]];
    }
    cells->push_back(static_cast<Index>(cell));
  }
  std::vector<CellZone> zones;
  zones.reserve(cellsOf.size());
  for (auto& [id, own] : cellsOf)
  {
    zones.push_back({zoneName(id), std::move(own)});
  }
  return zones;
}

} // namespace

SolverPatch solverPatch(const std::string& name)
{
  return {name, isSideName(name) ? SolverPatch::DomainSide : SolverPatch::Wall};
}

SolverPatch unclaimedPatch() { return {defaultPatchName, SolverPatch::Unclaimed}; }

std::string zoneName(std::int64_t id)
{
  const std::string sign = id < 0 ? "_" : ""; // a word such as zone-1 reads badly in expressions
  return "zone" + sign + std::to_string(id < 0 ? -id : id);
}

std::vector<BoundaryPatch> boundaryPatchesOf(const VtkFaceMesh& source)
{
  std::vector<BoundaryPatch> patches;
  for (const VtkPatches::Patch& patch : source.patches.patches)
  {
    const auto first = source.patchFaces.begin() + static_cast<std::ptrdiff_t>(patch.firstFace);
    patches.push_back({patch.name, {first, first + static_cast<std::ptrdiff_t>(patch.faceCount)}});
  }
  return patches;
}

SolverMesh makeSolverMesh(FaceMesh mesh, std::span<const BoundaryPatch> patches, std::span<const std::int64_t> zoneIds,
                          const Executor& executor)
{
  if (!zoneIds.empty() && zoneIds.size() != mesh.cellCount)
  {
    throw Error("there are " + std::to_string(zoneIds.size()) + " zone ids for " + std::to_string(mesh.cellCount) +
                " cells");
  }
  SolverMesh out;
  out.mesh = std::move(mesh);
  layOutPatches(out, patches);
  out.newPoint = dropUnusedPoints(out.mesh, executor);
  out.cellZones = numberedZones(zoneIds);
  return out;
}

std::vector<PatchName> namesOf(std::span<const SolverPatch> patches, const NameRules& rules,
                               std::span<const std::string> others)
{
  std::vector<std::string> names;
  for (const SolverPatch& patch : patches)
  {
    // The first of equal names stays unchanged.
    names.insert(patch.kind == SolverPatch::Unclaimed ? names.begin() : names.end(), patch.name);
  }
  names.insert(names.end(), others.begin(), others.end());
  std::vector<PatchName> words = makePatchNames(names, rules);
  if (!patches.empty() && patches.back().kind == SolverPatch::Unclaimed)
  {
    std::rotate(words.begin(), words.begin() + 1, words.begin() + static_cast<std::ptrdiff_t>(patches.size()));
  }
  return words;
}

std::size_t facesWithCommonPoints(const FaceMesh& mesh)
{
  std::vector<std::vector<Index>> faces;
  for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
  {
    const auto loop = mesh.face(f);
    faces.emplace_back(loop.begin(), loop.end());
    std::ranges::sort(faces.back());
  }
  std::ranges::sort(faces);
  std::size_t count = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const bool isRepeated = (i > 0 && faces[i] == faces[i - 1]) || (i + 1 < faces.size() && faces[i] == faces[i + 1]);
    count += isRepeated ? 1 : 0;
  }
  return count;
}

} // namespace atria
