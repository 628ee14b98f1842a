// SPDX-License-Identifier: GPL-3.0-or-later
/// Where vertices may go, without a mesh about them.
#include "Optimize/Constraints/ChainConstraints.h"
#include "Optimize/Constraints/ModelConstraints.h"
#include "Optimize/Kernel/VertexConstraints.h"
#include "SizedOctree.h"
#include "Support/QuietContext.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double rounding = 1e-6;
constexpr double length = 8.0;
const Box3 walls{Vec3(-1.3, -1.1, -1.7), Vec3(1.9, 1.4, 1.2)};

class BoxConstraints : public ::testing::Test
{
protected:
  static Sized octreeAboutBox()
  {
    TriangleSurface surface;
    addBox(surface, "Box", walls);
    return sized(surface, gridOf(length, 0.5, 0.5, 0.5), {});
  }

  Index leafAt(const Vec3& p) const
  {
    Index found = noIndex;
    eachLeaf(box.octree, [&](Index leaf) {
      const bool isIn = (box.octree.center(leaf) - p).cwiseAbs().maxCoeff() <= 0.5 * sizeOf(box.octree, leaf);
      found = isIn ? leaf : found;
    });
    return found;
  }

  /// The chart in the plane x = high.
  Index chartOfWall() const
  {
    for (Index t = 0; t < box.model.triangles.size(); ++t)
    {
      const auto isOnWall = [&](int i) {
        return std::abs(box.frame.toModel(box.model.corner(t, i))[0] - walls.max[0]) < rounding;
      };
      if (isOnWall(0) && isOnWall(1) && isOnWall(2))
      {
        return box.model.charts[t];
      }
    }
    return noIndex;
  }

  /// The curve where x and y are high.
  Index curveOfWall() const
  {
    for (const FeatureEdge& edge : box.model.featureEdges)
    {
      const Vec3 a = box.frame.toModel(box.model.points[edge.a]);
      const Vec3 b = box.frame.toModel(box.model.points[edge.b]);
      const auto isThere = [](const Vec3& p) {
        return std::abs(p[0] - walls.max[0]) < rounding && std::abs(p[1] - walls.max[1]) < rounding;
      };
      if (isThere(a) && isThere(b))
      {
        return edge.curve;
      }
    }
    return noIndex;
  }

  /// Constraints of one vertex, which has been prepared.
  ModelConstraints constraintsOf(VertexClass vertexClass, const Vec3& at, const std::vector<Index>& pieces)
  {
    start = {at};
    classification.classes = {vertexClass};
    classification.leaves = {leafAt(at)};
    classification.offsets = {0, static_cast<Index>(pieces.size())};
    classification.pieces = pieces;
    ModelConstraints out(context, classification, start, vertexOf);
    out.prepare(vertexOf, context);
    return out;
  }

  Vec3 randomNear(const Vec3& p, double reach)
  {
    std::uniform_real_distribution<double> shift(-reach, reach);
    return p + Vec3(shift(random), shift(random), shift(random));
  }

  const Sized box = octreeAboutBox();
  const TriangleTreeOnDemand tree{box.model};
  const MeshingContext context{quietContext(), box.octree, box.model, tree};
  std::mt19937 random{1};
  std::vector<Vec3> start;
  const std::vector<Index> vertexOf{0};
  VertexClassification classification;
};

TEST_F(BoxConstraints, AVertexOnASurfaceGoesToItsNearestPoint)
{
  const Vec3 at(walls.max[0], 0.1, -0.2);
  const ModelConstraints constraints = constraintsOf(VertexClass::surface, at, {chartOfWall()});
  EXPECT_TRUE(constraints.isMovable(0));
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 p = randomNear(at, 4.0);
    Vec3 nearest = p.cwiseMax(walls.min).cwiseMin(walls.max);
    nearest[0] = walls.max[0];
    EXPECT_LT((constraints.place(0, p) - nearest).norm(), rounding);
  }
  const Ways ways = constraints.waysFrom(0, at, 0.01);
  ASSERT_EQ(ways.count, 2);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(ways.along[i].norm(), 1.0, rounding);
    EXPECT_NEAR(ways.along[i][0], 0.0, rounding);
  }
  EXPECT_NEAR(ways.along[0].dot(ways.along[1]), 0.0, rounding);
}

TEST_F(BoxConstraints, AVertexOnACurveStaysOnItAndNearItsOctant)
{
  const Vec3 at(walls.max[0], walls.max[1], 0.1);
  const ModelConstraints constraints = constraintsOf(VertexClass::curve, at, {curveOfWall()});
  const Vec3 center = box.octree.center(classification.leaves[0]);
  const double reach = 0.6 * sizeOf(box.octree, classification.leaves[0]);
  int stays = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 p = randomNear(at, 1.0);
    const Vec3 nearest(walls.max[0], walls.max[1], p[2]);
    const bool isNear = (nearest - center).cwiseAbs().maxCoeff() <= reach;
    EXPECT_LT((constraints.place(0, p) - (isNear ? nearest : at)).norm(), rounding);
    stays += isNear ? 0 : 1;
  }
  EXPECT_GT(stays, 10);
  EXPECT_LT(stays, 190);
  const Ways ways = constraints.waysFrom(0, at, 0.01);
  ASSERT_EQ(ways.count, 1);
  EXPECT_NEAR(std::abs(ways.along[0][2]), 1.0, rounding);
}

