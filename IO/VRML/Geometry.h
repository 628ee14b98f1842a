// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Diagnostics.h"
#include "Instances.h"
#include "Primitives.h"
#include "SurfaceBuilder.h"

#include <optional>
#include <string>
#include <string_view>

namespace atria::vrml {

/// Turns geometry nodes into triangles.
class Geometry
{
public:
  /// `tessellation`: of round primitives, its error in the units of the scene.
  Geometry(Instances& access, Diagnostics& messages, const Tessellation& tessellation);

  /// How much longer than in its own coordinates a length of what is made next can get in the scene.
  void setStretch(double factor) { stretch = factor; }
  /// What the surface made next goes by in messages, where its node has no name.
  void setName(std::string_view shown) { name = shown; }
  /// Whether a node is a round solid, whose facets depend on the stretch and on the size of the model.
  static bool isRound(const NodeRef& node);
  /// Facets of solids with smaller radii, in the scene's units, are to be off by no less than those of one with this.
  void setSmall(double radius) { wanted.negligible = sagittaOf(wanted.angle, radius); }
  /// The round solid with as few facets as there can be.
  LocalSurface makeCoarse(const NodeRef& node);

  /// The triangles of a node of kind `surface`; none, with a warning, where its fields make no sense.
  LocalSurface make(const NodeRef& node);
  /// A surface nobody needs any longer, whose memory the next may have.
  void recycle(LocalSurface&& surface) { memory.surface = std::move(surface); }

  /// What holds for geometry nodes of VRML 1.0 where they stand.
  struct State
  {
    const Numbers* points = nullptr;
    bool clockwise = false;
  };
  /// The same for VRML 1.0.
  LocalSurface make(const NodeRef& node, const State& state);

  /// What faces of one node after the other are made in.
  struct Memory
  {
    LocalSurface surface;
    std::vector<Index> newIds;
    std::vector<Index> ids;
  };

private:
  LocalSurface box(const NodeRef& node);
  LocalSurface sphere(const NodeRef& node);
  LocalSurface cylinder(const NodeRef& node);
  LocalSurface cone(const NodeRef& node);
  LocalSurface elevationGrid(const NodeRef& node);
  LocalSurface extrusion(const NodeRef& node);
  LocalSurface faceSet(const NodeRef& node);
  LocalSurface faces(const NodeRef& node, const Numbers& points, const Integers& index, bool turned);
  LocalSurface cube(const NodeRef& node);
  /// By a flag of VRML97, or among the `parts` of VRML 1.0.
  bool hasPart(const NodeRef& node, std::string_view flag, std::string_view part) const;
  void warn(const NodeRef& node, const std::string& text);
  bool positive(const NodeRef& node, std::initializer_list<double> sizes);
  LocalSurface boxOf(const NodeRef& node, const Vec3& size);

  Instances& instances;
  Diagnostics& diagnostics;
  Tessellation unstretched() const { return {wanted.angle, wanted.error / stretch, wanted.negligible / stretch}; }
  int segments(double radius) const { return segmentsOf(unstretched(), radius); }
  int segmentsOfBall(double radius) const { return segmentsOfSphere(unstretched(), radius); }

  Tessellation wanted;
  double stretch = 1.0;
  std::string name;
  Memory memory;
};

} // namespace atria::vrml
