// SPDX-License-Identifier: GPL-3.0-or-later
#include "GroundRoughness.h"

#include "CaseDescription.h"
#include "FoamText.h"
#include "Quality/Faces/Geometry.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

namespace atria {

namespace {

/// Factor between the roughness lengths of the wind's profile and of the ground upstream that changes the profile
/// visibly. Neighboring kinds differ by a factor of 2 to 3, and of 6 and more over smooth ground.
constexpr double roughnessFactor = 2.0;
/// Largest roughness length of a rule, meters; that of the wind's profile has the same limit.
constexpr double mostRoughness = 100.0;

constexpr GroundKind kinds[] = {
    {"water", "sea", 0.0002},       {"smooth", "smooth", 0.005},  {"grass", "open", 0.03},
    {"crops", "roughly open", 0.1}, {"highCrops", "rough", 0.25}, {"parkland", "very rough", 0.5},
    {"suburb", "closed", 1.0},      {"forest", "closed", 1.0},    {"city", "chaotic", 2.0}};

std::vector<std::string> kindNames()
{
  std::vector<std::string> names;
  for (const GroundKind& kind : kinds)
  {
    names.emplace_back(kind.name);
  }
  return names;
}

/// Returns the number that a whole text is.
std::optional<double> numberFrom(const std::string& text)
{
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Returns where the buildings begin along the wind, meters; infinity without any.
double beginOfBuildings(const PolyMesh& poly, const CaseOfDirection& flow)
{
  double begin = std::numeric_limits<double>::infinity();
  for (const std::size_t i : flow.buildings())
  {
    for (const Index face : poly.patches[i].faces)
    {
      for (const Index point : poly.mesh.face(face))
      {
        begin = std::min(begin, flow.wind.dot(poly.mesh.points[point]));
      }
    }
  }
  return begin;
}

/// Returns the area of a patch before a place along the wind, square meters.
double areaBefore(const PolyMesh& poly, const PolyPatch& patch, const Vec3& wind, double place)
{
  double area = 0.0;
  for (const Index face : patch.faces)
  {
    const PolygonMeasure measured = measurePolygon(poly.mesh.points, poly.mesh.face(face));
    area += wind.dot(measured.centroid) < place ? measured.area.norm() : 0.0;
  }
  return area;
}

/// Returns a sentence on grounds whose roughness length fits neither cells nor wind, in quotes and by length.
std::string withLengths(const CaseOfDirection& flow, const std::vector<std::size_t>& patches)
{
  std::vector<std::string> texts;
  texts.reserve(patches.size());
  for (const std::size_t i : patches)
  {
    texts.push_back("'" + flow.mesh.patches[i].name + "' (" + foamNumber(flow.roughnessOf(flow.choices[i])) + " m)");
  }
  return listed(texts);
}

/// Returns the ground patches with faces for which `fails(patch, roughness)` is true.
template <typename Fails> std::vector<std::size_t> groundsThat(const CaseOfDirection& flow, Fails&& fails)
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    const CasePatch& patch = flow.mesh.patches[i];
    if (flow.choices[i].role == PatchRole::Ground && patch.area > 0.0 &&
        fails(patch, flow.roughnessOf(flow.choices[i])))
    {
      found.push_back(i);
    }
  }
  return found;
}

} // namespace

std::span<const GroundKind> groundKinds() { return kinds; }

double roughnessFrom(const std::string& lengthOrKind)
{
  const auto* const kind = std::ranges::find(kinds, std::string_view(lengthOrKind), &GroundKind::name);
  if (kind != std::end(kinds))
  {
    return kind->roughness;
  }
  const std::optional<double> length = numberFrom(lengthOrKind);
  if (!length)
  {
    throw Error("'" + lengthOrKind + "' is neither a roughness length in meters nor a kind of ground; " +
                namesInstead(lengthOrKind, kindNames()));
  }
  if (!(*length > 0.0) || *length > mostRoughness)
  {
    throw Error("the roughness length '" + lengthOrKind + "' is not above 0 and at most " + foamNumber(mostRoughness) +
                " m");
  }
  return *length;
}

PatchRule groundRuleFrom(const std::string& text)
{
  std::istringstream in(text);
  std::string pattern;
  std::string roughness;
  std::string more;
  if (!(in >> std::quoted(pattern) >> roughness) || in >> more)
  {
    throw Error("the rule '" + text + "' for grounds is not of the form PATTERN LENGTH or PATTERN KIND");
  }
  PatchChoice choice{PatchRole::Ground};
  choice.roughness = roughnessFrom(roughness);
  return {pattern, choice};
}

std::optional<double> roughnessUpstream(const PolyMesh& poly, const CaseOfDirection& flow)
{
  const double begin = beginOfBuildings(poly, flow);
  double area = 0.0;
  double sum = 0.0;
  std::set<double> lengths;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    if (flow.choices[i].role == PatchRole::Ground)
    {
      const double its = areaBefore(poly, poly.patches[i], flow.wind, begin);
      area += its;
      sum += its * std::log(flow.roughnessOf(flow.choices[i]));
      if (its > 0.0)
      {
        lengths.insert(flow.roughnessOf(flow.choices[i]));
      }
    }
  }
  if (lengths.size() == 1)
  {
    return *lengths.begin();
  }
  return area > 0.0 ? std::optional(std::exp(sum / area)) : std::nullopt;
}

std::vector<std::string> warnOfRoughness(const CaseOfDirection& flow)
{
  std::vector<std::string> warnings;
  const auto low = groundsThat(flow, [](const CasePatch& patch, double z0) { return z0 > patch.centers.low; });
  if (!low.empty())
  {
    const CasePatch& first = flow.mesh.patches[low.front()];
    warnings.push_back("the first cells are too low for the roughness length of " + withLengths(flow, low) +
                       ": it is more than half of their height, at '" + first.name + "' " +
                       foamNumber(std::round(first.centers.low * 1e4) / 1e4) +
                       " m, and wall functions hold above it. Make these cells higher or the roughness length smaller");
  }
  const double reference = flow.settings.wind.referenceHeight;
  const auto high = groundsThat(flow, [&](const CasePatch&, double z0) { return z0 > reference; });
  if (!high.empty())
  {
    warnings.push_back("the roughness length of " + withLengths(flow, high) +
                       " is more than the wind's reference height, " + foamNumber(reference) + " m");
  }
  return warnings;
}

std::vector<std::string> warnOfUpstream(const WindProfile& wind, const std::vector<Upstream>& directions)
{
  std::vector<Upstream> others;
  std::ranges::copy_if(directions, std::back_inserter(others), [&](const Upstream& upstream) {
    return std::abs(std::log(upstream.roughness / wind.roughness)) > std::log(roughnessFactor);
  });
  if (others.empty())
  {
    return {};
  }
  std::vector<std::string> folders;
  std::ranges::transform(others, std::back_inserter(folders), &Upstream::folder);
  std::ostringstream mean;
  mean << std::setprecision(2) << others.front().roughness;
  const std::string where = directions.size() > 1 ? " in " + listed(folders) : "";
  return {"the ground upstream of the buildings has a roughness length of " + mean.str() + " m on average" + where +
          ", the wind's profile one of " + foamNumber(wind.roughness) +
          " m: the profile changes on its way. If the ground is the same far upstream, set RoughnessLength to " +
          mean.str()};
}

} // namespace atria