TEST_F(BoxConstraints, AFreeVertexGoesAnywhereInTheDomain)
{
  const Vec3 at(3.0, 3.0, 3.0);
  const ModelConstraints constraints = constraintsOf(VertexClass::free, at, {});
  EXPECT_EQ(constraints.waysFrom(0, at, 0.01).count, 3);
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 p = randomNear(at, 4.0);
    EXPECT_EQ(constraints.place(0, p), p.cwiseMax(box.frame.domain.min).cwiseMin(box.frame.domain.max));
  }
}

TEST_F(BoxConstraints, ADetachedVertexKeepsToItsLimit)
{
  const Vec3 at(walls.max[0], 0.1, -0.2);
  classification.displacementLimits[0] = {at, 0.05};
  const ModelConstraints constraints = constraintsOf(VertexClass::detached, at, {});
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 p = randomNear(at, 0.1);
    const Vec3 placed = constraints.place(0, p);
    EXPECT_LE((placed - at).cwiseAbs().maxCoeff(), 0.05 + rounding);
    EXPECT_TRUE((p - at).cwiseAbs().maxCoeff() > 0.05 || placed == p);
  }
}

TEST_F(BoxConstraints, AFixedVertexIsNotMovable)
{
  EXPECT_FALSE(constraintsOf(VertexClass::fixed, walls.max, {}).isMovable(0));
}

/// Lets points go anywhere, but the first nowhere.
class AllButTheFirst : public VertexConstraints
{
public:
  bool isMovable(Index point) const override { return point != 0; }
  Vec3 place(Index, const Vec3& p) const override { return p; }
};

TEST(ChainConstraints, AChainFollowsItsCopyByTheSharesOfItsWay)
{
  // Above the wall point 0 stand 2, 3 and the copy 4; point 1 has no layer.
  LayerMesh layer;
  layer.mesh.points = {Vec3(1, 2, 3), Vec3(5, 5, 5), Vec3(1, 2, 3.5), Vec3(1.5, 2, 4), Vec3(1, 2, 5)};
  layer.plainPoints = 2;
  layer.copies = {4, noIndex};
  layer.wallPoints = {0, 0, 0};
  layer.places = {1, 2, 3};
  AllButTheFirst points;
  const ChainConstraints chains(layer, points);
  for (const Index p : {2, 3, 4})
  {
    EXPECT_EQ(chains.leaderOf(p), 4u);
    EXPECT_TRUE(chains.isMovable(p));
  }
  EXPECT_DOUBLE_EQ(chains.shareOf(2), 0.25);
  EXPECT_DOUBLE_EQ(chains.shareOf(3), 0.5);
  EXPECT_EQ(chains.shareOf(4), 1.0);
  EXPECT_FALSE(chains.isMovable(0));
  EXPECT_TRUE(chains.isMovable(1));
  EXPECT_EQ(chains.leaderOf(1), 1u);
  EXPECT_EQ(chains.shareOf(1), 1.0);
}

/// Positions on a plane, a line, a point, or anywhere, through the point (1, 2, 3).
class Flat : public VertexConstraints
{
public:
  explicit Flat(std::vector<Vec3> directions) : along(std::move(directions)) {}
  bool isMovable(Index) const override { return true; }
  Vec3 place(Index, const Vec3& p) const override
  {
    Vec3 out(1, 2, 3);
    const Vec3 way = p - out;
    std::ranges::for_each(along, [&](const Vec3& one) { out += one.dot(way) * one; });
    return out;
  }
  const std::vector<Vec3> along;
};

TEST(VertexConstraints, GiveOrthogonalWaysWithinAllowedPositions)
{
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const std::vector<Vec3> all{axes.col(0), axes.col(1), axes.col(2)};
  for (std::size_t count = 0; count <= 3; ++count)
  {
    const Flat flat({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)});
    const Ways ways = flat.waysFrom(0, Vec3(1, 2, 3), 0.01);
    ASSERT_EQ(ways.count, static_cast<int>(count));
    for (std::size_t i = 0; i < count; ++i)
    {
      EXPECT_NEAR(ways.along[i].norm(), 1.0, 1e-9);
      EXPECT_LT((flat.place(0, Vec3(1, 2, 3) + ways.along[i]) - Vec3(1, 2, 3) - ways.along[i]).norm(), 1e-9);
      for (std::size_t j = 0; j < i; ++j)
      {
        EXPECT_NEAR(ways.along[i].dot(ways.along[j]), 0.0, 1e-9);
      }
    }
  }
}

} // namespace
