// SPDX-License-Identifier: GPL-3.0-or-later
#include "EmptyDomain.h"

#include "CaseFiles.h"
#include "FoamText.h"
#include "OpenFOAMCase.h"
#include "OutputFolders.h"
#include "Support/Error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Limits for the numbers of cells: the run takes less than a minute on one core, and the profile has enough cells.
constexpr int leastUp = 10;
constexpr int mostUp = 60;
constexpr int leastAlong = 20;
constexpr int mostAlong = 60;
/// Profiles no longer change after some 100 iterations, as the run starts with the wind of the inlet.
constexpr int mostIterations = 200;
/// The profile is of interest up to this many heights of the buildings.
constexpr double heightsOfInterest = 2.0;
/// Share of the height of the domain within which its sides reach the top.
constexpr double topShare = 0.01;

// Cells over the height

/// Returns the factor by which heights grow from `first` if so many cells are as high as the domain.
double growthOf(double height, double first, int cells)
{
  const auto sum = [&](double growth) {
    return std::abs(growth - 1.0) < 1e-9 ? first * cells : first * (std::pow(growth, cells) - 1.0) / (growth - 1.0);
  };
  double low = 0.1;
  double high = 10.0;
  for (int i = 0; i < 100; ++i)
  {
    const double middle = 0.5 * (low + high);
    (sum(middle) < height ? low : high) = middle;
  }
  return low;
}

/// Returns the number of cells whose heights grow from `first` to `top`, not rounded.
double cellsBetween(double height, double first, double top)
{
  const double growth = (height - first) / (height - top);
  return std::abs(growth - 1.0) < 1e-9 ? height / first : 1.0 + std::log(top / first) / std::log(growth);
}

// Patches of the case

/// Returns the patch that faces a way with the largest area among those whose choice fits, or nothing.
template <typename Fits>
std::optional<std::size_t> largestThat(const CaseOfDirection& flow, const Vec3& way, Fits&& fits)
{
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    const double area = flow.mesh.patches[i].areaVector.dot(way);
    if (fits(flow.choices[i]) && area > 0.0 && (!found || area > flow.mesh.patches[*found].areaVector.dot(way)))
    {
      found = i;
    }
  }
  return found;
}

bool isWindy(const PatchChoice& choice, PatchRole role)
{
  return (choice.role == role || choice.role == PatchRole::InletOutlet) && !choice.supply;
}

const Vec3 upwards(0.0, 0.0, 1.0);

struct Ends
{
  std::optional<std::size_t> inlet, outlet, ground, top;
};

Ends endsOf(const CaseOfDirection& flow)
{
  Ends ends{largestThat(flow, -flow.wind, [](const PatchChoice& c) { return isWindy(c, PatchRole::Inlet); }),
            largestThat(flow, flow.wind, [](const PatchChoice& c) { return isWindy(c, PatchRole::Outlet); }),
            largestThat(flow, -upwards, [](const PatchChoice& c) { return c.role == PatchRole::Ground; }),
            largestThat(flow, upwards, [](const PatchChoice& c) { return c.role != PatchRole::Ground; })};
  if (ends.outlet == ends.inlet) // a side all around
  {
    ends.outlet.reset();
  }
  return ends;
}

// Extents of the case

/// Returns the box around the buildings, empty without any.
Box3 boxOfWalls(const CaseOfDirection& flow)
{
  Box3 walls;
  for (const std::size_t i : flow.buildings())
  {
    walls.extend(flow.mesh.patches[i].bounds.min);
    walls.extend(flow.mesh.patches[i].bounds.max);
  }
  return walls;
}

/// Returns half of the length of a box along a way.
double halfAlong(const Box3& box, const Vec3& way) { return 0.5 * box.size().cwiseAbs().dot(way.cwiseAbs()); }

/// True for a patch that reaches the top of the domain, as its sides do, and openings of buildings do not.
bool reachesTop(const CaseOfDirection& flow, const CasePatch& patch)
{
  const Box3& bounds = flow.mesh.bounds;
  return !patch.bounds.empty() && patch.bounds.max[2] >= bounds.max[2] - topShare * bounds.size()[2];
}

