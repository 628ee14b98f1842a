// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/Problems.h"

#include "Support/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using atria::Index;
using atria::Problem;
using atria::ProblemKind;
using atria::TriangleSurface;
using atria::Vec3;

class Model : public TriangleSurface
{
public:
  Index name(const std::string& text)
  {
    names.push_back(text);
    return static_cast<Index>(names.size() - 1);
  }
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, Index id = 0)
  {
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
    surfaceIds.push_back(id);
  }
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Index id = 0)
  {
    triangle(a, b, c, id);
    triangle(a, c, d, id);
  }
};

std::vector<Problem> problemsOf(const TriangleSurface& surface, double gap = 0.01)
{
  const atria::SerialExecutor executor;
  atria::SilentMonitor monitor;
  return findProblems(surface, {gap}, {executor, atria::ProgressRange(monitor)});
}

std::vector<Problem> ofKind(const std::vector<Problem>& all, ProblemKind kind)
{
  std::vector<Problem> out;
  std::copy_if(all.begin(), all.end(), std::back_inserter(out), [&](const Problem& p) { return p.kind == kind; });
  return out;
}

/// Corners of the unit cube.
std::array<Vec3, 8> cube()
{
  std::array<Vec3, 8> c;
  for (int i = 0; i < 8; ++i)
  {
    c[i] = Vec3(i & 1, (i >> 1) & 1, i >> 2);
  }
  return c;
}

Model box(bool withLid)
{
  Model m;
  m.name("Box");
  const auto c = cube();
  m.quad(c[0], c[2], c[3], c[1]);
  m.quad(c[0], c[1], c[5], c[4]);
  m.quad(c[1], c[3], c[7], c[5]);
  m.quad(c[3], c[2], c[6], c[7]);
  m.quad(c[2], c[0], c[4], c[6]);
  if (withLid)
  {
    m.quad(c[4], c[5], c[7], c[6]);
  }
  return m;
}

TEST(Problems, FindsNoneInABox) { EXPECT_TRUE(problemsOf(box(true)).empty()); }

TEST(Problems, FindsTheHoleOfAnOpenBoxAsOneRunOfEdges)
{
  const auto problems = problemsOf(box(false));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, ProblemKind::openEdges);
  EXPECT_EQ(problems[0].count, 4u);
  EXPECT_NEAR(problems[0].size, 4.0, 1e-12);
  EXPECT_EQ(problems[0].place.z(), 1.0);
  EXPECT_EQ(problems[0].surfaces, std::vector<Index>{0});
}

TEST(Problems, FindsEdgesWhereSurfacesBranchOff)
{
  Model m = box(true);
  const Index fin = m.name("Fin");
  const auto c = cube();
  m.quad(c[1], c[5], Vec3(2, 0, 1), Vec3(2, 0, 0), fin);
  const auto branches = ofKind(problemsOf(m), ProblemKind::nonManifoldEdges);
  ASSERT_EQ(branches.size(), 1u);
  EXPECT_EQ(branches[0].count, 1u);
  EXPECT_EQ(branches[0].surfaces, (std::vector<Index>{0, fin}));
  EXPECT_TRUE(branches[0].place.isApprox(Vec3(1, 0, 0.5)));
}

TEST(Problems, FindsDuplicatesAndTheirSurfaces)
{
  Model m = box(true);
  const Index copy = m.name("Copy");
  m.triangle(m.points[2], m.points[1], m.points[0], copy);
  const auto duplicates = ofKind(problemsOf(m), ProblemKind::duplicates);
  ASSERT_EQ(duplicates.size(), 1u);
  EXPECT_EQ(duplicates[0].count, 1u);
  EXPECT_NEAR(duplicates[0].size, 0.5, 1e-12);
  EXPECT_EQ(duplicates[0].surfaces, (std::vector<Index>{copy, 0})) << "the smaller keeps its faces";
  EXPECT_TRUE(ofKind(problemsOf(m), ProblemKind::overlaps).empty());
}

TEST(Problems, FindsWhatLiesUponOthersInPart)
{
  for (const double gap : {0.01, 0.0})
  {
    Model m = box(true);
    const Index window = m.name("Window");
    const Index sign = m.name("Sign");
    m.quad({0.25, 0, 0.25}, {0.75, 0, 0.25}, {0.75, 0, 0.75}, {0.25, 0, 0.75}, window);
    m.quad({0.5, 0, 0.5}, {2, 0, 0.5}, {2, 0, 2}, {0.5, 0, 2}, sign); // beyond the box
    const auto overlaps = ofKind(problemsOf(m, gap), ProblemKind::overlaps);
    std::map<std::vector<Index>, double> areas;
    for (const Problem& overlap : overlaps)
    {
      areas[overlap.surfaces] = overlap.size;
      EXPECT_GT(overlap.count, 0u);
      EXPECT_NEAR(overlap.place.y(), 0.0, 1e-9);
    }
    ASSERT_EQ(areas.size(), 3u);
    EXPECT_NEAR((areas[{window, 0}]), 0.25, 1e-6);
    EXPECT_NEAR((areas[{window, sign}]), 0.0625, 1e-6);
    EXPECT_NEAR((areas[{0, sign}]), 0.1875, 1e-6) << "the sign is larger than the box's side";
  }
}

TEST(Problems, FindsTheThinnestSliver)
{
  Model m;
  m.name("A");
  m.triangle({0, 0, 0}, {1, 0, 0}, {0.5, 0.005, 0});
  m.triangle({0, 0, 5}, {1, 0, 5}, {0.5, 0.001, 5});
  m.triangle({0, 0, 9}, {1, 0, 9}, {0.5, 0.02, 9});
  const auto slivers = ofKind(problemsOf(m), ProblemKind::slivers);
  ASSERT_EQ(slivers.size(), 1u);
  EXPECT_EQ(slivers[0].count, 2u);
  EXPECT_NEAR(slivers[0].size, 0.001, 1e-12);
  EXPECT_EQ(slivers[0].place.z(), 5.0);
}

