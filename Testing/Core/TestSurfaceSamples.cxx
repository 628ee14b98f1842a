// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests where surfaces are sampled: at the cuts of grid edges that are seen from air.
#include "Audit/SurfaceSamples.h"
#include "AuditSetting.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using namespace atria;
using atria::testing::quietContext;
using atria::testing::Setting;
using ::testing::IsEmpty;

/// The first points of a grid of some points.
class OwnPoints : public GridPart
{
public:
  OwnPoints(Index begin, Index end) : GridPart({begin, end}, {0, 1}, alone()) {}
};

/// Edges of a grid with cuts, and what is at their ends.
struct CutEdges : Setting
{
  /// Adds a triangle of a wall, or of one that can be looked through.
  Index addSurfaceOf(SurfaceKind kind)
  {
    const auto surface = static_cast<Index>(model.names.size());
    addTriangle(surface, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    model.kinds.push_back(kind);
    return static_cast<Index>(model.triangles.size() - 1);
  }

  /// Adds an edge from (0, 0, 0) to (1, 2, 4) between two points of their own, one after the other; no second point if
  /// `hasOther` is false. Cuts are at a tenth, two tenths and so on.
  void addEdge(const std::vector<Index>& triangles, View first, View second, bool hasOther = true)
  {
    const auto pointOf = [&](View view) {
      zones.ofPoint.push_back(static_cast<std::int32_t>(view));
      return static_cast<Index>(zones.ofPoint.size() - 1);
    };
    const Index point = pointOf(first);
    const Index other = pointOf(second);
    const EdgeSegment segment{frame.toLattice(Vec3(0, 0, 0)),
                              frame.toLattice(Vec3(1, 2, 4)),
                              -1,
                              frame.latticeSize(frame.depth - 1),
                              {0, 0, noIndex, noIndex}};
    crossings.crossedEdges.push_back({point, hasOther ? other : noIndex, xMax, segment,
                                      static_cast<std::uint32_t>(crossings.cuts.size()),
                                      static_cast<std::uint32_t>(triangles.size())});
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      crossings.cuts.push_back({triangles[i], 1, 0.1 * static_cast<double>(i + 1)});
    }
  }

  std::vector<SurfaceSample> sample(Index begin, Index end, int threads = 1) const
  {
    std::vector<View> views; // zones have the numbers of their views
    for (std::size_t view = 0; view < viewCount; ++view)
    {
      views.push_back(static_cast<View>(view));
    }
    const ThreadExecutor executor(threads);
    const TriangleTreeOnDemand tree(model);
    return sampleSurfaces(crossings, zones, views, OwnPoints(begin, end),
                          MeshingContext{quietContext(executor), octree, model, tree});
  }
  std::vector<SurfaceSample> sampleAll(int threads = 1) const
  {
    return sample(0, static_cast<Index>(zones.ofPoint.size()), threads);
  }
  std::vector<Index> surfacesOf() const
  {
    std::vector<Index> surfaces;
    std::ranges::transform(sampleAll(), std::back_inserter(surfaces), &SurfaceSample::surface);
    return surfaces;
  }

  Crossings crossings;
  Zones zones;
};

/// Returns the places of the cuts that are seen, in order: from the start, then from the end.
std::vector<std::size_t> naiveSeen(const std::vector<bool>& isWall, bool airAtStart, bool airAtEnd)
{
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < isWall.size() && airAtStart; ++i)
  {
    if (std::find(isWall.begin(), isWall.begin() + static_cast<std::ptrdiff_t>(i), true) ==
        isWall.begin() + static_cast<std::ptrdiff_t>(i))
    {
      seen.push_back(i);
    }
  }
  for (std::size_t i = isWall.size(); i-- > 0 && airAtEnd;)
  {
    const auto after = isWall.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (std::find(after, isWall.end(), true) == isWall.end() && std::ranges::count(seen, i) == 0)
    {
      seen.push_back(i);
    }
  }
  return seen;
}

