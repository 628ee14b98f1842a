// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/SurfaceRepair.h"

#include "Surface/Repair/Autorefine.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/GapClosing.h"
#include "Surface/Repair/SmallParts.h"
#include "Surface/Repair/SmoothCells.h"
#include "Surface/Triangles/Orientation.h"
#include "Surface/Triangles/Weld.h"

#include <Eigen/Geometry>

namespace atria {

namespace {

/// Distance up to which points may be merged if cuts do not end otherwise, as a part of the gap tolerance.
constexpr double widestWeld = 0.5;
/// Largest number of passes that close gaps. Points that still move then go to and fro.
constexpr int maximumPasses = 6;

void dropUnusedPoints(TriangleSoup& soup)
{
  std::vector<Index> number(soup.points.size(), noIndex);
  for (const auto& t : soup.triangles)
  {
    for (const Index p : t)
    {
      number[p] = 0;
    }
  }
  Index count = 0;
  for (Index p = 0; p < soup.points.size(); ++p)
  {
    if (number[p] != noIndex)
    {
      soup.points[count] = soup.points[p];
      number[p] = count++;
    }
  }
  soup.points.resize(count);
  for (auto& t : soup.triangles)
  {
    std::transform(t.begin(), t.end(), t.begin(), [&](Index p) { return number[p]; });
  }
}

void dropTriangles(TriangleSoup& soup, const std::vector<char>& isOut)
{
  TriangleSoup rest;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    if (!isOut[t])
    {
      rest.add(soup.triangles[t], soup.surfaceIds[t], soup.sources[t]);
    }
  }
  rest.points = std::move(soup.points);
  soup = std::move(rest);
}

/// Returns one entry per triangle; those with a moved point count as moved.
std::vector<Change> changesOf(const TriangleSoup& soup, const std::vector<char>& isMoved)
{
  std::vector<Change> changes;
  for (const auto& t : soup.triangles)
  {
    changes.push_back(isMoved[t[0]] || isMoved[t[1]] || isMoved[t[2]] ? Change::moved : Change::none);
  }
  return changes;
}

/// Closes gaps in passes until nothing moves or the passes run out. Then cuts the triangles that moved.
void closeAllGaps(TriangleSoup& soup, const GridFrame& frame, const GapOptions& options,
                  const AutorefineOptions& refining, AutorefineReport& refined, SurfaceRepairReport& report,
                  const RunContext& context)
{
  std::vector<LatticePoint> start = soup.points;
  std::vector<char> everMoved(soup.points.size(), 0);
  for (int pass = 0; pass < maximumPasses; ++pass)
  {
    context.progress.check();
    const std::vector<char> isMoved = closeGaps(soup, frame, options, context);
    if (std::find(isMoved.begin(), isMoved.end(), 1) == isMoved.end())
    {
      break;
    }
    for (Index p = 0; p < isMoved.size(); ++p)
    {
      everMoved[p] |= isMoved[p];
      const double move = isMoved[p] ? between(start[p], soup.points[p]).norm() * frame.latticeUnit() : 0.0;
      report.largestGap = std::max(report.largestGap, move);
    }
    const std::vector<Index> became = weldPoints(soup.points, 0);
    for (auto& t : soup.triangles)
    {
      std::transform(t.begin(), t.end(), t.begin(), [&](Index p) { return became[p]; });
    }
    for (Index p = 0; p < isMoved.size(); ++p)
    {
      everMoved[became[p]] |= everMoved[p];
    }
    report.overlappingTriangles += dropRepeated(soup, refining.overlaps);
  }
  std::vector<Change> changes = changesOf(soup, everMoved);
  if (std::ranges::find(changes, Change::moved) != changes.end())
  {
    refineAgain(soup, refining, options.clusters, std::move(changes), refined, context);
  }
  report.closedGaps = static_cast<std::size_t>(std::count(everMoved.begin(), everMoved.end(), 1));
}

/// Collects the hidden details of each surface.
class HiddenDetails
{
public:
  HiddenDetails(const TriangleSoup& soup, const GridFrame& frame)
      : entries(soup.surfaceIds.empty() ? 0 : *std::ranges::max_element(soup.surfaceIds) + 1),
        areaUnit(0.5 * frame.latticeUnit() * frame.latticeUnit())
  {
  }

