// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds where layers can grow, by the topology of the mesh.
#pragma once

#include "Layer/BoundaryGraph.h"
#include "Layer/LayerRules.h"
#include "Layer/SettledPoints.h"

#include <algorithm>

namespace atria {

/// Layers that nobody requested, but without which elements are not valid.
enum class SupportingLayer : std::uint8_t
{
  none,
  whereNeeded, ///< at elements which cannot be valid without, and around them
  everywhere
};

struct LayerOptions
{
  /// One entry per tag; see resolveLayerRules and fitted().
  std::vector<WallLayers> ofTag;
  /// True if no wall with a first height can pass the determinant check, as its layers are as thin as requested.
  bool failsDeterminants = false;
  /// Normals of the domain's sides by number, unit vectors; along the axes unless the domain is turned.
  std::vector<Vec3> sideNormals{-Vec3::UnitX(), Vec3::UnitX(),  -Vec3::UnitY(),
                                Vec3::UnitY(),  -Vec3::UnitZ(), Vec3::UnitZ()};
  /// Thickness of a layer without a height of its own, relative to the size of the elements beside the wall
  /// (findWallSizes).
  double relativeThickness = 0.3;
  /// The same for more than one layer; they would otherwise be very thin.
  double dividedThickness = 0.6;
  /// Unit to which reported areas of faces are rounded, a power of two in square model units, so that sums do not
  /// depend on their order; 0 does not round.
  double areaUnit = 0.0;
  /// True if points are doubled also where a prism then lies flat, so that layers end nowhere and all prisms are
  /// hexahedra.
  bool wraps = false;
  /// One entry per tag; empty if none has such a layer.
  std::vector<SupportingLayer> supporting;

  SupportingLayer supportOf(Index tag) const { return supporting.empty() ? SupportingLayer::none : supporting[tag]; }
  bool isSupporting(Index tag) const { return supportOf(tag) != SupportingLayer::none; }
  /// True if layers are requested on a tag.
  bool isAsked(Index tag) const { return ofTag[tag].layers > 0 && !isSupporting(tag); }
  /// True if a layer is requested anywhere.
  bool isAsked() const
  {
    return std::ranges::any_of(ofTag, [&](const WallLayers& wall) { return isAsked(Index(&wall - ofTag.data())); });
  }
  Index surfaceCount() const { return static_cast<Index>(ofTag.size()) - sideNumbers; }
  /// True if several layers are requested anywhere.
  bool isDivided() const
  {
    return std::ranges::any_of(ofTag, [](const WallLayers& wall) { return wall.layers > 1; });
  }
  /// True if layers with a first height are requested anywhere.
  bool hasHeights() const { return std::ranges::any_of(ofTag, &WallLayers::hasHeight); }
};

enum class FaceRole : std::uint8_t
{
  wall,  ///< layers grow on it
  slide, ///< a side of the domain: layers of walls that meet it end on it
  fixed, ///< a surface without layers: layers beside it taper to nothing
  tube   ///< a face within the mesh: of a tube that layers go round (EdgeTubes.h)
};

/// The boundary of a mesh that has one sector at each of its points (splitSheets).
struct LayerWalls
{
  BoundaryGraph graph;
  std::vector<FaceRole> roles;
  /// One entry per point: the largest number of layers that its walls request; 0 if no layer is possible. So layers run
  /// up to walls that have fewer, and taper on these.
  std::vector<Index> counts;
  SettledPoints settled;
};

/// Finds the points that can have layers:
/// - the faces around the point are one closed fan and the walls in it one run, so that every wall edge has one face
///   across,
/// - no face beside one of its walls has the same points as that wall,
/// - the point is on no surface without layers.
LayerWalls findLayerWalls(const DualMesh& mesh, const LayerOptions& options, const RunContext& context);

/// Returns the layers requested at each point: those of the wall that requests most. If several walls request that
/// many, the smallest given first height and the smallest growth hold.
std::vector<WallLayers> layersAskedAt(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options);

/// Returns the area vector of a boundary face, into the fluid.
Vec3 wallNormal(const DualMesh& mesh, const BoundaryFace& face);

/// Returns the unit normal of the plane that a face of role `slide` lies in.
Vec3 sideNormal(const BoundaryFace& face, const LayerOptions& options);

} // namespace atria
