// SPDX-License-Identifier: GPL-3.0-or-later
#include "OctreeLeaves.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace atria::testing {

namespace {

OctreeLeaf makeLeaf(const double bounds[6], vtkCellData* data, vtkIdType cell)
{
  OctreeLeaf leaf;
  leaf.box.min = Vec3(bounds[0], bounds[2], bounds[4]);
  leaf.box.max = Vec3(bounds[1], bounds[3], bounds[5]);
  leaf.level = static_cast<int>(data->GetArray("Level")->GetComponent(cell, 0));
  leaf.featureType = static_cast<int>(data->GetArray("FeatureType")->GetComponent(cell, 0));
  return leaf;
}

void collect(vtkHyperTreeGridNonOrientedGeometryCursor* cursor, vtkCellData* data, std::vector<OctreeLeaf>& leaves)
{
  if (cursor->IsMasked())
  {
    return;
  }
  if (cursor->IsLeaf())
  {
    double bounds[6];
    cursor->GetBounds(bounds);
    leaves.push_back(makeLeaf(bounds, data, cursor->GetGlobalNodeIndex()));
    return;
  }
  for (unsigned char child = 0; child < 8; ++child)
  {
    cursor->ToChild(child);
    collect(cursor, data, leaves);
    cursor->ToParent();
  }
}

} // namespace

std::vector<OctreeLeaf> leavesOf(vtkDataObject* octree)
{
  std::vector<OctreeLeaf> leaves;
  if (octree->GetNumberOfElements(vtkDataObject::CELL) == 0)
  {
    return leaves;
  }
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(octree))
  {
    vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
    trees->InitializeNonOrientedGeometryCursor(cursor, 0);
    collect(cursor, trees->GetCellData(), leaves);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(octree))
  {
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      double bounds[6];
      grid->GetCellBounds(cell, bounds);
      leaves.push_back(makeLeaf(bounds, grid->GetCellData(), cell));
    }
  }
  std::sort(leaves.begin(), leaves.end(), [](const OctreeLeaf& a, const OctreeLeaf& b) {
    const auto key = [](const OctreeLeaf& leaf) {
      const Vec3 c = leaf.box.center();
      return std::tuple(c[2], c[1], c[0]);
    };
    return key(a) < key(b);
  });
  return leaves;
}

LeafMap::LeafMap(const std::vector<OctreeLeaf>& leaves) : leaves_(leaves)
{
  Box3 bounds;
  unit = leaves.at(0).edge();
  for (const OctreeLeaf& leaf : leaves)
  {
    unit = std::min(unit, leaf.edge());
    bounds.extend(leaf.box.min);
    bounds.extend(leaf.box.max);
  }
  low = bounds.min;
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::size_t>(std::lround(bounds.size()[axis] / unit));
  }
  grid.assign(size[0] * size[1] * size[2], -1);
  for (int leaf = 0; leaf < static_cast<int>(leaves.size()); ++leaf)
  {
    paint(leaf);
  }
}

void LeafMap::paint(int leaf)
{
  const Vec3 first = (leaves_[leaf].box.min - low) / unit;
  const int width = static_cast<int>(std::lround(leaves_[leaf].edge() / unit));
  const std::array<int, 3> at{static_cast<int>(std::lround(first[0])), static_cast<int>(std::lround(first[1])),
                              static_cast<int>(std::lround(first[2]))};
  for (int z = at[2]; z < at[2] + width; ++z)
  {
    for (int y = at[1]; y < at[1] + width; ++y)
    {
      for (int x = at[0]; x < at[0] + width; ++x)
      {
        int& cell = grid.at(cellAt({x, y, z}));
        if (cell >= 0)
        {
          overlap = "leaves " + std::to_string(cell) + " and " + std::to_string(leaf) + " overlap";
        }
        cell = leaf;
      }
    }
  }
}

int LeafMap::leafAt(const std::array<int, 3>& at) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (at[axis] < 0 || at[axis] >= static_cast<int>(size[axis]))
    {
      return -1;
    }
  }
  return grid[cellAt(at)];
}

::testing::AssertionResult LeafMap::tiles(const Box3& domain) const
{
  if (!overlap.empty())
  {
    return ::testing::AssertionFailure() << overlap;
  }
  const double slack = 1e-9 * unit;
  double volume = 0.0;
  for (const OctreeLeaf& leaf : leaves_)
  {
    const Vec3 shared = leaf.box.max.cwiseMin(domain.max) - leaf.box.min.cwiseMax(domain.min);
    if (shared.minCoeff() < slack)
    {
      return ::testing::AssertionFailure() << "the leaf at " << leaf.box.min.transpose() << " is outside the domain";
    }
    volume += shared.prod();
  }
  if (std::abs(volume / domain.size().prod() - 1.0) > 1e-12)
  {
    return ::testing::AssertionFailure() << "leaves fill " << volume << " of the domain's " << domain.size().prod();
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult LeafMap::isBalanced() const
{
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    const std::array<int, 3> at{static_cast<int>(i % size[0]), static_cast<int>(i / size[0] % size[1]),
                                static_cast<int>(i / size[0] / size[1])};
    for (int k = 0; k < 27 && grid[i] >= 0; ++k)
    {
      const int other = leafAt({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      if (other >= 0 && std::abs(leaves_[other].level - leaves_[grid[i]].level) > 1)
      {
        return ::testing::AssertionFailure() << "levels " << leaves_[other].level << " and " << leaves_[grid[i]].level
                                             << " meet at " << leaves_[grid[i]].box.min.transpose();
      }
    }
  }
  return ::testing::AssertionSuccess();
}

} // namespace atria::testing
