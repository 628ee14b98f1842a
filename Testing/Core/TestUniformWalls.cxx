// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/UniformWalls.h"
#include "Octree/Tree/Balance.h"
#include "Octree/Tree/GeometryLists.h"
#include "Octree/Tree/SplitOctants.h"
#include "SizedOctree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace {

using namespace atria;
using namespace atria::testing;

SizingOptions forHexahedra()
{
  SizingOptions sizing;
  sizing.hexahedra = true;
  return sizing;
}

/// Returns the octants around a leaf that are at most so many octants of its size away.
std::vector<Index> leavesAround(const Octree& octree, Index leaf, int rings)
{
  const std::int64_t reach = rings * octree.frame().latticeSize(octree.level(leaf)) - 1;
  return leavesTouching(octree, grown({octree.lowCorner(leaf), octree.highCorner(leaf)}, reach));
}

void expectUniformAtWalls(const Sized& sized)
{
  const Octree& octree = sized.octree;
  const SplitOctants split(octree, quietContext());
  eachLeaf(octree, [&](Index leaf) {
    if (octree.items(leaf).empty())
    {
      return;
    }
    for (const Index other : leavesAround(octree, leaf, 1))
    {
      EXPECT_FALSE(octree.inDomain(other) && octree.level(other) < octree.level(leaf)) << leaf << " and " << other;
      EXPECT_FALSE(octree.inDomain(other) && split.isSplit(other)) << leaf << " and " << other;
    }
    for (const Index other : leavesAround(octree, leaf, 2))
    {
      EXPECT_LE(octree.level(other), octree.level(leaf)) << leaf << " and " << other;
    }
  });
  RefinedSets again = sized.octants.refined;
  makeUniformAtWalls(again, sized.model, sized.frame, 1, quietContext());
  EXPECT_EQ(again, sized.octants.refined) << "nothing is left to refine";
}

TEST(UniformWalls, HaveOneSizeNearEachSurface)
{
  expectUniformAtWalls(sized(twoBoxes(), gridOf(30.0, 0.25, 1.0, 4.0), forHexahedra()));
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    SCOPED_TRACE(seed);
    expectUniformAtWalls(sized(randomSoup(seed), gridOf(12.0, 0.25, 0.5, 2.0), forHexahedra()));
  }
}

TEST(UniformWalls, MayDifferBetweenSurfacesFarApart)
{
  SizingOptions sizing = forHexahedra();
  sizing.surfaceSizes = {{"Wall*", 1.0, 1.0}, {"Detail", 0.25, 0.25}};
  const Sized apart = sized(twoBoxes(), gridOf(30.0, 0.25, 1.0, 4.0), sizing);
  expectUniformAtWalls(apart);
  std::map<std::string, std::set<int>> levels;
  eachLeaf(apart.octree, [&](Index leaf) {
    for (const ModelItem item : apart.octree.items(leaf, ModelItem::triangle))
    {
      levels[apart.model.names[apart.model.surfaceIds[item.index]]].insert(apart.octree.level(leaf));
    }
  });
  EXPECT_EQ(levels["Wall north"].size(), 1U);
  EXPECT_EQ(levels["Detail"].size(), 1U);
  EXPECT_LT(*levels["Wall north"].begin(), *levels["Detail"].begin());
}

} // namespace
