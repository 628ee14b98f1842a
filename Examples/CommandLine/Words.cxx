// SPDX-License-Identifier: GPL-3.0-or-later
#include "Words.h"

#include <array>
#include <regex>
#include <utility>

namespace atria::tool {

namespace {

/// Longer names that begin alike come first.
constexpr std::array optionOf{
    std::pair{"DomainMode Automatic", "--automatic"},
    std::pair{"DomainMode Site", "--site"},
    std::pair{"DomainMode FromSurfaces", "--model-bounds"},
    std::pair{"DomainMode Explicit", "--domain"},
    std::pair{"DomainBounds", "--domain"},
    std::pair{"DomainAngle", "--domain-angle"},
    std::pair{"DomainSides", "--domain-sides"},
    std::pair{"DomainPolygon", "--domain-polygon"},
    std::pair{"WindAngle", "--wind"},
    std::pair{"SiteName", "--ground"},
    std::pair{"TerrainName", "--terrain"},
    std::pair{"GroundSnapRatio", "--ground-snap"},
    std::pair{"AlignGrid", "--align"},
    std::pair{"SizeMax", "--size-max"},
    std::pair{"SizeMid", "--size-mid"},
    std::pair{"SizeMin", "--size-min"},
    std::pair{"StartLevel", "--start-level"},
    std::pair{"FeatureAngle", "--feature-angle"},
    std::pair{"CurvatureAngle", "--curvature-angle"},
    std::pair{"CellsAcrossGap", "--gap-cells"},
    std::pair{"CellsPerLevel", "--cells-per-level"},
    std::pair{"ElementType Hexahedral", "--hex"},
    std::pair{"ElementType", "--hex"},
    std::pair{"MaxElements", "--max-elements"},
    std::pair{"MemoryLimit", "--memory-limit"},
    std::pair{"GapTolerance", "--gap"},
    std::pair{"SmallPartSize", "--small-parts"},
    std::pair{"CrackTolerance", "--crack"},
    std::pair{"SurfaceSizeRules", "--size"},
    std::pair{"RefinementBoxes", "--refine-box"},
    std::pair{"DistanceSizeRules", "--refine-near"},
    std::pair{"FaceZones", "--face-zone"},
    std::pair{"CellZones", "--cell-zone"},
    std::pair{"FindOpenings", "--openings"},
    std::pair{"SurfacesWithoutOpenings", "--no-openings"},
    std::pair{"ZoneRule", "--zone"},
    std::pair{"SealedSeeds", "--sealed-seed"},
    std::pair{"NumberOfLayers", "--layers"},
    std::pair{"LayerRules", "--layers"},
    std::pair{"FirstLayerHeight", "--first-layer"},
    std::pair{"LayerGrowth", "--layer-growth"},
    std::pair{"TargetNonOrthogonality", "--non-orthogonality"},
    std::pair{"TargetSkewness", "--skewness"},
    std::pair{"BlockSize", "--block-size"},
    std::pair{"TargetCellSquish", "--squish"},
    std::pair{"TargetScaledJacobian", "--scaled-jacobian"},
    std::pair{"FixBoundary", "--fix-boundary"},
    std::pair{"NumberOfSweeps", "--sweeps"},
    std::pair{"LengthUnit", "--unit"},
    std::pair{"UpAxis", "--up"},
    std::pair{"SurfaceBy Group", "--surfaces-by group"},
    std::pair{"SurfaceBy", "--surfaces-by"},
    std::pair{"Recenter", "--recenter"},
    std::pair{"MergeDuplicateFaces", "--keep-duplicates"},
    std::pair{"ExcludedSurfaces", "--without"},
    std::pair{"TessellationAngle", "--round-angle"},
    std::pair{"TessellationError", "--round-error"},
    std::pair{"check Scale", "check --scale"},
    std::pair{"set Scale", "give --scale"},
    std::pair{"by Scale", "by --scale"},
    std::pair{"Scale is", "--scale is"},
    std::pair{"MetricName", "--metric"},
    std::pair{"CheckMesh", "--checks"},
    std::pair{"Limit is", "--beyond is"},
    std::pair{"Rings is", "--rings is"},
    std::pair{"NumberOfElements is", "--worst is"},
    std::pair{"RestoreOffset", "--restore-offset"},
    std::pair{"NumberOfProcessors", "--processors"},
    std::pair{"Kind is", "--kind is"},
    std::pair{"InletQuantity", "--inlet-flow"},
    std::pair{"InletSpeed", "--inlet-speed"},
    std::pair{"InletFlowRate", "--inlet-flow"},
    std::pair{"ReferenceSpeed", "--speed"},
    std::pair{"ReferenceHeight", "--height"},
    std::pair{"RoughnessLength", "--roughness"},
    std::pair{"WindAngles", "--wind"},
    std::pair{"NumberOfRoseDirections", "--rose"},
    std::pair{"RoseFileName", "--rose"},
    std::pair{"NorthAngle", "--north"},
    std::pair{"TurbulenceModel", "--turbulence"},
    std::pair{"Season is", "--season is"},
    std::pair{"Sectors is", "--sectors is"},
    std::pair{"CalmSpeed", "--calm"},
    std::pair{"Dialect is", "--dialect is"},
    std::pair{"NumberOfIterations", "--iterations"},
    std::pair{"PedestrianHeight", "--pedestrian-height"},
    std::pair{"AgeOfAir", "--age-of-air"},
    std::pair{"PatchRules", "--patch"},
    std::pair{"ConditionRules", "--condition"},
    std::pair{"GroundRules", "--ground"},
    std::pair{"CheckProfile", "--check-profile"},
    std::pair{"WarmAir", "--outdoor-temperature"},
    std::pair{"OutdoorTemperature", "--outdoor-temperature"},
    std::pair{"TemperatureRules", "--temperature"},
    std::pair{"HeatRules", "--heat"},
    std::pair{"by itself, Calm", "by itself, --calm"},
    std::pair{"for Calm", "for --calm"},
    std::pair{"Calm is", "--calm is"},
    std::pair{"TransientDuration", "--transient"},
    std::pair{"by Seeds", "by --seed"},
};

} // namespace

std::string inOptions(const std::string& message)
{
  std::string text = message;
  for (const auto& [property, option] : optionOf)
  {
    text = std::regex_replace(text, std::regex("\\b" + std::string(property) + "\\b"), option);
  }
  // A message that names the option itself has it twice now.
  static const std::regex again(R"((--[a-z-]+)((, |; | or | and | with )\1)+(?![a-z-]))");
  static const std::regex inBrackets(R"((--[a-z-]+) \(\1\))");
  text = std::regex_replace(text, again, "$1");
  return std::regex_replace(text, inBrackets, "$1");
}

} // namespace atria::tool
