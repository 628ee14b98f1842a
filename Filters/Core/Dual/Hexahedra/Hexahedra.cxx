// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Hexahedra/Hexahedra.h"

#include "Dual/Grid/GridPoints.h"
#include "Dual/Vertices/TurnedDomain.h"
#include "Grid/DomainPlanes.h"
#include "Octree/Tree/SplitOctants.h"
#include "Support/Error.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <bit>
#include <map>
#include <sstream>

namespace atria {

namespace {

/// The eight cells around a point of the grid, by direction: bits x 1, y 2, z 4.
using CellsAround = std::array<SplitCell, 8>;

/// A point of the grid at split octants, whose element is made anew.
struct GridPoint
{
  LatticePoint place;
  CellsAround cells;
  /// Its element, or noIndex if it has none yet.
  Index element = noIndex;
};

/// A face of the element of a point, by its cells in rising order.
struct PointFace
{
  std::array<SplitCell, 4> cells;
  Index point;
  std::uint8_t direction;

  bool operator<(const PointFace& other) const { return cells < other.cells; }
};

class HexahedraMaker
{
public:
  HexahedraMaker(DualMesh& mesh, VertexClassification& classification, const Octree& octree, std::size_t surfaceCount,
                 const RunContext& context)
      : mesh_(mesh), vertices_(classification), octree_(octree), frame_(octree.frame()), surfaceCount_(surfaceCount),
        context_(context), split_(octree, context), oldVertices_(mesh.points.size())
  {
  }

  void run()
  {
    findPlanes();
    addOldPoints();
    oldPoints_ = points_.size();
    addNewPoints();
    matchFaces();
    keepReached();
    makeElements();
    linkElements();
    placeOnSides();
  }

private:
  void findPlanes()
  {
    vertices_.planes.resize(mesh_.points.size());
    context_.executor.forEach(mesh_.points.size(), 8192, [&](std::size_t v) {
      const Index leaf = vertices_.leaves[v];
      vertices_.planes[v] =
          static_cast<std::uint8_t>(frame_.domainPlanes(octree_.lowCorner(leaf), octree_.highCorner(leaf)));
    });
  }

  /// Adds the points whose elements have a split octant.
  void addOldPoints()
  {
    const std::vector<Index> touched = chosenNumbers(mesh_.elementCount(), context_.executor, [&](std::size_t e) {
      return std::ranges::any_of(mesh_.corners[e], [&](Index v) { return split_.isSplit(vertices_.leaves[v]); });
    });
    points_.resize(touched.size());
    context_.executor.forEach(touched.size(), 2048, [&](std::size_t i) {
      std::array<Index, 8> leaves{};
      for (std::uint8_t corner = 0; corner < 8; ++corner)
      {
        leaves[hexahedronCorner[corner]] = vertices_.leaves[mesh_.corners[touched[i]][corner]];
      }
      GridPoint& point = points_[i];
      point.place = positionOf(octree_, leaves);
      point.element = touched[i];
      for (unsigned direction = 0; direction < 8; ++direction)
      {
        point.cells[direction] = split_.cellAt(leaves[direction], point.place, direction);
      }
    });
  }

  bool isInDomain(const LatticePoint& p) const
  {
    return frame_.inDomain(p) &&
           (!frame_.turnedDomain || frame_.turnedDomain->contains(frame_.placement.toModel(frame_.toModel(p))));
  }

  CellsAround cellsAround(const LatticePoint& p) const
  {
    CellsAround cells{};
    for (unsigned direction = 0; direction < 8; ++direction)
    {
      LatticePoint beside = p;
      for (int axis = 0; axis < 3; ++axis)
      {
        beside[axis] -= (direction >> axis & 1) != 0 ? 0 : 1;
      }
      cells[direction] = split_.cellAt(octree_.leafAt(beside), p, direction);
    }
    return cells;
  }

  /// Adds the points in and on split octants that the octree does not have. Each belongs to the first leaf around it.
  void addNewPoints()
  {
    const std::vector<Index> leaves = chosenNumbers(octree_.leafCount(), context_.executor, [&](std::size_t leaf) {
      return split_.isSplit(static_cast<Index>(leaf)) && octree_.inDomain(static_cast<Index>(leaf));
    });
    std::vector<std::vector<GridPoint>> found(leaves.size());
    context_.executor.forEach(leaves.size(), 256, [&](std::size_t i) {
      for (const LatticePoint& place : split_.pointsOf(leaves[i]))
      {
        if (!isInDomain(place))
        {
          continue;
        }
        const CellsAround cells = cellsAround(place);
        if (leafOf(*std::ranges::min_element(cells)) == leaves[i])
        {
          found[i].push_back({place, cells});
        }
      }
    });
    for (const std::vector<GridPoint>& some : found)
    {
      points_.insert(points_.end(), some.begin(), some.end());
    }
  }

