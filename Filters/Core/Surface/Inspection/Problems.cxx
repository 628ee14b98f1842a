// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/Problems.h"

#include "Support/Error.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"
#include "Surface/Repair/Autorefine.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Repair/GapClosing.h"
#include "Surface/Repair/Overlaps.h"
#include "Surface/Triangles/CoincidentFaces.h"
#include "Surface/Triangles/EachEdge.h"
#include "Surface/Triangles/PointPlaces.h"
#include "Surface/Triangles/SoupParts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace atria {

namespace {

using Surfaces = std::vector<Index>;

Surfaces keptFirst(Index keeps, Index gives) { return keeps == gives ? Surfaces{keeps} : Surfaces{keeps, gives}; }

/// Problems of one kind, one for each set of surfaces, in the order in which these came up.
class Groups
{
public:
  explicit Groups(ProblemKind ofKind) : kind(ofKind) {}

  Problem& of(const Surfaces& surfaces)
  {
    const auto [found, isNew] = indexOf.try_emplace(surfaces, problems.size());
    if (isNew)
    {
      problems.push_back({kind, 0, 0.0, Vec3::Zero(), surfaces});
    }
    return problems[found->second];
  }
  void moveTo(std::vector<Problem>& out) { out.insert(out.end(), problems.begin(), problems.end()); }

private:
  ProblemKind kind;
  std::map<Surfaces, std::size_t> indexOf;
  std::vector<Problem> problems;
};

/// Collects the surfaces that take part in contacts at points.
class SurfacesAtPoints
{
public:
  void add(Index point, Index surface) { uses.emplace_back(point, surface); }

  /// Marks the points below `count` that have been added.
  std::vector<char> marked(std::size_t count) const
  {
    std::vector<char> marks(count, 0);
    for (const auto& [point, surface] : uses)
    {
      if (point < count)
      {
        marks[point] = 1;
      }
    }
    return marks;
  }

  /// Calls `visit` with each point and its surfaces, both ascending.
  template <typename Visitor> void forEach(const Visitor& visit)
  {
    sortUnique(uses);
    Surfaces surfaces;
    for (std::size_t i = 0; i < uses.size(); ++i)
    {
      surfaces.push_back(uses[i].second);
      if (i + 1 == uses.size() || uses[i + 1].first != uses[i].first)
      {
        visit(uses[i].first, surfaces);
        surfaces.clear();
      }
    }
  }

private:
  std::vector<std::pair<Index, Index>> uses;
};

GridFrame frameAbout(const Box3& box)
{
  const double extent = box.empty() ? 0.0 : box.size().maxCoeff();
  if (!(extent > 0.0))
  {
    throw Error("the model has no extent");
  }
  constexpr double octantsAcross = 64.0;
  GridOptions options;
  options.sizeMin = extent / octantsAcross;
  options.sizeMid = options.sizeMin;
  options.sizeMax = options.sizeMin;
  // Nothing of the model lies on the sides of this domain.
  options.domain = {box.min - Vec3::Constant(0.5 * extent), box.max + Vec3::Constant(0.5 * extent)};
  return makeGridFrame(options, options.domain);
}

class Search
{
public:
  Search(const TriangleSurface& source, const ProblemOptions& given, const RunContext& surroundings)
      : surface(source), options(given), context(surroundings), wasLeftOut(source.triangles.size(), 0)
  {
    Box3 box;
    for (const auto& t : surface.triangles)
    {
      for (const Index p : t)
      {
        box.extend(surface.points[p]);
      }
    }
    frame = frameAbout(box);
    const std::vector<Index> places = placesOf(surface.points, placeStep(box));
    std::vector<Index> numbers(surface.points.size(), noIndex);
    const auto numberOf = [&](Index point) {
      Index& number = numbers[places[point]];
      if (number == noIndex)
      {
        number = static_cast<Index>(points.size());
        points.push_back(surface.points[point]);
        soup.points.push_back(frame.toLattice(surface.points[point]));
      }
      return number;
    };
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    {
      const auto& t = surface.triangles[i];
      const Index a = numberOf(t[0]);
      const Index b = numberOf(t[1]);
      soup.add({a, b, numberOf(t[2])}, surface.surfaceIds[i], static_cast<Index>(i));
    }
  }

