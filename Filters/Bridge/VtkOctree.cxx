// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkOctree.h"

#include "AddArray.h"
#include "Support/Error.h"

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkHyperTree.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedCursor.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

constexpr const char* frameArrayName = "OctreeFrame";
constexpr vtkIdType frameValueCount = 24;

void addFrame(const GridFrame& f, vtkDataObject* out)
{
  auto* values = addArray<vtkDoubleArray>(out->GetFieldData(), frameArrayName);
  for (const double v : {f.origin[0], f.origin[1], f.origin[2], f.finestSize, double(f.depth), double(f.startLevel),
                         double(f.midLevel), double(f.topLevel), double(f.subBits), f.domain.min[0], f.domain.max[0],
                         f.domain.min[1], f.domain.max[1], f.domain.min[2], f.domain.max[2], double(f.featureLevel)})
  {
    values->InsertNextValue(v);
  }
  const PlacedPrism turned = f.prism();
  for (const double v :
       {f.placement.angle(), f.turnedDomain ? 1.0 : 0.0, turned.axes.angle(), turned.bounds.min[0],
        turned.bounds.max[0], turned.bounds.min[1], turned.bounds.max[1], double(turned.sides().size())})
  {
    values->InsertNextValue(v);
  }
  for (const PrismSide& side : turned.sides())
  {
    if (!turned.isBox())
    {
      values->InsertNextValue(side.start[0]);
      values->InsertNextValue(side.start[1]);
    }
  }
}

/// Reads the domain. Its corners follow the other values.
PlacedPrism prismOf(const PlacedBox& box, vtkDoubleArray& values)
{
  const auto count = static_cast<vtkIdType>(values.GetValue(frameValueCount - 1));
  if (values.GetNumberOfValues() != frameValueCount + 2 * count)
  {
    throw Error("the octree's field array OctreeFrame is damaged");
  }
  std::vector<Vec2> corners;
  for (vtkIdType i = 0; i < count; ++i)
  {
    corners.emplace_back(values.GetValue(frameValueCount + 2 * i), values.GetValue(frameValueCount + 2 * i + 1));
  }
  // A regular prism may be stretched more than a polygon may be.
  PlacedPrism regular(box, static_cast<int>(count));
  const bool isRegular = !regular.isBox() && std::ranges::equal(regular.sides(), corners, {}, &PrismSide::start);
  return isRegular ? regular : PlacedPrism(box.axes, corners, box.bounds.min[2], box.bounds.max[2]);
}

GridFrame frameOf(vtkDataObject* data)
{
  auto* values = vtkDoubleArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(frameArrayName));
  if (!values || values->GetNumberOfValues() < frameValueCount)
  {
    throw Error("the octree lacks the field array OctreeFrame: it must come from the octree source");
  }
  const auto at = [&](vtkIdType i) { return values->GetValue(i); };
  GridFrame f;
  f.origin = Vec3(at(0), at(1), at(2));
  f.finestSize = at(3);
  f.depth = static_cast<int>(at(4));
  f.startLevel = static_cast<int>(at(5));
  f.midLevel = static_cast<int>(at(6));
  f.topLevel = static_cast<int>(at(7));
  f.subBits = static_cast<int>(at(8));
  f.featureLevel = static_cast<int>(at(15));
  f.domain.min = Vec3(at(9), at(11), at(13));
  f.domain.max = Vec3(at(10), at(12), at(14));
  if (!(f.finestSize > 0.0) || f.depth < 0 || f.depth > GridFrame::maximumDepth || f.subBits < 1 || f.subBits > 39 ||
      f.featureLevel < 0 || f.featureLevel > f.depth || f.domain.empty())
  {
    throw Error("the octree's field array OctreeFrame is damaged");
  }
  f.placement = Placement(at(16));
  if (at(17) != 0.0)
  {
    const PlacedBox box{Placement(at(18)), {{at(19), at(21), at(13)}, {at(20), at(22), at(14)}}};
    f.turnedDomain = values->GetNumberOfValues() == frameValueCount ? PlacedPrism(box) : prismOf(box, *values);
  }
  f.domainLow = f.toLattice(f.domain.min);
  f.domainHigh = f.toLattice(f.domain.max);
  return f;
}

/// Collects the ancestors of leaves.
class SetBuilder
{
public:
  explicit SetBuilder(int depth) : depth_(depth), sets(depth) {}

  /// `key` in the grid of `level`.
  void addLeaf(MortonKey key, int level)
  {
    if (level > 0)
    {
      sets[level - 1].push_back(key >> 3);
    }
  }