  std::array<SplitCell, 4> cellsOf(const GridPoint& point, int direction) const
  {
    std::array<SplitCell, 4> cells{};
    std::ranges::transform(hexahedronFace[direction], cells.begin(),
                           [&](std::uint8_t corner) { return point.cells[hexahedronCorner[corner]]; });
    return cells;
  }

  /// Finds the point across each face that has a split octant; noIndex if there is none.
  void matchFaces()
  {
    across_.assign(points_.size(), {noIndex, noIndex, noIndex, noIndex, noIndex, noIndex});
    std::vector<PointFace> faces;
    for (Index i = 0; i < points_.size(); ++i)
    {
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        std::array<SplitCell, 4> cells = cellsOf(points_[i], direction);
        if (hasSplit(cells))
        {
          std::ranges::sort(cells);
          faces.push_back({cells, i, direction});
        }
      }
    }
    sortOnThreads(faces, context_);
    for (std::size_t f = 0; f + 1 < faces.size(); ++f)
    {
      if (faces[f].cells == faces[f + 1].cells)
      {
        across_[faces[f].point][faces[f].direction] = faces[f + 1].point;
        across_[faces[f + 1].point][faces[f + 1].direction] = faces[f].point;
        ++f;
      }
    }
  }

  bool hasSplit(const std::array<SplitCell, 4>& cells) const
  {
    return std::ranges::any_of(cells, [&](SplitCell cell) { return split_.isSplit(leafOf(cell)); });
  }

  /// Gives the points that are reached from an element's new elements, in order.
  void keepReached()
  {
    std::vector<Index> likes(points_.size(), noIndex);
    std::vector<Index> open;
    for (Index i = 0; i < oldPoints_; ++i)
    {
      likes[i] = points_[i].element;
      open.push_back(i);
    }
    for (std::size_t next = 0; next < open.size(); ++next)
    {
      for (const Index other : across_[open[next]])
      {
        if (other != noIndex && likes[other] == noIndex)
        {
          likes[other] = likes[open[next]];
          open.push_back(other);
        }
      }
    }
    for (std::size_t i = oldPoints_; i < points_.size(); ++i)
    {
      if (likes[i] != noIndex)
      {
        points_[i].element = static_cast<Index>(mesh_.elementCount());
        appendElement(mesh_, {}, {}, mesh_, likes[i]);
      }
    }
  }

  void makeElements()
  {
    for (Index v = 0; v < oldVertices_; ++v)
    {
      if (split_.isSplit(vertices_.leaves[v]))
      {
        moveToPart(v, SplitCell{vertices_.leaves[v]} << 3);
      }
    }
    for (const GridPoint& point : points_)
    {
      if (point.element == noIndex)
      {
        continue;
      }
      int finest = 0;
      for (std::uint8_t corner = 0; corner < 8; ++corner)
      {
        const SplitCell cell = point.cells[hexahedronCorner[corner]];
        mesh_.corners[point.element][corner] = vertexOf(cell);
        finest = std::max(finest, octree_.level(leafOf(cell)));
      }
      mesh_.levels[point.element] = static_cast<std::uint8_t>(finest);
    }
  }

  Index vertexOf(SplitCell cell)
  {
    if (const Index old = oldVertexOf(cell); old != noIndex)
    {
      return old;
    }
    const auto [place, isNew] = vertexOf_.try_emplace(cell, static_cast<Index>(mesh_.points.size()));
    if (isNew)
    {
      mesh_.points.emplace_back();
      vertices_.classes.push_back(VertexClass::free);
      vertices_.leaves.push_back(leafOf(cell));
      vertices_.offsets.push_back(vertices_.offsets.back());
      vertices_.planes.push_back(planesOf(cell));
      moveToPart(place->second, cell);
    }
    return place->second;
  }

  /// Returns the vertex of the octree's dual that a cell has; noIndex if there is none. These are in order of leaves.
  Index oldVertexOf(SplitCell cell) const
  {
    const auto end = vertices_.leaves.begin() + static_cast<std::ptrdiff_t>(oldVertices_);
    const auto found = std::lower_bound(vertices_.leaves.begin(), end, leafOf(cell));
    return partOf(cell) == 0 && found != end && *found == leafOf(cell)
               ? static_cast<Index>(found - vertices_.leaves.begin())
               : noIndex;
  }

  /// Returns the domain's planes through a cell.
  std::uint8_t planesOf(SplitCell cell) const
  {
    const LatticeBox box = split_.boundsOf(cell);
    return static_cast<std::uint8_t>(frame_.domainPlanes(box.low, box.high));
  }

  void moveToPart(Index vertex, SplitCell cell)
  {
    if (vertices_.classes[vertex] == VertexClass::free)
    {
      const Vec3 center = frame_.toModel(split_.centerOf(cell));
      mesh_.points[vertex] = onDomainPlanes(center, vertices_.planes[vertex], frame_);
    }
  }

  void linkElements()
  {
    for (Index i = 0; i < points_.size(); ++i)
    {
      for (int direction = 0; points_[i].element != noIndex && direction < 6; ++direction)
      {
        if (hasSplit(cellsOf(points_[i], direction)))
        {
          link(points_[i], across_[i][direction], direction);
        }
      }
    }
    dropUnused();
  }

