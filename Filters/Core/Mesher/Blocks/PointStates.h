// SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of the points of a mesh between the parts of the improver.
#pragma once

#include "Mesher/Blocks/WindowTask.h"

#include <map>

namespace atria {

/// By point of the plain mesh.
struct PointStates
{
  /// Where they are, and what stands above them.
  std::vector<Vec3> points;
  SettledPoints layers;
  /// As in VertexClassification, by vertex.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::unordered_map<Index, DisplacementLimit> displacementLimits;
  /// As in ImproverState.
  std::vector<char> suspect;
  /// Where points are wanted that are not there.
  std::map<Index, Vec3> detached;
};

/// Before the first part.
PointStates statesOf(std::vector<Vec3> points, const VertexClassification& classification);

/// Fills in what is known of the points of a task's window. Those marked as done in the whole mesh, and those at the
/// cut, are fixed.
void giveStates(const PointStates& states, const std::vector<char>& done, Index cutTag, WindowTask& task);

/// The states of some points as they are.
PointChanges copyStates(const PointStates& states, const std::vector<Index>& points,
                        const std::vector<Index>& vertexOf);
void apply(const PointChanges& changes, PointStates& states);

} // namespace atria
