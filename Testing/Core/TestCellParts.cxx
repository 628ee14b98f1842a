// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests windows of a mesh, boxes among boxes, and counts over the own part of a mesh.
#include "Quality/Checks/CellWindow.h"
#include "Quality/Checks/PartCounts.h"
#include "Quality/Checks/RegularBoxes.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/Error.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::hexahedra;
using atria::testing::mixedCells;
using atria::testing::SampleMesh;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Ids = std::vector<std::int64_t>;

std::vector<Index> upTo(std::size_t count)
{
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

Ids cornersOf(const SampleMesh& mesh, std::size_t cell)
{
  return {mesh.connectivity.begin() + mesh.offsets[cell], mesh.connectivity.begin() + mesh.offsets[cell + 1]};
}

bool shareAPoint(const SampleMesh& mesh, std::size_t a, std::size_t b)
{
  const Ids own = cornersOf(mesh, a);
  return std::ranges::find_first_of(own, cornersOf(mesh, b)) != own.end();
}

// Windows.

/// A face as a cell sees it: the cell across or noIndex, and the points outward, the lowest first.
using SeenFace = std::pair<Index, std::vector<Index>>;
/// The faces of each cell.
using SeenFaces = std::map<Index, std::multiset<SeenFace>>;

/// Returns the faces of each cell with other numbers of cells and points.
template <typename CellName, typename PointName>
SeenFaces seenFaces(const FaceMesh& mesh, CellName&& nameOfCell, PointName&& nameOfPoint)
{
  SeenFaces out;
  const auto add = [&](Index cell, Index across, std::vector<Index> loop) {
    std::ranges::rotate(loop, std::ranges::min_element(loop));
    out[nameOfCell(cell)].insert({across == noIndex ? noIndex : nameOfCell(across), loop});
  };
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    std::vector<Index> loop;
    std::ranges::transform(mesh.face(f), std::back_inserter(loop), nameOfPoint);
    const Index neighbor = f < mesh.internalFaceCount() ? mesh.neighbor[f] : noIndex;
    add(mesh.owner[f], neighbor, loop);
    if (neighbor != noIndex)
    {
      std::ranges::reverse(loop);
      add(neighbor, mesh.owner[f], loop);
    }
  }
  return out;
}

/// A mesh of the chosen cells only.
SampleMesh partOf(const SampleMesh& mesh, const std::vector<Index>& chosen)
{
  SampleMesh part;
  part.points = mesh.points;
  part.faceStream = mesh.faceStream;
  for (const Index cell : chosen)
  {
    part.addCell(mesh.types[cell], cornersOf(mesh, cell));
    part.faceLocations.back() = mesh.faceLocations[cell];
  }
  return part;
}

std::vector<Index> someCells(std::size_t count, std::mt19937& random, unsigned oneIn)
{
  std::vector<Index> chosen = upTo(count);
  std::erase_if(chosen, [&](Index) { return random() % oneIn == 0; });
  return chosen;
}

/// Returns the chosen cells that are own ones, and those that share a point with one of these.
std::vector<Index> cellsOfWindow(const SampleMesh& mesh, const std::vector<Index>& chosen,
                                 const std::vector<Index>& own)
{
  std::vector<Index> out = chosen;
  std::erase_if(out, [&](Index cell) {
    return std::ranges::none_of(own, [&](Index other) { return shareAPoint(mesh, cell, other); });
  });
  return out;
}

std::vector<Index> ownCells(const CellWindow& window)
{
  std::vector<Index> own;
  for (std::size_t cell = 0; cell < window.cells().size(); ++cell)
  {
    if (window.isOwn(cell))
    {
      own.push_back(window.cells()[cell]);
    }
  }
  return own;
}

/// Checks that a window's arrays are those of its cells.
void expectArrays(const CellWindow& window, const SampleMesh& mesh)
{
  const CellArrays arrays = window.arrays();
  ASSERT_EQ(arrays.types.size(), window.cells().size());
  ASSERT_EQ(arrays.offsets.size(), arrays.types.size() + 1);
  for (std::size_t cell = 0; cell < arrays.types.size(); ++cell)
  {
    EXPECT_EQ(arrays.types[cell], mesh.types[window.cells()[cell]]);
    Ids corners;
    for (std::int64_t i = arrays.offsets[cell]; i < arrays.offsets[cell + 1]; ++i)
    {
      corners.push_back(window.pointOf(static_cast<Index>(arrays.connectivity[static_cast<std::size_t>(i)])));
    }
    EXPECT_EQ(corners, cornersOf(mesh, window.cells()[cell]));
  }
  for (Index p = 0; p < window.mesh().points.size(); ++p)
  {
    EXPECT_EQ(window.mesh().points[p], mesh.points[window.pointOf(p)]);
  }
}

