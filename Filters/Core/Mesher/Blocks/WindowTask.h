// SPDX-License-Identifier: GPL-3.0-or-later
/// One part of the improver on one window: all that it takes and gives.
#pragma once

#include "Mesher/Blocks/MeshWindow.h"
#include "Mesher/Improvement/LayerImprover.h"

namespace atria {

/// The two parts of the improver, and another one for what has taken these.
enum class ImproverPart
{
  whole, ///< LayerImprover::improveWhole
  finish,
  mend ///< as finish, but layers begin as they are
};

/// What is the same for all windows of a mesh.
struct WindowSettings
{
  LayerOptions options;
  CurvedWallTargets curvedWalls;
  MeshTraits traits;
};

/// Lists are by point of the window, or by vertex where that is said.
struct WindowTask
{
  ImproverPart part;
  MeshWindow window;
  /// As in LayerWalls. Points at the cut are settled and fixed.
  std::vector<Index> counts;
  SettledPoints settled;
  /// Where vertices may be moved now; the window's classification has what the model wants. By vertex.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::unordered_map<Index, DisplacementLimit> displacementLimits;
  /// As in ImproverState.
  std::vector<char> suspect;
  /// Those that may move, in rising order.
  std::vector<DetachedVertex> detached;
  /// Points whose places are sought.
  std::vector<char> isOwn;
};

/// What became of points, that of each in turn; numbers are those of the whole mesh.
struct PointChanges
{
  std::vector<Index> points;
  std::vector<Vec3> places;
  /// How many points are above each, and these from the wall up.
  std::vector<Index> counts;
  std::vector<Vec3> above;
  /// Of the vertex that each is.
  std::vector<VertexClass> classes;
  std::vector<SideBits> turnedSides;
  std::vector<char> suspect;
  /// Of some.
  std::vector<std::pair<Index, DisplacementLimit>> displacementLimits;
  std::vector<DetachedVertex> detached;
};

/// Adds what became of others.
void append(const PointChanges& more, PointChanges& changes);

/// An element of a mesh with layers that is not as it should be, by what it stands on.
struct PoorElement
{
  /// The element of the plain mesh, or the boundary face of the plain mesh whose stack it is in.
  Index place;
  /// Its place in the stack, 0 and up; noIndex for elements of the plain mesh.
  Index height;
  bool fails; ///< else it is valid, with a large angle

  bool isPlain() const { return height == noIndex; }
  bool operator==(const PoorElement&) const = default;
};

struct WindowResult
{
  PointChanges changes;
  /// After the last parts: of elements with own points, all others of which are fixed.
  std::vector<PoorElement> poor;
};

/// Throws as improvers do.
WindowResult improveWindow(WindowTask task, const WindowSettings& settings, const MeshingContext& context);

} // namespace atria
