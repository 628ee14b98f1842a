// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of random scenes have the areas, volumes and footprints that are known of the scenes; the audit says the
/// same.
#include "Mesher/MeshStages.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/Scenes.h"
#include "Support/Watchdog.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace atria;
using namespace atria::testing;

/// Of areas and volumes.
constexpr double tolerance = 0.005;
/// Of figures that are two sums of the same.
constexpr double rounding = 1e-9;
constexpr unsigned usualSeeds = 3;
constexpr unsigned allSeeds = 8;

/// What a mesh has, from its faces and elements.
struct MeshFigures
{
  /// By patch; both sides of sheets.
  std::map<std::string, double> areas;
  double air = 0.0;
};

Vec3 areaVector(const DualMesh& mesh, const BoundaryFace& face)
{
  const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
  const Vec3& first = mesh.points[corners.points[0]];
  Vec3 sum = Vec3::Zero();
  for (int i = 1; i + 1 < corners.count; ++i)
  {
    sum += 0.5 * (mesh.points[corners.points[i]] - first).cross(mesh.points[corners.points[i + 1]] - first);
  }
  return sum;
}

MeshFigures measure(const MeshedModel& meshed)
{
  MeshFigures out;
  const std::size_t count = meshed.names.size();
  for (const BoundaryFace& face : meshed.mesh.boundaryFaces)
  {
    const double area = areaVector(meshed.mesh, face).norm();
    const std::string name = face.tag < count ? meshed.names[face.tag] : sideNames[face.tag - count];
    out.areas[name] += area;
  }
  out.air = totalVolume(meshed.mesh);
  return out;
}

/// Compares figures with what they should be, and keeps the largest difference.
class Comparison
{
public:
  void expect(double value, double wanted, const std::string& what)
  {
    // What should be 0 is so up to what an area or a volume of one meter has in rounding.
    EXPECT_NEAR(value, wanted, std::max(tolerance * wanted, rounding)) << what;
    if (wanted > 0.0 && std::abs(value / wanted - 1.0) > largest_)
    {
      largest_ = std::abs(value / wanted - 1.0);
      where_ = what;
    }
  }
  double largest() const { return largest_; }
  const std::string& where() const { return where_; }

private:
  double largest_ = 0.0;
  std::string where_;
};

/// The audit names surfaces whose area is off, and no others.
void expectTold(const MeshedModel& meshed, const std::set<std::string>& inexact)
{
  const auto isTold = [](const std::string& note) { return note.find("0.5 % off") != note.npos; };
  const auto note = std::ranges::find_if(meshed.notes, isTold);
  for (const std::string& name : meshed.names)
  {
    const bool isNamed = note != meshed.notes.end() && note->find(name + " (") != note->npos;
    EXPECT_EQ(isNamed, inexact.contains(name)) << name;
  }
}

