// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Cracks.h"

#include "Dual/Zones/CrackRuns.h"
#include "Octree/Tree/GeometryLists.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace atria {

namespace {

/// Steps along a boundary edge, and the least width of a crack, against the leaf's edge.
constexpr double stepRatio = 0.25;
constexpr double leastRatio = 1e-4;
/// Cosine of the angle to the direction in which the sheet would go on.
constexpr double leastCosine = 0.5;

/// Where the segment p-q passes through the parallelogram a, a + u, a + u + v, a + v.
bool passes(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& u, const Vec3& v)
{
  const Vec3 along = q - p;
  const Vec3 normal = u.cross(v);
  const double slope = normal.dot(along);
  if (std::abs(slope) <= 1e-12 * normal.norm() * along.norm())
  {
    return false;
  }
  const double t = normal.dot(a - p) / slope;
  const Vec3 x = p + t * along - a;
  const double squared = normal.squaredNorm();
  const double s = normal.dot(x.cross(v)) / squared;
  const double r = normal.dot(u.cross(x)) / squared;
  return t >= 0.0 && t <= 1.0 && s >= 0.0 && s <= 1.0 && r >= 0.0 && r <= 1.0;
}

/// Looks for cracks beside one boundary edge after another.
class BoundaryEdgeProbe
{
public:
  BoundaryEdgeProbe(const Zones& z, const std::vector<char>& keptZones, const Crossings& found,
                    const GridPlaces& places, const SurfaceModel& surfaces, const TriangleTree& pieces)
      : zones(z), kept(keptZones), crossings(found), grid(places), octree(places.octree()), frame(octree.frame()),
        points(places.points()), model(surfaces), tree(pieces)
  {
  }

  /// The steps of a boundary edge that are beside gaps narrower than an octant.
  std::vector<CrackStep> walk(Index featureEdge)
  {
    const FeatureEdge& edge = model.featureEdges[featureEdge];
    const Vec3 a = frame.toModel(model.points[edge.a]);
    const Vec3 b = frame.toModel(model.points[edge.b]);
    const double wanted = (b - a).norm() / (stepRatio * frame.finestSize);
    const auto count = static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), 1.0, 1e6));
    std::vector<CrackStep> steps;
    boundaryEdge = noIndex;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Vec3 begin = a + (b - a) * (static_cast<double>(i) / count);
      const Vec3 end = a + (b - a) * (static_cast<double>(i + 1) / count);
      const auto found = look(edge, begin, end);
      if (found)
      {
        steps.push_back({featureEdge, i, i + 1 == count, begin + 0.5 * found->across, end + 0.5 * found->across,
                         found->across.norm(), found->size, found->point, found->open});
      }
    }
    return steps;
  }

