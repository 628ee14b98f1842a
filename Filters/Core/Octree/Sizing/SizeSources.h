// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds octants to refine, from several sources. Each walks down from the root by itself.
#pragma once

#include "Octree/Sizing/OctantSink.h"
#include "Octree/Sizing/SizeRules.h"
#include "Octree/Tree/GeometryLists.h"

namespace atria {

/// Gap between two surfaces that face each other: a box that is moved along a line, in lattice units.
struct GapLine
{
  Vec3 from;
  Vec3 to;
  /// Half the lengths of the box around a triangle's part in an octant.
  Vec3 half;
  /// Level at which enough octants fit across.
  int level;
};

/// Adds all octants down to the top level. Below it, adds octants with pieces of the model, for sizes at surfaces and
/// features, for curvature and for gaps. Returns the gaps, sorted by the octants in which they were found.
std::vector<GapLine> sizeForModel(OctantSink& sets, const SurfaceModel& model, const ModelLevels& levels,
                                  const SizingOptions& options, const RunContext& context);

/// Adds octants that share volume with refinement boxes.
void sizeForBoxes(OctantSink& sets, const SurfaceModel& model, const SizingOptions& options, const RunContext& context);

/// Adds octants near surfaces.
void sizeForDistances(OctantSink& sets, const SurfaceModel& model, const SizingOptions& options,
                      const RunContext& context);

/// Adds octants along gap lines.
void sizeForGaps(OctantSink& sets, const std::vector<GapLine>& lines, const RunContext& context);

} // namespace atria
