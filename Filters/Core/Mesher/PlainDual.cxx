// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/PlainDual.h"

#include "Dual/Hexahedra/Hexahedra.h"
#include "Dual/Vertices/DualVertices.h"
#include "Dual/Vertices/TurnedDomain.h"
#include "Dual/Zones/CrackClosing.h"
#include "Mesher/MeshPort.h"
#include "Support/NumberInOrder.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <atomic>

namespace atria {

namespace {

/// Returns the leaves of kept elements, in order; `numbers` becomes their vertex numbers.
std::vector<Index> numberVertices(const GridPoints& points, const std::vector<Index>& elements, std::size_t leafCount,
                                  std::vector<Index>& numbers, const RunContext& context)
{
  std::vector<char> isUsed(leafCount, 0);
  context.executor.forEach(elements.size(), 8192, [&](std::size_t i) {
    if (elements[i] != noIndex)
    {
      for (const Index leaf : points.leaves[i])
      {
        std::atomic_ref(isUsed[leaf]).store(1, std::memory_order_relaxed);
      }
    }
  });
  numbers.resize(leafCount);
  std::vector<Index> used(
      numberInOrder(numbers, context.executor, [&](std::size_t leaf) { return isUsed[leaf] != 0; }));
  context.executor.forEach(leafCount, 16384, [&](std::size_t leaf) {
    if (numbers[leaf] != noIndex)
    {
      used[numbers[leaf]] = static_cast<Index>(leaf);
    }
  });
  return used;
}

/// Returns, for each boundary face between grid points, its code as a neighbor in the mesh; noFace if its element is
/// not kept.
std::vector<std::int32_t> fillBoundary(DualMesh& mesh, const Crossings& crossings, const std::vector<Index>& elements,
                                       const RunContext& context)
{
  const std::vector<Index> kept = chosenNumbers(crossings.boundaryFaces.size(), context.executor, [&](std::size_t f) {
    return elements[crossings.boundaryFaces[f].element] != noIndex;
  });
  mesh.boundaryFaces.resize(kept.size());
  std::vector<std::int32_t> codes(crossings.boundaryFaces.size(), DualMesh::noFace);
  context.executor.forEach(kept.size(), 4096, [&](std::size_t f) {
    BoundaryFace face = crossings.boundaryFaces[kept[f]];
    face.element = elements[face.element];
    face.opposite = face.opposite == noIndex ? noIndex : elements[face.opposite];
    codes[kept[f]] = ~static_cast<std::int32_t>(f);
    mesh.boundaryFaces[f] = face;
  });
  return codes;
}

/// Returns the faces of zones between kept elements. Both elements of a face are in one zone.
std::vector<ZoneFace> zoneFacesOf(std::vector<ZoneFace> faces, const std::vector<Index>& elements)
{
  std::erase_if(faces, [&](const ZoneFace& face) { return elements[face.element] == noIndex; });
  for (ZoneFace& face : faces)
  {
    face.element = elements[face.element];
  }
  return faces;
}

/// Sets the labels of elements from those of grid points, if there are any.
void fillLabels(Buffer<std::int32_t>& out, const std::vector<std::int32_t>& ofPoint, const std::vector<Index>& elements,
                std::size_t count, const RunContext& context)
{
  if (ofPoint.empty())
  {
    return;
  }
  out.resize(count);
  context.executor.forEach(elements.size(), 8192, [&](std::size_t i) {
    if (elements[i] != noIndex)
    {
      out[elements[i]] = ofPoint[i];
    }
  });
}

void takeLabels(DualMesh& mesh, Labels labels, const std::vector<Index>& elements, const RunContext& context)
{
  const std::size_t count = mesh.elementCount();
  fillLabels(mesh.rooms, labels.rooms.ofPoint, elements, count, context);
  fillLabels(mesh.cellZones, labels.cellZones, elements, count, context);
  mesh.zoneFaces = zoneFacesOf(std::move(labels.zoneFaces), elements);
}

void fillCorners(DualMesh& mesh, const Octree& octree, const GridPoints& points, const std::vector<Index>& elements,
                 const std::vector<Index>& vertices, const RunContext& context)
{
  const auto last = std::find_if(elements.rbegin(), elements.rend(), [](Index e) { return e != noIndex; });
  const std::size_t count = last == elements.rend() ? 0 : *last + std::size_t{1};
  mesh.corners.resize(count);
  mesh.levels.resize(count);
  context.executor.forEach(elements.size(), 8192, [&](std::size_t i) {
    const Index e = elements[i];
    if (e == noIndex)
    {
      return;
    }
    int finest = 0;
    for (int c = 0; c < 8; ++c)
    {
      const Index leaf = points.leaves[i][hexahedronCorner[c]];
      mesh.corners[e][c] = vertices[leaf];
      finest = std::max(finest, octree.level(leaf));
    }
    mesh.levels[e] = static_cast<std::uint8_t>(finest);
  });
}

void fillNeighbors(DualMesh& mesh, const Crossings& crossings, const Zones& zones, const std::vector<Index>& elements,
                   const RunContext& context)
{
  const std::vector<std::int32_t> boundary = fillBoundary(mesh, crossings, elements, context);
  context.progress.check();
  mesh.neighbors.resize(mesh.corners.size());
  mesh.zones.resize(mesh.corners.size());
  const auto codeOf = [&](std::int32_t code) {
    return code >= 0                    ? static_cast<std::int32_t>(elements[code])
           : DualMesh::isBoundary(code) ? boundary[DualMesh::boundaryFaceOf(code)]
                                        : code;
  };
  context.executor.forEach(elements.size(), 8192, [&](std::size_t i) {
    const Index e = elements[i];
    if (e != noIndex)
    {
      std::ranges::transform(crossings.neighbors[i], mesh.neighbors[e].begin(), codeOf);
      mesh.zones[e] = zones.ofPoint[i];
    }
  });
}

bool isCluster(const Octree& octree, Index leaf) { return octree.featureType(leaf) == FeatureType::cluster; }

/// Adds each vertex that stands between pieces or in a cluster, with an element that has it. `leaves` are the leaves of
/// the vertices.
void appendUnresolved(const DualMesh& mesh, const Octree& octree, const std::vector<Index>& leaves,
                      std::vector<char> compromised, std::vector<Diagnostic>& out)
{
  for (std::size_t v = 0; v < leaves.size(); ++v)
  {
    compromised[v] |= isCluster(octree, leaves[v]) ? 1 : 0;
  }
  if (std::ranges::find(compromised, 1) == compromised.end())
  {
    return;
  }
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (const Index p : mesh.corners[e])
    {
      if (compromised[p])
      {
        compromised[p] = 0;
        const auto kind = isCluster(octree, leaves[p]) ? Diagnostic::cluster : Diagnostic::unresolvedFeature;
        out.push_back({kind, mesh.points[p], mesh.points[p], e});
      }
    }
  }
}

void appendMerged(const Crossings& crossings, const std::vector<Index>& elements, const Octree& octree,
                  std::vector<Diagnostic>& out)
{
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    const Index here = elements[edge.point];
    const Index there = edge.other == noIndex ? noIndex : elements[edge.other];
    const auto isInCluster = [&](Index leaf) { return isCluster(octree, leaf); };
    if (edge.count < 2 || (here == noIndex && there == noIndex) || std::ranges::any_of(edge.segment.about, isInCluster))
    {
      continue;
    }
    const auto at = [&](const SurfaceCrossing& cut) {
      return octree.frame().toModel(pointOn(edge.segment, cut.parameter));
    };
    const auto cuts = crossings.of(edge);
    out.push_back({Diagnostic::mergedSheets, at(cuts.front()), at(cuts.back()), here != noIndex ? here : there});
  }
  // This order is the same in any part of a grid.
  std::stable_sort(out.begin() + first, out.end(),
                   [](const Diagnostic& l, const Diagnostic& r) { return l.element < r.element; });
}