private:
  struct Gap
  {
    Vec3 across; ///< from the boundary edge to the other side
    double size; ///< edge of the leaf there
    Index point;
    bool open; ///< an uncut octree edge passes through it
  };

  std::optional<Gap> look(const FeatureEdge& edge, const Vec3& begin, const Vec3& end)
  {
    const Vec3 middle = 0.5 * (begin + end);
    if (!frame.inDomain(frame.toLattice(middle)))
    {
      return std::nullopt;
    }
    const Index leaf = octree.leafAt(frame.toLattice(middle));
    const Index point = keptCorner(leaf);
    if (point == noIndex || octree.featureType(leaf) == FeatureType::cluster || !outwards(edge, leaf, end - begin))
    {
      return std::nullopt;
    }
    const double size = frame.sizeOf(octree.level(leaf));
    const std::optional<Vec3> across = acrossFrom(middle, size);
    return across ? std::optional(Gap{*across, size, point, isOpen(begin, end - begin, *across, size)}) : std::nullopt;
  }

  Index keptCorner(Index leaf) const
  {
    for (const Index point : points.atCorner[leaf])
    {
      if (point != noIndex && kept[zones.ofPoint[point]])
      {
        return point;
      }
    }
    return noIndex;
  }

  /// Finds the boundary edge's triangle, and with it the direction in which it would go on. False for one on a domain
  /// side or a permeable surface.
  bool outwards(const FeatureEdge& edge, Index leaf, const Vec3& along)
  {
    if (boundaryEdge == noIndex)
    {
      for (const ModelItem piece : octree.items(leaf))
      {
        if (piece.kind == ModelItem::triangle && hasEdge(piece.index, edge))
        {
          boundaryEdge = piece.index;
          break;
        }
      }
      if (boundaryEdge == noIndex)
      {
        return false;
      }
      Vec3 third = Vec3::Zero();
      for (const Index p : model.triangles[boundaryEdge])
      {
        third = p != edge.a && p != edge.b ? frame.toModel(model.points[p]) : third;
      }
      const Vec3 a = frame.toModel(model.points[edge.a]);
      const Vec3 direction = along.normalized();
      outward = (a - third - direction * direction.dot(a - third)).normalized();
    }
    return model.domainSides[boundaryEdge] == SurfaceModel::noSide && !model.isPermeable(boundaryEdge);
  }

  bool hasEdge(Index triangle, const FeatureEdge& edge) const
  {
    const auto& t = model.triangles[triangle];
    return std::find(t.begin(), t.end(), edge.a) != t.end() && std::find(t.begin(), t.end(), edge.b) != t.end();
  }

  void gatherAbout(const Vec3& middle, double reach)
  {
    const LatticeBox box{frame.toLattice(middle - Vec3::Constant(reach)),
                         frame.toLattice(middle + Vec3::Constant(reach))};
    triangles = tree.touching(box);
    std::erase_if(triangles, [&](Index t) { return t == boundaryEdge || model.isPermeable(t); });
  }

  /// From the boundary edge to the nearest thing in the direction in which its triangle would go on.
  std::optional<Vec3> acrossFrom(const Vec3& middle, double size)
  {
    gatherAbout(middle, size);
    Vec3 best = outward * size;
    bool found = false;
    const auto offer = [&](const Vec3& across) {
      const double distance = across.norm();
      if (across.dot(outward) >= leastCosine * distance && distance < best.norm())
      {
        best = across;
        found = true;
      }
    };
    for (const Index triangle : triangles)
    {
      const Vec3 a = frame.toModel(model.corner(triangle, 0));
      const Vec3 b = frame.toModel(model.corner(triangle, 1));
      const Vec3 c = frame.toModel(model.corner(triangle, 2));
      const Vec3 inBounds = middle.cwiseMax(a.cwiseMin(b).cwiseMin(c)).cwiseMin(a.cwiseMax(b).cwiseMax(c));
      if ((inBounds - middle).norm() > best.norm())
      {
        continue;
      }
      const Vec3 across = nearestOnTriangle(middle, a, b, c) - middle;
      if (across.norm() <= leastRatio * size)
      {
        return std::nullopt; // something is there already
      }
      offer(across);
      const NearestPair ahead = nearestOfSegmentAndTriangle(middle, middle + size * outward, a, b, c);
      offer(ahead.second - middle);
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      const int axis = axisOf(direction);
      Vec3 across = Vec3::Zero();
      across[axis] = frame.planeOf(direction) - middle[axis];
      offer(across);
    }
    return found && best.norm() > leastRatio * size ? std::optional(best) : std::nullopt;
  }

  /// Whether an uncut octree edge passes between the boundary edge and what is across.
  bool isOpen(const Vec3& begin, const Vec3& along, const Vec3& across, double size)
  {
    const Vec3 far = begin + along + across;
    const Vec3 low = begin.cwiseMin(begin + along).cwiseMin(begin + across).cwiseMin(far);
    const Vec3 high = begin.cwiseMax(begin + along).cwiseMax(begin + across).cwiseMax(far);
    // Edges with an end that was moved lie off their leaves, by up to an octant.
    const Vec3 margin = Vec3::Constant(grid.displacedCount() == 0 ? 0.0 : size);
    const LatticeBox box{frame.toLattice(low - margin), frame.toLattice(high + margin)};
    // As the predicates have it, grid points are shifted by little, so that none lies on the gap's border.
    const Vec3 shift = Vec3(1e-5, 1e-7, 1e-9) * frame.finestSize;
    for (const Index leaf : leavesTouching(octree, box))
    {
      for (unsigned corner = 0; corner < 8; ++corner)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          if (!isUncut(leaf, corner, axis))
          {
            continue;
          }
          const Index point = points.atCorner[leaf][corner];
          const int direction = directionOf(corner, axis);
          const EdgeSegment edge = grid.segment(point, direction, grid.edge(point, direction));
          if (passes(frame.toModel(edge.start) + shift, frame.toModel(edge.end) + shift, begin, along, across))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  static int directionOf(unsigned corner, int axis) { return 2 * axis + ((corner >> axis & 1) != 0 ? 0 : 1); }

  /// Whether the leaf's edge from a corner along an axis joins grid points, or one to an end of the domain. An edge
  /// divided by finer leaves counts with those.
  bool isUncut(Index leaf, unsigned corner, int axis) const
  {
    const Index point = points.atCorner[leaf][corner];
    if (point == noIndex)
    {
      return false;
    }
    const int direction = directionOf(corner, axis);
    const std::int32_t code = crossings.neighbors[point][direction];
    if (DualMesh::isBoundary(code))
    {
      return crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].onDomainSide;
    }
    return code >= 0 && static_cast<Index>(code) == points.atCorner[leaf][corner ^ (1u << axis)];
  }

  const Zones& zones;
  const std::vector<char>& kept;
  const Crossings& crossings;
  const GridPlaces& grid;
  const Octree& octree;
  const GridFrame& frame;
  const GridPoints& points;
  const SurfaceModel& model;
  const TriangleTree& tree;
  Index boundaryEdge = noIndex;
  Vec3 outward = Vec3::Zero();
  std::vector<Index> triangles;
};

} // namespace

std::vector<Crack> findCracks(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                              const GridPlaces& grid, const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  std::vector<Index> boundaryEdges;
  for (Index e = 0; e < model.featureEdges.size(); ++e)
  {
    if (model.kindOf(model.featureEdges[e]) == CurveKind::boundary)
    {
      boundaryEdges.push_back(e);
    }
  }
  if (boundaryEdges.empty())
  {
    return {};
  }
  const TriangleTree& tree = context.tree.get();
  std::vector<std::vector<CrackStep>> found(boundaryEdges.size());
  context.executor.forRanges(boundaryEdges.size(), 16, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    BoundaryEdgeProbe probe(zones, kept, crossings, grid, model, tree);
    for (std::size_t i = begin; i < end; ++i)
    {
      found[i] = probe.walk(boundaryEdges[i]);
    }
  });
  std::vector<CrackStep> steps;
  for (const auto& part : found)
  {
    steps.insert(steps.end(), part.begin(), part.end());
  }
  return joinSteps(steps, model);
}

} // namespace atria
