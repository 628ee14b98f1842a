// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests which vertices take the corners of a model.
#include "Dual/Leaf/FeatureCorners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Ending = std::vector<Index>;
using Endings = std::vector<Ending>;

/// Octants of 2 m from -0.5 to 7.5 m on each axis.
Octree coarseOctree()
{
  GridFrame frame;
  frame.depth = 3;
  frame.origin = Vec3::Constant(-0.5);
  frame.domain = {Vec3::Zero(), Vec3::Constant(7.0)};
  fitLattice(frame, {});
  return {frame, {{0}, {0, 1, 2, 3, 4, 5, 6, 7}}};
}

/// A corner of a model, and the curves that meet there by the charts that end.
struct CornerAt
{
  Vec3 place;
  Endings endings;
};

/// Corners with an edge for each of their curves; none is the point of its own number.
SurfaceModel modelWith(const GridFrame& frame, const std::vector<CornerAt>& corners)
{
  SurfaceModel model;
  model.points.push_back(frame.toLattice(Vec3::Zero()));
  for (const CornerAt& corner : corners)
  {
    const auto point = static_cast<Index>(model.points.size());
    model.corners.push_back(point);
    model.points.push_back(frame.toLattice(corner.place));
    for (const Ending& ending : corner.endings)
    {
      const auto curve = static_cast<Index>(model.curves.size());
      model.featureEdges.push_back(curve % 2 == 0 ? FeatureEdge{point, 0, curve} : FeatureEdge{0, point, curve});
      model.curves.push_back({CurveKind::crease, ending, ending});
    }
  }
  return model;
}

/// A vertex of a kind, in the leaf that holds a place.
struct VertexAt
{
  Vec3 place;
  ChainVertex::Kind kind;
  Endings curves;
};

/// The corner, counted in order, that each vertex takes; -1 for none. Vertices are in order of their leaves.
std::vector<int> takenCorners(const std::vector<CornerAt>& corners, const std::vector<VertexAt>& vertices)
{
  const Octree octree = coarseOctree();
  const SurfaceModel model = modelWith(octree.frame(), corners);
  std::vector<ChainVertex> chain;
  for (const VertexAt& vertex : vertices)
  {
    ChainVertex one;
    one.vertex = static_cast<Index>(chain.size());
    one.leaf = octree.leafAt(octree.frame().toLattice(vertex.place));
    one.kind = vertex.kind;
    one.curves = vertex.curves;
    EXPECT_TRUE(chain.empty() || chain.back().leaf < one.leaf);
    chain.push_back(one);
  }
  std::vector<int> taken;
  for (const Index point : assignCorners(octree, model, chain))
  {
    const auto found = std::ranges::find(model.corners, point);
    taken.push_back(found == model.corners.end() ? -1 : static_cast<int>(found - model.corners.begin()));
  }
  return taken;
}

const Endings three{{0, 1}, {0, 2}, {1, 2}};
const Endings single{{0, 1}};
/// Centers of two octants side by side, with a common face at x = 3.5.
const Vec3 lower(2.5, 2.5, 2.5);
const Vec3 upper(4.5, 2.5, 2.5);

TEST(FeatureCorners, HaveTheCurvesOfTheirEdges)
{
  const GridFrame frame = coarseOctree().frame();
  SurfaceModel model =
      modelWith(frame, {{lower, {{2, 3}, {0, 1}, {2, 3}}}, {upper, {}}, {Vec3(1, 1, 1), {{5}, {1, 9}, {1}}}});
  const Endings none;
  EXPECT_THAT(curvesAtCorners(model), ElementsAre(Endings{{0, 1}, {2, 3}}, none, Endings{{1}, {1, 9}, {5}}));
  model.featureEdges.push_back({model.corners[1], model.corners[0], 4});
  EXPECT_THAT(curvesAtCorners(model),
              ElementsAre(Endings{{0, 1}, {1, 9}, {2, 3}}, Endings{{1, 9}}, Endings{{1}, {1, 9}, {5}}));
}

TEST(FeatureCorners, AreTakenByAVertexWithOneOfTheirCurves)
{
  for (const auto kind : {ChainVertex::along, ChainVertex::sideEnd, ChainVertex::knot})
  {
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{0, 2}}}}), ElementsAre(0));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{0, 2}, {7}}}}), ElementsAre(0));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{7}}}}), ElementsAre(-1));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {}}}), ElementsAre(-1));
  }
  EXPECT_THAT(takenCorners({}, {{lower, ChainVertex::knot, three}}), ElementsAre(-1));
  EXPECT_THAT(takenCorners({{lower, three}}, {}), IsEmpty());
}

