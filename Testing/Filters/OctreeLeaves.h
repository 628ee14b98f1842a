// SPDX-License-Identifier: GPL-3.0-or-later
/// The leaves of an octree output, whatever its type, laid out in a grid of finest octants.
#pragma once

#include "Support/Types.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

class vtkDataObject;

namespace atria::testing {

struct OctreeLeaf
{
  Box3 box;
  int level = 0;
  int featureType = 0;

  double edge() const { return box.size()[0]; }
  bool touches(const Vec3& p) const
  {
    return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
  }
};

/// Cells of an unstructured grid of voxels, or leaves of a hyper tree grid that are not masked; by z, y, x of their
/// lower corners.
std::vector<OctreeLeaf> leavesOf(vtkDataObject* octree);

/// Which leaf is where: each is painted into the grid of finest octants.
class LeafMap
{
public:
  explicit LeafMap(const std::vector<OctreeLeaf>& leaves);

  /// The leaves overlap nowhere, and leave no gap in the domain.
  ::testing::AssertionResult tiles(const Box3& domain) const;
  /// Leaves that share a face, edge or corner differ by one level at most.
  ::testing::AssertionResult isBalanced() const;

private:
  std::size_t cellAt(const std::array<int, 3>& at) const { return at[0] + size[0] * (at[1] + size[1] * at[2]); }
  int leafAt(const std::array<int, 3>& at) const;
  void paint(int leaf);

  const std::vector<OctreeLeaf>& leaves_;
  double unit = 0.0;
  Vec3 low;
  std::array<std::size_t, 3> size{};
  std::vector<int> grid;
  std::string overlap;
};

} // namespace atria::testing