/// Checks that own cells of a window have the faces that they have among all chosen cells.
void expectFaces(const CellWindow& window, const SeenFaces& whole)
{
  const SeenFaces seen = seenFaces(
      window.mesh(), [&](Index cell) { return window.cells()[cell]; }, [&](Index p) { return window.pointOf(p); });
  for (const Index cell : ownCells(window))
  {
    EXPECT_EQ(seen.at(cell), whole.at(cell)) << "cell " << cell;
  }
}

void expectWindows(const SampleMesh& mesh, const std::vector<Index>& chosen, std::size_t length, int threads)
{
  const SampleMesh part = partOf(mesh, chosen);
  const SeenFaces whole = seenFaces(
      makeFaceMesh(part.points, part.view()), [&](Index cell) { return chosen[cell]; }, [](Index p) { return p; });
  const AskedFaces nothing;
  const ThreadExecutor executor(threads);
  const CellArrays cells = mesh.view();
  CellWindows windows(mesh.points, cells, chosen, nothing, length, executor);
  ASSERT_EQ(windows.count(), std::max<std::size_t>(1, chosen.size() / length));
  std::vector<Index> all;
  for (std::size_t number = 0; number < windows.count(); ++number)
  {
    const CellWindow window = windows.window(number, executor);
    const std::vector<Index> own = ownCells(window);
    EXPECT_GE(own.size(), std::min(length, chosen.size()));
    EXPECT_LT(own.size(), 2 * length);
    all.insert(all.end(), own.begin(), own.end());
    const std::vector<Index> expected = windows.count() == 1 ? chosen : cellsOfWindow(mesh, chosen, own);
    EXPECT_TRUE(std::ranges::equal(window.cells(), expected)) << number;
    expectArrays(window, mesh);
    expectFaces(window, whole);
    EXPECT_TRUE(window.hasAskedFaces(executor));
  }
  EXPECT_EQ(all, chosen);
}

TEST(CellWindows, AreOwnCellsWithAllAroundThem)
{
  std::mt19937 random(3);
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh mesh = mixedCells({4, 3, 3}, seed, 0.1);
    const std::size_t count = mesh.types.size();
    expectWindows(mesh, upTo(count), 10, 1);
    expectWindows(mesh, someCells(count, random, 3), 7, 1);
    expectWindows(mesh, someCells(count, random, 2), 20, 3);
  }
}

TEST(CellWindows, AreAsManyAsHoldTheirLength)
{
  const SampleMesh row = hexahedra({7, 1, 1});
  for (const std::size_t length : {1U, 2U, 3U, 4U, 6U, 7U, 8U, 100U})
  {
    SCOPED_TRACE(length);
    expectWindows(row, upTo(7), length, 1);
  }
  const AskedFaces nothing;
  const CellArrays cells = row.view();
  EXPECT_EQ(CellWindows(row.points, cells, {}, nothing, 3, SerialExecutor()).count(), 0U);
}

TEST(CellWindows, OfARowReachOneCellFurther)
{
  const SampleMesh row = hexahedra({7, 1, 1});
  const AskedFaces nothing;
  const CellArrays cells = row.view();
  const std::vector<Index> chosen{0, 1, 2, 3, 5, 6};
  CellWindows windows(row.points, cells, chosen, nothing, 2, SerialExecutor());
  ASSERT_EQ(windows.count(), 3U);
  for (int again = 0; again < 2; ++again) // a window leaves nothing behind
  {
    EXPECT_THAT(windows.window(0, SerialExecutor()).cells(), ElementsAre(0, 1, 2));
    EXPECT_THAT(windows.window(1, SerialExecutor()).cells(), ElementsAre(1, 2, 3));
    EXPECT_THAT(windows.window(2, SerialExecutor()).cells(), ElementsAre(5, 6)) << "4 is not there";
  }
}

// Faces that are requested of windows.

/// Requested faces that own their points.
struct Requests
{
  std::vector<Index> cells;
  std::vector<Ids> points;

