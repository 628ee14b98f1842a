// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how triangles are cut at their contacts.
#include "Draw.h"
#include "RepairSamples.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Repair/TriangleCuts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::areaOf;
using atria::testing::Draw;
using atria::testing::quietContext;
using atria::testing::reach;
using atria::testing::Triangle;
using ::testing::Each;
using ::testing::ElementsAre;

struct Cut
{
  std::vector<Change> changes;
  std::vector<char> isSplit;
  std::set<EdgeKey> meetings;
};

void cut(TriangleSoup& soup, const Contacts& contacts, Cut& out)
{
  out.isSplit.resize(soup.sources.back() + 1, 0);
  cutTriangles(soup, contacts, static_cast<double>(reach), out.changes, out.isSplit, out.meetings, quietContext());
}

TEST(TriangleCuts, DivideATriangleAtPointsOnAnEdge)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90000, 0, 0}, {0, 90000, 0}, {60000, 0, 0}, {30000, 0, 0}, {90000, 90000, 0}};
  soup.add({2, 1, 0}, 3, 2);
  soup.add({1, 5, 2}, 4, 5);
  Contacts contacts;
  contacts.edges = {{{0, 1}, 3}, {{0, 1}, 4}};
  Cut result;
  result.meetings = {{0, 1}, {1, 2}};
  cut(soup, contacts, result);
  ASSERT_EQ(soup.triangles.size(), 4u);
  EXPECT_THAT(soup.sources, ElementsAre(2, 2, 2, 5));
  EXPECT_THAT(soup.surfaceIds, ElementsAre(3, 3, 3, 4));
  EXPECT_THAT(result.changes, ElementsAre(Change::cut, Change::cut, Change::cut, Change::none));
  EXPECT_THAT(result.isSplit, ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 4), EdgeKey(1, 2), EdgeKey(1, 3), EdgeKey(3, 4)));
  EXPECT_EQ(soup.triangles[3], (Triangle{1, 5, 2}));
  for (Index t = 0; t < 3; ++t)
  {
    EXPECT_TRUE(contains(soup.triangles[t], 2)) << "all pieces reach the opposite corner";
    EXPECT_LT(areaOf(soup, t)[2], 0.0) << "they are wound as before";
  }
}

TEST(TriangleCuts, DivideATriangleAtAPointInIt)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90000, 0, 0}, {0, 90000, 0}, {20000, 20000, 0}};
  soup.add({0, 1, 2}, 0, 0);
  soup.add({2, 1, 0}, 0, 1);
  Contacts contacts;
  contacts.faces = {{1, 3}};
  Cut result;
  result.meetings = {{0, 1}};
  cut(soup, contacts, result);
  EXPECT_EQ(soup.triangles.size(), 4u);
  EXPECT_THAT(result.changes, ElementsAre(Change::none, Change::cut, Change::cut, Change::cut));
  EXPECT_THAT(result.isSplit, ElementsAre(0, 1));
  EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 1)));
  for (Index t = 1; t < 4; ++t)
  {
    EXPECT_TRUE(contains(soup.triangles[t], 3));
  }
}

TEST(TriangleCuts, WithoutContactsChangeNothing)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {90, 0, 0}, {0, 90, 0});
  const TriangleSoup before = soup;
  Cut result;
  result.changes = {Change::moved};
  cut(soup, {}, result);
  EXPECT_EQ(soup.triangles, before.triangles);
  EXPECT_EQ(soup.points, before.points);
  EXPECT_THAT(result.changes, ElementsAre(Change::none));
  EXPECT_THAT(result.isSplit, ElementsAre(0));
}

/// Returns the edges of the pieces of a source.
std::set<EdgeKey> edgesOf(const TriangleSoup& soup, Index source)
{
  std::set<EdgeKey> edges;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3 && soup.sources[t] == source; ++i)
    {
      edges.insert(edgeKey(soup.triangles[t], i));
    }
  }
  return edges;
}