TEST(FeatureCorners, AreTakenUpToATenthMoreThanHalfAnOctantAway)
{
  const VertexAt vertex{lower, ChainVertex::knot, three};
  for (const auto& [place, expected] : std::vector<std::pair<Vec3, int>>{{Vec3(4.69, 2.5, 2.5), 0},
                                                                         {Vec3(4.71, 2.5, 2.5), -1},
                                                                         {Vec3(2.5, 0.31, 2.5), 0},
                                                                         {Vec3(2.5, 0.29, 2.5), -1},
                                                                         {Vec3(2.5, 2.5, 4.69), 0},
                                                                         {Vec3(2.5, 2.5, 4.71), -1},
                                                                         {Vec3(4.3, 4.3, 2.5), 0},
                                                                         {Vec3(4.4, 4.4, 2.5), -1},
                                                                         {Vec3(4.1, 4.1, 4.1), 0},
                                                                         {Vec3(4.3, 4.3, 4.3), -1}})
  {
    EXPECT_THAT(takenCorners({{place, three}}, {vertex}), ElementsAre(expected)) << place.transpose();
  }
}

TEST(FeatureCorners, OnABorderBelongToTheLowerOctant)
{
  const Vec3 border(3.5, 2.5, 2.5);
  const VertexAt below{lower, ChainVertex::knot, three};
  const VertexAt above{upper, ChainVertex::knot, three};
  EXPECT_THAT(takenCorners({{border, three}}, {below, above}), ElementsAre(0, -1));
  EXPECT_THAT(takenCorners({{border, three}}, {above}), ElementsAre(0)) << "the upper one touches it";
}

TEST(FeatureCorners, OutsideOfTheOctreeAreNobodys)
{
  const VertexAt first{Vec3(0, 0, 0), ChainVertex::knot, three};
  const VertexAt last{Vec3(7, 7, 7), ChainVertex::knot, three};
  EXPECT_THAT(takenCorners({{Vec3(-0.6, 0, 0), three}, {Vec3(7, 7, 7.6), three}}, {first, last}), ElementsAre(-1, -1));
  EXPECT_THAT(takenCorners({{Vec3(-0.4, 0, 0), three}, {Vec3(7, 7, 7.5), three}}, {first, last}), ElementsAre(0, 1));
}

/// A vertex in the corner's octant against one that suits better at a distance: the distance at which both do as well.
struct Misfit
{
  ChainVertex::Kind kind;
  Endings curves;
  double distance;
};

TEST(FeatureCorners, PreferVerticesWhoseCurvesAgree)
{
  for (const Misfit& own : {Misfit{ChainVertex::knot, {{0, 1}, {0, 2}}, 0.2},
                            {ChainVertex::knot, {{0, 1}, {0, 2}, {7}}, 0.4},
                            {ChainVertex::sideEnd, single, 0.1},
                            {ChainVertex::along, single, 0.6}})
  {
    for (const double off : {-0.02, 0.02})
    {
      const double distance = own.distance + off;
      const Vec3 place(3.5 - 2.0 * distance, 2.5, 2.5);
      const bool isOther = off < 0.0;
      EXPECT_THAT(takenCorners({{place, three}}, {{lower, own.kind, own.curves}, {upper, ChainVertex::knot, three}}),
                  ElementsAre(isOther ? -1 : 0, isOther ? 0 : -1))
          << own.distance << " " << off;
    }
  }
  for (const auto kind : {ChainVertex::along, ChainVertex::sideEnd, ChainVertex::knot})
  {
    const Vec3 place(3.49, 2.5, 2.5); // a corner where one curve turns suits all alike
    EXPECT_THAT(takenCorners({{place, single}}, {{lower, kind, single}, {upper, ChainVertex::knot, single}}),
                ElementsAre(0, -1));
  }
}

TEST(FeatureCorners, GoToOneVertexEachTheNearestFirst)
{
  const VertexAt below{lower, ChainVertex::knot, three};
  const VertexAt above{upper, ChainVertex::knot, three};
  const CornerAt near{Vec3(3.7, 2.5, 2.5), three};
  const CornerAt far{Vec3(4.0, 2.5, 2.5), three};
  EXPECT_THAT(takenCorners({far, near}, {below}), ElementsAre(1));
  EXPECT_THAT(takenCorners({near, far}, {below}), ElementsAre(0));
  EXPECT_THAT(takenCorners({near}, {below, above}), ElementsAre(-1, 0));
  EXPECT_THAT(takenCorners({far, near}, {below, above}), ElementsAre(1, 0)) << "the second takes the other vertex";
  const CornerAt within{Vec3(2.2, 2.2, 2.2), three};
  EXPECT_THAT(takenCorners({within, {lower, three}}, {below}), ElementsAre(0)) << "the first of equal ones";
}

} // namespace
