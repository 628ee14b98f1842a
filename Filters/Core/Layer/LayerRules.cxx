// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerRules.h"

#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/PatternRule.h"
#include "Support/Types.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

void checkRule(const LayerRule& rule)
{
  const int layers = rule.layers.layers;
  const double firstHeight = rule.layers.firstHeight;
  const double growth = rule.layers.growth;
  const bool anyNumber = layers == WallLayers::asManyAsFit;
  const bool anyGrowth = growth == WallLayers::fittingGrowth;
  const char* wrong = !anyNumber && (layers < 0 || layers > 100)             ? "the number of layers must be 0 to 100"
                      : !(firstHeight >= 0.0) || !std::isfinite(firstHeight) ? "the first height must not be negative"
                      : !anyGrowth && !(growth >= 0.5 && growth <= 5.0)      ? "the growth must be 0.5 to 5"
                      : anyNumber && anyGrowth ? "either the number or the growth may be 'auto', not both"
                      : (anyNumber || anyGrowth) && firstHeight == 0.0 ? "'auto' needs a first height"
                                                                       : nullptr;
  if (wrong)
  {
    throw Error("layers on '" + rule.pattern + "': " + wrong);
  }
}

} // namespace

LayerRule layerRuleFrom(const std::string& text, const WallLayers& otherwise)
{
  constexpr const char* form = "PATTERN LAYERS [FIRSTHEIGHT [GROWTH]]";
  const PatternRule parsed = patternRuleFrom(text, 1, 3, "layer", form, true);
  LayerRule rule{parsed.pattern, otherwise};
  const std::vector<double>& numbers = parsed.numbers;
  const bool anyNumber = std::isnan(numbers[0]);
  if (!anyNumber && (numbers[0] != std::floor(numbers[0]) || std::abs(numbers[0]) > 1e6))
  {
    throw Error("the layer rule '" + text + "' is not of the form " + form + ": LAYERS is a whole number or 'auto'");
  }
  rule.layers.layers = anyNumber ? WallLayers::asManyAsFit : static_cast<int>(numbers[0]);
  rule.layers.firstHeight = numbers.size() > 1 ? numbers[1] : otherwise.firstHeight;
  rule.layers.growth = numbers.size() < 3       ? otherwise.growth
                       : std::isnan(numbers[2]) ? WallLayers::fittingGrowth
                                                : numbers[2];
  checkRule(rule);
  return rule;
}

std::string tagName(Index tag, const std::vector<std::string>& surfaceNames)
{
  const auto surfaces = static_cast<Index>(surfaceNames.size());
  return tag < surfaces ? surfaceNames[tag] : sideName(tag - surfaces);
}

std::vector<WallLayers> resolveLayerRules(const std::vector<LayerRule>& rules,
                                          const std::vector<std::string>& surfaceNames)
{
  std::vector<WallLayers> ofTag(surfaceNames.size() + sideNumbers);
  for (const LayerRule& rule : rules)
  {
    checkRule(rule);
    std::vector<char> matching = matchingNames(rule.pattern, surfaceNames);
    for (Index side = 0; side < sideNumbers; ++side)
    {
      matching.push_back(rule.pattern == sideName(side) ? 1 : 0);
    }
    std::ranges::transform(ofTag, matching, ofTag.begin(),
                           [&](const WallLayers& is, char matches) { return matches ? rule.layers : is; });
    if (rule.pattern != "*" && std::ranges::find(matching, 1) == matching.end())
    {
      throw Error("no surface matches '" + rule.pattern + "', for which layers are requested; " +
                  namesInstead(rule.pattern, surfaceNames) +
                  ", and the domain's sides: xMin to zMax, domainSide1 and so on");
    }
  }
  return ofTag;
}

} // namespace atria
