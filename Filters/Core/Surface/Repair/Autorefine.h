// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>
#include <set>
#include <span>

namespace atria {

class Overlaps;

struct AutorefineOptions
{
  /// A point this close to an edge or a triangle, in lattice units, lies on it. At least 3, as points are rounded.
  std::int64_t reach = 4;
  /// Points at contacts that cuts do not get rid of become one up to this far from each other, in lattice units.
  std::int64_t widestWeld = 0;
  /// Rounds after which what is still found is left and counted.
  int maximumRounds = 16;
  /// Settles which of triangles with the same points stays, and learns of the others; the first stays without.
  Overlaps* overlaps = nullptr;
};

struct AutorefineReport
{
  /// Points that became one with an earlier one because it was within four times the reach.
  std::size_t mergedPoints = 0;
  /// Triangles that fell together with another one, after both were cut, and were dropped.
  std::size_t overlappingTriangles = 0;
  /// Triangles without area that were dropped.
  std::size_t degenerateTriangles = 0;
  /// Triangles that were cut.
  std::size_t splitTriangles = 0;
  /// Edges on which triangles now meet that only touched or cut each other before.
  std::size_t intersectionEdges = 0;
  /// Contacts left after the last round, and those among triangles that are left, as they were then.
  std::size_t unresolvedContacts = 0;
  std::size_t leftContacts = 0;
  /// What the counts are of: per source, whether it was cut, and whether its contacts with others so marked are left,
  /// as cuts only made more of them; the edges on which triangles now meet.
  std::vector<char> isSplit;
  std::vector<char> isLeft;
  std::set<EdgeKey> meetings;
};

/// Cuts triangles until they meet in common edges and points only.
///
/// In rounds: points on edges and faces are found, and points where edges cut edges or faces are added; the triangles
/// they lie on are triangulated anew with these points, and with the segments that two triangles have in common as
/// edges; points closer than the reach allows become one; of triangles with the same points one is kept. New
/// points are rounded to the lattice, which can make new contacts; the next round looks at the pieces, each with those
/// of what its triangle has touched. From the second on, points at contacts become one within a distance that grows to
/// the widest weld, as what is left then lies closer together than cuts can tell apart. A triangle that has four times
/// the contacts of two rounds before, or no fewer once that distance no longer grows, is left: its contacts with others
/// that are left are only counted. Pieces take the place of their triangle, with its winding,
/// surface and source; those of one triangle are not compared with each other. O(n log n) where little is cut. Nothing
/// is cut in clusters; what touches too many others is hidden as if it were in one. Triangles in `isLone` are known to
/// meet no others; it may be empty.
AutorefineReport autorefine(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                            const RunContext& context, std::span<const char> isLone = {});

/// The same for a soup that was cut before and in which triangles changed since; goes on with the report.
void refineAgain(TriangleSoup& soup, const AutorefineOptions& options, ClusterCells& clusters,
                 std::vector<Change> changes, AutorefineReport& report, const RunContext& context);

/// Drops triangles with repeated points, and of those with the same points all but one: the one that `overlaps` settles
/// on, else the first. Returns how many of the second sort.
std::size_t dropRepeated(TriangleSoup& soup, Overlaps* overlaps = nullptr);

} // namespace atria