  void add(Index cell, Ids ids)
  {
    cells.push_back(cell);
    points.push_back(std::move(ids));
  }
  std::vector<BoundaryFaceKey> keys() const
  {
    std::vector<BoundaryFaceKey> out;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      out.push_back({cells[i], points[i]});
    }
    return out;
  }
};

/// Six cubes in a row along x.
class Row
{
public:
  /// Points of the square at x = i.
  Ids square(std::int64_t i) const { return {i, i + 7, i + 21, i + 14}; }
  Ids floorOf(std::int64_t cell) const { return {cell, cell + 1, cell + 8, cell + 7}; }

  /// Returns by window of two cells whether it has the requested faces.
  std::vector<bool> have(const Requests& patches, const Requests& zones, const std::vector<Index>& neighbors) const
  {
    const std::vector<BoundaryFaceKey> patchKeys = patches.keys();
    const std::vector<BoundaryFaceKey> zoneKeys = zones.keys();
    const AskedFaces asked{patchKeys, false, zoneKeys, neighbors};
    const CellArrays cells = mesh.view();
    const std::vector<Index> all = upTo(6);
    CellWindows windows(mesh.points, cells, all, asked, 2, SerialExecutor());
    std::vector<bool> out;
    for (std::size_t number = 0; number < windows.count(); ++number)
    {
      out.push_back(windows.window(number, SerialExecutor()).hasAskedFaces(SerialExecutor()));
    }
    return out;
  }
  std::vector<bool> havePatches(const Requests& patches) const { return have(patches, {}, {}); }
  std::vector<bool> haveZones(const Requests& zones, const std::vector<Index>& neighbors) const
  {
    return have({}, zones, neighbors);
  }

  SampleMesh mesh = hexahedra({6, 1, 1});
};

TEST(CellWindows, HaveTheFacesOfPatches)
{
  const Row row;
  Requests patches;
  for (std::int64_t cell = 0; cell < 6; ++cell)
  {
    patches.add(static_cast<Index>(cell), row.floorOf(cell));
  }
  patches.add(0, row.square(0));
  patches.add(5, row.square(6));
  patches.add(1, row.square(2)); // both sides of a sheet
  patches.add(2, row.square(2));
  EXPECT_THAT(row.havePatches(patches), Each(true));
}

TEST(CellWindows, MissPatchesOfOwnCellsOnly)
{
  const Row row;
  Requests patches;
  patches.add(3, row.floorOf(2));
  EXPECT_THAT(row.havePatches(patches), ElementsAre(true, false, true));
  Requests twice;
  twice.add(4, row.floorOf(4));
  twice.add(4, row.floorOf(4));
  EXPECT_THAT(row.havePatches(twice), ElementsAre(true, false, false)) << "4 is around the second window";
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{28}})
  {
    Requests beyond;
    beyond.add(0, {0, 1, 8, wrong});
    EXPECT_THAT(row.havePatches(beyond), ElementsAre(false, true, true));
  }
}

TEST(CellWindows, HaveTheFacesOfZones)
{
  const Row row;
  Requests zones;
  std::vector<Index> neighbors;
  for (Index cell = 0; cell < 5; ++cell)
  {
    zones.add(cell % 2 == 0 ? cell : cell + 1, row.square(cell + 1));
    neighbors.push_back(cell % 2 == 0 ? cell + 1 : cell);
  }
  EXPECT_THAT(row.haveZones(zones, neighbors), Each(true));
}

TEST(CellWindows, MissZonesBetweenOtherCells)
{
  const Row row;
  Requests zones;
  zones.add(2, row.square(3));
  EXPECT_THAT(row.haveZones(zones, {3}), Each(true));
  EXPECT_THAT(row.haveZones(zones, {1}), ElementsAre(true, false, true)) << "its points are those of 2 and 3";
  EXPECT_THAT(row.haveZones(zones, {5}), ElementsAre(true, false, true));
  Requests floor;
  floor.add(2, row.floorOf(2));
  EXPECT_THAT(row.haveZones(floor, {3}), ElementsAre(true, false, true)) << "it is on the boundary";
  Requests twice;
  twice.add(2, row.square(3));
  twice.add(3, row.square(3));
  EXPECT_THAT(row.haveZones(twice, {3, 2}), ElementsAre(true, false, true));
}

