// SPDX-License-Identifier: GPL-3.0-or-later
/// VRML's solids as triangles. Points of the round ones lie on the surface; `segments` counts them around the axis.
#pragma once

#include "SurfaceBuilder.h"

namespace atria::vrml {

/// Fineness of the facets of round solids.
struct Tessellation
{
  double angle = 10.0; ///< largest angle between neighboring points, degrees
  double error = 0.0;  ///< largest distance between facets and the true surface; 0 for any
  /// Distance between facets and the true surface that is negligible. Small solids get no more points than it requires,
  /// though at least `fewestSegments`, unless `error` is stricter.
  double negligible = 0.0;
};

/// Returns the distance between the middle of an arc of so many degrees and its chord.
double sagittaOf(double degrees, double radius);

/// Returns the number of points around a full turn so that none is further than `degrees` from the next; at least
/// three.
int segmentsOf(double degrees);

/// Returns the same for a circle of a radius, so that no chord is further from its arc than the error allows: the
/// sagitta, radius (1 - cos(pi / n)). At most `mostSegments`.
int segmentsOf(const Tessellation& wanted, double radius);

/// Returns the same for a sphere. The middles of its facets, on chords of chords, are at radius cos(pi / n)^2 at least.
int segmentsOfSphere(const Tessellation& wanted, double radius);

inline constexpr int mostSegments = 3600;
inline constexpr int fewestSegments = 6;

LocalSurface makeBox(const Vec3& size);
LocalSurface makeSphere(double radius, int segments);

struct Cylinder
{
  double radius = 1.0;
  double height = 2.0;
  bool side = true;
  bool bottom = true;
  bool top = true;
};
LocalSurface makeCylinder(const Cylinder& cylinder, int segments);

struct Cone
{
  double bottomRadius = 1.0;
  double height = 2.0;
  bool side = true;
  bool bottom = true;
};
LocalSurface makeCone(const Cone& cone, int segments);

} // namespace atria::vrml
