// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/UnreachedParts.h"

#include "Octree/Sizing/Refinement.h"
#include "Support/UnionFind.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Search/Distance.h"
#include "Surface/Triangles/EachEdge.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

namespace {

bool isHidden(const TriangleViews& views)
{
  return std::ranges::all_of(views, [](View view) { return view == View::solid || view == View::ground; });
}

/// Gives views to sides that no edge of the grid sees, such as the insides of beams thinner than an octant. Closed
/// bodies decide, or else rays.
class UnseenSides
{
public:
  UnseenSides(const MeshingContext& c, const SolidPlaces& s, std::vector<TriangleViews>& v)
      : model(c.model), octree(c.octree), tree(c.tree.get()), executor(c.executor), solids(s), views(v),
        pieceOf(piecesBetweenEdges(model, count, executor)), largest(count, noIndex), sets(2 * std::size_t{count}),
        facts(2 * std::size_t{count})
  {
  }

  /// Gives sides the view of the space that rays find before them: that of any other side of it, or the inside of a
  /// solid if all of its walls are in one. Spaces that rays leave, or with air in them, stay unseen.
  void run()
  {
    findLargest();
    std::vector<Index> unseen = findUnseen();
    std::vector<char> isSolid(unseen.size(), 0);
    executor.forEach(unseen.size(), 16, [&](std::size_t i) { isSolid[i] = isInSolid(unseen[i]) ? 1 : 0; });
    std::vector<char> isSolidSide(facts.size(), 0);
    for (std::size_t i = 0; i < unseen.size(); ++i)
    {
      isSolidSide[unseen[i]] = isSolid[i];
    }
    giveViews([&](Index side) { return isSolidSide[side] ? View::solid : View::nothing; });
    unseen = findUnseen();
    std::vector<std::vector<Index>> seen(unseen.size());
    executor.forEach(unseen.size(), 16, [&](std::size_t i) { seen[i] = sidesBefore(unseen[i]); });
    for (std::size_t i = 0; i < unseen.size(); ++i)
    {
      for (const Index side : seen[i])
      {
        sets.join(unseen[i], side == noIndex || viewOf(side) != View::nothing ? unseen[i] : side);
      }
    }
    for (std::size_t i = 0; i < unseen.size(); ++i)
    {
      gather(unseen[i], seen[i]);
    }
    giveViews([&](Index side) { return facts[sets.find(side)].view(); });
  }

private:
  /// Facts about a space.
  struct Space
  {
    bool isOpen = false;  ///< air may be in it
    bool isWithin = true; ///< all of its walls are in solids
    View seen = View::nothing;

    View view() const
    {
      return isOpen ? View::nothing : seen != View::nothing ? seen : isWithin ? View::solid : View::nothing;
    }
  };

  View viewOf(Index side) const { return views[largest[side / 2]][side % 2]; }

  /// Gives views to sides that have none.
  template <typename ViewOf> void giveViews(ViewOf&& viewBefore)
  {
    for (Index t = 0; t < views.size(); ++t)
    {
      for (Index side = 0; side < 2; ++side)
      {
        if (views[t][side] == View::nothing)
        {
          views[t][side] = viewBefore(2 * pieceOf[t] + side);
        }
      }
    }
  }

  std::vector<Index> findUnseen() const
  {
    std::vector<Index> unseen;
    for (Index side = 0; side < facts.size(); ++side)
    {
      if (viewOf(side) == View::nothing)
      {
        unseen.push_back(side);
      }
    }
    return unseen;
  }

  Vec3 middleOf(Index triangle) const
  {
    return (toVector(model.corner(triangle, 0)) + toVector(model.corner(triangle, 1)) +
            toVector(model.corner(triangle, 2))) /
           3.0;
  }

  Vec3 aheadOf(Index side) const { return (side % 2 == 0 ? 1.0 : -1.0) * model.normal(largest[side / 2]).normalized(); }