  RefinedSets finish()
  {
    for (int level = depth_ - 1; level >= 0; --level)
    {
      auto& set = sets[level];
      std::sort(set.begin(), set.end());
      set.erase(std::unique(set.begin(), set.end()), set.end());
      for (const MortonKey key : set)
      {
        addLeaf(key, level);
      }
    }
    while (!sets.empty() && sets.back().empty())
    {
      sets.pop_back();
    }
    return std::move(sets);
  }

private:
  int depth_;
  RefinedSets sets;
};

/// Bounds of a cell along the grid's axes.
std::array<double, 6> boundsInGrid(vtkUnstructuredGrid* grid, vtkIdType cell, const Placement& placement)
{
  std::array<double, 6> bounds;
  if (placement.angle() == 0.0)
  {
    grid->GetCellBounds(cell, bounds.data());
    return bounds;
  }
  Box3 box;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cell, count, ids);
  for (vtkIdType i = 0; i < count; ++i)
  {
    box.extend(placement.fromModel(Vec3(grid->GetPoint(ids[i]))));
  }
  return {box.min[0], box.max[0], box.min[1], box.max[1], box.min[2], box.max[2]};
}

RefinedSets setsOf(vtkUnstructuredGrid* grid, const GridFrame& frame)
{
  SetBuilder builder(frame.depth);
  const bool turned = frame.placement.angle() != 0.0;
  const int wanted = turned ? VTK_HEXAHEDRON : VTK_VOXEL;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    const std::array<double, 6> bounds = boundsInGrid(grid, i, frame.placement);
    const double ratio = std::log2((bounds[1] - bounds[0]) / frame.finestSize);
    const int level = frame.depth - static_cast<int>(std::lround(ratio));
    const double size = frame.sizeOf(std::clamp(level, 0, frame.depth));
    GridCell cell;
    bool fits = grid->GetCellType(i) == wanted && level >= 0 && level <= frame.depth &&
                std::abs(ratio - std::round(ratio)) < 1e-3;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double position = (bounds[std::size_t{2} * axis] - frame.origin[axis]) / size;
      fits = fits && std::abs(position - std::round(position)) < 1e-3 && position > -0.5 &&
             position < static_cast<double>(std::int64_t{1} << std::clamp(level, 0, 20)) - 0.5;
      cell[axis] = fits ? static_cast<std::uint32_t>(std::llround(position)) : 0;
    }
    if (!fits)
    {
      throw Error("cell " + std::to_string(i) + " is not an octant of the octree its OctreeFrame describes");
    }
    builder.addLeaf(mortonKey(cell), level);
  }
  return builder.finish();
}

void collect(vtkHyperTreeGridNonOrientedCursor* cursor, MortonKey key, int level, SetBuilder& builder, int depth)
{
  if (cursor->IsLeaf() || level >= depth)
  {
    builder.addLeaf(key, level);
    return;
  }
  for (unsigned char k = 0; k < 8; ++k)
  {
    cursor->ToChild(k);
    collect(cursor, key << 3 | k, level + 1, builder, depth);
    cursor->ToParent();
  }
}

RefinedSets setsOf(vtkHyperTreeGrid* grid, const GridFrame& frame)
{
  SetBuilder builder(frame.depth);
  vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
  grid->InitializeNonOrientedCursor(cursor, 0);
  collect(cursor, 0, 0, builder, frame.depth);
  return builder.finish();
}

/// Fills a hyper tree and its arrays, indexed by the tree's own numbers.
class HyperTreeFiller
{
public:
  HyperTreeFiller(const Octree& source, vtkHyperTreeGrid* target)
      : octree(source), levels(addArray<vtkUnsignedCharArray>(target->GetCellData(), "Level")),
        types(addArray<vtkUnsignedCharArray>(target->GetCellData(), "FeatureType"))
  {
  }

  void fill(vtkHyperTreeGrid* target)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    target->InitializeNonOrientedCursor(cursor, 0, true);
    cursor->SetGlobalIndexStart(0);
    fill(cursor, octree.root(), 0);
    target->SetMask(mask);
  }

