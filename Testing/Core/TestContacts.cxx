// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests lists of contacts, and between which triangles contacts are sought.
#include "Draw.h"
#include "RepairSamples.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/ContactFinder.h"
#include "Surface/Repair/Contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::Draw;
using atria::testing::gridSoup;
using atria::testing::quietContext;
using atria::testing::reach;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Contacts, MarkTheBeginsOfEdgesWithPoints)
{
  const std::vector<EdgeContact> contacts{{{0, 3}, 9}, {{0, 4}, 9}, {{2, 4}, 1}};
  EXPECT_THAT(beginsOfEdges(contacts, 5), ElementsAre(1, 0, 1, 0, 0));
  EXPECT_THAT(beginsOfEdges({}, 2), ElementsAre(0, 0));
}

/// Contacts of the pairs (0, 1), (1, 2) and (0, 3) of a soup of ten points. One contact belongs to no pair.
FoundContacts someContacts()
{
  FoundContacts found;
  found.newPoints = {{9, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  found.edges = {{{7, 8}, 2}, {{1, 2}, 10}, {{3, 4}, 11}, {{1, 2}, 12}, {{5, 6}, 0}};
  found.faces = {{1, 10}, {0, 12}, {3, 5}};
  found.pairs = {{0, 1, 1, 3, 0, 1}, {1, 2, 3, 4, 1, 2}, {0, 3, 4, 5, 2, 3}};
  return found;
}

TriangleSoup soupOfTenPoints()
{
  TriangleSoup soup;
  soup.points.resize(10);
  soup.triangles.resize(4, {0, 1, 2});
  soup.sources = {0, 1, 1, 4};
  return soup;
}

TEST(Contacts, AreSortedWithoutRepeatsAndNumberPointsByPlace)
{
  const Contacts contacts = someContacts().sorted(soupOfTenPoints());
  EXPECT_THAT(contacts.newPoints, ElementsAre(LatticePoint{1, 0, 0}, LatticePoint{9, 0, 0}));
  EXPECT_EQ(contacts.edges, (std::vector<EdgeContact>{{{1, 2}, 11}, {{3, 4}, 10}, {{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(contacts.faces, (std::vector<FaceContact>{{0, 11}, {1, 11}, {3, 5}}));
  EXPECT_THAT(contacts.pairs, ElementsAre(std::pair(0, 1), std::pair(0, 3), std::pair(1, 2)));
  EXPECT_FALSE(contacts.empty());
  EXPECT_TRUE(Contacts{}.empty());
}

TEST(Contacts, LeaveOutPairsOfSourcesThatAreLeft)
{
  const TriangleSoup soup = soupOfTenPoints();
  const FoundContacts found = someContacts();
  const Contacts contacts = found.sorted(soup, {0, 1, 0, 0, 0}); // pair (1, 2) is of source 1 alone
  EXPECT_THAT(contacts.newPoints, ElementsAre(LatticePoint{1, 0, 0}, LatticePoint{9, 0, 0}));
  EXPECT_EQ(contacts.edges, (std::vector<EdgeContact>{{{1, 2}, 11}, {{3, 4}, 10}, {{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(contacts.faces, (std::vector<FaceContact>{{1, 11}, {3, 5}}));
  EXPECT_THAT(contacts.pairs, ElementsAre(std::pair(0, 1), std::pair(0, 3)));
  const Contacts few = found.sorted(soup, {1, 1, 0, 0, 0});
  EXPECT_EQ(few.edges, (std::vector<EdgeContact>{{{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(few.faces, (std::vector<FaceContact>{{3, 5}}));
  EXPECT_THAT(few.newPoints, IsEmpty());
}

TEST(Contacts, CountThoseThatAreLeftWithoutRepeats)
{
  const TriangleSoup soup = soupOfTenPoints();
  const FoundContacts found = someContacts();
  EXPECT_EQ(found.countLeft(soup, {}), 0u);
  EXPECT_EQ(found.countLeft(soup, {0, 1, 0, 0, 1}), 2u) << "an edge and a face of pair (1, 2)";
  EXPECT_EQ(found.countLeft(soup, {1, 1, 0, 0, 0}), 4u) << "two edges and two faces: one edge is repeated";
  EXPECT_EQ(found.countLeft(soup, {1, 1, 0, 0, 1}), 6u);
}

TEST(MetSources, HoldPairsWhicheverComesFirst)
{
  Draw draw(7);
  TriangleSoup soup;
  for (Index t = 0; t < 40; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  MetSources met;
  EXPECT_FALSE(met.contains(0, 1));
  std::set<std::pair<Index, Index>> expected;
  for (const std::size_t count : {0u, 1u, 5u, 60u})
  {
    std::vector<FoundContacts::Pair> pairs;
    for (std::size_t i = 0; i < count; ++i)
    {
      pairs.push_back({draw.below(40), draw.below(40), 0, 0, 0, 0});
      const Index first = pairs.back().first / 2;
      const Index second = pairs.back().second / 2;
      expected.emplace(std::min(first, second), std::max(first, second));
    }
    met.add(soup, pairs);
    for (Index a = 0; a < 22; ++a)
    {
      for (Index b = 0; b < 22; ++b)
      {
        EXPECT_EQ(met.contains(a, b), expected.contains({std::min(a, b), std::max(a, b)})) << a << ' ' << b;
      }
    }
  }
}

TEST(AskedPairs, AreThoseThatMovedOrWereCutAndHaveMet)
{
  TriangleSoup soup;
  for (Index t = 0; t < 6; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  const std::vector<Change> changes{Change::moved, Change::none, Change::cut, Change::cut, Change::cut, Change::none};
  MetSources met;
  met.add(soup, {{2, 4, 0, 0, 0, 0}}); // sources 1 and 2
  const std::vector<char> none;
  const AskedPairs asked{changes, met, none};
  const std::vector<std::tuple<Index, Index, bool>> cases{{0, 1, false}, {0, 2, true},  {2, 0, true},
                                                          {0, 5, true},  {1, 2, false}, {2, 4, true},
                                                          {4, 3, true},  {2, 3, false}, {1, 5, false}};
  for (const auto& [a, b, expected] : cases)
  {
    EXPECT_EQ(asked.contains(soup, a, b), expected) << a << ' ' << b;
  }
  const std::vector<char> isLeft{0, 1, 1};
  const AskedPairs fewer{changes, met, isLeft};
  EXPECT_FALSE(fewer.contains(soup, 2, 4));
  EXPECT_TRUE(fewer.contains(soup, 0, 2)) << "only one is left";
}

/// Looks at all pairs.
Contacts naiveContacts(const TriangleSoup& soup, const AskedPairs& asked)
{
  ContactFinder finder(soup, static_cast<double>(reach));
  for (Index a = 0; a < soup.triangles.size(); ++a)
  {
    if (asked.changes[a] != Change::none)
    {
      finder.look(a);
    }
    for (Index b = 0; b < a; ++b)
    {
      if (asked.contains(soup, a, b) && (asked.changes[a] != Change::none || asked.changes[b] != Change::none))
      {
        finder.look(b, a);
      }
    }
  }
  return finder.take().sorted(soup);
}

TEST(Contacts, AreFoundAmongAllAskedPairs)
{
  Draw draw(8);
  const ThreadExecutor executor(2);
  const ClusterCells clusters;
  for (int round = 0; round < 30; ++round)
  {
    TriangleSoup soup = gridSoup(draw, 40);
    std::vector<Change> changes;
    for (std::size_t t = 0; t < 40; ++t)
    {
      soup.sources[t] = static_cast<Index>(t * 2 / 3);
      changes.push_back(round % 3 == 0 ? Change::moved : static_cast<Change>(draw.in(0, 2)));
    }
    MetSources met;
    met.add(soup, {{1, 30, 0, 0, 0, 0}, {4, 5, 0, 0, 0, 0}, {2, 18, 0, 0, 0, 0}, {9, 27, 0, 0, 0, 0}});
    std::vector<char> isLeft(27, 0);
    std::ranges::generate(isLeft, [&] { return static_cast<char>(draw.in(0, 5) == 0); });
    const AskedPairs asked{changes, met, isLeft};
    const Contacts expected = naiveContacts(soup, asked);
    const Contacts found = findContacts(soup, asked, reach, clusters, quietContext(executor)).sorted(soup);
    EXPECT_EQ(found.newPoints, expected.newPoints);
    EXPECT_EQ(found.edges, expected.edges);
    EXPECT_EQ(found.faces, expected.faces);
    EXPECT_EQ(found.pairs, expected.pairs);
  }
}

TEST(Contacts, OfUnchangedTrianglesAreNone)
{
  Draw draw(9);
  const TriangleSoup soup = gridSoup(draw, 20);
  const std::vector<Change> changes(20, Change::none);
  const MetSources met;
  const FoundContacts found = findContacts(soup, {changes, met, {}}, reach, {}, quietContext());
  EXPECT_TRUE(found.edges.empty() && found.faces.empty() && found.pairs.empty());
}

TEST(Contacts, OfHiddenTrianglesAreNone)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {9000, 0, 0}, {0, 9000, 0});
  addTriangle(soup, {1000, 1000, -500}, {1200, 1000, 500}, {1000, 1200, 500});
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  ClusterCells clusters;
  EXPECT_FALSE(findContacts(soup, {changes, met, {}}, reach, clusters, quietContext()).edges.empty());
  clusters.hide(1);
  EXPECT_TRUE(findContacts(soup, {changes, met, {}}, reach, clusters, quietContext()).edges.empty());
}

} // namespace
