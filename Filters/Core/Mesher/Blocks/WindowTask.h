// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs one part of the improver on one window; defines all that it takes and returns.
#pragma once

#include "Mesher/Blocks/MeshWindow.h"
#include "Mesher/Improvement/LayerImprover.h"

namespace atria {

/// The two parts of the improver, and a third for windows whose points have taken both.
enum class ImproverPart
{
  whole, ///< LayerImprover::improveWhole
  finish,
  mend ///< as finish, but layers start as they are
};

/// Settings that are the same for all windows of a mesh.
struct WindowSettings
{
  LayerOptions options;
  CurvedWallTargets curvedWalls;
  MeshTraits traits;
};

/// Input of one part. Lists have one entry per point of the window, or per vertex if that is stated.
struct WindowTask
{
  ImproverPart part;
  MeshWindow window;
  /// As in LayerWalls. Points at the cut are settled and fixed.
  std::vector<Index> counts;
  SettledPoints settled;
  /// One entry per vertex: how it may move now. The window's classification has what the model wants.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::unordered_map<Index, DisplacementLimit> displacementLimits;
  /// As in ImproverState.
  std::vector<char> suspect;
  /// Vertices that are detached and may move, in rising order.
  std::vector<DetachedVertex> detached;
  /// 1 for points that this task improves. Changes of all others are dropped.
  std::vector<char> isOwn;
};

/// New states of some points, one entry per point unless stated. Numbers are those of the whole mesh.
struct PointChanges
{
  std::vector<Index> points;
  std::vector<Vec3> places;
  /// Number of layer points above each point, and positions of all these, from the wall up.
  std::vector<Index> counts;
  std::vector<Vec3> above;
  /// States of the vertex that each point stands for.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::vector<char> suspect;
  /// Only for points that have such a limit, or are detached.
  std::vector<std::pair<Index, DisplacementLimit>> displacementLimits;
  std::vector<DetachedVertex> detached;
};

/// Appends the changes of other points.
void append(const PointChanges& more, PointChanges& changes);

/// An element of a mesh with layers that fails or has a large angle, given by what it stands on.
struct PoorElement
{
  /// The element of the plain mesh, or the boundary face of the plain mesh whose stack it is in.
  Index place;
  /// Its place in the stack, 0 and up; noIndex for elements of the plain mesh.
  Index height;
  bool fails; ///< false if it is valid, but has a large angle

  bool isPlain() const { return height == noIndex; }
  bool operator==(const PoorElement&) const = default;
};

struct WindowResult
{
  PointChanges changes;
  /// Poor elements with own points whose other points are fixed; empty after the first part.
  std::vector<PoorElement> poor;
};

/// Runs one part on a window. Returns an empty result if the window has no elements. Throws as LayerImprover does.
WindowResult improveWindow(WindowTask task, const WindowSettings& settings, const MeshingContext& context);

} // namespace atria