  void addClustered(const TriangleSoup& soup, const ClusterCells& clusters)
  {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (clusters.isHidden(soup.sources[t]))
      {
        HiddenDetail& entry = entries[soup.surfaceIds[t]];
        ++entry.clusteredTriangles;
        entry.clusteredArea += areaOf(soup, t);
      }
    }
  }

  void addLeftOut(const TriangleSoup& soup, const std::vector<char>& isOut)
  {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (isOut[t])
      {
        HiddenDetail& entry = entries[soup.surfaceIds[t]];
        ++entry.leftOutTriangles;
        entry.leftOutArea += areaOf(soup, t);
      }
    }
  }

  std::vector<HiddenDetail> take()
  {
    for (Index surface = 0; surface < entries.size(); ++surface)
    {
      entries[surface].surface = surface;
    }
    std::erase_if(entries, [](const HiddenDetail& e) { return e.clusteredTriangles + e.leftOutTriangles == 0; });
    return std::move(entries);
  }

private:
  double areaOf(const TriangleSoup& soup, Index t) const
  {
    return areaUnit *
           between(soup.corner(t, 0), soup.corner(t, 1)).cross(between(soup.corner(t, 0), soup.corner(t, 2))).norm();
  }

  std::vector<HiddenDetail> entries;
  double areaUnit;
};

void repairOutside(ClusterCells& clusters, const std::vector<char>& isLone, TriangleSoup& soup, const GridFrame& frame,
                   const SurfaceRepairOptions& options, const AutorefineOptions& refining, SurfaceRepairReport& report,
                   const RunContext& context)
{
  const std::vector<std::array<Index, 3>> drawnTriangles = soup.triangles;
  const SoupAsDrawn drawn(soup);
  AutorefineReport refined = autorefine(soup, refining, clusters, context, isLone);
  closeAllGaps(soup, frame, {options.gapTolerance, drawn, clusters}, refining, refined, report, context);
  report.weldedPoints += refined.mergedPoints;
  report.degenerateTriangles += refined.degenerateTriangles;
  report.overlappingTriangles += refined.overlappingTriangles;
  report.splitTriangles = refined.splitTriangles;
  report.intersectionEdges = refined.intersectionEdges;
  report.unresolvedContacts = refined.unresolvedContacts + refined.leftContacts;
  if (soup.triangles != drawnTriangles)
  {
    report.flippedTriangles += orientTriangles(soup, context.executor);
  }
  dropUnusedPoints(soup);
}

} // namespace

void repairSurface(TriangleSoup& soup, const GridFrame& frame, const SurfaceRepairOptions& options,
                   SurfaceRepairReport& report, const RunContext& context)
{
  HiddenDetails hidden(soup, frame);
  const SmallPartOptions smallOptions{options.smallPartSize, options.gapTolerance, options.keptSurfaces,
                                      options.clusters.finerPlaces};
  const std::vector<char> isSmall = findSmallParts(soup, frame, smallOptions, context);
  hidden.addLeftOut(soup, isSmall);
  if (std::ranges::find(isSmall, 1) != isSmall.end())
  {
    dropTriangles(soup, isSmall);
  }
  dropUnusedPoints(soup);
  AutorefineOptions refining;
  refining.reach = std::max(refining.reach, options.weldDistance / 4);
  refining.overlaps = options.overlaps;
  refining.widestWeld = static_cast<std::int64_t>(widestWeld * options.gapTolerance);
  ClusterCells clusters;
  std::vector<char> isLone;
  {
    // Pieces are closed as they were drawn; after cuts they share edges with others.
    std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, context.executor);
    report.flippedTriangles = orientTriangles(soup, uses);
    const SmoothPieces smooth(soup, uses, options.clusters.featureAngle, context.executor);
    clusters = ClusterCells(soup, smooth.pieces, frame, options.clusters, context);
    isLone = findLoneTriangles(soup, uses, smooth, frame.latticeSize(clusters.finestLevel()), refining.reach);
  }
  const TriangleSoup drawn = soup;
  repairOutside(clusters, isLone, soup, frame, options, refining, report, context);
  hidden.addClustered(drawn, clusters);
  report.hidden = hidden.take();
}

} // namespace atria
