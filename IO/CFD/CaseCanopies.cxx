// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseCanopies.h"

#include "FoamText.h"
#include "NumberTable.h"
#include "PatchNames.h"
#include "Quality/Faces/Geometry.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>

namespace atria {

namespace {

/// Share of a tree's height at which its crown begins.
constexpr double crownBase = 1.0 / 3.0;
constexpr const char* zoneName = "trees";
/// Largest drag coefficient: of a plate across the wind. Leaves have 0.1 to 0.5.
constexpr double largestDrag = 2.0;
/// A length far below the sizes of cells, over the cube root of the smallest volume: also flat cells of layers have
/// their centers farther apart.
constexpr double smallShare = 1e-3;

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }

bool isTree(const std::vector<double>& n)
{
  return n.size() == 6 && std::isfinite(n[0]) && std::isfinite(n[1]) &&
         std::all_of(n.begin() + 2, n.end(), isPositive) && n[5] <= largestDrag;
}

/// Returns the height of the ground at a tree: that of the face of the ground with the nearest center, seen from above.
double groundBelow(const Tree& tree, const std::vector<Vec3>& ground, double lowest)
{
  double nearest = std::numeric_limits<double>::max();
  double height = lowest;
  for (const Vec3& center : ground)
  {
    const double distance = std::hypot(center[0] - tree.x, center[1] - tree.y);
    if (distance < nearest)
    {
      nearest = distance;
      height = center[2];
    }
  }
  return height;
}

std::vector<Vec3> centersOf(const PolyMesh& poly, const std::vector<std::string>& patches)
{
  std::vector<Vec3> centers;
  for (const PolyPatch& patch : poly.patches)
  {
    for (std::size_t i = 0; std::ranges::find(patches, patch.name) != patches.end() && i < patch.faces.size(); ++i)
    {
      centers.push_back(measurePolygon(poly.mesh.points, poly.mesh.face(patch.faces[i])).centroid);
    }
  }
  return centers;
}

bool isInCrown(const Vec3& place, const Tree& tree, double ground)
{
  const double half = 0.5 * (1.0 - crownBase) * tree.height;
  const Vec3 middle(tree.x, tree.y, ground + tree.height - half);
  const Vec3 axes(tree.crownRadius, tree.crownRadius, half);
  return (place - middle).cwiseQuotient(axes).squaredNorm() <= 1.0;
}

double dragOf(const Tree& tree) { return tree.leafAreaDensity * tree.dragCoefficient; }

/// Gives cells to a tree unless they have one whose leaves slow the air as much. Returns false if no cell is in its
/// crown.
bool plant(const Buffer<Vec3>& centers, const std::vector<Tree>& trees, std::size_t tree, double ground,
           std::vector<int>& treeOf)
{
  bool isPlanted = false;
  for (std::size_t cell = 0; cell < treeOf.size(); ++cell)
  {
    if (isInCrown(centers[cell], trees[tree], ground))
    {
      isPlanted = true;
      const bool isDenser =
          treeOf[cell] < 0 || dragOf(trees[tree]) > dragOf(trees[static_cast<std::size_t>(treeOf[cell])]);
      treeOf[cell] = isDenser ? static_cast<int>(tree) : treeOf[cell];
    }
  }
  return isPlanted;
}

/// Adds a zone for each pair of LAD and Cd.
void addZones(const std::vector<Tree>& trees, const std::vector<int>& treeOf, const Buffer<double>& volumes,
              PlantedTrees& planted)
{
  std::map<std::pair<double, double>, std::size_t> kinds;
  for (std::size_t cell = 0; cell < treeOf.size(); ++cell)
  {
    if (treeOf[cell] >= 0)
    {
      const Tree& tree = trees[static_cast<std::size_t>(treeOf[cell])];
      const auto [kind, isNew] = kinds.try_emplace({tree.leafAreaDensity, tree.dragCoefficient}, kinds.size());
      if (isNew)
      {
        planted.zones.emplace_back();
        planted.canopies.push_back({{}, tree.leafAreaDensity, tree.dragCoefficient, 0.0});
      }
      planted.zones[kind->second].cells.push_back(static_cast<Index>(cell));
      planted.canopies[kind->second].volume += volumes[cell];
    }
  }
}

void nameZones(const PolyMesh& poly, PlantedTrees& planted)
{
  for (std::size_t i = 0; i < planted.zones.size(); ++i)
  {
    const std::string name = zoneName + (planted.zones.size() > 1 ? "_" + std::to_string(i + 1) : "");
    planted.zones[i].name = planted.canopies[i].zone = name;
    if (std::ranges::find(poly.cellZones, name, &CellZone::name) != poly.cellZones.end())
    {
      throw Error("the mesh has a cell zone '" + name + "' already, which is the name of trees from a file");
    }
  }
}

} // namespace

CanopyRule canopyRuleFrom(const std::string& text)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  CanopyRule rule;
  std::string more;
  const bool isRule =
      static_cast<bool>(in >> std::quoted(rule.pattern) >> rule.leafAreaDensity >> rule.dragCoefficient);
  if (!isRule || in >> more || !isPositive(rule.leafAreaDensity) || !isPositive(rule.dragCoefficient) ||
      rule.dragCoefficient > largestDrag)
  {
    throw Error("the canopy '" + text +
                "' is not of the form PATTERN LAD CD, with a leaf area density in 1/m above 0 and a drag coefficient "
                "of at most 2, such as Trees 1.2 0.2");
  }
  return rule;
}