/// Fixes vertices that were moved by the sides of a turned domain.
void fixMoved(const std::vector<Vec3>& before, const std::vector<Vec3>& points, VertexClassification& classification)
{
  for (std::size_t v = 0; v < before.size(); ++v)
  {
    classification.classes[v] = before[v] != points[v] ? VertexClass::fixed : classification.classes[v];
  }
}

/// Displaces grid points and closes cracks.
DisplacedGrid findBoundary(const GridPoints& points, Crossings undisplaced, const BoundaryGaps& gaps,
                           double crackTolerance, const GridPart& part, const MeshingContext& context)
{
  context.progress.report(0.45, "Moving grid points");
  DisplacedGrid grid = displaceGrid(points, std::move(undisplaced), part, context);
  grid.crossings = closeCracks(std::move(grid.crossings), gaps, grid.places, crackTolerance, context);
  grid.crossings = markTurnedSides(std::move(grid.crossings), context.model.names.size());
  return grid;
}

GridPoints pointsOf(StageClock& clock, const MeshingContext& context)
{
  context.progress.report(0.0, "Finding grid points");
  GridPoints points = findGridPoints(context.octree, context);
  clock.lap("dual");
  return points;
}

} // namespace

std::vector<Index> numberElements(const Zones& zones, const std::vector<char>& kept, const RunContext& context)
{
  std::vector<Index> numbers(zones.ofPoint.size());
  numberInOrder(numbers, context.executor, [&](std::size_t i) { return kept[zones.ofPoint[i]] != 0; });
  return numbers;
}

