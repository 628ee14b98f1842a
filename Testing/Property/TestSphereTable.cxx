// SPDX-License-Identifier: GPL-3.0-or-later
/// The six rows of the published table: a sphere of radius 2 m in a cube of 10 m, the region between them
/// meshed.
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace atria;
using namespace atria::testing;

struct Row
{
  double size;
  bool adaptive;
  double vertices;
  double elements;
  bool large; ///< only in the full campaign
};

void PrintTo(const Row& row, std::ostream* os) { *os << (row.adaptive ? "adaptive " : "uniform ") << row.size << " m"; }

class SphereRow : public ::testing::TestWithParam<Row>
{
};

/// Volume enclosed by the mesh's boundary, by the divergence theorem over the same triangles elements are measured by.
double enclosedVolume(const DualMesh& mesh)
{
  double volume = 0.0;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
    Vec3 center = Vec3::Zero();
    for (int i = 0; i < corners.count; ++i)
    {
      center += mesh.points[corners.points[i]] / corners.count;
    }
    for (int i = 0; i < corners.count; ++i)
    {
      const Vec3& a = mesh.points[corners.points[i]];
      const Vec3& b = mesh.points[corners.points[(i + 1) % corners.count]];
      volume += center.dot(Vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])) / 6.0;
    }
  }
  return volume;
}

TEST_P(SphereRow, HasThePublishedCountsAndIsValid)
{
  const Row& row = GetParam();
  if (row.large && !isFullCampaign())
  {
    GTEST_SKIP() << "set ATRIA_TEST_FULL for the largest mesh";
  }
  GridOptions grid;
  grid.domain = {Vec3::Constant(-5.0), Vec3::Constant(5.0)};
  grid.sizeMin = grid.sizeMid = row.size;
  grid.sizeMax = row.adaptive ? 100.0 : row.size;
  const Meshed meshed = meshIt(sphereInCube(6), grid, {}, 2);
  const DualMesh& mesh = meshed.mesh();
  const double tolerance = row.adaptive ? 0.03 : 0.002;
  EXPECT_NEAR(static_cast<double>(mesh.points.size()) / row.vertices, 1.0, tolerance);
  EXPECT_NEAR(static_cast<double>(mesh.elementCount()) / row.elements, 1.0, tolerance);
  EXPECT_TRUE(isConformal(mesh));
  if (!row.large)
  {
    EXPECT_TRUE(elementsAreClosed(mesh));
    EXPECT_TRUE(boundaryIsWatertight(mesh));
  }
  const std::vector<double> all = volumes(mesh);
  EXPECT_GT(*std::min_element(all.begin(), all.end()), 0.0);
  // What holds exactly: elements fill what their boundary encloses. That boundary is flat on the cube; on the sphere it
  // is an inscribed polyhedron, whose volume differs from the ball's in the second order of the size.
  EXPECT_NEAR(totalVolume(mesh) / enclosedVolume(mesh), 1.0, 1e-9);
  const double ball = 4.0 / 3.0 * std::numbers::pi * 8.0;
  EXPECT_NEAR(totalVolume(mesh), 1000.0 - ball, 1.5 * ball * row.size * row.size / 4.0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < corners.count; ++i)
    {
      const Vec3& p = mesh.points[corners.points[i]];
      if (face.onDomainSide)
      {
        ASSERT_EQ(std::abs(p[axisOf(face.direction)]), 5.0);
        ASSERT_EQ(face.tag, 0u) << "the cube names the sides";
      }
      else
      {
        ASSERT_NEAR(p.norm(), 2.0, 1e-3);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Published, SphereRow,
                         ::testing::Values(Row{0.2, false, 129371, 120837, false},
                                           Row{0.1, false, 1000984, 966536, false},
                                           Row{0.05, false, 7869492, 7731934, true},
                                           Row{0.2, true, 32435, 31161, false}, Row{0.1, true, 132443, 129207, false},
                                           Row{0.05, true, 540140, 533562, false}));

} // namespace
