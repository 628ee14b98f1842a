// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the plane of a wall by the model's parts in it and across it.
#pragma once

#include "Surface/Openings/WallPlanes.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <span>

namespace atria {

/// Data for the sections of a model, shared by all planes.
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
  /// Charts that go back from there.
  std::vector<Index> reveals;
};

/// A plane, divided by the parts of the model that lie in it or pass through it.
struct PlaneSection
{
  PlanarTriangulation parted;
  /// Lattice points of the first points of `parted`, if the model has points there.
  std::vector<LatticePoint> corners;
  /// One flag per region: nonzero if a wall of the plane covers it.
  std::vector<char> covered;
  std::vector<WallEnd> ends;
};

/// Returns the section at a plane. It has no triangulation if the walls have no ends, and so no openings. `lines`
/// between points of the model close openings as walls would.
PlaneSection sectionAt(const WallPlane& plane, std::span<const EdgeKey> lines, const SectionSource& source);

} // namespace atria
