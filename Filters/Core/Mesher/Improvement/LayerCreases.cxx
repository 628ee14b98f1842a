// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerCreases.h"

#include "Layer/CreaseSheets.h"
#include "Mesher/Improvement/LayerCells.h"
#include "Optimize/Constraints/CreaseSheetConstraints.h"
#include "Support/Pieces.h"

#include <algorithm>

namespace atria {

namespace {

/// How good the hexahedra of a mesh are.
struct Goodness
{
  double least = std::numeric_limits<double>::infinity(); ///< scaled Jacobian of the worst
  std::size_t poor = 0;                                   ///< hexahedra below the wanted scaled Jacobian
};

Goodness goodnessOf(const DualMesh& mesh, double wantedJacobian, const RunContext& context)
{
  const DualSource source(mesh);
  const Pieces pieces(mesh.elementCount());
  std::vector<Goodness> found(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    for (std::size_t e = pieces.begin(piece); e < pieces.end(piece); ++e)
    {
      const NativeCell native = source.nativeOf(static_cast<Index>(e));
      if (native.type == 0)
      {
        continue;
      }
      std::array<Vec3, 8> corners;
      std::ranges::transform(native.corners, corners.begin(), [&](Index p) { return mesh.points[p]; });
      const double jacobian = scaledJacobian(native.type, corners);
      found[piece].least = std::min(found[piece].least, jacobian);
      found[piece].poor += jacobian < wantedJacobian ? 1 : 0;
    }
  });
  Goodness whole;
  for (const Goodness& piece : found)
  {
    whole.least = std::min(whole.least, piece.least);
    whole.poor += piece.poor;
  }
  return whole;
}

/// Improves the cells of crease sheets and those around them.
class CreaseSheetImprover
{
public:
  CreaseSheetImprover(DualMesh& m, const CreaseSheets& creaseSheets, VertexConstraints& g, const MeshTraits& t,
                      const RunContext& c)
      : mesh(m), source(m), constraints(g), traits(t), marked(m.points.size(), 0), context(c)
  {
    std::fill(marked.begin() + creaseSheets.firstPoint, marked.end(), 1);
  }

  /// Runs all stages. Returns true if all cells are valid then.
  bool run()
  {
    const QualityTargets valid = baseTargets(traits);
    const QualityTargets wanted = wantedOfCreaseSheets(traits);
    const bool isSound = std::ranges::any_of(soundCreaseStages(traits), [&](const ImproverStage& stage) {
      run(stage);
      return !hasBad(valid);
    });
    const std::vector<ImproverStage> stages = isSound ? creaseStages(traits) : std::vector<ImproverStage>();
    for (std::size_t i = 0; i < stages.size() && (i < firstCreaseStages || hasBad(wanted)); ++i)
    {
      run(stages[i]);
    }
    return isSound && !hasBad(valid);
  }

private:
  std::vector<ShortCell> find(const QualityTargets& targets) const
  {
    context.progress.check();
    return findShortCells(source, marked, targets, context);
  }

  bool hasBad(const QualityTargets& targets) const { return !badOf(find(targets)).empty(); }

  void run(const ImproverStage& stage)
  {
    std::vector<ShortCell> cells = find(stage.options.targets);
    std::erase_if(cells, [&](const ShortCell& cell) { return cell.worst >= stage.below; });
    optimize(source, mesh.points, cells, constraints, stage.options, context);
  }

  DualMesh& mesh;
  DualSource source;
  VertexConstraints& constraints;
  const MeshTraits& traits;
  std::vector<char> marked;
  const RunContext& context;
};

} // namespace

void addCreaseSheets(ImproverState& state)
{
  const CreaseCharts charts = findCreaseCharts(state.layer, state.plain, state.walls);
  if (charts.isEmpty())
  {
    return;
  }
  const LayerMesh before = state.layer;
  LayerMesh best = state.layer;
  const double wantedJacobian = wantedOfCreaseSheets(state.traits).jacobianLimit;
  Goodness bestOf = goodnessOf(before.mesh, wantedJacobian, state.context);
  const bool hasTubes = std::ranges::find(state.walls.roles, FaceRole::tube) != state.walls.roles.end();
  for (const double width : creaseWidths)
  {
    state.layer = before;
    LayerFreedom plain(state); // before crease sheets are inserted
    state.layer.creaseSheets = insertCreaseSheets(state.layer, state.plain, state.walls, charts, width);
    CreaseSheetConstraints constraints(plain.layer, state.layer, state.context.octree.frame(), state.context.model,
                                       state.context.tree.get());
    state.context.executor.forEach(state.layer.creaseSheets.points.size(), 256, [&](std::size_t i) {
      const auto p = state.layer.creaseSheets.firstPoint + static_cast<Index>(i);
      Vec3& place = state.layer.mesh.points[p];
      place = constraints.isMovable(p) ? constraints.place(p, place) : place;
    });
    const bool isValid =
        CreaseSheetImprover(state.layer.mesh, state.layer.creaseSheets, constraints, state.traits, state.context).run();
    const Goodness its = goodnessOf(state.layer.mesh, wantedJacobian, state.context);
    // Cells at steps of boundary edges that layers go round miss the targets with any width, so the worst tells
    // nothing.
    const bool isBetter = state.traits.wraps ? its.poor < bestOf.poor : its.least >= bestOf.least;
    if (isValid && isBetter)
    {
      best = std::move(state.layer);
      bestOf = its;
    }
    // Around tubes another width hardly helps where one did not, and takes minutes.
    const bool isEnough = isValid && isBetter && (its.poor == 0 || state.traits.wraps);
    if (isEnough || hasTubes)
    {
      break;
    }
  }
  state.layer = std::move(best);
}

} // namespace atria
