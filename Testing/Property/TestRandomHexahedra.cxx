// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds of every mesh of hexahedra, on random octrees.
#include "Mesher/DualMesher.h"
#include "Octree/Tree/Balance.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/RandomOctrees.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;

int campaign(int usual, int full) { return std::getenv("ATRIA_TEST_FULL") ? full : usual; }

DualMesh dualOf(const GridFrame& frame, const RefinedSets& sets, bool hexahedra)
{
  StageClock clock;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.hexahedra = hexahedra;
  return makeDualMesh(Octree(frame, sets), {}, options, clock, quietContext()).mesh;
}

/// Least scaled Jacobian of the corners of an element.
double scaledJacobian(const DualMesh& mesh, Index element)
{
  double least = 1.0;
  for (unsigned c = 0; c < 8; ++c)
  {
    const auto at = [&](unsigned bits) {
      const auto corner = std::ranges::find(hexahedronCorner, static_cast<std::uint8_t>(bits)) - hexahedronCorner.begin();
      return mesh.points[mesh.corners[element][corner]];
    };
    const auto edge = [&](unsigned bit) {
      return Vec3((at(c ^ bit) - at(c)).normalized() * ((c & bit) != 0 ? -1.0 : 1.0));
    };
    least = std::min(least, edge(1).cross(edge(2)).dot(edge(4)));
  }
  return least;
}

double volumeOf(const DualMesh& mesh, Index e)
{
  const auto& c = mesh.corners[e];
  const auto& p = mesh.points;
  const Vec3 a = p[c[1]] + p[c[2]] + p[c[5]] + p[c[6]] - p[c[0]] - p[c[3]] - p[c[4]] - p[c[7]];
  const Vec3 b = p[c[2]] + p[c[3]] + p[c[6]] + p[c[7]] - p[c[0]] - p[c[1]] - p[c[4]] - p[c[5]];
  const Vec3 d = p[c[4]] + p[c[5]] + p[c[6]] + p[c[7]] - p[c[0]] - p[c[1]] - p[c[2]] - p[c[3]];
  return a.cross(b).dot(d) / 64.0;
}

void smooth(DualMesh& mesh)
{
  const auto onBoundary = boundaryPoints(mesh, quietContext().executor);
  const int n = std::getenv("SMOOTH") ? std::atoi(std::getenv("SMOOTH")) : 0;
  const double w = std::getenv("WEIGHT") ? std::atof(std::getenv("WEIGHT")) : 1.0;
  const int mode = std::getenv("MODE") ? std::atoi(std::getenv("MODE")) : 0;
  // points of irregular elements: those whose valence is not 8
  std::vector<int> valence(mesh.points.size(), 0);
  for (const auto& c : mesh.corners) for (Index p : c) ++valence[p];
  std::vector<char> movable(mesh.points.size(), 0);
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    bool irregular = false;
    for (Index p : mesh.corners[e]) irregular |= valence[p] != 8 && !onBoundary[p];
    if (irregular) for (Index p : mesh.corners[e]) movable[p] = !onBoundary[p];
  }
  for (int i = 0; i < n; ++i)
  {
    std::vector<Vec3> sum(mesh.points.size(), Vec3::Zero());
    std::vector<double> weight(mesh.points.size(), 0.0);
    for (Index e = 0; e < mesh.elementCount(); ++e)
      for (unsigned c = 0; c < 8; ++c)
      {
        if (mode == 0)
          for (unsigned bit = 1; bit < 8; bit <<= 1)
          {
            auto cornerAt = [&](unsigned bits) { return mesh.corners[e][std::ranges::find(hexahedronCorner, static_cast<std::uint8_t>(bits)) - hexahedronCorner.begin()]; };
            sum[cornerAt(c)] += mesh.points[cornerAt(c ^ bit)];
            weight[cornerAt(c)] += 1.0;
          }
        else
        {
          Vec3 middle = Vec3::Zero();
          for (Index p : mesh.corners[e]) middle += 0.125 * mesh.points[p];
          const double f = mode == 1 ? 1.0 : std::pow(std::abs(volumeOf(mesh, e)), mode == 2 ? 0.333 : 1.0);
          sum[mesh.corners[e][c]] += f * middle;
          weight[mesh.corners[e][c]] += f;
        }
      }
    for (Index p = 0; p < mesh.points.size(); ++p)
      if (movable[p]) mesh.points[p] += w * (sum[p] / weight[p] - mesh.points[p]);
  }
}