  void link(const GridPoint& point, Index across, int direction)
  {
    std::int32_t& code = mesh_.neighbors[point.element][direction];
    const bool wasOnBoundary = DualMesh::isBoundary(code); // codes of new elements are 0
    if (wasOnBoundary && !mesh_.boundaryFaces[DualMesh::boundaryFaceOf(code)].onDomainSide)
    {
      refuse(point);
    }
    if (across != noIndex)
    {
      code = static_cast<std::int32_t>(points_[across].element);
    }
    else if (!wasOnBoundary)
    {
      code = ~static_cast<std::int32_t>(mesh_.boundaryFaces.size());
      mesh_.boundaryFaces.push_back({point.element, sideOf(point, direction), noIndex,
                                     static_cast<std::uint8_t>(direction), SheetSide::front, true});
    }
  }

  /// Returns the tag of the domain's side at which a face is.
  Index sideOf(const GridPoint& point, int direction) const
  {
    unsigned common = 0x3f;
    for (const SplitCell cell : cellsOf(point, direction))
    {
      common &= planesOf(cell);
    }
    const Index bare = static_cast<Index>(surfaceCount_);
    if ((common >> direction & 1) != 0)
    {
      return bare + static_cast<Index>(direction);
    }
    if (frame_.turnedDomain)
    {
      return bare + uprightSideAt(point, direction);
    }
    if (common == 0)
    {
      refuse(point);
    }
    return bare + static_cast<Index>(std::countr_zero(common));
  }

  Index uprightSideAt(const GridPoint& point, int direction) const
  {
    Vec3 p = frame_.toModel(point.place);
    const double step = frame_.sizeOf(octree_.level(leafOf(cellsOf(point, direction)[0])));
    p[axisOf(direction)] += isUpper(direction) ? step : -step;
    const Vec3 along = frame_.turnedDomain->axes.fromModel(frame_.placement.toModel(p));
    const auto& sides = frame_.turnedDomain->sides();
    return std::ranges::max_element(sides, {}, [&](const PrismSide& s) { return s.beyond(along.head<2>()); })->number;
  }

  [[noreturn]] void refuse(const GridPoint& point) const
  {
    const Vec3 at = frame_.placement.toModel(frame_.toModel(point.place));
    std::ostringstream text;
    text << "sizes change too close to a surface for a mesh of hexahedra, at (" << at[0] << ", " << at[1] << ", "
         << at[2] << "): use the same size there and on the surface";
    throw Error(text.str());
  }

  /// Drops boundary faces that have an element across now.
  void dropUnused()
  {
    std::vector<BoundaryFace> kept;
    for (std::size_t f = 0; f < mesh_.boundaryFaces.size(); ++f)
    {
      const BoundaryFace& face = mesh_.boundaryFaces[f];
      std::int32_t& code = mesh_.neighbors[face.element][face.direction];
      if (code == ~static_cast<std::int32_t>(f))
      {
        code = ~static_cast<std::int32_t>(kept.size());
        kept.push_back(face);
      }
    }
    mesh_.boundaryFaces = std::move(kept);
  }

  /// Moves vertices of faces on upright sides of a turned domain to these.
  void placeOnSides()
  {
    if (!frame_.turnedDomain)
    {
      return;
    }
    std::map<Index, SideBits> sides;
    for (const BoundaryFace& face : mesh_.boundaryFaces)
    {
      const Index side = face.tag - static_cast<Index>(surfaceCount_);
      if (face.tag < surfaceCount_ || !isUprightSide(side))
      {
        continue;
      }
      for (const std::uint8_t corner : hexahedronFace[face.direction])
      {
        const Index v = mesh_.corners[face.element][corner];
        if (split_.isSplit(vertices_.leaves[v]) && vertices_.classes[v] == VertexClass::free)
        {
          sides[v] |= SideBits{1} << side;
        }
      }
    }
    for (const auto& [vertex, on] : sides)
    {
      mesh_.points[vertex] = onTurnedSides(mesh_.points[vertex], on, frame_);
    }
  }

  DualMesh& mesh_;
  VertexClassification& vertices_;
  const Octree& octree_;
  const GridFrame& frame_;
  std::size_t surfaceCount_;
  const RunContext& context_;
  SplitOctants split_;
  std::size_t oldVertices_;
  std::vector<GridPoint> points_; ///< points with elements of the octree's dual come first
  std::size_t oldPoints_ = 0;
  std::vector<std::array<Index, 6>> across_;
  std::map<SplitCell, Index> vertexOf_;
};

} // namespace

void makeHexahedral(DualMesh& mesh, VertexClassification& classification, const Octree& octree,
                    std::size_t surfaceCount, const RunContext& context)
{
  HexahedraMaker(mesh, classification, octree, surfaceCount, context).run();
}

} // namespace atria
