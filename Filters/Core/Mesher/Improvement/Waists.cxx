// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/Waists.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Quality/Unions/MergeFaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

namespace atria {

namespace {

/// A boundary face of an element.
struct Side
{
  const BoundaryFace* face;
  ReducedFace points;
  Vec3 normal; ///< unit, outward

  /// Of a point among those of the face; their count where it is none.
  int placeOf(Index point) const
  {
    const auto first = points.points.begin();
    return static_cast<int>(std::find(first, first + points.count, point) - first);
  }
  bool has(Index point) const { return placeOf(point) < points.count; }
  Index next(Index point, int step) const
  {
    return points.points[(placeOf(point) + step + points.count) % points.count];
  }
};

std::vector<Side> sidesOf(const DualMesh& mesh, Index element)
{
  std::vector<Side> sides;
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::int32_t code = mesh.neighbors[element][direction];
    if (DualMesh::isBoundary(code))
    {
      const BoundaryFace& face = mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)];
      sides.push_back({&face, faceOf(mesh.corners[element], direction), -wallNormal(mesh, face).normalized()});
    }
  }
  return sides;
}

bool areInOnePlane(const Side& a, const Side& b)
{
  return a.face->tag == b.face->tag && a.face->side == b.face->side && a.normal.dot(b.normal) > 0.0 &&
         a.normal.cross(b.normal).norm() < mergedPlanarSine;
}

/// Notes where points of the common edge of two faces ought to be.
void findWaists(const DualMesh& mesh, const Side& a, const Side& b, std::map<Index, Vec3>& wanted)
{
  for (int i = 0; i < a.points.count; ++i)
  {
    const Index p = a.points.points[i];
    const Index along = a.next(p, 1);
    if (!b.has(p) || !b.has(along))
    {
      continue;
    }
    // The union runs through either end of the edge from one face to the other.
    for (const auto& [end, before, after] :
         {std::tuple(p, a.next(p, -1), b.next(p, 1)), std::tuple(along, b.next(along, -1), a.next(along, 1))})
    {
      const Vec3& at = mesh.points[end];
      const Vec3 turn = (at - mesh.points[before]).cross(mesh.points[after] - at);
      if (turn.dot(a.normal) < 0.0)
      {
        wanted[end] = 0.5 * (mesh.points[before] + mesh.points[after]);
      }
    }
  }
}

/// Where points at waists ought to be.
std::map<Index, Vec3> findWaists(const ImproverState& state)
{
  const DualMesh& mesh = state.layer.mesh;
  std::map<Index, Vec3> wanted;
  for (const Index element : findConcaveAtWalls(mesh, state.context))
  {
    const std::vector<Side> sides = sidesOf(mesh, element);
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (areInOnePlane(sides[i], sides[j]))
        {
          findWaists(mesh, sides[i], sides[j], wanted);
        }
      }
    }
  }
  return wanted;
}

/// Those of points that may move, in rising order.
std::vector<WantedPlace> allowedPlaces(const std::map<Index, Vec3>& wanted, LayerConstraints& constraints,
                                       const RunContext& context)
{
  std::vector<Index> points;
  for (const auto& [point, place] : wanted)
  {
    if (constraints.leaderOf(point) == point && constraints.isMovable(point))
    {
      points.push_back(point);
    }
  }
  constraints.prepare(points, context);
  std::vector<WantedPlace> places;
  std::ranges::transform(points, std::back_inserter(places), [&](Index point) {
    return WantedPlace{point, constraints.place(point, wanted.at(point))};
  });
  return places;
}

} // namespace

void widenWaists(ImproverState& state, VertexDetachment& detachment)
{
  for (int round = 0; round < mostWaistRounds; ++round)
  {
    state.context.progress.check();
    const std::map<Index, Vec3> wanted = findWaists(state);
    for (const auto& [point, place] : wanted)
    {
      if (!state.layer.isNew(point))
      {
        detachment.letGoOn(state.vertexOf[point], anOctant);
      }
    }
    LayerFreedom freedom(state);
    const std::vector<WantedPlace> places = allowedPlaces(wanted, freedom.layer, state.context);
    std::vector<Index> changed;
    if (!places.empty())
    {
      approach(DualSource(state.layer.mesh), state.layer.mesh.points, places, freedom.layer, leastPutBack,
               targetsBack(state.traits), state.context, changed);
      state.outdate(changed);
    }
    detachment.keepThoseAway();
    if (changed.empty())
    {
      return;
    }
  }
}

} // namespace atria