ClassifiedMesh makeElements(CrossedGrid& grid, bool keepGrid, bool hexahedra, const Zones& zones,
                            const std::vector<Index>& elements, Labels labels, std::vector<Diagnostic>& diagnostics,
                            StageClock& clock, const MeshingContext& context)
{
  const Octree& octree = context.octree;
  const SurfaceModel& model = context.model;
  Crossings& crossings = grid.displaced.crossings;
  const auto dispose = [keepGrid](auto& list) {
    if (!keepGrid)
    {
      release(list);
    }
  };
  context.progress.report(0.7, "Placing vertices");
  std::vector<Index> vertexOfLeaf;
  const std::vector<Index> leaves = numberVertices(grid.points, elements, octree.leafCount(), vertexOfLeaf, context);
  DualMesh mesh;
  DualVertices placed = placeVertices(octree, model, crossings, leaves, context);
  mesh.points = std::move(placed.positions);
  clock.lap("vertices");
  context.progress.report(0.9, "Making elements");
  context.progress.check();
  appendMerged(crossings, elements, octree, diagnostics);
  dispose(crossings.crossedEdges);
  dispose(crossings.cuts);
  fillCorners(mesh, octree, grid.points, elements, vertexOfLeaf, context);
  release(vertexOfLeaf);
  dispose(grid.points.leaves);
  fillNeighbors(mesh, crossings, zones, elements, context);
  dispose(crossings.neighbors);
  takeLabels(mesh, std::move(labels), elements, context);
  context.progress.check();
  if (hexahedra)
  {
    makeHexahedral(mesh, placed.classification, octree, model.names.size(), context);
    placed.compromised.resize(mesh.points.size(), 0);
  }
  const std::vector<Vec3> before = octree.frame().turnedDomain ? mesh.points : std::vector<Vec3>();
  sharpenTurnedEdges(mesh, octree.frame(), model.names.size());
  appendUnresolved(mesh, octree, leaves, std::move(placed.compromised), diagnostics);
  keepWithinSides(mesh.points, octree.frame());
  fixMoved(before, mesh.points, placed.classification);
  placed.classification.turnedSides = turnedSidesOf(mesh, octree.frame(), model.names.size());
  return classified(std::move(mesh), std::move(placed.classification));
}

void OctreeGrid::findAnew(const MeshingContext& context)
{
  crossings = findCrossings(GridPlaces(context.octree, points), context.model, context);
  crossings = markTurnedSides(std::move(crossings), context.model.names.size());
}

OctreeGrid::OctreeGrid(StageClock& clock, const MeshingContext& context) : points(pointsOf(clock, context))
{
  context.progress.report(0.3, "Finding crossings");
  findAnew(context);
  clock.lap("crossings");
}

CrossedGrid::CrossedGrid(OctreeGrid grid, const CrossingOptions& options, MeshPort& port, StageClock& clock,
                         const MeshingContext& context)
    : points(std::move(grid.points)), gaps(findBoundaryGaps(context)),
      displaced(findBoundary(points, std::move(grid.crossings), gaps, options.crackTolerance,
                             port.divide(context.octree, points, context), context))
{
  clock.lap("crossings");
}

} // namespace atria