  /// True if a place before the middle of a piece's largest triangle, at most halfway to the next one, is in a solid.
  bool isInSolid(Index side) const
  {
    constexpr double before = 0.05; // octants
    const Vec3 origin = middleOf(largest[side / 2]);
    const Vec3 ahead = aheadOf(side);
    const GridFrame& frame = octree.frame();
    const double octant = static_cast<double>(frame.latticeSize(frame.featureLevel));
    const TriangleTree::Hit hit = tree.firstHit(origin, ahead, latticeRounding, 2.0 * before * octant);
    const double distance = hit.triangle == noIndex ? before * octant : 0.5 * hit.distance;
    return solids.contains(frame.toModel(Vec3(origin + distance * ahead)));
  }

  void findLargest()
  {
    std::vector<double> areas(largest.size(), -1.0);
    for (Index t = 0; t < pieceOf.size(); ++t)
    {
      const double area = model.normal(t).squaredNorm();
      if (area > areas[pieceOf[t]])
      {
        areas[pieceOf[t]] = area;
        largest[pieceOf[t]] = t;
      }
    }
  }

  /// Returns the sides that rays from the middle of a piece's largest triangle meet first; noIndex for a ray that meets
  /// no wall within reach, or something else first.
  std::vector<Index> sidesBefore(Index side) const
  {
    const Index from = largest[side / 2];
    const Vec3 corner = toVector(model.corner(from, 0));
    const Vec3 origin = middleOf(from);
    if (isInCluster(origin))
    {
      return {noIndex};
    }
    const Vec3 ahead = aheadOf(side);
    const Vec3 across = (toVector(model.corner(from, 1)) - corner).normalized();
    const Vec3 along = ahead.cross(across);
    std::vector<Index> out{sideMet(origin, ahead)};
    constexpr int around = 7; // an odd number, so that no two rays go along one line of a plan
    for (const double lean : {1.0, 4.0})
    {
      for (int i = 0; i < around; ++i)
      {
        const double angle = 2.0 * std::numbers::pi * i / around;
        const Vec3 direction = ahead + lean * (std::cos(angle) * across + std::sin(angle) * along);
        out.push_back(sideMet(origin, direction.normalized()));
      }
    }
    return out;
  }

  /// True if p is in a cluster, which is not resolved in any case.
  bool isInCluster(const Vec3& p) const
  {
    const LatticePoint at{std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
    return octree.frame().inDomain(at) && octree.featureType(octree.leafAt(at)) == FeatureType::cluster;
  }

  Index sideMet(const Vec3& origin, const Vec3& direction) const
  {
    const TriangleTree::Hit hit =
        tree.firstHit(origin, direction, latticeRounding,
                      reach * static_cast<double>(octree.frame().latticeSize(octree.frame().featureLevel)));
    if (hit.triangle == noIndex || model.isPermeable(hit.triangle) || model.isTurnedSide(hit.triangle))
    {
      return noIndex;
    }
    const Index side = model.normal(hit.triangle).dot(direction) < 0.0 ? 0 : 1;
    return 2 * pieceOf[hit.triangle] + side;
  }

  void gather(Index side, const std::vector<Index>& seen)
  {
    Space& space = facts[sets.find(side)];
    const View behind = viewOf(side ^ 1u);
    space.isWithin = space.isWithin && (behind == View::solid || behind == View::ground);
    for (const Index other : seen)
    {
      const View view = other == noIndex ? View::air : viewOf(other);
      space.isOpen = space.isOpen || view == View::air;
      space.seen = std::max(space.seen, view);
    }
  }

  /// Length of rays in octants at features. A space without a point of the grid is narrower.
  static constexpr double reach = 4.0;

  const SurfaceModel& model;
  const Octree& octree;
  const TriangleTree& tree;
  const Executor& executor;
  const SolidPlaces& solids;
  std::vector<TriangleViews>& views;
  Index count = 0;
  std::vector<Index> pieceOf;
  std::vector<Index> largest; ///< triangle of each piece
  UnionFind sets;             ///< sets of sides, two for each piece
  std::vector<Space> facts;   ///< indexed by the first side of a space
};

/// Unmarks pieces whose removal would leave one triangle at an edge that has several.
void keepEdgesClosed(const SurfaceModel& model, std::vector<char>& isUnreached, const Executor& executor)
{
  Index count = 0;
  const std::vector<Index> pieceOf = piecesBetweenEdges(model, count, executor);
  std::vector<char> isLeft(count, 0);
  for (Index t = 0; t < isUnreached.size(); ++t)
  {
    isLeft[pieceOf[t]] |= isUnreached[t];
  }
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(model.triangles, model.points.size(), executor);
  for (bool changed = true; changed;)
  {
    changed = false;
    eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
      const auto left =
          std::ranges::count_if(edge, [&](const auto& use) { return isLeft[pieceOf[use.triangle]] != 0; });
      if (left > 0 && left + 1 == static_cast<std::ptrdiff_t>(edge.size()))
      {
        std::ranges::for_each(edge, [&](const auto& use) { isLeft[pieceOf[use.triangle]] = 0; });
        changed = true;
      }
    });
  }
  std::ranges::transform(pieceOf, isUnreached.begin(), [&](Index piece) { return isLeft[piece]; });
}

