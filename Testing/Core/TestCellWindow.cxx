// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests windows of a mesh, and the faces that are requested of them.
#include "CellSamples.h"
#include "Quality/Checks/CellWindow.h"
#include "Support/Error.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::cornersOf;
using atria::testing::hexahedra;
using atria::testing::Ids;
using atria::testing::mixedCells;
using atria::testing::SampleMesh;
using atria::testing::upTo;
using ::testing::Each;
using ::testing::ElementsAre;

bool shareAPoint(const SampleMesh& mesh, std::size_t a, std::size_t b)
{
  const Ids own = cornersOf(mesh, a);
  return std::ranges::find_first_of(own, cornersOf(mesh, b)) != own.end();
}

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
  const CellWindows windows(mesh.points, cells, chosen, nothing, length, executor);
  ASSERT_EQ(windows.count(), std::max<std::size_t>(1, chosen.size() / length));
  std::vector<Index> all;
  for (std::size_t number = 0; number < windows.count(); ++number)
  {
    const CellWindow window = windows.window(number);
    const std::vector<Index> own = ownCells(window);
    EXPECT_GE(own.size(), std::min(length, chosen.size()));
    EXPECT_LT(own.size(), 2 * length);
    all.insert(all.end(), own.begin(), own.end());
    const std::vector<Index> expected = windows.count() == 1 ? chosen : cellsOfWindow(mesh, chosen, own);
    EXPECT_TRUE(std::ranges::equal(window.cells(), expected)) << number;
    expectArrays(window, mesh);
    expectFaces(window, whole);
    EXPECT_TRUE(window.hasAskedFaces());
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
  const CellWindows windows(row.points, cells, chosen, nothing, 2, SerialExecutor());
  ASSERT_EQ(windows.count(), 3U);
  for (int again = 0; again < 2; ++again) // a window leaves nothing behind
  {
    EXPECT_THAT(windows.window(0).cells(), ElementsAre(0, 1, 2));
    EXPECT_THAT(windows.window(1).cells(), ElementsAre(1, 2, 3));
    EXPECT_THAT(windows.window(2).cells(), ElementsAre(5, 6)) << "4 is not there";
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
    const CellWindows windows(mesh.points, cells, all, asked, 2, SerialExecutor());
    std::vector<bool> out;
    for (std::size_t number = 0; number < windows.count(); ++number)
    {
      out.push_back(windows.window(number).hasAskedFaces());
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
    EXPECT_THROW(single.window(0), Error) << wrong;
  }
}

} // namespace
