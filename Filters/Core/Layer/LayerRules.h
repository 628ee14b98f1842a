// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules by which users request layers on walls.
#pragma once

#include "Grid/Prism.h"

#include <limits>
#include <string>
#include <vector>

namespace atria {

/// Layers requested on the faces of one tag.
struct WallLayers
{
  /// In place of numbers that follow from the elements beside the wall; see fitted() in LayerHeights.h.
  static constexpr int asManyAsFit = std::numeric_limits<int>::max();
  static constexpr double fittingGrowth = std::numeric_limits<double>::infinity();

  /// Layers of elements, 0 to 100; 0 for none.
  int layers = 0;
  /// Height of the first one in model units, not negative; 0 leaves it to the size of the elements beside the wall.
  double firstHeight = 0.0;
  /// Ratio of each layer's height to that of the one below it, 0.5 to 5.
  double growth = 1.2;

  bool hasHeight() const { return layers > 0 && firstHeight > 0.0; }
  bool operator==(const WallLayers&) const = default;
};

/// Layers on the surfaces whose names match a pattern (`*` any text, `?` any character). A bare side of the domain is a
/// wall only if a rule has exactly its name.
struct LayerRule
{
  std::string pattern;
  WallLayers layers;
};

/// Reads a rule from text, `PATTERN LAYERS [FIRSTHEIGHT [GROWTH]]`; the pattern is in double quotes if it holds blanks,
/// LAYERS or GROWTH may be `auto` (asManyAsFit, fittingGrowth). Missing values are taken from `otherwise`. Throws Error
/// that quotes the text.
LayerRule layerRuleFrom(const std::string& text, const WallLayers& otherwise);

/// Returns the name of a tag: of a surface, or of a side of the domain, whose numbers follow those of the surfaces.
std::string tagName(Index tag, const std::vector<std::string>& surfaceNames);

/// Returns the layers of each tag: the surfaces, then the sides of the domain. The last rule that matches holds;
/// without one there are no layers. Throws Error for numbers out of range, and for a pattern other than `*` that
/// matches nothing.
std::vector<WallLayers> resolveLayerRules(const std::vector<LayerRule>& rules,
                                          const std::vector<std::string>& surfaceNames);

} // namespace atria