  std::vector<Problem> run()
  {
    context.progress.report(0.0, "Looking for problems");
    findSlivers();
    findDuplicates();
    Overlaps overlaps(surface, {}, frame);
    dropRepeated(soup, &overlaps);
    findEdges();
    context.progress.report(0.3, "Looking for contacts");
    findContactsOfTriangles();
    context.progress.report(0.7, "Looking for gaps");
    const SoupAsDrawn drawn(soup);
    overlaps.forget();
    findOverlaps(overlaps);
    findGaps(drawn);
    clusters.moveTo(problems);
    std::stable_sort(problems.begin(), problems.end(),
                     [](const Problem& a, const Problem& b) { return a.kind < b.kind; });
    return std::move(problems);
  }

private:
  std::array<Vec3, 3> cornersOf(Index triangle) const
  {
    const auto& t = surface.triangles[triangle];
    return {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
  }

  void findSlivers()
  {
    constexpr double thin = 0.01;
    Groups groups(ProblemKind::slivers);
    for (Index i = 0; i < soup.triangles.size(); ++i)
    {
      const auto [a, b, c] = cornersOf(i);
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const double height = longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
      if (height >= thin * longest && longest > 0.0)
      {
        continue;
      }
      Problem& problem = groups.of({soup.surfaceIds[i]});
      if (problem.count++ == 0 || height < problem.size)
      {
        problem.size = height;
        problem.place = (a + b + c) / 3.0;
      }
    }
    groups.moveTo(problems);
  }

  void findDuplicates()
  {
    std::vector<Index> faces(surface.triangles.size());
    std::iota(faces.begin(), faces.end(), Index{0});
    const CoincidentFaces found = findCoincidentFaces(surface.points, surface.triangles, faces, surface.surfaceIds);
    Groups groups(ProblemKind::duplicates);
    for (Index i = 0; i < found.kept.size(); ++i)
    {
      if (found.kept[i] == i)
      {
        continue;
      }
      const auto [a, b, c] = cornersOf(i);
      Problem& problem = groups.of(keptFirst(soup.surfaceIds[found.kept[i]], soup.surfaceIds[i]));
      problem.place = problem.count++ == 0 ? Vec3((a + b + c) / 3.0) : problem.place;
      problem.size += 0.5 * (b - a).cross(c - a).norm();
    }
    groups.moveTo(problems);
  }

  void findEdges()
  {
    const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, context.executor);
    std::vector<std::span<const SoupEdgeUse>> open;
    std::vector<std::span<const SoupEdgeUse>> many;
    eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
      if (edge.size() != 2)
      {
        (edge.size() == 1 ? open : many).push_back(edge);
      }
    });
    gatherEdges(ProblemKind::openEdges, open);
    gatherEdges(ProblemKind::nonManifoldEdges, many);
  }

  /// Adds one problem for each set of connected edges.
  void gatherEdges(ProblemKind kind, const std::vector<std::span<const SoupEdgeUse>>& edges)
  {
    UnionFind runs(soup.points.size());
    for (const std::span<const SoupEdgeUse> uses : edges)
    {
      runs.join(uses[0].edge.first, uses[0].edge.second);
    }
    std::unordered_map<Index, std::size_t> indexOf;
    const std::size_t before = problems.size();
    for (const std::span<const SoupEdgeUse> uses : edges)
    {
      const Vec3& a = points[uses[0].edge.first];
      const Vec3& b = points[uses[0].edge.second];
      const auto [found, isNew] = indexOf.try_emplace(runs.find(uses[0].edge.first), problems.size());
      if (isNew)
      {
        problems.push_back({kind, 0, 0.0, 0.5 * (a + b), {}});
      }
      Problem& problem = problems[found->second];
      ++problem.count;
      problem.size += (b - a).norm();
      for (const SoupEdgeUse& use : uses)
      {
        problem.surfaces.push_back(soup.surfaceIds[use.triangle]);
      }
    }
    for (std::size_t i = before; i < problems.size(); ++i)
    {
      sortUnique(problems[i].surfaces);
    }
  }

  void findContactsOfTriangles()
  {
    leaveOut(findClusters(soup, contactReach, maximumPairs(), context));
    const Contacts found = findContacts(soup, {std::vector<Change>(soup.triangles.size(), Change::moved), {}, {}},
                                        contactReach, {}, context.part(0.3, 0.7))
                               .sorted(soup);
    SurfacesAtPoints atPoints;
    for (const FaceContact& contact : found.faces)
    {
      atPoints.add(contact.point, soup.surfaceIds[contact.triangle]);
    }
    const std::vector<SoupEdgeUse> uses =
        found.edges.empty() ? std::vector<SoupEdgeUse>{} : sortedEdgeUses(soup, context.executor);
    for (const EdgeContact& contact : found.edges)
    {
      const auto less = [](const SoupEdgeUse& use, const EdgeKey& edge) { return use.edge < edge; };
      for (auto use = std::lower_bound(uses.begin(), uses.end(), contact.edge, less);
           use != uses.end() && use->edge == contact.edge; ++use)
      {
        atPoints.add(contact.point, soup.surfaceIds[use->triangle]);
      }
    }
    addUsersOfPoints(atPoints);
    Groups crossings(ProblemKind::crossings);
    Groups contacts(ProblemKind::contacts);
    atPoints.forEach([&](Index point, const Surfaces& surfaces) {
      const bool isNew = point >= soup.points.size();
      Problem& problem = (isNew ? crossings : contacts).of(surfaces);
      if (problem.count++ == 0)
      {
        problem.place = isNew ? frame.toModel(found.newPoints[point - soup.points.size()]) : points[point];
      }
    });
    crossings.moveTo(problems);
    contacts.moveTo(problems);
    tangled = findTangles(soup.triangles.size(), found.pairs, options.maximumMeetings);
  }

  std::size_t maximumPairs() const
  {
    constexpr std::size_t perTriangle = 64;
    return std::max(options.maximumPairs, perTriangle * soup.triangles.size());
  }

  /// Takes the marked triangles out of the soup and into the report.
  void leaveOut(const std::vector<char>& isOut)
  {
    TriangleSoup rest;
    for (Index i = 0; i < isOut.size(); ++i)
    {
      if (!isOut[i])
      {
        rest.add(soup.triangles[i], soup.surfaceIds[i], soup.sources[i]);
        continue;
      }
      if (wasLeftOut[soup.sources[i]])
      {
        continue; // another piece of it
      }
      wasLeftOut[soup.sources[i]] = 1;
      Problem& problem = clusters.of({soup.surfaceIds[i]});
      const auto [a, b, c] = cornersOf(soup.sources[i]);
      problem.place = problem.count++ == 0 ? Vec3((a + b + c) / 3.0) : problem.place;
    }
    rest.points = std::move(soup.points);
    soup = std::move(rest);
  }

  /// Adds the surfaces that have a point as a corner: they take part in its contacts.
  void addUsersOfPoints(SurfacesAtPoints& atPoints) const
  {
    const std::vector<char> isTouched = atPoints.marked(soup.points.size());
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    {
      for (const Index p : soup.triangles[i])
      {
        if (isTouched[p])
        {
          atPoints.add(p, soup.surfaceIds[i]);
        }
      }
    }
  }

  double gapTolerance() const { return options.gapTolerance / frame.latticeUnit(); }

  /// Cuts triangles that touch, as the repair does, and finds pieces that lie upon each other.
  void findOverlaps(Overlaps& overlaps)
  {
    leaveOut(tangled);
    const double tolerance = gapTolerance();
    leaveOut(findClusters(soup, tolerance >= 1.0 ? static_cast<std::int64_t>(std::ceil(tolerance)) : contactReach,
                          maximumPairs(), context));
    AutorefineOptions refining;
    refining.overlaps = &overlaps;
    autorefine(soup, refining, hidden, context.part(0.7, 0.9));
    constexpr double roundedAway = 1e-9; // part of the square of the model's extent
    const double extent = frame.rootSize();
    for (const Overlap& overlap : overlaps.all())
    {
      if (overlap.shared.area < roundedAway * extent * extent)
      {
        continue;
      }
      problems.push_back({ProblemKind::overlaps, overlap.pieces, overlap.shared.area, frame.toModel(overlap.place),
                          keptFirst(overlap.shared.keeps, overlap.shared.gives)});
    }
  }

  /// Finds the points that the repair would move.
  void findGaps(const SoupAsDrawn& drawn)
  {
    const double tolerance = gapTolerance();
    if (!(tolerance >= 1.0))
    {
      return;
    }
    const std::vector<LatticePoint> start = soup.points;
    const std::vector<char> isMoved = closeGaps(soup, frame, {tolerance, drawn, hidden}, context);
    SurfacesAtPoints atPoints;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    {
      for (const Index p : soup.triangles[i])
      {
        if (isMoved[p])
        {
          atPoints.add(p, soup.surfaceIds[i]);
        }
      }
    }
    Groups groups(ProblemKind::gaps);
    atPoints.forEach([&](Index point, const Surfaces& surfaces) {
      Problem& problem = groups.of(surfaces);
      const double width = between(start[point], soup.points[point]).norm() * frame.latticeUnit();
      if (problem.count++ == 0 || width > problem.size)
      {
        problem.size = width;
        problem.place = frame.toModel(start[point]);
      }
    });
    groups.moveTo(problems);
  }

  static constexpr std::int64_t contactReach = 4; ///< in lattice units, for rounding

  const TriangleSurface& surface;
  const ProblemOptions& options;
  const RunContext& context;
  GridFrame frame;
  ClusterCells hidden;      ///< none
  std::vector<Vec3> points; ///< places that triangles use
  TriangleSoup soup;        ///< with these points
  std::vector<Problem> problems;
  std::vector<char> tangled; ///< triangles that crossings would cut into too many pieces
  Groups clusters{ProblemKind::clusters};
  std::vector<char> wasLeftOut; ///< per triangle of the model, whether it is in clusters
};

} // namespace

std::vector<Problem> findProblems(const TriangleSurface& surface, const ProblemOptions& options,
                                  const RunContext& context)
{
  return Search(surface, options, context).run();
}

} // namespace atria