/// \param inexact  Surfaces whose area is known to be off.
void expectScene(const Scene& scene, const std::set<std::string>& inexact, Comparison& comparison)
{
  const MeshedModel meshed = meshModel(scene.surface, scene.options, quietContext());
  const MeshFigures figures = measure(meshed);
  const auto areaOf = [](const std::map<std::string, double>& areas, const std::string& name) {
    const auto found = areas.find(name);
    return found == areas.end() ? 0.0 : found->second;
  };
  for (const std::string& name : meshed.names)
  {
    if (!inexact.contains(name))
    {
      comparison.expect(areaOf(figures.areas, name), areaOf(scene.areas, name), "area of " + name);
    }
  }
  expectTold(meshed, inexact);

  const GroundedInput grounded = groundModel(scene.surface, scene.options);
  const Box3 domain = planSite(grounded.surface, grounded.options).domain.bounds;
  const Vec3 size = domain.size();
  if (scene.isIndoors)
  {
    comparison.expect(figures.air, scene.roomVolume, "volume of rooms");
    for (const char* side : sideNames)
    {
      EXPECT_EQ(areaOf(figures.areas, side), 0.0) << side;
    }
  }
  else
  {
    const double empty = scene.emptyVolume > 0.0 ? scene.emptyVolume : size.prod();
    comparison.expect(empty - figures.air, scene.displaced, "displaced volume");
    double ground = areaOf(figures.areas, sideNames[zMin]);
    if (!scene.options.site.terrain.empty())
    {
      EXPECT_EQ(ground, 0.0);
      for (const BoundaryFace& face : meshed.mesh.boundaryFaces)
      {
        const bool isGround = face.tag < meshed.names.size() && meshed.names[face.tag] == scene.options.site.terrain;
        ground += isGround ? -areaVector(meshed.mesh, face)[2] : 0.0;
      }
    }
    comparison.expect(size[0] * size[1] - ground, scene.footprint, "footprint");
  }

  for (std::size_t i = 0; i < meshed.names.size(); ++i)
  {
    const std::string& name = meshed.names[i];
    const SurfaceAudit& surface = meshed.audit.surfaces[i];
    // The audit counts sheets once.
    const double area = (scene.sheets.contains(name) ? 0.5 : 1.0) * areaOf(figures.areas, name);
    EXPECT_NEAR(surface.meshArea, area, rounding * std::max(1.0, area)) << "audited area of " << name;
    EXPECT_LE(surface.lost, tolerance * surface.drawnArea) << "lost of " << name;
  }
  const VolumeAudit& volumes = meshed.audit.volumes;
  EXPECT_NEAR(volumes.air, figures.air, rounding * figures.air);
  EXPECT_NEAR(volumes.displaced(), volumes.domain - figures.air, rounding * volumes.domain);
  EXPECT_NEAR(volumes.displacedByModel, volumes.displaced(), tolerance * volumes.displaced() + rounding);
}

constexpr std::array angles{0.0, 17.0, 30.0, 45.0};

/// Surfaces of a scene whose area is off. Where two sheets meet upright, one vertex of the edge is 5 cm off: one area
/// is 0.51 % too large.
std::set<std::string> inexactSurfaces(const SceneKind& kind, unsigned seed, double angle)
{
  const bool isKnown = std::string(kind.name) == "FreeWalls" && seed == 4 && angle == 30.0;
  return isKnown ? std::set<std::string>{"Second"} : std::set<std::string>{};
}

/// Numbers of a kind and of an angle.
using KindAndAngle = std::tuple<std::size_t, std::size_t>;

class GeneratedScenes : public ::testing::TestWithParam<KindAndAngle>
{
};

TEST_P(GeneratedScenes, AreMeshedWithTheirAreasAndVolumes)
{
  const SceneKind& kind = sceneKinds()[std::get<0>(GetParam())];
  const auto angle = static_cast<unsigned>(std::get<1>(GetParam()));
  Comparison comparison;
  for (unsigned i = 0; i < campaign(usualSeeds, allSeeds); ++i)
  {
    const unsigned seed = (angle + i) % allSeeds;
    const std::string what =
        std::string(kind.name) + " " + std::to_string(seed) + " at " + std::to_string(angles[angle]);
    SCOPED_TRACE(what);
    const Watchdog watchdog(what, std::chrono::seconds(300));
    expectScene(turnedScene(kind, seed, angles[angle]), inexactSurfaces(kind, seed, angles[angle]), comparison);
  }
  RecordProperty("LargestDifference", std::to_string(comparison.largest()) + ", " + comparison.where());
}

std::string nameOf(const ::testing::TestParamInfo<KindAndAngle>& info)
{
  const auto& [kind, angle] = info.param;
  return std::string(sceneKinds()[kind].name) + "At" + std::to_string(static_cast<int>(angles[angle]));
}

INSTANTIATE_TEST_SUITE_P(All, GeneratedScenes,
                         ::testing::Combine(::testing::Range<std::size_t>(0, sceneKinds().size()),
                                            ::testing::Range<std::size_t>(0, angles.size())),
                         nameOf);

} // namespace