/// Returns the distance from a place to the first side of a role along a way: to its plane, or, without a plane one, to
/// the end of the domain.
double distanceTo(const CaseOfDirection& flow, PatchRole role, const Vec3& place, const Vec3& way)
{
  double distance = halfAlong(flow.mesh.bounds, way) + (flow.mesh.bounds.center() - place).dot(way);
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    const CasePatch& patch = flow.mesh.patches[i];
    const double across = patch.areaVector.dot(way);
    if (flow.choices[i].role == role && !flow.choices[i].supply && across > 0.0 && reachesTop(flow, patch))
    {
      distance = std::min(distance, (patch.bounds.center() - place).dot(patch.areaVector) / across);
    }
  }
  return distance;
}

// Files

/// Returns a side of the block as a patch.
CasePatch sideOf(const CaseOfDirection& flow, std::optional<std::size_t> of, const char* otherwise, const Box3& bounds)
{
  CasePatch side = of ? flow.mesh.patches[*of] : CasePatch{otherwise, "patch"};
  side.type = of && flow.choices[*of].role == PatchRole::Constraint ? side.type : "patch";
  side.type = of && isWall(flow.choices[*of].role) ? "wall" : side.type;
  side.bounds = bounds;
  return side;
}

std::vector<Vec3> verticesOf(const EmptyDomain& domain)
{
  const Vec3 along = domain.length * domain.wind;
  const Vec3 across = 0.5 * domain.cellLength() * upwards.cross(domain.wind);
  const Vec3 up = domain.height * upwards;
  const Vec3 first = domain.start - across;
  const Vec3 second = domain.start + across;
  return {first,      first + along,      second + along,      second,
          first + up, first + along + up, second + along + up, second + up};
}

/// Patches of the block and their conditions, in the order inlet, outlet, ground, top and the two sides.
struct Sides
{
  CaseMesh mesh;
  std::vector<PatchChoice> choices;
};
constexpr const char* faces[] = {"(0 4 7 3)", "(1 2 6 5)", "(0 3 2 1)", "(4 5 6 7)", "(0 1 5 4)", "(3 7 6 2)"};

Sides sidesOf(const CaseOfDirection& flow, const EmptyDomain& domain, std::optional<double> roughness)
{
  const Ends ends = endsOf(flow);
  Sides sides;
  for (const Vec3& vertex : verticesOf(domain))
  {
    sides.mesh.bounds.extend(vertex);
  }
  const Box3& box = sides.mesh.bounds;
  sides.mesh.patches = {sideOf(flow, ends.inlet, "inlet", box),      sideOf(flow, ends.outlet, "outlet", box),
                        sideOf(flow, ends.ground, "ground", box),    sideOf(flow, ends.top, "top", box),
                        {"symmetryOfEmptyDomain1", "symmetryPlane"}, {"symmetryOfEmptyDomain2", "symmetryPlane"}};
  sides.mesh.patches[2].type = "wall";
  PatchChoice ground{PatchRole::Ground};
  ground.roughness = roughness;
  sides.choices = {{PatchRole::Inlet},
                   {PatchRole::Outlet},
                   ground,
                   ends.top ? flow.choices[*ends.top] : PatchChoice{PatchRole::Slip},
                   {PatchRole::Constraint},
                   {PatchRole::Constraint}};
  return sides;
}

Lines boundaryOf(const Sides& sides)
{
  Lines lines;
  for (std::size_t i = 0; i < sides.choices.size(); ++i)
  {
    const CasePatch& patch = sides.mesh.patches[i];
    const Filling filling{{}, {{"patch", {patch.name}}, {"patchType", {patch.type}}, {"face", {faces[i]}}}};
    const Lines side = textOf(caseParts(), "side", filling);
    lines.insert(lines.end(), side.begin(), side.end());
  }
  return lines;
}

