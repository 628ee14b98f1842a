// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Openings/WallPlanes.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <span>

namespace atria {

/// What the section of a model is made of, for all planes.
struct SectionSource
{
  SectionSource(const SurfaceModel& model, const GridFrame& frame, bool sidesAreWalls, double distance,
                const RunContext& context);

  const SurfaceModel& model;
  const GridFrame& frame;
  bool sidesAreWalls;
  double distance;
  BoxTree triangles;
  std::vector<SoupEdgeUse> uses;
  /// Per triangle and edge, the uses of the edge.
  std::vector<std::array<std::span<const SoupEdgeUse>, 3>> usesOf;
};

/// An edge of a plane's walls at which they end.
struct WallEnd
{
  Vec2 from;
  Vec2 to;
  Index triangle;
  /// The charts that go back from there.
  std::vector<Index> reveals;
};

/// A plane, parted by what of the model is in it and passes through it.
struct PlaneSection
{
  PlanarTriangulation parted;
  /// Lattice points of the first points of `parted`, as far as the model has them there.
  std::vector<LatticePoint> corners;
  /// Per region: whether a wall of the plane covers it.
  std::vector<char> covered;
  std::vector<WallEnd> ends;
};

/// Without a triangulation where the walls have no ends, and so no openings. `lines` between points of the model close
/// openings as walls would.
PlaneSection sectionAt(const WallPlane& plane, std::span<const EdgeKey> lines, const SectionSource& source);

} // namespace atria
