// SPDX-License-Identifier: GPL-3.0-or-later
/// Where layers can grow, as far as the mesh's topology has to say.
#pragma once

#include "Layer/BoundaryGraph.h"
#include "Layer/LayerRules.h"
#include "Layer/SettledPoints.h"

#include <algorithm>

namespace atria {

/// Layers that nobody asked for, without which elements are not valid.
enum class SupportingLayer : std::uint8_t
{
  none,
  whereNeeded, ///< on the whole of a surface that has an element which cannot be valid without
  everywhere
};

struct LayerOptions
{
  /// By tag: see resolveLayerRules.
  std::vector<WallLayers> ofTag;
  /// Normals of the domain's sides by number, unit vectors; along the axes unless the domain is turned.
  std::vector<Vec3> sideNormals{-Vec3::UnitX(), Vec3::UnitX(),  -Vec3::UnitY(),
                                Vec3::UnitY(),  -Vec3::UnitZ(), Vec3::UnitZ()};
  /// Thickness of a layer without a height of its own, relative to the size of the elements beside the wall
  /// (findWallSizes).
  double relativeThickness = 0.3;
  /// The same for more layers than one, which else would be very thin.
  double dividedThickness = 0.6;
  /// Areas told of surfaces are sums of multiples of this, a power of two, so that they are the same in any order; 0
  /// leaves them as they are. Square model units.
  double areaUnit = 0.0;
  /// By tag. Empty: none has such a layer.
  std::vector<SupportingLayer> supporting;

  SupportingLayer supportOf(Index tag) const { return supporting.empty() ? SupportingLayer::none : supporting[tag]; }
  bool isSupporting(Index tag) const { return supportOf(tag) != SupportingLayer::none; }
  /// Whether a layer was asked for somewhere.
  bool isAsked() const
  {
    return std::ranges::any_of(ofTag, [&](const WallLayers& wall) {
      return wall.layers > 0 && !isSupporting(static_cast<Index>(&wall - ofTag.data()));
    });
  }
  Index surfaceCount() const { return static_cast<Index>(ofTag.size()) - sideNumbers; }
  /// Whether several layers are asked for somewhere.
  bool isDivided() const
  {
    return std::ranges::any_of(ofTag, [](const WallLayers& wall) { return wall.layers > 1; });
  }
  /// Whether a height is asked for somewhere.
  bool hasHeights() const
  {
    return std::ranges::any_of(ofTag, [](const WallLayers& wall) { return wall.firstHeight > 0.0; });
  }
};

enum class FaceRole : std::uint8_t
{
  wall,  ///< layers grow on it
  slide, ///< a side of the domain: layers of walls that meet it end on it
  fixed  ///< a surface without layers: those beside it taper to nothing
};

/// The boundary of a mesh that has one sector at each of its points (splitSheets).
struct LayerWalls
{
  BoundaryGraph graph;
  std::vector<FaceRole> roles;
  /// Per point: the layers that its walls ask for, the least of them; 0 where no layer can be.
  std::vector<Index> counts;
  SettledPoints settled;
};

/// A point has layers if the faces about it are one closed fan and the walls in it one run, so that every edge of a
/// wall has one face across; if no other face has the very same points as one of its walls; and if it is on no surface
/// without layers.
LayerWalls findLayerWalls(const DualMesh& mesh, const LayerOptions& options, const RunContext& context);

/// Area vector of a boundary face, into the fluid.
Vec3 wallNormal(const DualMesh& mesh, const BoundaryFace& face);

/// The plane a face of role `slide` lies in.
Vec3 sideNormal(const BoundaryFace& face, const LayerOptions& options);

} // namespace atria