TEST(CellWindowsError, NameFacesAndPointsThatDoNotExist)
{
  Row row;
  Requests beyond;
  beyond.add(6, row.floorOf(5));
  EXPECT_THROW(row.havePatches(beyond), Error);
  EXPECT_THROW(row.haveZones(beyond, {5}), Error);
  EXPECT_NO_THROW(row.havePatches({}));
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{28}})
  {
    row.mesh.connectivity[20] = wrong;
    EXPECT_THROW(row.havePatches({}), Error) << wrong;
    const AskedFaces nothing;
    const CellArrays cells = row.mesh.view();
    const std::vector<Index> all = upTo(6);
    CellWindows single(row.mesh.points, cells, all, nothing, 6, SerialExecutor());
    EXPECT_THROW(single.window(0, SerialExecutor()), Error) << wrong;
  }
}

// Regular boxes.

/// Place of each corner of VTK's hexahedron along x, y and z.
constexpr std::array<std::array<int, 3>, 8> places{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

bool isHexahedron(const SampleMesh& mesh, std::size_t cell)
{
  const Ids corners = cornersOf(mesh, cell);
  return mesh.types[cell] == hexahedronCell && corners.size() == 8 && std::ranges::all_of(corners, [&](std::int64_t p) {
           return p >= 0 && p < static_cast<std::int64_t>(mesh.points.size());
         });
}

bool isBox(const SampleMesh& mesh, std::size_t cell)
{
  if (!isHexahedron(mesh, cell))
  {
    return false;
  }
  const Ids corners = cornersOf(mesh, cell);
  const Vec3 low = mesh.points[corners[0]];
  const Vec3 size = mesh.points[corners[6]] - low;
  bool same = size.minCoeff() > 0.0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3& expected = places[i][axis] != 0 ? mesh.points[corners[6]] : low;
      same = same && mesh.points[corners[i]][axis] == expected[axis];
    }
  }
  return same;
}

/// Regular boxes by their definition: eight boxes lie around each corner, each at another place.
struct NaiveBoxes
{
  NaiveBoxes(const SampleMesh& mesh, const Ids& apart) : isRegular(mesh.types.size()), isTouched(mesh.points.size())
  {
    std::vector<std::multiset<int>> placesAt(mesh.points.size());
    constexpr int noBox = 8;
    eachCorner(mesh, [&](std::size_t cell, std::size_t i, std::int64_t p) {
      placesAt[p].insert(isBox(mesh, cell) ? static_cast<int>(i) : noBox);
    });
    const auto isGood = [&](std::int64_t p) {
      return placesAt[p] == std::multiset<int>{0, 1, 2, 3, 4, 5, 6, 7} && std::ranges::count(apart, p) == 0;
    };
    for (std::size_t cell = 0; cell < isRegular.size(); ++cell)
    {
      isRegular[cell] = isBox(mesh, cell) && std::ranges::all_of(cornersOf(mesh, cell), isGood) ? 1 : 0;
    }
    eachCorner(mesh, [&](std::size_t cell, std::size_t, std::int64_t p) { isTouched[p] |= isRegular[cell] ? 0 : 1; });
    countFaces(mesh);
  }

  std::vector<char> isRegular;
  std::vector<char> isTouched;
  std::vector<Index> measured;
  std::size_t idealFaces = 0;

private:
  template <typename F> static void eachCorner(const SampleMesh& mesh, F&& use)
  {
    for (std::size_t cell = 0; cell < mesh.types.size(); ++cell)
    {
      const Ids corners = cornersOf(mesh, cell);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        if (corners[i] >= 0 && corners[i] < static_cast<std::int64_t>(mesh.points.size()))
        {
          use(cell, i, corners[i]);
        }
      }
    }
  }

  void countFaces(const SampleMesh& mesh)
  {
    std::map<std::set<std::int64_t>, int> sidesOf; // of faces between regular boxes that are not touched everywhere
    for (Index cell = 0; cell < isRegular.size(); ++cell)
    {
      bool isMeasured = !isRegular[cell];
      for (const LocalFace& face : isRegular[cell] ? shapeOf(hexahedronCell).faces : std::span<const LocalFace>())
      {
        std::set<std::int64_t> points;
        std::ranges::for_each(face.corners, [&](int c) { points.insert(cornersOf(mesh, cell)[c]); });
        const bool all = std::ranges::all_of(points, [&](std::int64_t p) { return isTouched[p] != 0; });
        isMeasured = isMeasured || all;
        sidesOf[points] += all ? 0 : 1;
      }
      measured.insert(measured.end(), isMeasured ? 1 : 0, cell);
    }
    idealFaces =
        static_cast<std::size_t>(std::ranges::count(sidesOf, 2, [](const auto& entry) { return entry.second; }));
  }
};

