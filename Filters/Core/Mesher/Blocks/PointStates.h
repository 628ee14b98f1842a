// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps the states of a mesh's points between the parts of the improver.
#pragma once

#include "Mesher/Blocks/WindowTask.h"

#include <map>

namespace atria {

/// States of points. Lists have one entry per point of the plain mesh, or per vertex if that is stated.
struct PointStates
{
  /// Positions, and the layers above them.
  std::vector<Vec3> points;
  SettledPoints layers;
  /// As in VertexClassification, one entry per vertex.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::unordered_map<Index, DisplacementLimit> displacementLimits;
  /// As in ImproverState.
  std::vector<char> suspect;
  /// Positions where the model wants vertices that are elsewhere.
  std::map<Index, Vec3> detached;
};

/// Returns the states before the first part.
PointStates statesOf(std::vector<Vec3> points, const VertexClassification& classification);

/// Copies the states of the points of a task's window to the task. Points at the cut are fixed, and so are points that
/// are `done` (one entry per point of the whole mesh).
void giveStates(const PointStates& states, const std::vector<char>& done, Index cutTag, WindowTask& task);

/// Returns the present states of some points.
PointChanges copyStates(const PointStates& states, const std::vector<Index>& points,
                        const std::vector<Index>& vertexOf);
void apply(const PointChanges& changes, PointStates& states);

} // namespace atria
