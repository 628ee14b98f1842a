// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how points on sheets are split.
#include "Dual/Mesh/Sheets.h"
#include "DualBlock.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

/// The sectors of the elements around a point, by flooding through inner faces at the point, in order of elements.
std::map<Index, Index> sectorsAt(const DualMesh& mesh, Index point)
{
  std::map<Index, Index> sectors;
  Index count = 0;
  const auto has = [&](Index e, std::size_t direction) {
    return std::ranges::any_of(hexahedronFace.at(direction),
                               [&](std::uint8_t c) { return mesh.corners[e].at(c) == point; });
  };
  for (Index seed = 0; seed < mesh.elementCount(); ++seed)
  {
    std::vector<Index> open;
    if (std::ranges::count(mesh.corners[seed], point) > 0 && !sectors.contains(seed))
    {
      sectors[seed] = count++;
      open.push_back(seed);
    }
    while (!open.empty())
    {
      const Index e = open.back();
      open.pop_back();
      for (std::size_t direction = 0; direction < 6; ++direction)
      {
        const std::int32_t next = mesh.neighbors[e].at(direction);
        if (next >= 0 && has(e, direction) && sectors.try_emplace(static_cast<Index>(next), sectors[e]).second)
        {
          open.push_back(static_cast<Index>(next));
        }
      }
    }
  }
  return sectors;
}

void expectSplit(const DualMesh& before, const Executor& executor)
{
  DualMesh expected = before;
  std::vector<Index> sources;
  for (Index point = 0; point < before.points.size(); ++point)
  {
    const Index first = static_cast<Index>(expected.points.size()) - 1;
    Index most = 0;
    for (const auto& [element, sector] : sectorsAt(before, point))
    {
      most = std::max(most, sector);
      std::ranges::replace(expected.corners[element], point, sector == 0 ? point : first + sector);
    }
    expected.points.insert(expected.points.end(), most, before.points[point]);
    sources.insert(sources.end(), most, point);
  }
  DualMesh mesh = before;
  EXPECT_EQ(splitSheets(mesh, quietContext(executor)), sources);
  EXPECT_EQ(mesh.points, expected.points);
  EXPECT_EQ(mesh.corners, expected.corners);
  EXPECT_EQ(mesh.neighbors, before.neighbors);
}

TEST(Sheets, GiveEachSectorAroundAPointItsCopy)
{
  std::mt19937 random(4);
  const SerialExecutor serial;
  const ThreadExecutor threads(3);
  for (int round = 0; round < 60; ++round)
  {
    std::set<std::pair<Index, int>> sheets;
    for (Index e = 0; e < 27; ++e)
    {
      for (const int direction : {xMax, yMax, zMax})
      {
        if (static_cast<int>(random() % 60) < round)
        {
          sheets.emplace(e, direction);
        }
      }
    }
    const Block block({3, 3, 3}, [&](Index e, int direction) { return sheets.contains({e, direction}); });
    expectSplit(block.mesh, round % 2 == 0 ? static_cast<const Executor&>(serial) : threads);
  }
}

TEST(Sheets, KeepTheirBoundaryEdgesWholeAndPartAtJunctions)
{
  const auto copiesOf = [](std::array<Index, 3> size, const std::set<std::pair<Index, int>>& sheets) {
    DualMesh mesh = Block(size, [&](Index e, int direction) { return sheets.contains({e, direction}); }).mesh;
    return splitSheets(mesh, quietContext()).size();
  };
  EXPECT_EQ(copiesOf({2, 2, 1}, {}), 0U);
  EXPECT_EQ(copiesOf({2, 1, 1}, {{0, xMax}}), 4U) << "a sheet across parts all points";
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}}), 2U) << "but not those of its boundary edge";
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}, {2, xMax}}), 6U);
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}, {2, xMax}, {0, yMax}}), 6U + 2U + 2U) << "a junction has three sectors";
}

} // namespace