void expectBoxes(const SampleMesh& mesh, const Ids& apart, const Executor& executor = SerialExecutor())
{
  const NaiveBoxes expected(mesh, apart);
  const RegularBoxes found = findRegularBoxes(mesh.points, mesh.view(), apart, executor);
  EXPECT_TRUE(std::ranges::equal(found.isRegular, expected.isRegular));
  EXPECT_TRUE(std::ranges::equal(found.isTouched, expected.isTouched));
  EXPECT_EQ(found.measured, expected.measured);
  EXPECT_EQ(found.idealFaces, expected.idealFaces);
  for (std::size_t cell = 0; cell < mesh.types.size(); ++cell)
  {
    if (isBox(mesh, cell))
    {
      const Ids corners = cornersOf(mesh, cell);
      const Vec3 size = mesh.points[corners[6]] - mesh.points[corners[0]];
      EXPECT_DOUBLE_EQ(found.volumes[cell], size[0] * size[1] * size[2]);
      EXPECT_DOUBLE_EQ(found.aspectRatios[cell], size.norm() / std::min({size[0], size[1], size[2]}));
    }
  }
}

/// Boxes of different lengths.
SampleMesh gradedBoxes(std::array<int, 3> n)
{
  SampleMesh mesh = hexahedra(n);
  for (Vec3& p : mesh.points)
  {
    p = Vec3(p[0] * (1.0 + 0.3 * p[0]), 0.5 * p[1] * (3.0 - 0.1 * p[1]), p[2] * p[2]);
  }
  return mesh;
}

TEST(RegularBoxes, AreAmongEightBoxesAtEachCorner)
{
  for (const std::array<int, 3>& n : {std::array{1, 1, 1}, std::array{2, 3, 3}, std::array{3, 3, 3},
                                      std::array{5, 4, 3}, std::array{5, 5, 5}, std::array{7, 6, 5}})
  {
    SCOPED_TRACE(n[0]);
    expectBoxes(gradedBoxes(n), {});
  }
  const SampleMesh cubes = hexahedra({3, 3, 3});
  const RegularBoxes boxes = findRegularBoxes(cubes.points, cubes.view(), {}, SerialExecutor());
  EXPECT_EQ(std::ranges::count(boxes.isRegular, 1), 1);
  EXPECT_EQ(boxes.isRegular[13], 1);
  EXPECT_EQ(boxes.idealFaces, 0U) << "all its faces are touched";
}

TEST(RegularBoxes, AreNotAtPointsThatAreApart)
{
  const SampleMesh mesh = gradedBoxes({6, 6, 6});
  expectBoxes(mesh, {3 + 7 * (3 + 7 * 3)});
  expectBoxes(mesh, {2 + 7 * (2 + 7 * 2), 4 + 7 * (3 + 7 * 2), 0});
  expectBoxes(mesh, {-1, 343, 342}); // there are points 0 to 342
}

TEST(RegularBoxes, AreNotAtMovedPointsHoweverLittle)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SampleMesh mesh = gradedBoxes({6, 6, 6});
    double& place = mesh.points[2 + 7 * (3 + 7 * 3)][axis];
    place = std::nextafter(place, 1e9);
    expectBoxes(mesh, {});
  }
}

TEST(RegularBoxes, HaveLengthsAboveZero)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double factor : {-1.0, 0.0})
    {
      SampleMesh mesh = gradedBoxes({3, 3, 3});
      std::ranges::for_each(mesh.points, [&](Vec3& p) { p[axis] *= factor; });
      EXPECT_THAT(findRegularBoxes(mesh.points, mesh.view(), {}, SerialExecutor()).isRegular, Each(0)) << axis;
    }
  }
}

TEST(RegularBoxes, HaveEightCorners)
{
  const SampleMesh whole = gradedBoxes({6, 6, 6});
  for (const std::size_t size : {7U, 9U})
  {
    SampleMesh mesh;
    mesh.points = whole.points;
    for (std::size_t cell = whole.types.size(); cell-- > 0;)
    {
      Ids corners = cornersOf(whole, cell);
      if (cell == 87) // inside
      {
        corners.resize(size, corners.front());
      }
      mesh.addCell(hexahedronCell, corners);
    }
    expectBoxes(mesh, {});
  }
}

