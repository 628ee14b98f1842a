// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/AnyMesh/MeshOptimizer.h"

#include "Optimize/AnyMesh/BoundaryConstraints.h"

namespace atria {

MeshOptimizerOptions::MeshOptimizerOptions()
{
  optimizer.rings = 1;
  optimizer.sweeps = 50;
  optimizer.patient = true;
  optimizer.tellProgress = true;
  optimizer.keepWorst = true;
  optimizer.tryMiddle = true;
  optimizer.targets.scaledJacobian = 0.3;
}

MeshOptimizerReport optimizeMesh(FaceMesh& mesh, const CellArrays& cells, std::span<const Index> patches,
                                 const MeshOptimizerOptions& options, const RunContext& context)
{
  MeshOptimizerReport report;
  context.progress.report(0.0, "Finding edges");
  const CellFaces cellFaces = makeCellFaces(mesh, context.executor);
  BoundaryFeatures features =
      findBoundaryFeatures(mesh, cellFaces, patches, options.featureAngle, context.part(0.0, 0.2));
  for (const Index point : options.keptPoints)
  {
    features.kinds[features.leaders[point]] = BoundaryKind::corner;
  }
  BoundaryConstraints constraints(mesh, features, options.fixedBoundary);
  const FaceMeshSource source(mesh, cellFaces, cells);
  const QualityTargets& targets = options.optimizer.targets;
  context.progress.report(0.2, "Judging cells");
  std::vector<char> marked(mesh.points.size(), 1);
  const std::vector<ShortCell> shortCells = findShortCells(source, marked, targets, context);
  report.shortBefore = shortCells.size();
  context.progress.report(0.4, "Moving points");
  std::vector<Vec3> before = mesh.points;
  optimize(source, mesh.points, shortCells, constraints, options.optimizer, context.part(0.4, 0.9));
  for (std::size_t p = 0; p < before.size(); ++p)
  {
    marked[p] = before[p] != mesh.points[p] ? 1 : 0;
    report.movedPoints += marked[p] ? 1 : 0;
  }
  CellSource::Scratch scratch;
  for (const ShortCell& cell : shortCells)
  {
    source.facesOf(cell.cell, scratch);
    for (const Index p : scratch.points)
    {
      marked[p] = 1;
    }
  }
  context.progress.report(0.9, "Judging cells");
  std::vector<ShortCell> left = findShortCells(source, marked, targets, context);
  if (left.size() > shortCells.size())
  {
    // More cells fall short than before, so the gain of others is not worth it.
    mesh.points = std::move(before);
    left = shortCells;
    report.movedPoints = 0;
  }
  report.shortAfter = left.size();
  report.shares.assign(mesh.cellCount, 1.0F);
  for (const ShortCell& cell : left)
  {
    report.shares[cell.cell] = cell.worst;
  }
  context.progress.report(1.0, "Mesh improved");
  return report;
}

} // namespace atria