private:
  void fill(vtkHyperTreeGridNonOrientedCursor* cursor, Octree::Node node, int level)
  {
    const vtkIdType id = cursor->GetGlobalNodeIndex();
    const bool isLeaf = Octree::isLeaf(node);
    levels->InsertValue(id, static_cast<unsigned char>(level));
    types->InsertValue(id, isLeaf ? static_cast<unsigned char>(octree.featureType(Octree::leafOf(node))) : 0);
    mask->InsertValue(id, isLeaf && !octree.inDomain(Octree::leafOf(node)) ? 1 : 0);
    if (isLeaf)
    {
      return;
    }
    cursor->SubdivideLeaf();
    for (unsigned char k = 0; k < 8; ++k)
    {
      cursor->ToChild(k);
      fill(cursor, octree.children(node)[k], level + 1);
      cursor->ToParent();
    }
  }

  const Octree& octree;
  vtkUnsignedCharArray* levels;
  vtkUnsignedCharArray* types;
  vtkNew<vtkBitArray> mask;
};

/// Grid points of the leaves, each once.
std::vector<std::array<vtkIdType, 8>> numberCorners(const Octree& octree, const std::vector<Index>& leaves,
                                                    vtkPoints* points)
{
  struct Use
  {
    LatticePoint at;
    Index cell;
    unsigned corner;
  };
  std::vector<Use> uses;
  uses.reserve(8 * leaves.size());
  for (Index i = 0; i < leaves.size(); ++i)
  {
    for (unsigned c = 0; c < 8; ++c)
    {
      uses.push_back({octree.cornerOf(leaves[i], c), i, c});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& l, const Use& r) {
    return std::tie(l.at[2], l.at[1], l.at[0], l.cell) < std::tie(r.at[2], r.at[1], r.at[0], r.cell);
  });
  std::vector<std::array<vtkIdType, 8>> corners(leaves.size());
  for (std::size_t i = 0; i < uses.size(); ++i)
  {
    if (i == 0 || uses[i].at != uses[i - 1].at)
    {
      const GridFrame& frame = octree.frame();
      points->InsertNextPoint(frame.placement.toModel(frame.toModel(uses[i].at)).data());
    }
    corners[uses[i].cell][uses[i].corner] = points->GetNumberOfPoints() - 1;
  }
  return corners;
}

} // namespace

void octreeToVtk(const Octree& octree, vtkUnstructuredGrid* out)
{
  std::vector<Index> leaves;
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    if (octree.inDomain(leaf))
    {
      leaves.push_back(leaf);
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  auto corners = numberCorners(octree, leaves, points);
  // A voxel stands along the axes; turned octants are hexahedra.
  const bool turned = octree.frame().placement.angle() != 0.0;
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(leaves.size()), 8 * static_cast<vtkIdType>(leaves.size()));
  auto* levels = addArray<vtkUnsignedCharArray>(out->GetCellData(), "Level");
  auto* types = addArray<vtkUnsignedCharArray>(out->GetCellData(), "FeatureType");
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    if (turned)
    {
      std::swap(corners[i][2], corners[i][3]);
      std::swap(corners[i][6], corners[i][7]);
    }
    cells->InsertNextCell(8, corners[i].data());
    levels->InsertNextValue(static_cast<unsigned char>(octree.level(leaves[i])));
    types->InsertNextValue(static_cast<unsigned char>(octree.featureType(leaves[i])));
  }
  out->SetPoints(points);
  out->SetCells(turned ? VTK_HEXAHEDRON : VTK_VOXEL, cells);
  addFrame(octree.frame(), out);
}

void octreeToVtk(const Octree& octree, vtkHyperTreeGrid* out)
{
  if (octree.frame().placement.angle() != 0.0)
  {
    throw Error("a hyper tree grid stands along the axes and cannot be turned: choose OutputType UnstructuredGrid, or "
                "AlignGrid ToAxes");
  }
  out->Initialize();
  out->SetDimensions(2, 2, 2);
  out->SetBranchFactor(2);
  const GridFrame& frame = octree.frame();
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->InsertNextValue(frame.origin[axis]);
    coordinates->InsertNextValue(frame.origin[axis] + frame.rootSize());
    axis == 0   ? out->SetXCoordinates(coordinates)
    : axis == 1 ? out->SetYCoordinates(coordinates)
                : out->SetZCoordinates(coordinates);
  }
  HyperTreeFiller(octree, out).fill(out);
  addFrame(frame, out);
}

OctreeSets octreeFromVtk(vtkDataObject* data)
{
  OctreeSets out;
  out.frame = frameOf(data);
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    out.refined = setsOf(grid, out.frame);
  }
  else if (auto* trees = vtkHyperTreeGrid::SafeDownCast(data))
  {
    out.refined = setsOf(trees, out.frame);
  }
  else
  {
    throw Error("an octree must be an unstructured grid of voxels or a hyper tree grid");
  }
  return out;
}

} // namespace atria