/// Boxes of which some are left out, moved, or of another type.
SampleMesh brokenBoxes(unsigned seed)
{
  std::mt19937 random(seed);
  const SampleMesh whole = gradedBoxes({7, 7, 7});
  SampleMesh mesh;
  mesh.points = whole.points;
  for (std::size_t cell = 0; cell < whole.types.size(); ++cell)
  {
    const Ids c = cornersOf(whole, cell);
    switch (random() % 150)
    {
      case 0:
        break;
      case 1:
        mesh.addCell(voxelCell, {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
        break;
      case 2:
        mesh.addCell(hexahedronCell, {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]}); // starts at another corner
        break;
      case 3:
        mesh.addCell(hexahedronCell, {c.begin(), c.begin() + 7}); // is wrong
        break;
      default:
        mesh.addCell(hexahedronCell, c);
    }
  }
  mesh.points[random() % mesh.points.size()][seed % 3] += 0.01;
  return mesh;
}

TEST(RegularBoxes, AreFoundBesideCellsThatAreNone)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    expectBoxes(brokenBoxes(seed), {static_cast<std::int64_t>(seed * 17)}, ThreadExecutor(seed % 2 == 0 ? 1 : 3));
  }
}

TEST(RegularBoxes, AreNotBesideCellsWithPointsThatDoNotExist)
{
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{343}})
  {
    SampleMesh mesh = gradedBoxes({6, 6, 6});
    mesh.connectivity[8 * 100 + 2] = wrong;
    expectBoxes(mesh, {});
  }
}

TEST(RegularBoxes, AreNotBesideCellsThatTakeTheSamePlace)
{
  SampleMesh mesh = gradedBoxes({6, 6, 6});
  mesh.addCell(hexahedronCell, cornersOf(mesh, 86));
  expectBoxes(mesh, {});
}

// Counts.

TEST(CountedValues, KeepTheWorstAndCountFailures)
{
  for (const bool isGreatest : {false, true})
  {
    CountedValues counted{isGreatest};
    counted.add(CountedValues{isGreatest, 1e9 * (isGreatest ? 1 : -1), 0.0, 0, 0}); // without values it has no worst
    EXPECT_EQ(counted.count, 0U);
    counted.add(isGreatest ? -5.0 : 5.0, true);
    EXPECT_EQ(counted.worst, isGreatest ? -5.0 : 5.0) << "0 is no value";
    counted.add(isGreatest ? -6.0 : 6.0, false);
    EXPECT_EQ(counted.worst, isGreatest ? -5.0 : 5.0);
    counted.add(isGreatest ? -4.0 : 4.0, true);
    EXPECT_EQ(counted.worst, isGreatest ? -4.0 : 4.0);
    EXPECT_EQ(counted.sum, isGreatest ? -15.0 : 15.0);
    EXPECT_EQ(counted.count, 3U);
    EXPECT_EQ(counted.failing, 2U);
  }
}

TEST(CountedValues, AreTheSameInParts)
{
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round)
  {
    const bool isGreatest = round % 2 == 0;
    CountedValues all{isGreatest};
    std::vector<CountedValues> parts(3, CountedValues{isGreatest});
    for (int i = 0; i < round; ++i)
    {
      const double value = static_cast<double>(random() % 100) - 50.0;
      all.add(value, i % 3 == 0);
      parts[random() % 2].add(value, i % 3 == 0); // the third part stays empty
    }
    CountedValues sum{isGreatest};
    std::ranges::for_each(parts, [&](const CountedValues& part) { sum.add(part); });
    EXPECT_EQ(sum.count, all.count);
    EXPECT_EQ(sum.worst, all.worst);
    EXPECT_EQ(sum.sum, all.sum);
    EXPECT_EQ(sum.failing, all.failing);
  }
}

