// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerCreases.h"

#include "Layer/CreaseSheets.h"
#include "Mesher/Improvement/LayerCells.h"
#include "Optimize/Constraints/CreaseSheetConstraints.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <array>

namespace atria {

namespace {

/// The scaled Jacobian that crease sheets are to have. At a corner of three surfaces at right angles 0.41 is the most
/// there is.
constexpr QualityRange wantedJacobian{0.3, 0.31};
/// And the cosine of non-orthogonality: 60 degrees.
constexpr QualityRange wantedFaceCosine{0.5, 0.51};
/// What is aimed at first.
constexpr double goodJacobian = 0.45;
constexpr int mostSoundRounds = 6;
/// Of crease sheets, tried in turn until one comes to what is wanted.
constexpr std::array widths{0.35, 0.25, 0.45, 0.3, 0.4};

/// Ranges to hold cells to. Limits rise, as cells far from the last ones find no way there. In the last stages they go
/// down again: what is just above one may not fall below it, and holds others back.
struct RowStage
{
  QualityRange jacobian;
  QualityRange faceCosine;
  bool last;
};
constexpr std::array stages{RowStage{{0.1, 0.45}, {0.3, 0.5}, false},    RowStage{{0.2, 0.4}, {0.4, 0.54}, false},
                            RowStage{{0.25, 0.35}, {0.46, 0.54}, false}, RowStage{{0.28, 0.35}, {0.48, 0.54}, false},
                            RowStage{{0.29, 0.33}, {0.49, 0.53}, true},  RowStage{{0.28, 0.33}, {0.47, 0.53}, true},
                            RowStage{{0.29, 0.32}, {0.49, 0.52}, true},  RowStage{{0.27, 0.33}, {0.47, 0.53}, true},
                            RowStage{{0.29, 0.32}, {0.49, 0.52}, true},  RowStage{{0.28, 0.33}, {0.47, 0.53}, true},
                            RowStage{{0.29, 0.32}, {0.49, 0.52}, true},  RowStage{{0.27, 0.33}, {0.47, 0.53}, true},
                            RowStage{{0.29, 0.32}, {0.49, 0.52}, true}};

/// Of all hexahedra.
double leastScaledJacobian(const DualMesh& mesh, const RunContext& context)
{
  const DualSource source(mesh);
  const Pieces pieces(mesh.elementCount());
  std::vector<double> least(pieces.count, std::numeric_limits<double>::infinity());
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    for (std::size_t e = pieces.begin(piece); e < pieces.end(piece); ++e)
    {
      const NativeCell native = source.nativeOf(static_cast<Index>(e));
      std::array<Vec3, 8> corners;
      std::ranges::transform(native.corners, corners.begin(), [&](Index p) { return mesh.points[p]; });
      least[piece] = native.type == 0 ? least[piece] : std::min(least[piece], scaledJacobian(native.type, corners));
    }
  });
  return std::ranges::min(least);
}

/// Improves the cells of crease sheets and those about them.
class CreaseSheetImprover
{
public:
  CreaseSheetImprover(DualMesh& m, const CreaseSheets& creaseSheets, VertexConstraints& g, const QualityTargets& sound,
                      const RunContext& c)
      : mesh(m), source(m), constraints(g), valid(sound), marked(m.points.size(), 0), context(c)
  {
    std::fill(marked.begin() + creaseSheets.firstPoint, marked.end(), 1);
  }

  /// Returns whether all cells are valid then.
  bool run()
  {
    if (!makeSound())
    {
      return false;
    }
    const QualityTargets wanted = targetsFor(wantedJacobian, wantedFaceCosine);
    for (const RowStage& stage : stages)
    {
      if (stage.last && badOf(find(wanted)).empty())
      {
        break;
      }
      improve(stage);
    }
    return badOf(find(valid)).empty();
  }

private:
  std::vector<ShortCell> find(const QualityTargets& targets) const
  {
    context.progress.check();
    return findShortCells(source, marked, targets, context);
  }

  QualityTargets targetsFor(const QualityRange& jacobian, const QualityRange& faceCosine) const
  {
    QualityTargets out = valid;
    out.jacobianLimit = jacobian.limit;
    out.scaledJacobian = jacobian.target;
    out.leastOfJacobian = -std::numeric_limits<double>::infinity();
    out.faceCosine = faceCosine;
    return out;
  }

  void optimizeCells(const std::vector<ShortCell>& cells, const OptimizerOptions& options)
  {
    optimize(source, mesh.points, cells, constraints, options, context);
  }

  /// Crease sheets begin flat. What does not come right at once gets more room.
  bool makeSound()
  {
    for (int round = 0; round < mostSoundRounds; ++round)
    {
      OptimizerOptions options;
      options.targets = targetsFor({0.0, goodJacobian}, valid.faceCosine);
      options.rings = round < 2 ? 2 : 3;
      options.tryMiddle = round > 1;
      options.patient = true;
      options.firstReach = round % 2 == 0 ? 0.3 : 0.1;
      const std::vector<ShortCell> cells = find(options.targets);
      optimizeCells(round == 0 ? cells : badOf(cells), options);
      if (badOf(find(valid)).empty())
      {
        return true;
      }
    }
    return false;
  }

  void improve(const RowStage& stage)
  {
    OptimizerOptions options;
    options.targets = targetsFor(stage.jacobian, stage.faceCosine);
    options.targets.leastOfJacobian = options.targets.leastOfFaceCosine = options.leastWorst = leastOfOthers;
    options.rings = stage.last ? 3 : 2;
    options.sweeps = stage.last ? 60 : 20;
    options.leastGain = stage.last ? 0.001 : 0.01;
    options.patient = true;
    options.firstReach = 0.3;
    optimizeCells(find(options.targets), options);
  }

  DualMesh& mesh;
  DualSource source;
  VertexConstraints& constraints;
  QualityTargets valid;
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
  double bestWorst = leastScaledJacobian(before.mesh, state.context);
  for (const double width : widths)
  {
    state.layer = before;
    LayerFreedom plain(state); // of the layer without crease sheets
    state.layer.creaseSheets = insertCreaseSheets(state.layer, state.plain, state.walls, charts, width);
    CreaseSheetConstraints constraints(plain.layer, state.layer, state.context.octree.frame(), state.context.model,
                                       state.context.tree.get());
    state.context.executor.forEach(state.layer.creaseSheets.points.size(), 256, [&](std::size_t i) {
      const auto p = state.layer.creaseSheets.firstPoint + static_cast<Index>(i);
      Vec3& place = state.layer.mesh.points[p];
      place = constraints.isMovable(p) ? constraints.place(p, place) : place;
    });
    const bool isValid = CreaseSheetImprover(state.layer.mesh, state.layer.creaseSheets, constraints,
                                             baseTargets(state.traits), state.context)
                             .run();
    const double worst = leastScaledJacobian(state.layer.mesh, state.context);
    if (isValid && worst >= bestWorst)
    {
      best = std::move(state.layer);
      bestWorst = worst;
      if (worst >= wantedJacobian.limit)
      {
        break;
      }
    }
  }
  state.layer = std::move(best);
}

} // namespace atria
