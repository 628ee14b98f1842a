// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a model as read belongs together: places, coincident faces, smooth pieces.
#include "Surface/Triangles/CoincidentFaces.h"
#include "Surface/Triangles/PointPlaces.h"
#include "Surface/Triangles/SmoothPieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using atria::findCoincidentFaces;
using atria::Index;
using atria::placesOf;
using atria::smoothPieces;
using atria::Vec3;
using Triangles = std::vector<std::array<Index, 3>>;

TEST(PointPlaces, AreEqualCoordinatesWithoutAStep)
{
  const std::vector<Vec3> points{{0, 0, 0}, {-0.0, 0, -0.0}, {1e-300, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(placesOf(points, 0.0), (std::vector<Index>{0, 0, 2, 0}));
}

TEST(PointPlaces, TakeInWhatRoundingParts)
{
  const double third = 0.1 + 0.2; // not 0.3
  const std::vector<Vec3> points{{0.3, 5, 0}, {third, 5, -1e-17}, {0.3001, 5, 0}};
  EXPECT_EQ(placesOf(points, 1e-8), (std::vector<Index>{0, 0, 2}));
}

TEST(PointPlaces, HaveAStepThatGoesWithTheCoordinates)
{
  atria::Box3 box;
  EXPECT_EQ(atria::placeStep(box), 0.0);
  box.extend({0, 0, 0});
  EXPECT_EQ(atria::placeStep(box), 0.0);
  box.extend({50, -700, 0});
  EXPECT_NEAR(atria::placeStep(box), 1e-6, 1e-12);
  box.extend({1e300, 0, 0});
  EXPECT_TRUE(std::isfinite(atria::placeStep(box)));
}

TEST(PointPlaces, FarFromTheOriginTheStepIsThatOfTheSizeUntilNumbersRunOut)
{
  for (const double far : {1e3, 1e5, 1e7})
  {
    const atria::Box3 box{Vec3(far, -far, 0), Vec3(far + 60, 30 - far, 9)};
    EXPECT_LE(atria::placeStep(box), 1e-7 * 1.01) << far;
    const double unit = std::nextafter(far, 2 * far) - far;
    EXPECT_GT(atria::placeStep(box), 4.0 * unit) << far;
  }
  const atria::Box3 beyond{Vec3::Constant(1e12), Vec3::Constant(1e12 + 60)};
  EXPECT_NEAR(atria::placeStep(beyond), 1e-2, 1e-4);
}

const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(CoincidentFaces, ArePolygonsOfOneOutlineHoweverCut)
{
  const Triangles triangles{
      {0, 1, 2}, {0, 2, 3}, {3, 1, 0}, {3, 2, 1}}; // the second one from behind, cut the other way
  const auto found = findCoincidentFaces(square, triangles, std::vector<Index>{0, 0, 1, 1});
  EXPECT_EQ(found.kept, (std::vector<Index>{0, 1, 0, 0}));
  EXPECT_EQ(found.faces, 1u);
  EXPECT_EQ(found.opposite, 1u);
}

TEST(CoincidentFaces, AreTrianglesOfOtherPolygonsToo)
{
  const Triangles triangles{{0, 1, 2}, {0, 2, 3}, {1, 2, 0}, {3, 2, 0}};
  const auto found = findCoincidentFaces(square, triangles, std::vector<Index>{0, 0, 1, 2});
  EXPECT_EQ(found.kept, (std::vector<Index>{0, 1, 0, 1}));
  EXPECT_EQ(found.faces, 2u);
  EXPECT_EQ(found.opposite, 1u);
}

TEST(CoincidentFaces, AreNotThoseThatShareSomeCorners)
{
  const Triangles triangles{{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(findCoincidentFaces(square, triangles, std::vector<Index>{0, 1, 2, 3}).faces, 0u);
}

TEST(CoincidentFaces, LeaveTheSmallerSurfaceItsFacesWhateverTheOrder)
{
  // A wall of two squares, and a window on one of them, wound either way.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const Triangles wall{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  for (const Triangles& window : {Triangles{{0, 1, 2}, {0, 2, 3}}, Triangles{{1, 0, 3}, {1, 3, 2}}})
  {
    for (const bool isFirst : {false, true})
    {
      Triangles triangles = isFirst ? window : wall;
      triangles.insert(triangles.end(), isFirst ? wall.begin() : window.begin(), isFirst ? wall.end() : window.end());
      const std::vector<Index> faces = {0, 0, 1, 1, 2, 2};
      const std::vector<Index> surfaces =
          isFirst ? std::vector<Index>{0, 0, 1, 1, 1, 1} : std::vector<Index>{0, 0, 0, 0, 1, 1};
      const auto found = findCoincidentFaces(points, triangles, faces, surfaces);
      EXPECT_EQ(found.kept, isFirst ? (std::vector<Index>{0, 1, 0, 0, 4, 5}) : (std::vector<Index>{4, 4, 2, 3, 4, 5}));
      EXPECT_EQ(found.faces, 1u);
      EXPECT_TRUE(found.isByOrder.empty());
    }
  }
}

TEST(CoincidentFaces, LeaveTheFirstOfEqualSurfacesItsFaces)
{
  const Triangles triangles{{0, 1, 2}, {0, 2, 3}, {3, 1, 0}, {3, 2, 1}, {0, 1, 2}, {0, 2, 3}};
  const auto found = findCoincidentFaces(square, triangles, std::vector<Index>{0, 0, 1, 1, 2, 2},
                                         std::vector<Index>{1, 1, 0, 0, 0, 0});
  EXPECT_EQ(found.kept, (std::vector<Index>{0, 1, 0, 0, 0, 0})) << "what surface 0 repeats counts once";
  EXPECT_EQ(found.isByOrder, (std::vector<char>{0, 0, 1, 1, 1, 1}));
}

TEST(SmoothPieces, EndAtAnglesAndGroups)
{
  // Three strips about the x axis, 20 and 40 degrees apart.
  std::vector<Vec3> points;
  double y = 0;
  double z = 0;
  for (const double degrees : {0.0, 0.0, 20.0, 60.0})
  {
    y += points.empty() ? 0.0 : std::cos(degrees * std::numbers::pi / 180);
    z += points.empty() ? 0.0 : std::sin(degrees * std::numbers::pi / 180);
    points.insert(points.end(), {{0, y, z}, {1, y, z}});
  }
  Triangles triangles;
  for (Index i = 0; i < 6; i += 2)
  {
    triangles.push_back({i, i + 1, i + 3});
    triangles.push_back({i + 2, i + 3, i}); // wound the other way
  }
  const std::vector<Index> one(6, 0);
  EXPECT_EQ(smoothPieces(points, triangles, one, 30.0), (std::vector<Index>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(smoothPieces(points, triangles, one, 40.0), std::vector<Index>(6, 0));
  EXPECT_EQ(smoothPieces(points, triangles, one, 0.0), (std::vector<Index>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(smoothPieces(points, triangles, std::vector<Index>{0, 0, 1, 1, 1, 1}, 180.0),
            (std::vector<Index>{0, 0, 1, 1, 1, 1}));
}

} // namespace
