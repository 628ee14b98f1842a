// SPDX-License-Identifier: GPL-3.0-or-later
#include "Words.h"

#include <array>
#include <regex>
#include <utility>

namespace atria::tool {

namespace {

/// Longer ones that begin alike come first.
constexpr std::array optionOf{
    std::pair{"DomainMode Automatic", "--automatic"},
    std::pair{"DomainMode Site", "--site"},
    std::pair{"DomainMode FromSurfaces", "--model-bounds"},
    std::pair{"DomainMode Explicit", "--domain"},
    std::pair{"FromSurfaces", "--model-bounds"},
    std::pair{"DomainBounds", "--domain"},
    std::pair{"DomainAngle", "--domain-angle"},
    std::pair{"DomainSides", "--domain-sides"},
    std::pair{"DomainPolygon", "--domain-polygon"},
    std::pair{"WindAngle", "--wind"},
    std::pair{"SiteName", "--ground"},
    std::pair{"TerrainName", "--terrain"},
    std::pair{"AlignGrid", "--align"},
    std::pair{"SizeMax", "--size-max"},
    std::pair{"SizeMid", "--size-mid"},
    std::pair{"SizeMin", "--size-min"},
    std::pair{"StartLevel", "--start-level"},
    std::pair{"FeatureAngle", "--feature-angle"},
    std::pair{"CurvatureAngle", "--curvature-angle"},
    std::pair{"CellsAcrossGap", "--gap-cells"},
    std::pair{"CellsPerLevel", "--cells-per-level"},
    std::pair{"MaxElements", "--max-elements"},
    std::pair{"MemoryLimit", "--memory-limit"},
    std::pair{"GapTolerance", "--gap"},
    std::pair{"SmallPartSize", "--small-parts"},
    std::pair{"CrackTolerance", "--crack"},
    std::pair{"NumberOfLayers", "--layers"},
    std::pair{"LayerRules", "--layers"},
    std::pair{"FirstLayerHeight", "--first-layer"},
    std::pair{"LayerGrowth", "--layer-growth"},
    std::pair{"LengthUnit", "--unit"},
    std::pair{"UpAxis", "--up"},
    std::pair{"SurfaceBy", "--surfaces-by"},
    std::pair{"Recenter", "--recenter"},
    std::pair{"check Scale", "check --scale"},
    std::pair{"set Scale", "give --scale"},
    std::pair{"MetricName", "--metric"},
    std::pair{"\\(Explicit, ", "("},
};

} // namespace

std::string inOptions(const std::string& message)
{
  std::string text = message;
  for (const auto& [property, option] : optionOf)
  {
    const std::string word(property);
    std::string pattern = word[0] == '\\' ? "" : "\\b";
    pattern += word;
    pattern += word.back() == ' ' ? "" : "\\b";
    text = std::regex_replace(text, std::regex(pattern), option);
  }
  // Where the message names the option itself, it is there twice now.
  static const std::regex again(R"((--[a-z-]+)((, |; | or | and )\1)+(?![a-z-]))");
  static const std::regex inBrackets(R"((--[a-z-]+) \(\1\))");
  text = std::regex_replace(text, again, "$1");
  return std::regex_replace(text, inBrackets, "$1");
}

} // namespace atria::tool
