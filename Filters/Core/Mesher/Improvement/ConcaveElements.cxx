// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ConcaveElements.h"

#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/MergeFaces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <map>

namespace atria {

namespace {

/// The sine from which on checkMesh takes a cell for convex.
constexpr double leastSine = 1e-6;

/// Whether one of two faces, outward, has the other behind its plane or in it.
bool areConcave(const PolygonMeasure& a, const PolygonMeasure& b)
{
  const Vec3 way = b.centroid - a.centroid;
  const double least = leastSine * way.norm();
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

std::span<const Index> pointsOf(const ReducedFace& face)
{
  return {face.points.data(), static_cast<std::size_t>(face.count)};
}

/// Those with two boundary faces or more that are concave as they are.
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
        faces.push_back(measurePolygon(mesh.points, pointsOf(faceOf(mesh.corners[e], direction))));
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

/// Some elements, the first cells, and those beside them as a mesh of their own.
struct Part
{
  FaceMesh mesh;
  std::vector<Index> patchOf; ///< as for mergeCoplanarFaces()
};

class PartMaker
{
public:
  explicit PartMaker(const DualMesh& whole) : mesh_(whole) {}

  Part make(const std::vector<Index>& elements)
  {
    for (const Index e : elements)
    {
      number(e);
    }
    for (const Index e : elements)
    {
      for (const std::int32_t next : mesh_.neighbors[e])
      {
        if (next >= 0)
        {
          number(static_cast<Index>(next));
        }
      }
    }
    Part part;
    part.mesh.cellCount = elements_.size();
    for (const OrderedFace& face : facesInOrder())
    {
      append(part, face);
    }
    return part;
  }

private:
  void number(Index element)
  {
    if (cellOf_.emplace(element, static_cast<Index>(elements_.size())).second)
    {
      elements_.push_back(element);
    }
  }

  Index cellOf(std::int32_t code) const
  {
    const auto found = code >= 0 ? cellOf_.find(static_cast<Index>(code)) : cellOf_.end();
    return found == cellOf_.end() ? noIndex : found->second;
  }

  /// Numbered by cell and direction.
  std::vector<OrderedFace> facesInOrder() const
  {
    std::vector<OrderedFace> order;
    for (Index cell = 0; cell < elements_.size(); ++cell)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        const std::int32_t code = mesh_.neighbors[elements_[cell]][direction];
        const Index across = cellOf(code);
        if (code != DualMesh::noFace && (across == noIndex || cell < across))
        {
          order.push_back(orderFace(6 * cell + static_cast<Index>(direction), cell, across));
        }
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  void append(Part& part, const OrderedFace& face)
  {
    const Index element = elements_[face.owner];
    const auto direction = static_cast<int>(face.face % 6);
    std::vector<Index> loop;
    for (const Index p : pointsOf(faceOf(mesh_.corners[element], direction)))
    {
      const auto [at, isNew] = pointOf_.emplace(p, static_cast<Index>(part.mesh.points.size()));
      if (isNew)
      {
        part.mesh.points.push_back(mesh_.points[p]);
      }
      loop.push_back(at->second);
    }
    appendFace(part.mesh, face, loop);
    if (face.onBoundary)
    {
      part.patchOf.push_back(beyond(mesh_.neighbors[element][direction]));
    }
  }

  /// A number for each side of each surface, and another one for each element.
  Index beyond(std::int32_t code) const
  {
    if (code >= 0)
    {
      return noIndex - 1 - static_cast<Index>(code);
    }
    const BoundaryFace& face = mesh_.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    return 2 * face.tag + (face.side == SheetSide::back ? 1 : 0);
  }

  const DualMesh& mesh_;
  std::vector<Index> elements_;
  std::map<Index, Index> cellOf_;
  std::map<Index, Index> pointOf_;
};

} // namespace

std::vector<Index> findConcaveAtWalls(const DualMesh& mesh, const RunContext& context)
{
  const std::vector<Index> candidates = findCandidates(mesh, context.executor);
  Part part = PartMaker(mesh).make(candidates);
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
      if (face >= part.mesh.internalFaceCount()) // of this cell, as all beside it are there
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
