// SPDX-License-Identifier: GPL-3.0-or-later
/// VRML's solids as triangles. Points of the round ones lie on the surface; `segments` counts them around the
/// axis.
#pragma once

#include "SurfaceBuilder.h"

namespace atria::vrml {

/// Points around a full turn so that none is further than `degrees` from the next; at least three.
int segmentsOf(double degrees);

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