void optimizeAll(DualMesh& mesh)
{
  const auto onBoundary = boundaryPoints(mesh, quietContext().executor);
  const int n = std::getenv("SWEEPS") ? std::atoi(std::getenv("SWEEPS")) : 0;
  const double goal = std::getenv("GOAL") ? std::atof(std::getenv("GOAL")) : 0.6;
  std::vector<std::vector<Index>> star(mesh.points.size());
  for (Index e = 0; e < mesh.elementCount(); ++e) for (Index p : mesh.corners[e]) star[p].push_back(e);
  for (int i = 0; i < n; ++i)
  {
    long moved = 0;
    for (Index p = 0; p < mesh.points.size(); ++p)
    {
      if (onBoundary[p]) continue;
      auto energy = [&] { double sum = 0; for (Index e : star[p]) { const double q = scaledJacobian(mesh, e); sum += q < goal ? (goal - q) * (goal - q) : 0.0; } return sum; };
      double best = energy();
      if (best == 0.0) continue;
      double size = 1e9;
      for (Index e : star[p]) size = std::min(size, std::cbrt(std::abs(volumeOf(mesh, e))));
      for (double step = 0.3 * size; step > 0.02 * size; step *= 0.5)
      {
        bool again = true;
        for (int t = 0; t < 3 && again; ++t)
        {
          again = false;
          const Vec3 from = mesh.points[p];
          Vec3 to = from;
          for (int x = -1; x <= 1; ++x) for (int y = -1; y <= 1; ++y) for (int z = -1; z <= 1; ++z)
          {
            mesh.points[p] = from + step * Vec3(x, y, z);
            const double e = energy();
            if (e < best) { best = e; to = mesh.points[p]; again = true; }
          }
          mesh.points[p] = to;
        }
        moved += again;
      }
    }
  }
}

TEST(RandomHexahedra, FillTheDomainWithHexahedraOnly)
{
  const int count = campaign(10, 400);
  double least = 1.0;
  double more = 0.0;
  for (int seed = 0; seed < count; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    const GridFrame frame = frameOfDepth(5, {31.0, 20.0 + 0.37 * (seed % 7), 17.0});
    RefinedSets sets = randomSets(frame, random);
    balance(sets, frame, quietContext(), 1, true);
    RefinedSets again = sets;
    balance(again, frame, quietContext(), 1, true);
    EXPECT_EQ(sets, again) << "balancing twice changes nothing";
    DualMesh mesh = dualOf(frame, sets, true);
    smooth(mesh);
    optimizeAll(mesh);
    EXPECT_TRUE(isSound(mesh, 0));
    EXPECT_NEAR(totalVolume(mesh) / frame.domain.size().prod(), 1.0, 1e-9);
    std::vector<double> sj;
    const auto onBoundary = boundaryPoints(mesh, quietContext().executor);
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      EXPECT_EQ(std::set<Index>(mesh.corners[e].begin(), mesh.corners[e].end()).size(), 8U);
      if (std::ranges::any_of(mesh.corners[e], [&](Index p) { return onBoundary[p] != 0; }))
      {
        continue;
      }
      sj.push_back(scaledJacobian(mesh, e));
      least = std::min(least, scaledJacobian(mesh, e));
    }
    const double ratio = static_cast<double>(mesh.elementCount()) / static_cast<double>(dualOf(frame, sets, false).elementCount());
    more = std::max(more, ratio);
    std::sort(sj.begin(), sj.end());
    std::printf("seed %d: %zu elements, ratio %.2f, sj min %.3f 1%% %.3f negative %zu\n", seed, mesh.elementCount(), ratio, sj[0], sj[sj.size()/100],
      (std::size_t)std::count_if(sj.begin(), sj.end(), [](double v){return v<=0;}));
    const std::vector<double> all = volumes(mesh);
    EXPECT_GT(*std::min_element(all.begin(), all.end()), 0.0);
  }
  std::printf("least %.3f most %.2f\n", least, more);
}

} // namespace
