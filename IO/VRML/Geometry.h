// SPDX-License-Identifier: GPL-3.0-or-later
/// Turns VRML's geometry nodes into triangles.
#pragma once

#include "Diagnostics.h"
#include "Instances.h"
#include "Primitives.h"
#include "SurfaceBuilder.h"

#include <optional>
#include <string>
#include <string_view>

namespace atria::vrml {

using scene::Diagnostics;

/// Makes the triangles of geometry nodes, and warns of invalid fields.
class Geometry
{
public:
  /// `tessellation` is for round primitives; its error is in the units of the scene.
  Geometry(Instances& access, Diagnostics& messages, const Tessellation& tessellation);

  /// Sets the factor by which lengths of the next surface can grow from its own coordinates to the scene.
  void setStretch(double factor) { stretch = factor; }
  /// Sets the name for the next surface in messages, used if its node has none.
  void setName(std::string_view shown) { name = shown; }
  /// True if a node is a round solid, whose facets depend on the stretch and on the size of the model.
  static bool isRound(const NodeRef& node);
  /// Sets a radius in the scene's units. Smaller solids get facets that are as far off as those of a solid with this
  /// radius.
  void setSmall(double radius) { wanted.negligible = sagittaOf(wanted.angle, radius); }
  /// Returns the round solid with as few facets as it may get.
  LocalSurface makeCoarse(const NodeRef& node);

  /// Returns the triangles of a node of kind `surface`; none, with a warning, if its fields make no sense.
  LocalSurface make(const NodeRef& node);
  /// Gives back a surface that is no longer needed; the next one may use its memory.
  void recycle(LocalSurface&& surface) { memory.surface = std::move(surface); }

  /// State of VRML 1.0 for a geometry node.
  struct State
  {
    const Numbers* points = nullptr;
    bool clockwise = false;
  };
  /// Returns the same for VRML 1.0.
  LocalSurface make(const NodeRef& node, const State& state);

  /// Buffers for faces, used by one node after the other.
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
  /// True if a flag of VRML97 is set, or if the `parts` of VRML 1.0 include the part.
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
