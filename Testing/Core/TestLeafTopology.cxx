// SPDX-License-Identifier: GPL-3.0-or-later
/// What the cut edges of one leaf say about a vertex there, on octrees alone: models whose walls cross octants at known
/// places.
#include "Dual/Grid/Crossings.h"
#include "Dual/Leaf/LeafTopology.h"
#include "SizedOctree.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace atria;
using namespace atria::testing;

/// An octree of equal octants, of 1 m with their centers at whole numbers, and what is said of its leaves.
class LeavesOf
{
public:
  explicit LeavesOf(const TriangleSurface& surface, double size = 1.0)
      : octants(sized(surface, gridOf(16.0, size, size, size), {})), points(findGridPoints(octants.octree, context)),
        places(octants.octree, points), crossings(findCrossings(places, octants.model, context)),
        byLeaf(edgesByLeaf(crossings, octants.octree.leafCount(), context)),
        curves(octants.octree, octants.model, context), topology_(octants.octree, octants.model, curves)
  {
  }

  Index leafAt(const Vec3& place) const
  {
    for (Index leaf = 0; leaf < octants.octree.leafCount(); ++leaf)
    {
      const Vec3 low = octants.frame.toModel(octants.octree.lowCorner(leaf));
      const Vec3 high = octants.frame.toModel(octants.octree.highCorner(leaf));
      if ((low.array() <= place.array()).all() && (place.array() < high.array()).all())
      {
        return leaf;
      }
    }
    ADD_FAILURE() << "no leaf at " << place.transpose();
    return 0;
  }

  const LeafTopology& at(Index leaf)
  {
    std::vector<CutEdge> seen;
    for (const Index edge : byLeaf.of(leaf))
    {
      seen.push_back(seenFrom(leaf, crossings.crossedEdges[edge].segment, crossings.of(crossings.crossedEdges[edge])));
    }
    topology_.analyze(leaf, seen);
    return topology_;
  }
  const LeafTopology& at(const Vec3& place) { return at(leafAt(place)); }

  Index leafCount() const { return static_cast<Index>(octants.octree.leafCount()); }

  Index chartOf(const std::string& name) const
  {
    for (Index t = 0; t < octants.model.triangles.size(); ++t)
    {
      if (octants.model.names[octants.model.surfaceIds[t]] == name)
      {
        return octants.model.charts[t];
      }
    }
    return noIndex;
  }

private:
  RunContext context = quietContext();
  Sized octants;
  GridPoints points;
  GridPlaces places;
  Crossings crossings;
  Buckets byLeaf;
  LeafCurves curves;
  LeafTopology topology_;
};

TriangleSurface box()
{
  TriangleSurface out;
  addBox(out, "Box", {Vec3(-2.4, -2.4, -2.4), Vec3(2.4, 2.4, 2.4)});
  return out;
}

TEST(LeafTopology, SeesTheFaceTheEdgesAndTheCornersOfABox)
{
  LeavesOf leaves(box());
  const LeafTopology& face = leaves.at(Vec3(0, 0, 2));
  EXPECT_EQ(face.charts().size(), 1u);
  EXPECT_TRUE(face.links().empty());
  EXPECT_FALSE(face.isKnot());
  EXPECT_EQ(face.sheets(), 1);
  EXPECT_TRUE(face.apart().empty());

  const Index onEdge = leaves.leafAt(Vec3(2, 0, 2));
  const LeafTopology& edge = leaves.at(onEdge);
  EXPECT_EQ(edge.charts().size(), 2u);
  ASSERT_EQ(edge.links().size(), 2u);
  EXPECT_EQ(edge.links()[0].ending, edge.charts());
  EXPECT_EQ(edge.links()[0].to, std::min(leaves.leafAt(Vec3(2, -1, 2)), leaves.leafAt(Vec3(2, 1, 2))));
  EXPECT_EQ(edge.curves(), std::vector<std::vector<Index>>(1, edge.charts()));
  EXPECT_FALSE(edge.isKnot());
  EXPECT_FALSE(edge.isEnd());
  EXPECT_EQ(edge.sheets(), 1);

  const LeafTopology& corner = leaves.at(Vec3(2, 2, 2));
  EXPECT_EQ(corner.charts().size(), 3u);
  EXPECT_EQ(corner.links().size(), 3u);
  EXPECT_EQ(corner.curves().size(), 3u);
  EXPECT_TRUE(corner.isKnot());
  EXPECT_EQ(corner.sheets(), 1);
}