/// Returns the centers of a column of cells, moved to a distance from the inlet.
Lines column(const EmptyDomain& domain, double distance)
{
  Lines places;
  for (const double height : centersOf(domain.grading, domain.height))
  {
    places.push_back(foamVector(domain.start + distance * domain.wind + height * upwards));
  }
  return places;
}

/// Returns the distance of the last cell centers before the buildings from the inlet.
double lastCenter(const EmptyDomain& domain)
{
  const double cells = std::max(1.0, std::floor(domain.fetch / domain.cellLength() + 1e-6));
  return (cells - 0.5) * domain.cellLength();
}

/// Returns a field of one value per cell, in blockMesh's order, from values over the height.
std::string fieldOf(const EmptyDomain& domain, const char* type, const Lines& overHeight)
{
  std::string field =
      std::string("nonuniform List<") + type + ">\n" + std::to_string(domain.cellsAlong * domain.grading.cells) + "\n(";
  for (const std::string& value : overHeight)
  {
    for (int i = 0; i < domain.cellsAlong; ++i)
    {
      field.append("\n").append(value);
    }
  }
  return field + "\n)";
}

/// Adds initial fields: the profile of the inlet everywhere.
void addStart(Filling& filling, const EmptyDomain& domain, const WindProfile& wind)
{
  Lines velocity;
  Lines epsilon;
  Lines omega;
  for (const double height : centersOf(domain.grading, domain.height))
  {
    velocity.push_back(foamVector(wind.velocity(height) * domain.wind));
    epsilon.push_back(foamNumber(wind.dissipation(height)));
    omega.push_back(foamNumber(wind.specificDissipation(height)));
  }
  filling.values["initialVelocity"] = {fieldOf(domain, "vector", velocity)};
  filling.values["initialEpsilon"] = {fieldOf(domain, "scalar", epsilon)};
  filling.values["initialOmega"] = {fieldOf(domain, "scalar", omega)};
}

Filling fillingOf(const EmptyDomain& domain, const Sides& sides)
{
  Filling filling{{"emptyDomain"}, {}};
  auto& values = filling.values;
  for (const Vec3& vertex : verticesOf(domain))
  {
    values["vertices"].push_back(foamVector(vertex));
  }
  values["cellsAlong"] = {std::to_string(domain.cellsAlong)};
  values["cellsUp"] = {std::to_string(domain.grading.cells)};
  values["topOverFirst"] = {foamNumber(domain.grading.topOverFirst)};
  values["sides"] = boundaryOf(sides);
  values["inlet"] = {sides.mesh.patches[0].name};
  values["placesAtInlet"] = column(domain, 0.0);
  values["placesAtBuildings"] = column(domain, lastCenter(domain));
  return filling;
}

/// Returns the name of the file by which ParaView opens an empty domain, and by which it is known to be one.
std::string markerName() { return std::string(emptyDomainFolder) + ".foam"; }

/// Returns the settings of a case for its empty domain.
FlowCaseSettings settingsOf(const CaseOfDirection& flow)
{
  FlowCaseSettings settings = flow.settings;
  settings.iterations = mostIterations;
  settings.processors = 1;
  settings.ageOfAir = false;
  settings.checkProfile = false;
  settings.warmAir = false;
  settings.transientDuration = 0.0;
  // The channel carries no age, no scalars and no heat.
  std::erase_if(settings.conditionRules, [](const ConditionRule& rule) {
    const auto found = std::ranges::find(caseFields(), rule.field, &CaseField::name);
    return found == caseFields().end() || found->kind == FieldKind::Scalar || found->kind == FieldKind::Temperature;
  });
  return settings;
}

} // namespace

Grading gradingOf(double height, double first, double top)
{
  first = std::min(first, height / 2.0);
  const double wanted = cellsBetween(height, first, std::min(top, height / 2.0));
  const int cells = static_cast<int>(std::lround(std::clamp<double>(wanted, leastUp, mostUp)));
  if (wanted >= leastUp && wanted <= mostUp)
  {
    return {cells, std::min(top, height / 2.0) / first};
  }
  return {cells, std::pow(growthOf(height, first, cells), cells - 1)};
}