TEST(SurfaceSamples, AreTakenUpToTheFirstWallFromEachEnd)
{
  for (std::size_t count = 0; count <= 4; ++count)
  {
    for (unsigned bits = 0; bits < 4U << count; ++bits)
    {
      CutEdges edges;
      std::vector<bool> isWall;
      std::vector<Index> triangles;
      for (std::size_t i = 0; i < count; ++i)
      {
        isWall.push_back((bits >> i & 1U) != 0);
        triangles.push_back(edges.addSurfaceOf(isWall.back() ? SurfaceKind::wall : SurfaceKind::faceZone));
      }
      const bool airAtStart = (bits >> count & 1U) != 0;
      const bool airAtEnd = (bits >> (count + 1) & 1U) != 0;
      edges.addEdge(triangles, airAtStart ? View::air : View::solid, airAtEnd ? View::air : View::room);
      std::vector<Index> expected;
      for (const std::size_t place : naiveSeen(isWall, airAtStart, airAtEnd))
      {
        expected.push_back(edges.model.surfaceIds[triangles[place]]);
      }
      EXPECT_EQ(edges.surfacesOf(), expected) << count << ' ' << bits;
    }
  }
}

TEST(SurfaceSamples, LieWhereTheEdgeIsCut)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  edges.addEdge({wall, wall, wall}, View::air, View::air);
  const std::vector<SurfaceSample> samples = edges.sampleAll();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_LT((samples[0].at - Vec3(0.1, 0.2, 0.4)).norm(), 1e-6);
  EXPECT_LT((samples[1].at - Vec3(0.3, 0.6, 1.2)).norm(), 1e-6);
  EXPECT_FLOAT_EQ(samples[0].size, 0.5F) << "octants of the second level from below";
}

TEST(SurfaceSamples, AreTakenFromAirOnly)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  for (const View view : {View::nothing, View::ground, View::solid, View::narrow, View::room, View::beyond})
  {
    edges.addEdge({wall}, view, view);
  }
  edges.addEdge({wall}, View::solid, View::air, false); // outside of the domain there is no air
  EXPECT_THAT(edges.surfacesOf(), IsEmpty());
  edges.addEdge({wall}, View::solid, View::air);
  EXPECT_EQ(edges.surfacesOf().size(), 1U);
}

TEST(SurfaceSamples, AreNotTakenOnSidesOfADomainNorInClusters)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  edges.addEdge({wall}, View::air, View::solid);
  EXPECT_EQ(edges.surfacesOf().size(), 1U);
  for (const FeatureType type : {FeatureType::several, FeatureType::cluster})
  {
    edges.octree.setItems({0, 0}, {}, {type});
    EXPECT_EQ(edges.surfacesOf().size(), type == FeatureType::cluster ? 0U : 1U);
  }
  edges.octree.setItems({0, 0}, {}, {FeatureType::none});
  edges.model.surfaceIds[wall] = static_cast<Index>(edges.model.names.size());
  EXPECT_THAT(edges.surfacesOf(), IsEmpty());
}

TEST(SurfaceSamples, AreTakenByTheOwnersOfEdgesInTheOrderOfThese)
{
  CutEdges edges;
  const Index first = edges.addSurfaceOf(SurfaceKind::wall);
  const Index second = edges.addSurfaceOf(SurfaceKind::wall);
  std::vector<Index> expected;
  std::mt19937 random(5);
  for (int i = 0; i < 9000; ++i) // more than two pieces
  {
    expected.push_back(static_cast<Index>(random() % 2));
    edges.addEdge({expected.back() == 0 ? first : second}, View::air, View::solid);
  }
  EXPECT_EQ(edges.surfacesOf(), expected);
  EXPECT_EQ(edges.sampleAll(3).size(), expected.size());
  const std::vector<SurfaceSample> some = edges.sample(4, 9); // starts of edges 2, 3 and 4
  ASSERT_EQ(some.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(some[i].surface, expected[i + 2]);
  }
}

} // namespace