TEST(LeafTopology, SeesTwoSheetsInOneLeaf)
{
  TriangleSurface sheets;
  addSheet(sheets, "Lower", {-9, -9, -0.2}, {18, 0, 0}, {0, 18, 0});
  addSheet(sheets, "Upper", {-9, -9, 0.1}, {18, 0, 0.36}, {0, 18, 0});
  LeavesOf leaves(sheets);
  const LeafTopology& found = leaves.at(Vec3(0, 0, 0));
  EXPECT_EQ(found.charts().size(), 2u);
  EXPECT_EQ(found.sheets(), 2);
  const std::pair<Index, Index> both = std::minmax({leaves.chartOf("Lower"), leaves.chartOf("Upper")});
  EXPECT_EQ(found.apart(), (std::vector<std::pair<Index, Index>>{both}));
  EXPECT_TRUE(found.links().empty()) << "neither ends there";
}

TEST(LeafTopology, SeesWhereASheetEnds)
{
  TriangleSurface sheet;
  addSheet(sheet, "Sheet", {-3.2, -3.2, 0.2}, {6.4, 0, 0}, {0, 6.4, 0});
  LeavesOf leaves(sheet);
  const LeafTopology& border = leaves.at(Vec3(3, 0, 0));
  EXPECT_EQ(border.charts().size(), 1u);
  EXPECT_EQ(border.links().size(), 2u);
  EXPECT_EQ(border.links()[0].ending, border.charts());
  EXPECT_FALSE(border.isKnot());
  const LeafTopology& corner = leaves.at(Vec3(3, 3, 0));
  EXPECT_EQ(corner.links().size(), 2u) << "one chart ends, so the two edges are one curve to the leaf";
}

TEST(LeafTopology, SeesACurveAlongWhichThreeSheetsMeet)
{
  TriangleSurface walls;
  addSheet(walls, "West", {-9, 0.3, -9}, {9.2, 0, 0}, {0, 0, 18});
  addSheet(walls, "East", {0.2, 0.3, -9}, {9, 0, 0}, {0, 0, 18});
  addSheet(walls, "North", {0.2, 0.3, -9}, {0, 9, 0}, {0, 0, 18});
  LeavesOf leaves(walls);
  const LeafTopology& found = leaves.at(Vec3(0, 0, 0));
  EXPECT_EQ(found.charts().size(), 3u);
  EXPECT_EQ(found.links().size(), 2u);
  EXPECT_EQ(found.links()[0].ending, found.charts());
  EXPECT_FALSE(found.isKnot());
  EXPECT_EQ(found.sheets(), 1);
}

/// Of every two leaves that a link joins each knows it, with the same charts.
TEST(LeafTopology, LinksAreMutualOnRandomModels)
{
  for (const unsigned seed : {1u, 2u, 3u})
  {
    LeavesOf leaves(randomSoup(seed), 0.5);
    std::map<std::pair<Index, Index>, std::vector<Index>> links;
    for (Index leaf = 0; leaf < leaves.leafCount(); ++leaf)
    {
      for (const LeafTopology::Link& link : leaves.at(leaf).links())
      {
        links[{leaf, link.to}] = link.ending;
      }
    }
    EXPECT_GT(links.size(), 100u);
    for (const auto& [between, ending] : links)
    {
      const auto back = links.find({between.second, between.first});
      ASSERT_NE(back, links.end()) << between.first << " to " << between.second;
      EXPECT_EQ(back->second, ending);
    }
  }
}

} // namespace
