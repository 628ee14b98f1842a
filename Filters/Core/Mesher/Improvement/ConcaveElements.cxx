// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ConcaveElements.h"

#include "Mesher/Improvement/PartialMesh.h"
#include "Quality/Checks/CheckLimits.h"
#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/MergeFaces.h"
#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

namespace {

/// True if one of two outward faces is behind the plane of the other, or in it.
bool areConcave(const PolygonMeasure& a, const PolygonMeasure& b)
{
  const Vec3 way = b.centroid - a.centroid;
  const double least = checkLimits::concaveSine * way.norm();
  return way.dot(a.area) > -least * a.area.norm() || -way.dot(b.area) > -least * b.area.norm();
}

bool anyConcave(const std::vector<PolygonMeasure>& faces)
{
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (areConcave(faces[i], faces[j]))
      {
        return true;
      }
    }
  }
  return false;
}

/// Returns the elements with several boundary faces that are concave before faces are merged.
std::vector<Index> findCandidates(const DualMesh& mesh, const Executor& executor)
{
  std::vector<Index> elements(mesh.boundaryFaces.size());
  std::ranges::transform(mesh.boundaryFaces, elements.begin(), &BoundaryFace::element);
  sortUnique(elements);
  std::vector<char> chosen(elements.size(), 0);
  executor.forEach(elements.size(), 1024, [&](std::size_t i) {
    const Index e = elements[i];
    std::vector<PolygonMeasure> faces;
    for (int direction = 0; direction < 6; ++direction)
    {
      if (DualMesh::isBoundary(mesh.neighbors[e][direction]))
      {
        const ReducedFace face = faceOf(mesh.corners[e], direction);
        faces.push_back(measurePolygon(mesh.points, face.loop()));
      }
    }
    chosen[i] = anyConcave(faces) ? 1 : 0;
  });
  std::vector<Index> found;
  for (std::size_t i = 0; i < elements.size(); ++i)
  {
    if (chosen[i])
    {
      found.push_back(elements[i]);
    }
  }
  return found;
}

} // namespace

std::vector<Index> findConcaveAtWalls(const DualMesh& mesh, const RunContext& context)
{
  const std::vector<Index> candidates = findCandidates(mesh, context.executor);
  PartialMesh part = makePartialMesh(mesh, candidates);
  SilentMonitor silent;
  const RunContext quiet{context.executor, ProgressRange(silent)};
  mergeCoplanarFaces(part.mesh, part.patchOf, quiet);
  context.progress.check();
  const CellFaces cellFaces = makeCellFaces(part.mesh, context.executor);
  std::vector<Index> found;
  for (Index cell = 0; cell < candidates.size(); ++cell)
  {
    std::vector<PolygonMeasure> faces;
    for (const Index face : cellFaces.of(cell))
    {
      if (face >= part.mesh.internalFaceCount()) // a boundary face of this cell, as all its neighbors are in the part
      {
        faces.push_back(measurePolygon(part.mesh.points, part.mesh.face(face)));
      }
    }
    if (anyConcave(faces))
    {
      found.push_back(candidates[cell]);
    }
  }
  return found;
}

} // namespace atria