SurfaceModel withoutParts(const SurfaceModel& model, const std::vector<char>& isUnreached, const GridFrame& frame,
                          const Executor& executor)
{
  SurfaceModel out;
  out.names = model.names;
  out.kinds = model.kinds;
  out.walls = model.walls;
  out.repair = model.repair;
  out.featureAngle = model.featureAngle;
  std::vector<Index> numbers(model.points.size(), noIndex);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (!isUnreached[t])
    {
      std::ranges::for_each(model.triangles[t], [&](Index p) { numbers[p] = 0; });
    }
  }
  for (Index p = 0; p < numbers.size(); ++p)
  {
    if (numbers[p] != noIndex)
    {
      numbers[p] = static_cast<Index>(out.points.size());
      out.points.push_back(model.points[p]);
    }
  }
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (!isUnreached[t])
    {
      const auto [a, b, c] = model.triangles[t];
      out.triangles.push_back({numbers[a], numbers[b], numbers[c]});
      out.surfaceIds.push_back(model.surfaceIds[t]);
      out.domainSides.push_back(model.domainSides[t]);
    }
  }
  findFeatures(out, frame, executor);
  return out;
}

} // namespace

UnreachedParts findUnreachedParts(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                  const std::vector<View>& ofZone, const SolidPlaces& solids, const GridPart& part,
                                  const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  UnreachedParts out;
  if (std::ranges::none_of(ofZone, [](View view) { return view == View::solid || view == View::ground; }))
  {
    return out;
  }
  out.views = findModelViews(crossings, grid, zones, ofZone, model, part, context);
  UnseenSides(context, solids, out.views).run();
  out.isUnreached.resize(model.triangles.size());
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const bool canBe = model.domainSides[t] == SurfaceModel::noSide && !model.isPermeable(t) && !model.isTurnedSide(t);
    out.isUnreached[t] = canBe && isHidden(out.views[t]) ? 1 : 0;
  }
  const auto any = [&] { return std::ranges::find(out.isUnreached, 1) != out.isUnreached.end(); };
  if (any())
  {
    keepEdgesClosed(model, out.isUnreached, context.executor);
  }
  return any() ? out : UnreachedParts{};
}

ReachedModel::ReachedModel(const UnreachedParts& parts, const MeshingContext& context)
    : model_(withoutParts(context.model, parts.isUnreached, context.octree.frame(), context.executor)),
      octree_(context.octree.frame(), context.octree.refinedSets(), context.executor), tree_(model_)
{
  locateModel(octree_, model_, context);
}

} // namespace atria
