// SPDX-License-Identifier: GPL-3.0-or-later
/// Upright edges of solids whose tips reach a little beyond an edge of the grid.
#include "Mesher/MeshModel.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

namespace {

using namespace atria;

constexpr double size = 0.25;
/// Grid points are at odd multiples of half an octant.
constexpr double gridLine = 12.5 * size;
constexpr double height = 15.0 * size;

/// A post, four octants wide and turned, whose edge with the largest y is at `tip`.
TriangleSurface postWithTipAt(const Eigen::Vector2d& tip, double degrees)
{
  TriangleSurface post;
  const double half = 2.0 * size;
  atria::testing::addBox(post, "Post", {Vec3(-half, -half, 0), Vec3(half, half, height)});
  atria::testing::turn(post, degrees);
  const Vec3 far = *std::ranges::max_element(post.points, {}, [](const Vec3& p) { return p[1]; });
  for (Vec3& p : post.points)
  {
    p += Vec3(tip[0] - far[0], tip[1] - far[1], 0.0);
  }
  return post;
}

class Nicks : public ::testing::TestWithParam<double>
{
};

TEST_P(Nicks, KeepTheirEdgesAndAreas)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3(-10, -10, 0), Vec3(10, 10, 10)};
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = 2.0 * size;
  options.sizes.sizeMax = 8.0 * size;
  const double width = 4.0 * size;
  const double area = 4.0 * width * height + width * width;
  for (const double beyond : {0.02 * size, 0.12 * size})
  {
    for (const double along : {0.2, 0.4, 0.6})
    {
      SCOPED_TRACE(::testing::Message() << beyond << " beyond, " << along << " along");
      const Eigen::Vector2d tip(2.5 * size + along * size, gridLine + beyond);
      const MeshedModel meshed = meshModel(postWithTipAt(tip, GetParam()), options, atria::testing::quietContext());
      const SurfaceAudit& post = meshed.audit.surfaces.front();
      EXPECT_NEAR(post.meshArea, area, 0.002 * area);
      EXPECT_LT(post.distances.ofFaces.inElements, 0.15);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Nicks, ::testing::Values(5.0, 17.0, 30.0));

} // namespace
