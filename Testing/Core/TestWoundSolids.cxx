// SPDX-License-Identifier: GPL-3.0-or-later
/// Solids that are told by the winding of their triangles, and what stays of faces that coincide.
#include "Surface/Triangles/CoincidentFaces.h"
#include "Surface/Triangles/WoundSolids.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>

#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace {

using namespace atria;
using Triangles = std::vector<std::array<Index, 3>>;

/// Boxes by their faces, each of two triangles; equal points are one.
class Boxes
{
public:
  explicit Boxes(double angle = 0.0) : turn(Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized())) {}

  void addQuad(const std::array<Vec3, 4>& corners, Front front = Front::outside)
  {
    std::array<Index, 4> p{};
    std::ranges::transform(corners, p.begin(), [&](const Vec3& corner) { return numberOf(corner); });
    if (front == Front::inside)
    {
      std::swap(p[1], p[3]);
    }
    triangles.push_back({p[0], p[1], p[2]});
    triangles.push_back({p[0], p[2], p[3]});
    const Index face = faces.empty() ? 0 : faces.back() + 1;
    faces.insert(faces.end(), 2, face);
  }

  void addBox(const Vec3& low, const Vec3& high, Front front = Front::outside)
  {
    const auto at = [&](int i) {
      return Vec3((i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]);
    };
    for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    {
      addQuad({at(a), at(b), at(c), at(d)}, front);
    }
  }

  std::size_t solids(Front front = Front::outside) const
  {
    const std::vector<Index> found = findWoundSolids(points, triangles, front);
    std::set<Index> all(found.begin(), found.end());
    all.erase(noIndex);
    return all.size();
  }

  std::size_t merged() const { return findCoincidentFaces(points, triangles, faces).faces; }

  std::vector<Vec3> points;
  Triangles triangles;
  std::vector<Index> faces;

private:
  Index numberOf(const Vec3& p)
  {
    const auto [entry, isNew] = numbers.try_emplace({p[0], p[1], p[2]}, static_cast<Index>(points.size()));
    if (isNew)
    {
      points.push_back(turn * p);
    }
    return entry->second;
  }

  Eigen::AngleAxisd turn;
  std::map<std::array<double, 3>, Index> numbers;
};

class WoundSolids : public ::testing::TestWithParam<double>
{
};

/// A block of boxes, of which the middle one shares all of its faces, and edges are shared by four.
TEST_P(WoundSolids, AreToldApartWhereTheyShareFaces)
{
  for (const Front front : {Front::outside, Front::inside})
  {
    Boxes block(GetParam());
    for (int i = 0; i < 27; ++i)
    {
      const Vec3 low(i % 3, i / 3 % 3, i / 9);
      block.addBox(low, low + Vec3::Ones(), front);
    }
    EXPECT_EQ(block.solids(front), 27u);
    // From the other side there is one: the place of the middle one, which faces of its neighbors bound.
    EXPECT_EQ(block.solids(front == Front::outside ? Front::inside : Front::outside), 1u);
    EXPECT_EQ(block.merged(), 0u);
  }
}

TEST_P(WoundSolids, AreToldApartWhereTheyShareAnEdgeOrAPoint)
{
  Boxes boxes(GetParam());
  boxes.addBox({0, 0, 0}, {1, 1, 1});
  boxes.addBox({1, 1, 0}, {2, 2, 1});
  boxes.addBox({2, 2, 1}, {3, 3, 2});
  EXPECT_EQ(boxes.solids(), 3u);
}

TEST_P(WoundSolids, AreClosed)
{
  Boxes open(GetParam());
  open.addBox({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  open.addBox({3, 0, 0}, {4, 1, 1});
  EXPECT_EQ(open.solids(), 1u);
}

TEST_P(WoundSolids, AreWoundAlikeAllRound)
{
  Boxes mixed(GetParam());
  mixed.addBox({0, 0, 0}, {1, 1, 1});
  std::swap(mixed.triangles[4][0], mixed.triangles[4][1]);
  EXPECT_EQ(mixed.solids(Front::outside) + mixed.solids(Front::inside), 0u);
}

TEST_P(WoundSolids, AreNoneWhereAShellHasTwoSides)
{
  Boxes shell(GetParam());
  shell.addBox({0, 0, 0}, {1, 1, 1}, Front::outside);
  shell.addBox({0, 0, 0}, {1, 1, 1}, Front::inside);
  EXPECT_EQ(shell.solids(Front::outside), 1u);
  EXPECT_EQ(shell.solids(Front::inside), 1u);
  EXPECT_EQ(shell.merged(), 6u) << "one of each pair of sides is left out";
}

TEST_P(WoundSolids, AreNoneOfASheetWithTwoSides)
{
  Boxes sheet(GetParam());
  sheet.addQuad({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, Front::outside);
  sheet.addQuad({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, Front::inside);
  EXPECT_EQ(sheet.solids(), 0u);
  EXPECT_EQ(sheet.merged(), 1u);
}

/// Beside a closed box, one that has no lid: the face between them is the box's, once.
TEST_P(WoundSolids, LetFacesOfOpenNeighborsBeMerged)
{
  Boxes boxes(GetParam());
  boxes.addBox({0, 0, 0}, {1, 1, 1});
  boxes.addBox({1, 0, 0}, {2, 1, 1});
  boxes.triangles.erase(boxes.triangles.begin() + 14, boxes.triangles.begin() + 16);
  boxes.faces.erase(boxes.faces.begin() + 14, boxes.faces.begin() + 16);
  EXPECT_EQ(boxes.solids(), 1u);
  EXPECT_EQ(boxes.merged(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Angle, WoundSolids, ::testing::Values(0.0, 0.3, std::numbers::pi / 2, 2.0));

} // namespace
