// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/SurfaceRepair.h"

#include "Surface/Autorefine.h"
#include "Surface/GapClosing.h"
#include "Surface/Orientation.h"

namespace atria {

namespace {

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

} // namespace

void repairSurface(TriangleSoup& soup, const GridFrame& frame, const SurfaceRepairOptions& options,
                   SurfaceRepairReport& report)
{
  dropUnusedPoints(soup);
  // Pieces are closed as they were drawn; where they are cut they share edges with others.
  report.flippedTriangles = orientTriangles(soup);
  const std::vector<Index> parts = partsOf(soup);
  AutorefineOptions refining;
  refining.reach = std::max(refining.reach, options.weldDistance / 4);
  AutorefineReport refined = autorefine(soup, refining);
  GapReport gaps = closeGaps(soup, frame, options.gapTolerance, parts);
  report.closedGaps = gaps.closedGaps;
  report.largestGap = gaps.largestMove * frame.latticeUnit();
  if (gaps.closedGaps > 0)
  {
    if (refined.unresolvedContacts > 0)
    {
      std::fill(gaps.movedTriangles.begin(), gaps.movedTriangles.end(), 1);
    }
    refineAgain(soup, refining, std::move(gaps.movedTriangles), refined);
  }
  report.weldedPoints += refined.mergedPoints;
  report.degenerateTriangles += refined.degenerateTriangles;
  report.overlappingTriangles = refined.overlappingTriangles;
  report.splitTriangles = refined.splitTriangles;
  report.intersectionEdges = refined.intersectionEdges;
  report.unresolvedContacts = refined.unresolvedContacts;

  report.flippedTriangles += orientTriangles(soup);
  dropUnusedPoints(soup);
}

} // namespace atria