std::vector<double> centersOf(const Grading& grading, double height)
{
  const double growth = grading.cells > 1 ? std::pow(grading.topOverFirst, 1.0 / (grading.cells - 1)) : 1.0;
  double sum = 0.0;
  double size = 1.0;
  std::vector<double> centers;
  for (int i = 0; i < grading.cells; ++i, size *= growth)
  {
    centers.push_back(sum + 0.5 * size);
    sum += size;
  }
  for (double& center : centers)
  {
    center *= height / sum;
  }
  return centers;
}

EmptyDomain emptyDomainOf(const CaseOfDirection& flow)
{
  const Ends ends = endsOf(flow);
  if (!ends.inlet || !ends.ground)
  {
    throw Error(std::string("CheckProfile needs a mesh with ") + (ends.inlet ? "ground" : "an inlet for the wind"));
  }
  const CasePatch& inlet = flow.mesh.patches[*ends.inlet];
  const CasePatch& ground = flow.mesh.patches[*ends.ground];
  const Box3 walls = boxOfWalls(flow);
  Vec3 middle = walls.empty() ? flow.mesh.bounds.center() : walls.center();
  middle[2] = inlet.bounds.min[2];
  const double before = distanceTo(flow, PatchRole::Inlet, middle, -flow.wind);
  EmptyDomain domain;
  domain.wind = flow.wind;
  domain.start = middle - before * flow.wind;
  domain.length = before + distanceTo(flow, PatchRole::Outlet, middle, flow.wind);
  if (!(before > 0.0) || !(domain.length > before))
  {
    throw Error("CheckProfile found no way from an inlet over the buildings to an outlet along the wind");
  }
  domain.height = flow.mesh.bounds.max[2] - middle[2];
  const double wanted = domain.length / std::max(2.0 * inlet.centers.median, 1e-6 * domain.length);
  domain.cellsAlong = static_cast<int>(std::lround(std::clamp<double>(wanted, leastAlong, mostAlong)));
  domain.fetch = std::max(before - (walls.empty() ? 0.0 : halfAlong(walls, flow.wind)), domain.cellLength());
  const double first = 2.0 * ground.centers.median;
  domain.grading =
      gradingOf(domain.height, first, ends.top ? 2.0 * flow.mesh.patches[*ends.top].centers.median : first);
  domain.heightOfInterest =
      walls.empty() ? flow.settings.wind.referenceHeight : heightsOfInterest * (walls.max[2] - middle[2]);
  domain.heightOfInterest = std::min(domain.heightOfInterest, domain.height);
  return domain;
}

void removeEmptyDomain(const std::filesystem::path& folder)
{
  const std::filesystem::path empty = folder / emptyDomainFolder;
  std::error_code error;
  if (std::filesystem::exists(empty / markerName()))
  {
    std::filesystem::remove_all(empty, error);
  }
  if (error)
  {
    throw OutputError("cannot remove '" + empty.string() + "': " + error.message());
  }
}

nlohmann::ordered_json writeEmptyDomain(const std::filesystem::path& folder, const CaseOfDirection& flow,
                                        std::optional<double> roughness)
{
  const EmptyDomain domain = emptyDomainOf(flow);
  const Sides sides = sidesOf(flow, domain, roughness);
  const FlowCaseSettings settings = settingsOf(flow);
  const CaseOfDirection empty{sides.mesh, settings, flow.wind, sides.choices, {}};
  Filling filling = fillingOf(domain, sides);
  addStart(filling, domain, settings.wind);
  writeCaseFiles(folder / emptyDomainFolder, empty, std::move(filling));
  writePlainFile(folder / emptyDomainFolder / markerName(), "");
  return {{"folder", emptyDomainFolder},
          {"fetch", domain.fetch},
          {"length", domain.length},
          {"height_of_interest", domain.heightOfInterest},
          {"first_center", centersOf(domain.grading, domain.height).front()},
          {"roughness_length", roughness.value_or(settings.wind.roughness)},
          {"heights", centersOf(domain.grading, domain.height)}};
}

} // namespace atria