std::vector<CaseCanopy> canopiesOf(const CaseMesh& mesh, const std::vector<CanopyRule>& rules)
{
  std::vector<std::string> names;
  std::map<std::string, CaseCanopy> found;
  for (const CaseRoom& zone : mesh.rooms)
  {
    names.push_back(zone.name);
  }
  for (const CanopyRule& rule : rules)
  {
    bool isUsed = false;
    for (const CaseRoom& zone : mesh.rooms)
    {
      if (zone.volume > 0.0 && matchesPatchName(rule.pattern, zone.name, openFOAMNames))
      {
        found[zone.name] = {zone.name, rule.leafAreaDensity, rule.dragCoefficient, zone.volume};
        isUsed = true;
      }
    }
    if (!isUsed)
    {
      throw Error(names.empty()
                      ? "canopy '" + rule.pattern + "': the mesh has no cell zones"
                      : "canopy '" + rule.pattern + "': no cell zone matches; " + namesInstead(rule.pattern, names));
    }
  }
  std::vector<CaseCanopy> canopies;
  canopies.reserve(found.size());
  for (const auto& [name, canopy] : found)
  {
    canopies.push_back(canopy);
  }
  return canopies;
}

void addCenters(const PolyMesh& poly, std::vector<CaseCanopy>& canopies, const RunContext& context)
{
  const MeasuredMesh measured = measureMesh(poly.mesh, context);
  for (CaseCanopy& canopy : canopies)
  {
    const auto zone = std::ranges::find(poly.cellZones, canopy.zone, &CellZone::name);
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; zone != poly.cellZones.end() && i < zone->cells.size(); ++i)
    {
      canopy.centers.push_back(measured.geometry.cellCentroids[zone->cells[i]]);
      least = std::min(least, measured.geometry.cellVolumes[zone->cells[i]]);
    }
    canopy.smallLength = smallShare * std::cbrt(least);
  }
}

std::string surfaceFileOf(const CaseCanopy& canopy) { return "canopy_" + canopy.zone + ".obj"; }

std::string surfaceOf(const CaseCanopy& canopy)
{
  const double reach = 0.5 * canopy.smallLength;
  const Vec3 corners[] = {{-reach, -reach, reach}, {reach, -reach, reach}, {0.0, reach, reach}};
  std::string text;
  for (const Vec3& center : canopy.centers)
  {
    for (const Vec3& corner : corners)
    {
      const Vec3 point = center + corner;
      text += "v " + foamNumber(point[0]) + " " + foamNumber(point[1]) + " " + foamNumber(point[2]) + "\n";
    }
  }
  for (std::size_t i = 0; i < canopy.centers.size(); ++i)
  {
    text += "f " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " + std::to_string(3 * i + 3) + "\n";
  }
  return text;
}

std::vector<Tree> readTrees(const std::filesystem::path& file)
{
  const NumberTable table{
      "trees", "a tree has x, y, height, crown radius, LAD and Cd; all but its place are above 0, and Cd is at most 2",
      isTree};
  std::vector<Tree> trees;
  for (const NumberRow& row : readNumbers(file, table))
  {
    const std::vector<double>& n = row.numbers;
    trees.push_back({n[0], n[1], n[2], n[3], n[4], n[5]});
  }
  return trees;
}

PlantedTrees plantTrees(const PolyMesh& poly, const std::vector<Tree>& trees, const std::vector<std::string>& ground,
                        const RunContext& context)
{
  const MeasuredMesh measured = measureMesh(poly.mesh, context);
  const std::vector<Vec3> faces = centersOf(poly, ground);
  Box3 bounds;
  for (const Vec3& point : poly.mesh.points)
  {
    bounds.extend(point);
  }
  PlantedTrees planted;
  planted.count = trees.size();
  std::vector<int> treeOf(poly.mesh.cellCount, -1);
  for (std::size_t i = 0; i < trees.size(); ++i)
  {
    context.progress.check();
    const double base = groundBelow(trees[i], faces, bounds.min[2]);
    if (!plant(measured.geometry.cellCentroids, trees, i, base, treeOf))
    {
      planted.missed.push_back(trees[i]);
    }
  }
  addZones(trees, treeOf, measured.geometry.cellVolumes, planted);
  nameZones(poly, planted);
  return planted;
}

std::string summaryOf(const PlantedTrees& planted)
{
  std::size_t cells = 0;
  double volume = 0.0;
  std::string names;
  for (std::size_t i = 0; i < planted.zones.size(); ++i)
  {
    cells += planted.zones[i].cells.size();
    volume += planted.canopies[i].volume;
    names += (i == 0 ? "" : ", ") + planted.zones[i].name;
  }
  std::ostringstream text;
  text << std::setprecision(3) << planted.count - planted.missed.size() << " of " << planted.count << " trees in "
       << cells << " cells, " << volume << " m3";
  return text.str() + (names.empty() ? "" : ": cell zones " + names);
}

std::vector<std::string> warnOfMissed(const PlantedTrees& planted)
{
  if (planted.missed.empty())
  {
    return {};
  }
  std::ostringstream text;
  text << planted.missed.size() << " of " << planted.count
       << " trees are smaller than the cells there, or outside of the mesh, and left out; the first is at ("
       << planted.missed[0].x << " " << planted.missed[0].y << "). Make the mesh finer there";
  return {text.str()};
}

} // namespace atria
