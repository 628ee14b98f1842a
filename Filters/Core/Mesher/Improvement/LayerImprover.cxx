// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerImprover.h"

#include "Mesher/Improvement/LayerCells.h"
#include "Mesher/Improvement/PathConstraints.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <functional>

namespace atria {

namespace {

/// Of the targets, what elements keep when points are put back where the model wants them.
constexpr double leastPutBack = 0.3;
/// The least cosine of non-orthogonality they keep, 65 degrees: solvers need corrections beyond it.
constexpr double leastFaceCosine = 0.4226;
/// Cells with less than this share of the way to a target are improved.
constexpr float clearlyShort = 0.5F;
/// What hexahedra of a uniform mesh should have.
constexpr double goodJacobian = 0.6;

} // namespace

enum class LayerImprover::Step : std::uint8_t
{
  leaveCurves,
  leaveALittle,
  leaveSurfaces,
  goHalfway,
  startAgain,
  exclude
};

LayerImprover::LayerImprover(const MeshingContext& context, const VertexClassification& classification,
                             const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                             const LayerOptions& options, const CurvedWallTargets& curvedWalls)
    : context_(context), whole_(context.progress), wanted_(classification), classification_(classification),
      vertexOf_(vertexOf), plain_(plain), walls_(walls), options_(options), curvedWalls_(curvedWalls),
      layered_(std::ranges::any_of(options.ofTag, [](const WallLayers& wall) { return wall.layers > 0; })),
      hasHeights_(options.hasHeights()), divided_(options.isDivided()),
      uniform_(std::ranges::adjacent_find(plain.levels, std::not_equal_to()) == plain.levels.end()),
      mayLeave_(vertexOf.size(), 1), letGo_(vertexOf.size(), 0), excluded_(vertexOf.size(), 0),
      suspect_(vertexOf.size(), 0), isLeft_(vertexOf.size(), 0)
{
  if (!context.octree.frame().turnedDomain)
  {
    return;
  }
  // Octants know the planes of an upright domain's sides, not of a turned one's.
  for (const BoundaryFace& face : plain.boundaryFaces)
  {
    for (int i = 0; i < 4 && face.tag >= options.surfaceCount(); ++i)
    {
      mayLeave_[vertexOf_[cornerOf(plain, face, i)]] = 0;
    }
  }
}

QualityTargets LayerImprover::targets() const
{
  QualityTargets targets;
  targets.convex = layered_;
  if (layered_ && uniform_)
  {
    targets.scaledJacobian = goodJacobian;
    targets.leastOfJacobian = leastPutBack;
  }
  if (!layered_ || hasHeights_)
  {
    targets.leastOfDeterminant = std::numeric_limits<double>::infinity();
  }
  if (hasHeights_)
  {
    // Users who ask for a height have the jump in size that comes with it.
    targets.weight.limit = 0.0;
    targets.volumeRatio.limit = 0.0;
  }
  return targets;
}

/// Begins a phase, a part of the whole.
void LayerImprover::enter(double begin, double end, const char* phase)
{
  context_.progress = whole_.part(begin, end);
  context_.progress.report(0.0, phase);
}

LayerMesh LayerImprover::run()
{
  const bool isSingle = layered_ && !hasHeights_ && !divided_;
  enter(0.0, 0.1, "Growing layers");
  grow();
  enter(0.1, 0.3, "Improving elements at walls");
  const std::vector<ShortCell> shortCells = improve(isSingle ? thicken() : findAll());
  enter(0.3, 0.4, "Mending elements");
  mend(shortCells);
  if (!left_.empty())
  {
    enter(0.4, 0.5, "Putting vertices back");
    putBack();
    mend(findAll());
    keepThoseAway();
  }
  if (divided_)
  {
    enter(0.5, 0.6, "Dividing layers");
    layer_ = divide(layer_);
    if (!hasHeights_)
    {
      enter(0.6, 1.0, "Straightening layers");
      straightenDivided();
    }
    return std::move(layer_);
  }
  if (isSingle)
  {
    enter(0.5, 0.7, "Improving elements at curved walls");
    improveAtCurved();
  }
  enter(0.7, 0.9, "Straightening elements");
  straighten();
  if (isSingle && uniform_)
  {
    enter(0.9, 1.0, "Adding crease sheets");
    addCreaseSheets();
  }
  return std::move(layer_);
}

void LayerImprover::grow()
{
  context_.progress.check();
  layer_ = layered_ ? growLayer(plain_, walls_, options_, excluded_, context_) : withoutLayer(std::move(plain_));
  context_.progress.check();
}

/// At the boundary, and where cells fell short before.
std::vector<ShortCell> LayerImprover::findAll()
{
  std::vector<char> marked = pointsToEvaluate(layer_, context_.executor);
  for (Index p = 0; p < layer_.plainPoints; ++p)
  {
    marked[p] |= suspect_[p];
  }
  const DualSource source(layer_.mesh);
  auto found =
      findShortCells(source, cellsWithMarked(source, marked, context_), std::array{strictest(), targets()}, context_);
  unsure_ = cellsOf(found[0]);
  return std::move(found[1]);
}

/// `about` gets the cells about points that moved, and their neighbors.
std::vector<ShortCell> LayerImprover::move(const std::vector<ShortCell>& cells, const OptimizerOptions& options,
                                           std::vector<Index>* about)
{
  Constraints constraints(*this);
  const DualSource source(layer_.mesh);
  std::vector<Index> changed;
  std::vector<ShortCell> left =
      optimize(source, layer_.mesh.points, cells, constraints.layer, options, context_, &changed);
  changed = withNeighbors(source, changed, context_);
  mergeUnique(unsure_, changed);
  if (about)
  {
    *about = std::move(changed);
  }
  return left;
}

/// Under layers those that are clearly short: the others are good enough, and there are many. In uniform meshes all are
/// to be good, and without layers determinants gain by it.
std::vector<ShortCell> LayerImprover::improve(std::vector<ShortCell> cells)
{
  std::erase_if(cells, [&](const ShortCell& cell) { return layered_ && !uniform_ && cell.worst >= clearlyShort; });
  OptimizerOptions options;
  options.targets = targets();
  options.leastPenalty = 0.01; // about a tenth short of a target: good enough where cells are far from their limits
  std::vector<ShortCell> left = move(cells, options);
  markPoints(layer_, left, suspect_);
  return left;
}

void LayerImprover::mend(const std::vector<ShortCell>& cells)
{
  constexpr std::array steps{Step::leaveCurves, Step::leaveALittle, Step::leaveSurfaces, Step::goHalfway,
                             Step::startAgain,  Step::exclude,      Step::leaveSurfaces, Step::goHalfway,
                             Step::startAgain,  Step::exclude,      Step::leaveSurfaces};
  std::vector<ShortCell> bad = badOf(cells);
  for (const Step step : steps)
  {
    if (bad.empty())
    {
      return;
    }
    context_.progress.check();
    if (prepare(step, bad))
    {
      bad = badOf(findAll());
    }
    bad = badOf(improve(bad));
  }
}

/// Calls visit(leader) for the points of cells, or those their copies stand on; more than once for some.
template <typename Visit> void LayerImprover::eachLeaderOf(const std::vector<ShortCell>& cells, Visit&& visit) const
{
  for (const ShortCell& cell : cells)
  {
    for (const Index p : layer_.mesh.corners[cell.cell])
    {
      visit(vertexOf_[layer_.wallPointOf(p)]);
    }
  }
}

/// Whether other cells may have become bad.
bool LayerImprover::prepare(Step step, const std::vector<ShortCell>& bad)
{
  if (step == Step::exclude)
  {
    exclude(bad);
    return true;
  }
  constexpr double aLittle = 0.2;
  constexpr double anOctant = 0.75;
  eachLeaderOf(bad, [&](Index leader) {
    letGo_[leader] = 1;
    step == Step::leaveCurves ? leaveCurve(leader)
                              : leaveSurface(leader, step == Step::leaveALittle ? aLittle : anOctant);
  });
  if (step == Step::goHalfway || step == Step::startAgain)
  {
    startAgain(bad, step == Step::startAgain ? 1.0 : 0.5);
    return true;
  }
  return false;
}

/// A vertex may leave more than once: those that did not get back stay where they are, but may have to go on.
void LayerImprover::noteLeft(Index leader)
{
  if (!isLeft_[leader])
  {
    isLeft_[leader] = 1;
    left_.push_back({leader, layer_.mesh.points[leader]});
  }
}

void LayerImprover::leaveCurve(Index leader)
{
  VertexClass& vertexClass = classification_.classes[leader];
  if (mayLeave_[leader] && vertexClass == VertexClass::curve)
  {
    noteLeft(leader);
    vertexClass = VertexClass::adjacent;
  }
}

/// By `reach` times the size of the vertex's octant.
void LayerImprover::leaveSurface(Index leader, double reach)
{
  VertexClass& vertexClass = classification_.classes[leader];
  if (!mayLeave_[leader] || vertexClass == VertexClass::free)
  {
    return;
  }
  noteLeft(leader);
  vertexClass = VertexClass::detached;
  const double size = context_.octree.frame().sizeOf(context_.octree.level(classification_.leaves[leader]));
  classification_.displacementLimits.try_emplace(leader, DisplacementLimit{layer_.mesh.points[leader], 0.0})
      .first->second.reach = reach * size;
}

/// Lets the points of cells leave their curves, and their surfaces by `reach`.
void LayerImprover::detach(const std::vector<ShortCell>& cells, double reach)
{
  eachLeaderOf(cells, [&](Index leader) {
    letGo_[leader] = 1;
    leaveCurve(leader);
    leaveSurface(leader, reach);
  });
}

/// Takes the points of cells towards the centers of their octants.
void LayerImprover::startAgain(const std::vector<ShortCell>& bad, double share)
{
  std::vector<char> fresh(layer_.plainPoints, 0);
  eachLeaderOf(bad, [&](Index leader) { fresh[leader] = mayLeave_[leader]; });
  const Constraints constraints(*this);
  for (Index p = 0; p < fresh.size(); ++p)
  {
    fresh[p] = fresh[vertexOf_[p]];
    if (fresh[p])
    {
      const Vec3 center = constraints.model.centerOf(p);
      layer_.mesh.points[p] += share * (center - layer_.mesh.points[p]);
      if (const auto found = classification_.displacementLimits.find(vertexOf_[p]);
          found != classification_.displacementLimits.end())
      {
        found->second.origin = center;
      }
    }
  }
  growAgain(fresh);
}

/// Leaves the layer out at the points of cells that have it; gives it back to those that are bad without it.
void LayerImprover::exclude(const std::vector<ShortCell>& bad)
{
  for (const ShortCell& cell : bad)
  {
    const auto& corners = layer_.mesh.corners[cell.cell];
    const bool has = std::ranges::any_of(corners, [&](Index p) { return layer_.isNew(p); });
    for (const Index p : corners)
    {
      if (!has || layer_.isNew(p))
      {
        excluded_[layer_.wallPointOf(p)] = has ? 1 : 0;
      }
    }
  }
  growAgain(std::vector<char>(layer_.plainPoints, 0));
}

/// Grows the layer from the walls as they are now; copies but those of `fresh` points stay where they are.
void LayerImprover::growAgain(const std::vector<char>& fresh)
{
  if (!layered_)
  {
    return;
  }
  const LayerMesh before = std::move(layer_);
  std::copy_n(before.mesh.points.begin(), before.plainPoints, plain_.points.begin());
  grow();
  takeCopies(before, fresh, layer_);
}

/// Where the points that left their pieces of the model ought to be, seen from where they are.
std::vector<WantedPlace> LayerImprover::wantedPlaces() const
{
  ModelConstraints constraints(context_, wanted_, layer_.mesh.points, vertexOf_);
  std::vector<Index> points;
  std::ranges::transform(left_, std::back_inserter(points), &WantedPlace::point);
  constraints.prepare(points, context_);
  std::vector<WantedPlace> places(left_.size());
  context_.executor.forEach(left_.size(), 64, [&](std::size_t i) {
    const Index p = left_[i].point;
    const bool was = wanted_.classes[vertexOf_[p]] == VertexClass::fixed;
    places[i] = {p, was ? left_[i].place : constraints.nearest(p, layer_.mesh.points[p])};
  });
  return places;
}

/// Takes points back to where the model wants them, as far as elements stay valid; their neighbors make room.
void LayerImprover::putBack()
{
  constexpr int passes = 6;
  std::ranges::sort(left_, {}, &WantedPlace::point); // as approach() asks
  QualityTargets wanted = targets();
  QualityRange& cosine = wanted.faceCosine;
  cosine.limit = (leastFaceCosine - leastPutBack * cosine.target) / (1.0 - leastPutBack);
  for (int pass = 0; pass < passes && !left_.empty(); ++pass)
  {
    context_.progress.check();
    const std::vector<ShortCell> cells = approach(DualSource(layer_.mesh), layer_.mesh.points, wantedPlaces(),
                                                  Constraints(*this).layer, leastPutBack, wanted, context_);
    const std::size_t before = left_.size();
    keepThoseAway();
    if (before == left_.size() || pass + 1 == passes)
    {
      return;
    }
    improve(cells);
  }
}

/// Forgets the points that are back; the others stay where they are.
void LayerImprover::keepThoseAway()
{
  constexpr double nearlyThere = 1e-6;
  std::vector<WantedPlace> away;
  detached_.clear();
  std::ranges::sort(left_, {}, &WantedPlace::point);
  const std::vector<WantedPlace> wanted = wantedPlaces();
  for (std::size_t i = 0; i < left_.size(); ++i)
  {
    const Index p = left_[i].point;
    const Index vertex = vertexOf_[p];
    const double size = context_.octree.frame().sizeOf(context_.octree.level(wanted_.leaves[vertex]));
    const bool back = (layer_.mesh.points[p] - wanted[i].place).norm() <= nearlyThere * size;
    classification_.classes[vertex] = back ? wanted_.classes[vertex] : VertexClass::fixed;
    isLeft_[p] = back ? 0 : 1;
    if (!back)
    {
      away.push_back(left_[i]);
      detached_.push_back({p, wanted[i].place});
    }
  }
  left_ = std::move(away);
}

} // namespace atria