/// Some cells of a mesh as its own part.
struct OwnPart
{
  explicit OwnPart(unsigned seed)
      : sample(mixedCells({3, 3, 3}, seed)), mesh(makeFaceMesh(sample.points, sample.view()))
  {
    std::mt19937 random(seed);
    isOwn.resize(mesh.cellCount);
    std::ranges::generate(isOwn, [&] { return static_cast<char>(random() % 2); });
    cellIds.resize(mesh.cellCount);
    pointIds.resize(mesh.points.size());
    std::iota(cellIds.begin(), cellIds.end(), std::int64_t{100});
    std::iota(pointIds.begin(), pointIds.end(), std::int64_t{1000});
  }
  /// 1 if the first cell that has the point is an own one.
  char ownsPoint(Index point) const
  {
    for (std::size_t cell = 0; cell < isOwn.size(); ++cell)
    {
      if (std::ranges::count(cornersOf(sample, cell), point) > 0)
      {
        return isOwn[cell];
      }
    }
    return 0;
  }
  CheckedPart part() const { return {isOwn, cellIds, pointIds, alone()}; }

  SampleMesh sample;
  FaceMesh mesh;
  std::vector<char> isOwn;
  Ids cellIds;
  Ids pointIds;
};

TEST(PartCounts, CountPointsWhereTheirLowestCellIsOwn)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    OwnPart own(seed);
    own.mesh.points.emplace_back(9, 9, 9); // without a cell
    const std::vector<char> counted = pointsOfOwn(own.mesh, own.isOwn);
    ASSERT_EQ(counted.size(), own.mesh.points.size());
    std::vector<Index> some;
    std::size_t expected = 0;
    for (Index point = 0; point < counted.size(); ++point)
    {
      EXPECT_EQ(counted[point], own.ownsPoint(point)) << point;
      if (point % 3 != 0)
      {
        some.push_back(point);
        expected += own.ownsPoint(point) != 0 ? 1 : 0;
      }
    }
    const CheckedPart part = own.part();
    EXPECT_EQ(PartCounts(own.mesh, &part).countPoints(some), expected);
    EXPECT_EQ(PartCounts(own.mesh, nullptr).countPoints(some), some.size());
  }
}

TEST(PartCounts, CountFacesWhereTheirOwnerIsOwn)
{
  const OwnPart own(3);
  const CheckedPart part = own.part();
  const PartCounts counts(own.mesh, &part);
  const PartCounts all(own.mesh, nullptr);
  for (std::size_t cell = 0; cell < own.mesh.cellCount; ++cell)
  {
    EXPECT_EQ(counts(MeshPart::Cells, cell), own.isOwn[cell] != 0);
    EXPECT_TRUE(all(MeshPart::Cells, cell));
  }
  for (std::size_t f = 0; f < own.mesh.faceCount(); ++f)
  {
    EXPECT_EQ(counts(MeshPart::Faces, f), own.isOwn[own.mesh.owner[f]] != 0);
    EXPECT_TRUE(all(MeshPart::Faces, f));
  }
  EXPECT_TRUE(counts(MeshPart::Mesh, 0));
}

TEST(PartCounts, OfASingleProcessKeepItsValues)
{
  const OwnPart own(4);
  const CheckedPart part = own.part();
  for (const CheckedPart* which : {static_cast<const CheckedPart*>(nullptr), &part})
  {
    const PartCounts counts(own.mesh, which);
    CountedValues values{true, 4.0, 7.0, 2, 1};
    counts.addOthers(values);
    EXPECT_EQ(std::tuple(values.isGreatest, values.worst, values.sum, values.count, values.failing),
              std::tuple(true, 4.0, 7.0, std::size_t{2}, std::size_t{1}));
    Vec3 sum(1, 2, 3);
    double size = 4.0;
    counts.addOthers(sum, size);
    EXPECT_EQ(sum, Vec3(1, 2, 3));
    EXPECT_EQ(size, 4.0);
    Box3 box{Vec3(0, 1, 2), Vec3(3, 4, 5)};
    counts.addOthers(box);
    EXPECT_EQ(box.min, Vec3(0, 1, 2));
    EXPECT_EQ(box.max, Vec3(3, 4, 5));
    for (const MeshPart kind : {MeshPart::Cells, MeshPart::Faces, MeshPart::Mesh})
    {
      EXPECT_EQ(counts.first(kind, 0, Vec3(6, 7, 8)), Vec3(6, 7, 8));
    }
    EXPECT_EQ(counts.first(MeshPart::Faces, own.mesh.faceCount() - 1, Vec3(6, 7, 8)), Vec3(6, 7, 8));
    EXPECT_THAT(counts.pointsOfOthers(1e9), IsEmpty());
  }
}

} // namespace
