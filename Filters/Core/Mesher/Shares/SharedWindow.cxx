// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedWindow.h"

#include "Support/Error.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <map>
#include <utility>

namespace atria {

namespace {

/// Of the points of a mesh, by the vertices that they are and the leaves of these, the points `chosen`.
std::vector<SharedPoint> sharedPointsOf(const std::vector<Index>& vertexOf, const std::vector<Index>& leaves,
                                        const Octree& octree, const std::vector<Index>& chosen)
{
  std::vector<Index> copies(vertexOf.size() - leaves.size());
  std::map<Index, Index> last;
  for (std::size_t i = 0; i < copies.size(); ++i)
  {
    copies[i] = ++last[vertexOf[leaves.size() + i]];
  }
  std::vector<SharedPoint> points(chosen.size());
  std::ranges::transform(chosen, points.begin(), [&](Index p) {
    return SharedPoint{octree.finestKey(leaves[vertexOf[p]]), p < leaves.size() ? 0 : copies[p - leaves.size()]};
  });
  return points;
}

/// In order.
std::vector<Index> elementsAtPoints(const DualMesh& mesh, const std::vector<char>& marked)
{
  std::vector<Index> elements;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (hasMarked(mesh.corners[e], marked))
    {
      elements.push_back(e);
    }
  }
  return elements;
}

/// Own elements, all at own points, which are marked, and all that share points with own ones; and what shares points
/// with those of them that are near the boundary, so that all is known of what grows on them.
std::vector<Index> elementsAbout(const DualMesh& mesh, std::vector<char> marked, const NearBoundary& near,
                                 const std::vector<char>& isOwn)
{
  const auto mark = [&](Index e) { std::ranges::for_each(mesh.corners[e], [&](Index p) { marked[p] = 1; }); };
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (isOwn[e])
    {
      mark(e);
    }
  }
  for (const Index e : elementsAtPoints(mesh, marked))
  {
    if (near.isNear(e))
    {
      mark(e);
    }
  }
  return elementsAtPoints(mesh, marked);
}

std::vector<Index> elementsToKeep(const DualMesh& mesh, std::vector<char> ownPoints, const NearBoundary& near,
                                  const std::vector<char>& isOwn)
{
  std::vector<Index> all = elementsAbout(mesh, std::move(ownPoints), near, isOwn);
  std::vector<Index> nearOwn;
  std::ranges::copy_if(all, std::back_inserter(nearOwn), [&](Index e) { return near.isNear(e); });
  // With a row of elements more no window of a block ends where this one does.
  mergeUnique(all, ElementRows(mesh).grow(WindowRows(mesh, near).grow(std::move(nearOwn)), 1));
  return all;
}

template <typename List> List chosenOf(const List& list, const std::vector<Index>& chosen)
{
  List out(chosen.size());
  std::ranges::transform(chosen, out.begin(), [&](Index i) { return list[i]; });
  return out;
}

} // namespace

GlobalCount countBefore(std::size_t own, RankExchange& exchange)
{
  GlobalCount count{0, 0};
  const std::vector<std::size_t> counts = gatherAll(exchange, own);
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    count.before += rank < static_cast<std::size_t>(exchange.rank()) ? counts[rank] : 0;
    count.all += counts[rank];
  }
  return count;
}

Index SharedWindow::find(const SharedPoint& point) const
{
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(vertexCount);
  const auto begin = point.copy == 0 ? points.begin() : middle;
  const auto end = point.copy == 0 ? middle : points.end();
  const auto found = std::lower_bound(begin, end, point);
  return found != end && *found == point ? static_cast<Index>(found - points.begin()) : noIndex;
}

SharedWindow keepShare(const DualMesh& mesh, const VertexClassification& classification,
                       const std::vector<Index>& vertexOf, const std::vector<PointKey>& elementKeys, Index cutTag,
                       const Octree& octree, const RankShare& share, const RunContext& context)
{
  context.progress.check();
  SharedWindow out;
  const std::vector<Index>& leaves = classification.leaves;
  std::vector<char> ownPoints(vertexOf.size());
  std::ranges::transform(vertexOf, ownPoints.begin(),
                         [&](Index v) { return share.isOwn(octree.finestKey(leaves[v])) ? 1 : 0; });
  std::vector<char> isOwn(elementKeys.size());
  std::ranges::transform(elementKeys, isOwn.begin(),
                         [&](PointKey key) { return key != SharedPoints::noKey && share.isOwn(key >> 3) ? 1 : 0; });
  const NearBoundary near = findNearBoundary(mesh, vertexOf, classification.classes.size());
  const std::vector<Index> kept = elementsToKeep(mesh, std::move(ownPoints), near, isOwn);
  out.mesh = extractWindow(mesh, mesh.points, classification, vertexOf, kept, cutTag);
  orderBoundaryFaces(out.mesh.mesh);
  out.mesh.mesh.rooms = mesh.rooms.empty() ? mesh.rooms : chosenOf(mesh.rooms, kept);
  out.mesh.mesh.cellZones = mesh.cellZones.empty() ? mesh.cellZones : chosenOf(mesh.cellZones, kept);
  out.elementKeys = chosenOf(elementKeys, kept);
  if (std::ranges::find(out.elementKeys, SharedPoints::noKey) != out.elementKeys.end())
  {
    throw RanksDisagree("a rank's octree ends where its share still needs it");
  }
  const std::vector<char> keptOwn = chosenOf(isOwn, kept);
  out.firstOwn = static_cast<Index>(std::ranges::find(keptOwn, 1) - keptOwn.begin());
  out.endOwn = out.firstOwn + static_cast<Index>(std::ranges::count(keptOwn, 1));
  out.points = sharedPointsOf(vertexOf, leaves, octree, out.mesh.pointIds);
  out.vertexCount = static_cast<Index>(out.mesh.vertexCount());
  const std::vector<Index> vertices(out.mesh.pointIds.begin(), out.mesh.pointIds.begin() + out.vertexCount);
  out.near = {chosenOf(near.mayMove, vertices), chosenOf(near.rows, kept)};
  return out;
}

} // namespace atria