TEST(Problems, TellsCrossingsFromContacts)
{
  Model m;
  const Index floor = m.name("Floor");
  const Index through = m.name("Through");
  const Index on = m.name("On");
  m.quad({0, 0, 0}, {10, 0, 0}, {10, 9, 0}, {0, 9, 0}, floor);
  m.triangle({2, 1, -1}, {4, 1, -1}, {3, 1, 1}, through); // pierces the floor at x = 2.5 and 3.5
  m.triangle({6, 2, 0}, {6, 2, 3}, {7, 2, 3}, on);        // stands on it with one corner
  const auto problems = problemsOf(m);
  const auto crossings = ofKind(problems, ProblemKind::crossings);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_EQ(crossings[0].count, 2u);
  EXPECT_EQ(crossings[0].surfaces.front(), floor);
  EXPECT_NEAR(crossings[0].place.z(), 0.0, 1e-6);
  EXPECT_NEAR(crossings[0].place.y(), 1.0, 1e-6);
  const auto contacts = ofKind(problems, ProblemKind::contacts);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].count, 1u);
  EXPECT_EQ(contacts[0].surfaces, (std::vector<Index>{floor, on}));
  EXPECT_TRUE(contacts[0].place.isApprox(Vec3(6, 2, 0)));
}

TEST(Problems, FindsGapsBelowTheToleranceOnly)
{
  Model m;
  m.name("Floor");
  const Index wall = m.name("Wall");
  m.quad({0, 0, 0}, {10, 0, 0}, {10, 9, 0}, {0, 9, 0});
  m.quad({2, 4, 0.004}, {7, 4, 0.004}, {7, 4, 3}, {2, 4, 3}, wall);
  const auto gaps = ofKind(problemsOf(m), ProblemKind::gaps);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].count, 2u);
  EXPECT_NEAR(gaps[0].size, 0.004, 1e-6);
  EXPECT_EQ(gaps[0].surfaces, std::vector<Index>{wall});
  EXPECT_TRUE(ofKind(problemsOf(m, 0.002), ProblemKind::gaps).empty());
  EXPECT_TRUE(ofKind(problemsOf(m, 0.0), ProblemKind::gaps).empty());
}

/// As many squares upon each other that none has a corner in common with another, turned so that all cross.
Model pile(int squares)
{
  Model m;
  m.name("Pile");
  for (int i = 0; i < squares; ++i)
  {
    const double angle = 1.5 * i / squares;
    const Vec3 x(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 y(-x.y(), x.x(), 0.0);
    m.quad(-x - y, x - y, x + y, y - x);
  }
  return m;
}

TEST(Problems, EndsOnThousandsOfFacesInOnePlaceAndSaysWhatItLeftOut)
{
  constexpr int squares = 5000;
  Model m = pile(squares);
  const Index apart = m.name("Apart");
  m.quad({9, 0, 0}, {10, 0, 0}, {10, 1, 0}, {9, 1, 0}, apart);
  m.triangle({9.2, 0.5, -1}, {9.8, 0.5, -1}, {9.5, 0.4, 1}, apart);
  const auto problems = problemsOf(m);
  const auto clusters = ofKind(problems, ProblemKind::clusters);
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(clusters[0].surfaces, std::vector<Index>{0});
  EXPECT_GT(clusters[0].count, squares * 18u / 10u); // of two triangles each
  EXPECT_LT(clusters[0].count, squares * 2u);
  EXPECT_LT(clusters[0].place.norm(), 1.5);
  // Some of the pile are looked at still, and all that is not part of it.
  const auto crossings = ofKind(problems, ProblemKind::crossings);
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_GT(crossings[0].count, 100u);
  EXPECT_LT(crossings[0].count, std::size_t{squares} * squares);
  EXPECT_EQ(crossings[1].surfaces, std::vector<Index>{apart});
  EXPECT_EQ(crossings[1].count, 3u); // two boundary edges of the triangle, and the diagonal of the square
}

TEST(Problems, LooksAtAllTrianglesOfASmallPile)
{
  const auto problems = problemsOf(pile(20));
  EXPECT_TRUE(ofKind(problems, ProblemKind::clusters).empty());
  const auto crossings = ofKind(problems, ProblemKind::crossings);
  ASSERT_EQ(crossings.size(), 1u);
  // The outlines of two squares about one center cross in eight points.
  EXPECT_GE(crossings[0].count, 20u * 19u / 2u * 8u);
}

TEST(Problems, LooksAtHundredsOfWallsThroughOneFloor)
{
  constexpr int walls = 400;
  Model m;
  m.name("Floor");
  const Index wall = m.name("Wall");
  m.quad({-1, -1, 0}, {walls, -1, 0}, {walls, 2, 0}, {-1, 2, 0});
  for (int i = 0; i < walls; ++i)
  {
    m.quad({i + 0.5, 0, -0.5}, {i + 0.5, 1, -0.5}, {i + 0.5, 1, 1}, {i + 0.5, 0, 1}, wall);
  }
  const auto problems = problemsOf(m);
  EXPECT_TRUE(ofKind(problems, ProblemKind::clusters).empty());
  std::size_t found = 0;
  for (const Problem& p : ofKind(problems, ProblemKind::crossings))
  {
    found += p.count;
  }
  EXPECT_GE(found, 3u * walls); // two ends and the diagonal of each wall
}

TEST(Problems, RefusesAModelWithoutExtent) { EXPECT_THROW(problemsOf(TriangleSurface{}), atria::Error); }

} // namespace
