// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/SurfaceRepair.h"

#include "Surface/Repair/Autorefine.h"
#include "Surface/Repair/GapClosing.h"
#include "Surface/Triangles/Orientation.h"
#include "Surface/Triangles/SoupParts.h"
#include "Surface/Triangles/Weld.h"

namespace atria {

namespace {

/// Against the gap tolerance: what is this near may be taken for touching where cuts do not end otherwise.
constexpr double largestReach = 1.0 / 16.0;
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

/// Triangles with a point that was moved.
std::vector<char> trianglesAt(const TriangleSoup& soup, const std::vector<char>& isMoved)
{
  std::vector<char> changed;
  for (const auto& t : soup.triangles)
  {
    changed.push_back(isMoved[t[0]] | isMoved[t[1]] | isMoved[t[2]]);
  }
  return changed;
}

/// Closes gaps and cuts what moved, in turn, until nothing moves.
void closeAllGaps(TriangleSoup& soup, const GridFrame& frame, double tolerance, const std::vector<Index>& parts,
                  const AutorefineOptions& refining, AutorefineReport& refined, SurfaceRepairReport& report,
                  const RunContext& context)
{
  std::vector<LatticePoint> start = soup.points;
  std::vector<char> everMoved(soup.points.size(), 0);
  for (int pass = 0; pass < maximumPasses; ++pass)
  {
    context.progress.check();
    const std::vector<char> isMoved = closeGaps(soup, frame, tolerance, parts, start, context);
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
    report.overlappingTriangles += dropRepeated(soup);
  }
  std::vector<char> changed = trianglesAt(soup, everMoved);
  if (std::find(changed.begin(), changed.end(), 1) != changed.end())
  {
    if (refined.unresolvedContacts > 0)
    {
      std::fill(changed.begin(), changed.end(), 1);
    }
    refineAgain(soup, refining, std::move(changed), refined, context);
  }
  report.closedGaps = static_cast<std::size_t>(std::count(everMoved.begin(), everMoved.end(), 1));
}

} // namespace

void repairSurface(TriangleSoup& soup, const GridFrame& frame, const SurfaceRepairOptions& options,
                   SurfaceRepairReport& report, const RunContext& context)
{
  dropUnusedPoints(soup);
  // Pieces are closed as they were drawn; where they are cut they share edges with others.
  report.flippedTriangles = orientTriangles(soup, context.executor);
  const std::vector<Index> parts = partsOf(soup);
  AutorefineOptions refining;
  refining.reach = std::max(refining.reach, options.weldDistance / 4);
  refining.largestReach = std::max(refining.reach, static_cast<std::int64_t>(largestReach * options.gapTolerance));
  AutorefineReport refined = autorefine(soup, refining, context);
  closeAllGaps(soup, frame, options.gapTolerance, parts, refining, refined, report, context);
  report.weldedPoints += refined.mergedPoints;
  report.degenerateTriangles += refined.degenerateTriangles;
  report.overlappingTriangles += refined.overlappingTriangles;
  report.splitTriangles = refined.splitTriangles;
  report.intersectionEdges = refined.intersectionEdges;
  report.unresolvedContacts = refined.unresolvedContacts;

  report.flippedTriangles += orientTriangles(soup, context.executor);
  dropUnusedPoints(soup);
}

} // namespace atria
