// SPDX-License-Identifier: GPL-3.0-or-later
/// Turns sizes and names, as users give them, into levels.
#pragma once

#include "Octree/Sizing/Sizing.h"

#include <string_view>

namespace atria {

/// Marks the surfaces for which a rule with this pattern requests a size. Throws Error if there are none.
std::vector<char> sizedSurfaces(const std::string& pattern, const std::vector<std::string>& names);

/// Convert rules from and to text, with the pattern in double quotes if it holds blanks. Throw Error that quotes it.
SurfaceSize surfaceSizeFrom(const std::string& text);                 ///< PATTERN SIZE [FEATURESIZE]
std::vector<DistanceSize> distanceSizesFrom(const std::string& text); ///< PATTERN DISTANCE SIZE [DISTANCE SIZE ...]
std::string textOf(const SurfaceSize& rule);
std::string textOf(const DistanceSize& rule);

/// Returns the level of the largest octants that are not above `size`; the finest level if all are.
int levelNotAbove(double size, const GridFrame& frame);

/// Returns the width of the narrowest side of a prism; infinite for a box. A side that is narrower than the diagonal of
/// an octant's face may lie between elements and have no face.
double narrowestSide(const PlacedPrism& domain);

/// Levels down to which pieces of the model refine the octants that hold them.
struct ModelLevels
{
  std::vector<int> ofSurface;        ///< one per surface, for octants it passes through
  std::vector<int> featureOfSurface; ///< one per surface, for octants where it comes close to others
  std::vector<int> ofFeatureEdge;
  std::vector<int> ofCorner;

  int of(ModelItem piece, const SurfaceModel& model) const
  {
    switch (piece.kind)
    {
      case ModelItem::triangle:
        return ofSurface[model.surfaceIds[piece.index]];
      case ModelItem::featureEdge:
        return ofFeatureEdge[piece.index];
      default:
        return ofCorner[piece.index];
    }
  }
};

/// Returns the levels by the rules; curves and corners get the finest of their surfaces. O(n log n). May throw Error.
ModelLevels modelLevels(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options);

/// Marks the surfaces that sizing rules name. Throws Error for bad rules.
std::vector<char> surfacesOfRules(const std::vector<std::string>& names, const SizingOptions& options);

/// Returns the places for which rules request octants finer than at features elsewhere: boxes, and bounds of named
/// surfaces, as far as distances reach. Throws Error for bad rules.
std::vector<FinerPlace> finerPlaces(const TriangleSurface& surface, const GridFrame& frame,
                                    const SizingOptions& options);

} // namespace atria
