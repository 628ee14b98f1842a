// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/ConformingLayer.h"

#include "Layer/ElementShape.h"
#include "Layer/LayerHeights.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

namespace atria {

namespace {

/// An element is crowded if its shape's cosine is below this, and was not without the layer. Less height does not help
/// elements that were flat or inverted without it: copies that lift them farther off the wall open them.
constexpr double crowdedCosine = 0.05;
/// Share of their height that a crowded element's copies keep in a round, and number of rounds.
constexpr double shrinkFactor = 0.7;
constexpr int shrinkRounds = 8;

constexpr std::array<std::array<std::uint8_t, 2>, 12> hexahedronEdge{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Removes the layer from points of faces on which it would lie flat. Repeats this while other faces lose their last
/// support.
void dropFlat(const DualMesh& mesh, const LayerWalls& walls, const LayerDirections& directions,
              std::vector<Index>& counts)
{
  const auto isFlat = [&](Index f) {
    const Vec3& normal = directions.normal(f);
    const double area = normal.norm();
    bool doubled = false;
    for (int i = 0; i < 4; ++i)
    {
      const Index p = cornerOf(mesh, mesh.boundaryFaces[f], i);
      doubled = doubled || counts[p] > 0;
      if (counts[p] > 0 && directions.at(p).direction.dot(normal) > feasibleCosine * area)
      {
        return false;
      }
    }
    return doubled;
  };
  for (bool changed = true; changed;)
  {
    changed = false;
    std::vector<Index> flat;
    for (Index f = 0; f < walls.roles.size(); ++f)
    {
      if (walls.roles[f] == FaceRole::wall && isFlat(f))
      {
        flat.push_back(f);
      }
    }
    for (const Index f : flat)
    {
      for (int i = 0; i < 4; ++i)
      {
        counts[cornerOf(mesh, mesh.boundaryFaces[f], i)] = 0;
        changed = true;
      }
    }
  }
}

/// True if the edge belongs to a boundary face that is not a sliding side of the domain.
bool liesOnWall(const DualMesh& mesh, const LayerWalls& walls, Index p, Index q)
{
  const auto star = walls.graph.facesAt(p);
  if (walls.graph.facesAt(q).empty())
  {
    return false;
  }
  return std::any_of(star.begin(), star.end(), [&](Index f) {
    bool found = false;
    for (int i = 0; i < 4; ++i)
    {
      const Index a = cornerOf(mesh, mesh.boundaryFaces[f], i);
      const Index b = cornerOf(mesh, mesh.boundaryFaces[f], i + 1);
      found = found || (a == p && b == q) || (a == q && b == p);
    }
    return found && walls.roles[f] != FaceRole::slide;
  });
}

/// Replaces a value if `isBetter(candidate, value)`; several threads may do so at once.
template <typename IsBetter> void replaceIf(double& value, double candidate, IsBetter&& isBetter)
{
  const std::atomic_ref<double> shared(value);
  double now = shared.load(std::memory_order_relaxed);
  while (isBetter(candidate, now) && !shared.compare_exchange_weak(now, candidate, std::memory_order_relaxed))
  {
  }
}

/// Returns the requested thickness at each point. Without a first height it is infinite at points that are not of
/// `elements`.
std::vector<double> thicknesses(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Index>& counts,
                                const std::vector<Index>& elements, const LayerOptions& options,
                                const RunContext& context)
{
  const std::vector<WallLayers> asked = layersAskedAt(mesh, walls, options);
  std::vector<double> out = findWallSizes(mesh, walls, counts, elements, context);
  std::ranges::transform(out, asked, out.begin(),
                         [&](double size, const WallLayers& layers) { return thicknessAsked(layers, size, options); });
  return out;
}

/// Moves the copies of some points off the wall and draws them back in where they cluster.
class Spacing
{
public:
  Spacing(const DualMesh& p, LayerMesh& l, const LayerDirections& d, const std::vector<double>& t,
          const std::vector<char>& o, const RunContext& c)
      : plain(p), layer(l), directions(d), open(o), heights(l.copies.size(), 0.0), context(c)
  {
    for (Index point = 0; point < heights.size(); ++point)
    {
      if (open[point])
      {
        // The thickness is meant across the wall.
        const double cosine = directions.at(point).cosine;
        heights[point] = cosine > 0.1 ? t[point] / std::max(cosine, 0.5) : t[point];
      }
    }
  }

  void run()
  {
    std::vector<Index> active = touched();
    place();
    for (int round = 0; round < shrinkRounds && !active.empty(); ++round)
    {
      context.progress.check();
      const std::vector<char> changed = shrink(active);
      place();
      const auto& corners = layer.mesh.corners;
      std::erase_if(active, [&](Index e) {
        return std::none_of(corners[e].begin(), corners[e].end(),
                            [&](Index p) { return changed[layer.wallPointOf(p)]; });
      });
    }
  }

private:
  bool isOpen(Index p) const { return layer.isNew(p) && open[layer.wallPointOf(p)]; }

  std::vector<Index> touched() const
  {
    const auto& corners = layer.mesh.corners;
    return chosenNumbers(corners.size(), context.executor, [&](std::size_t e) {
      return std::ranges::any_of(corners[e], [&](Index p) { return isOpen(p); });
    });
  }

  void place()
  {
    context.executor.forEach(layer.wallPoints.size(), 8192, [&](std::size_t i) {
      const Index p = layer.wallPoints[i];
      if (open[p])
      {
        layer.mesh.points[layer.plainPoints + i] = plain.points[p] + heights[p] * directions.at(p).direction;
      }
    });
  }

  bool isCrowded(Index e) const
  {
    return shapeOf(layer.mesh.points, layer.mesh.corners[e]).cosine < crowdedCosine &&
           (e >= layer.plainElements || shapeOf(plain.points, plain.corners[e]).cosine >= crowdedCosine);
  }

  /// Lowers the copies of crowded elements. Returns marks of the wall points whose copies were lowered.
  std::vector<char> shrink(const std::vector<Index>& active)
  {
    std::vector<char> crowded(active.size());
    context.executor.forEach(active.size(), 1024, [&](std::size_t i) { crowded[i] = isCrowded(active[i]); });
    std::vector<char> changed(heights.size(), 0);
    for (std::size_t i = 0; i < active.size(); ++i)
    {
      for (const Index p : layer.mesh.corners[active[i]])
      {
        if (crowded[i] && isOpen(p) && !changed[layer.wallPointOf(p)])
        {
          changed[layer.wallPointOf(p)] = 1;
          heights[layer.wallPointOf(p)] *= shrinkFactor;
        }
      }
    }
    return changed;
  }

  const DualMesh& plain;
  LayerMesh& layer;
  const LayerDirections& directions;
  const std::vector<char>& open;
  std::vector<double> heights;
  const RunContext& context;
};

/// Extends the marks to all points whose heights can depend on those marked: each round of drawing in reaches one
/// element further.
void widen(std::vector<char>& marked, const DualMesh& plain, const LayerMesh& layer, const Executor& executor)
{
  const std::vector<Index> touched = chosenNumbers(plain.elementCount(), executor, [&](std::size_t e) {
    return std::ranges::any_of(plain.corners[e], [&](Index p) { return layer.copies[p] != noIndex; });
  });
  for (int ring = 0; ring <= shrinkRounds; ++ring)
  {
    const std::vector<Index> about = chosenNumbers(
        touched.size(), executor, [&](std::size_t i) { return hasMarked(plain.corners[touched[i]], marked); });
    for (const Index i : about)
    {
      for (const Index p : plain.corners[touched[i]])
      {
        marked[p] = layer.copies[p] != noIndex ? 1 : 0;
      }
    }
  }
}

} // namespace

std::vector<Index> elementsAt(const DualMesh& mesh, const std::vector<char>& marked, const Executor& executor)
{
  return chosenNumbers(mesh.elementCount(), executor,
                       [&](std::size_t e) { return hasMarked(mesh.corners[e], marked); });
}

std::vector<double> findWallSizes(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Index>& counts,
                                  const std::vector<Index>& elements, const RunContext& context)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> off(mesh.points.size(), 0.0);
  std::vector<double> along(mesh.points.size(), none);
  context.executor.forEach(elements.size(), 4096, [&](std::size_t i) {
    const auto& corners = mesh.corners[elements[i]];
    for (const auto& [c, d] : hexahedronEdge)
    {
      const Index p = corners[c];
      const Index q = corners[d];
      if (p == q || (counts[p] == 0 && counts[q] == 0))
      {
        continue;
      }
      const double length = (mesh.points[q] - mesh.points[p]).norm();
      const bool onWall = liesOnWall(mesh, walls, p, q);
      const double share = counts[p] > 0 && counts[q] > 0 ? 0.5 : 1.0;
      for (const Index end : {p, q})
      {
        // Maximum and minimum do not depend on the order.
        onWall ? replaceIf(along[end], length, std::less()) : replaceIf(off[end], share * length, std::greater());
      }
    }
  });
  std::vector<double> sizes(mesh.points.size(), none);
  for (std::size_t p = 0; p < sizes.size(); ++p)
  {
    sizes[p] = counts[p] == 0 ? none : off[p] > 0.0 ? off[p] : along[p];
  }
  return sizes;
}

/// Returns one entry per point: 1 if it has a layer.
std::vector<Index> LayerGrower::countsOf(const DualMesh& plain, const std::vector<char>& excluded,
                                         const RunContext& context)
{
  std::vector<Index> counts(walls_.counts.size());
  for (std::size_t p = 0; p < counts.size(); ++p)
  {
    counts[p] = walls_.counts[p] > 0 && (excluded.empty() || !excluded[p]) ? 1 : 0;
  }
  directions_.update(plain, counts, context);
  if (options_.wraps)
  {
    return counts;
  }
  for (Index p = 0; p < counts.size(); ++p)
  {
    counts[p] = counts[p] > 0 && directions_.at(p).cosine < feasibleCosine ? 0 : counts[p];
  }
  dropFlat(plain, walls_, directions_, counts);
  return counts;
}

LayerMesh LayerGrower::grow(const DualMesh& plain, const std::vector<char>& excluded, const RunContext& context)
{
  LayerMesh none;
  none.copies.assign(plain.points.size(), noIndex);
  return growAgain(plain, excluded, none, {}, context);
}

LayerMesh LayerGrower::growAgain(const DualMesh& plain, const std::vector<char>& excluded, const LayerMesh& before,
                                 const std::vector<char>& fresh, const RunContext& context)
{
  const bool isFirst = fresh.empty();
  const auto isSettled = [&](Index p) { return isFirst ? walls_.settled.has(p) : walls_.settled.stays(p); };
  std::vector<Index> counts = countsOf(plain, excluded, context);
  for (Index p = 0; p < counts.size(); ++p)
  {
    counts[p] = isSettled(p) ? std::min<Index>(walls_.settled.counts[p], 1) : counts[p];
  }
  LayerMesh layer = buildLayer(plain, walls_, counts, context.executor);
  const auto stays = [&](Index p) {
    return layer.copies[p] != noIndex && !isSettled(p) && before.copies[p] != noIndex && !fresh[p];
  };
  std::vector<char> open(counts.size(), 0);
  for (Index p = 0; p < open.size(); ++p)
  {
    open[p] = layer.copies[p] != noIndex && !stays(p) && !isSettled(p) ? 1 : 0;
  }
  if (std::ranges::find(open, 1) != open.end())
  {
    widen(open, plain, layer, context.executor);
    const std::vector<Index> elements = elementsAt(plain, open, context.executor);
    Spacing(plain, layer, directions_, thicknesses(plain, walls_, counts, elements, options_, context), open, context)
        .run();
  }
  for (Index p = 0; p < open.size(); ++p)
  {
    if (stays(p))
    {
      layer.mesh.points[layer.copies[p]] = before.mesh.points[before.copies[p]];
    }
    else if (layer.copies[p] != noIndex && isSettled(p))
    {
      layer.mesh.points[layer.copies[p]] = walls_.settled.aboveOf(p).back();
    }
  }
  return layer;
}

} // namespace atria
