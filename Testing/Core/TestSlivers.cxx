// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the points that slivers share with their neighbors.
#include "Draw.h"
#include "Surface/Repair/Slivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;
using Triangle = std::array<Index, 3>;

/// Adds points to the edges of the slivers until nothing changes.
std::set<EdgeContact> naiveAligned(const TriangleSoup& soup, const std::vector<EdgeContact>& contacts)
{
  const std::set<EdgeContact> given(contacts.begin(), contacts.end());
  std::set<EdgeContact> all = given;
  for (std::size_t before = 0; before != all.size();)
  {
    before = all.size();
    for (const Triangle& t : soup.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        const EdgeKey edge = edgeKey(t, i);
        const Index apex = t.at(static_cast<std::size_t>((i + 2) % 3));
        if (!all.contains({edge, apex}) || !given.contains({edge, apex}))
        {
          continue;
        }
        for (const EdgeContact& c : std::set<EdgeContact>(all))
        {
          const bool isBefore = std::abs(soup.points[c.point][0] - soup.points[edge.first][0]) <
                                std::abs(soup.points[apex][0] - soup.points[edge.first][0]);
          const EdgeKey part = isBefore ? edgeKey(edge.first, apex) : edgeKey(edge.second, apex);
          if (c.edge == edge && c.point != apex)
          {
            all.insert({part, c.point});
          }
          if (c.edge == edgeKey(edge.first, apex) || c.edge == edgeKey(edge.second, apex))
          {
            all.insert({edge, c.point});
          }
        }
      }
    }
  }
  return all;
}

/// Points in a row, in a random order, and triangles between them. Some have a corner on their long edge as a contact.
void drawSlivers(Draw& draw, TriangleSoup& soup, std::vector<EdgeContact>& contacts)
{
  std::vector<std::int64_t> places(12);
  std::iota(places.begin(), places.end(), 0);
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
  {
    std::swap(places[i], places[i + draw.below(places.size() - i)]);
  }
  std::ranges::for_each(places, [&](std::int64_t x) { soup.points.push_back({100 * x, 50 * x, 0}); });
  std::set<EdgeContact> drawn;
  for (Index i = 0; i < 4; ++i)
  {
    Triangle t = draw.triangle(12);
    if (hasRepeatedPoint(t))
    {
      continue;
    }
    soup.add(t, 0, i);
    std::ranges::sort(t, {}, [&](Index p) { return places[p]; });
    if (draw.in(0, 3) > 0)
    {
      drawn.insert({edgeKey(t[0], t[2]), t[1]});
    }
    for (Index p = 0; p < 12; ++p)
    {
      const std::size_t side = draw.below(2);
      if (draw.in(0, 3) == 0 && places[p] > places[t.at(side)] && places[p] < places[t.at(side + 1)])
      {
        drawn.insert({edgeKey(t.at(side), t.at(side + 1)), p});
      }
    }
  }
  contacts.assign(drawn.begin(), drawn.end());
}

TEST(Slivers, HaveTheSamePointsOnTheLongEdgeAsOnTheOthers)
{
  Draw draw(10);
  std::size_t added = 0;
  for (int round = 0; round < 1000; ++round)
  {
    TriangleSoup soup;
    std::vector<EdgeContact> contacts;
    drawSlivers(draw, soup, contacts);
    const std::set<EdgeContact> expected = naiveAligned(soup, contacts);
    added += expected.size() - contacts.size();
    alignSlivers(soup, contacts);
    EXPECT_TRUE(std::ranges::equal(contacts, expected));
  }
  EXPECT_GT(added, 500u);
}

TEST(Slivers, TakePointsFromTheLongEdgeAndGivePointsToIt)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {100, 0, 0}, {50, 0, 0}, {20, 0, 0}, {70, 0, 0}, {80, 0, 0}};
  soup.add({0, 1, 2}, 0, 0);
  std::vector<EdgeContact> contacts{{{0, 1}, 2}, {{0, 1}, 3}, {{0, 1}, 4}, {{1, 2}, 5}};
  alignSlivers(soup, contacts);
  EXPECT_EQ(contacts, (std::vector<EdgeContact>{
                          {{0, 1}, 2}, {{0, 1}, 3}, {{0, 1}, 4}, {{0, 1}, 5}, {{0, 2}, 3}, {{1, 2}, 4}, {{1, 2}, 5}}));
}

TEST(Slivers, LeaveOtherTrianglesAlone)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {100, 0, 0}, {50, 80, 0}, {20, 0, 0}};
  soup.add({0, 1, 2}, 0, 0);
  const std::vector<EdgeContact> before{{{0, 1}, 3}};
  std::vector<EdgeContact> contacts = before;
  alignSlivers(soup, contacts);
  EXPECT_EQ(contacts, before);
}

} // namespace