TEST(TriangleCuts, TrianglesThatCrossShareTheirLineAndKeepTheirAreas)
{
  Draw draw(11);
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  int crossing = 0;
  for (int round = 0; round < 300; ++round)
  {
    TriangleSoup soup;
    addTriangle(soup, draw.point(100000), draw.point(100000), draw.point(100000));
    addTriangle(soup, draw.point(100000), draw.point(100000), draw.point(100000));
    const std::array<Vec3, 2> areas{areaOf(soup, 0), areaOf(soup, 1)};
    const Contacts contacts = findContacts(soup, {changes, met, {}}, reach, {}, quietContext()).sorted(soup);
    if (contacts.newPoints.size() != 2 || contacts.pairs.size() != 1 ||
        between(contacts.newPoints[0], contacts.newPoints[1]).norm() < 5000.0)
    {
      continue;
    }
    ++crossing;
    soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
    Cut result;
    cut(soup, contacts, result);
    EXPECT_THAT(result.changes, Each(Change::cut));
    EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(6, 7)));
    std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      sums.at(soup.sources[t]) += areaOf(soup, t);
      EXPECT_GT(areaOf(soup, t).dot(areas.at(soup.sources[t])), 0.0);
    }
    for (const Index source : {0u, 1u})
    {
      EXPECT_LT((sums.at(source) - areas.at(source)).norm(), 1e-3 * areas.at(source).norm());
      EXPECT_TRUE(edgesOf(soup, source).contains(EdgeKey(6, 7))) << round;
    }
  }
  EXPECT_GT(crossing, 30);
}

TEST(TriangleCuts, JoinACornerWithAPointOnTheOppositeEdge)
{
  // Triangle 1 cuts triangle 0 from their common corner to the middle of its opposite edge. Another point near the cut
  // would keep the two apart if the cut were no segment.
  for (int turn = 0; turn < 3; ++turn)
  {
    TriangleSoup soup;
    soup.points = {{0, 0, 0},         {90000, 0, 0},    {0, 90000, 0}, {90000, 90000, -50000}, {90000, 90000, 50000},
                   {45000, 45000, 0}, {24000, 21000, 0}};
    soup.add({0, 1, 2}, 0, 0);
    soup.add({0, 3, 4}, 0, 1);
    std::rotate(soup.triangles[0].begin(), soup.triangles[0].begin() + turn, soup.triangles[0].end());
    Contacts contacts;
    contacts.edges = {{{1, 2}, 5}};
    contacts.faces = {{0, 6}, {1, 5}};
    contacts.pairs = {{0, 1}};
    Cut result;
    cut(soup, contacts, result);
    EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 5)));
    EXPECT_TRUE(edgesOf(soup, 0).contains(EdgeKey(0, 5))) << turn;
    EXPECT_TRUE(edgesOf(soup, 1).contains(EdgeKey(0, 5))) << turn;
  }
}

TEST(TriangleCuts, MakeEdgesOfTheOutlineOfAnOverlap)
{
  // Two triangles in one plane overlap in a hexagon.
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {90000, 0, 0}, {45000, 90000, 0});
  addTriangle(soup, {0, 60000, 0}, {45000, -30000, 0}, {90000, 60000, 0});
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  const Contacts contacts = findContacts(soup, {changes, met, {}}, reach, {}, quietContext()).sorted(soup);
  ASSERT_EQ(contacts.newPoints.size(), 6u);
  soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
  Cut result;
  cut(soup, contacts, result);
  // Points 6 to 11 are sorted by x: left, two upper and lower left ones, and so on.
  std::set<EdgeKey> common;
  std::ranges::set_intersection(edgesOf(soup, 0), edgesOf(soup, 1), std::inserter(common, common.end()));
  double length = 0.0;
  for (const EdgeKey& edge : result.meetings)
  {
    EXPECT_TRUE(common.contains(edge));
    length += between(soup.points[edge.first], soup.points[edge.second]).norm();
  }
  EXPECT_EQ(result.meetings.size(), 6u);
  double expected = 0.0;
  for (const auto& [a, b] : {std::pair<LatticePoint, LatticePoint>{{15000, 30000, 0}, {30000, 0, 0}},
                             {{30000, 0, 0}, {60000, 0, 0}},
                             {{60000, 0, 0}, {75000, 30000, 0}},
                             {{75000, 30000, 0}, {60000, 60000, 0}},
                             {{60000, 60000, 0}, {30000, 60000, 0}},
                             {{30000, 60000, 0}, {15000, 30000, 0}}})
  {
    expected += between(a, b).norm();
  }
  EXPECT_NEAR(length, expected, 10.0);
}

} // namespace
