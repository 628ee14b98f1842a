// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/AnyMesh/BoundaryFeatures.h"

#include "Support/Angles.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace atria {

namespace {

/// Cosine between a face or edge and its reversed neighbor from which on it is folded back onto that.
constexpr double folded = 1.0 - 1e-4;

/// Sorts pairs (list, number) into lists.
Buckets makeLists(std::size_t lists, const std::vector<std::array<Index, 2>>& pairs)
{
  return fillBuckets(lists, SerialExecutor(), [&](auto&& use) {
    for (const auto& [list, number] : pairs)
    {
      use(list, number);
    }
  });
}

class FeatureSearch
{
public:
  FeatureSearch(const FaceMesh& source, const CellFaces& facesOfCells, std::span<const Index> patchOfFace, double angle,
                const RunContext& runContext)
      : mesh(source), cellFaces(facesOfCells), patches(patchOfFace), smooth(cosOfDegrees(angle)), context(runContext)
  {
  }

  BoundaryFeatures run()
  {
    findLeaders();
    collectFaces();
    context.progress.report(0.4, "Finding edges");
    findEdges();
    context.progress.report(0.8, "Finding edges");
    classifyPoints();
    context.progress.report(1.0, "Finding edges");
    return std::move(out);
  }

private:
  /// An edge of a face, by the leaders of its ends, the smaller first.
  struct Side
  {
    Index a, b, face;
    bool forward;
    bool sameEdge(const Side& other) const { return a == other.a && b == other.b; }
  };

  void findLeaders()
  {
    out.leaders.resize(mesh.points.size());
    std::iota(out.leaders.begin(), out.leaders.end(), Index{0});
    std::vector<char> onBoundary(mesh.points.size(), 0);
    for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
    {
      for (const Index p : mesh.face(f))
      {
        onBoundary[p] = 1;
      }
    }
    std::vector<Index> sorted;
    for (Index p = 0; p < onBoundary.size(); ++p)
    {
      if (onBoundary[p])
      {
        sorted.push_back(p);
      }
    }
    const auto place = [&](Index p) { return std::array{mesh.points[p][0], mesh.points[p][1], mesh.points[p][2]}; };
    std::ranges::sort(sorted, [&](Index a, Index b) {
      const auto placeA = place(a);
      const auto placeB = place(b);
      return placeA != placeB ? placeA < placeB : a < b;
    });
    bool anyShared = false;
    for (std::size_t i = 1; i < sorted.size(); ++i)
    {
      if (place(sorted[i]) == place(sorted[i - 1]))
      {
        out.leaders[sorted[i]] = out.leaders[sorted[i - 1]];
        anyShared = true;
      }
    }
    if (anyShared)
    {
      partCollapsed();
    }
  }

  /// Makes points lead themselves if a cell has two of them in one position, because these must move apart.
  void partCollapsed()
  {
    std::vector<char> collapsed(mesh.points.size(), 0);
    context.executor.forRanges(mesh.cellCount, 4096, [&](std::size_t begin, std::size_t end) {
      std::vector<Index> points;
      for (std::size_t cell = begin; cell < end; ++cell)
      {
        points.clear();
        for (const Index f : cellFaces.of(cell))
        {
          points.insert(points.end(), mesh.face(f).begin(), mesh.face(f).end());
        }
        std::ranges::sort(points);
        points.erase(std::unique(points.begin(), points.end()), points.end());
        for (Index& p : points)
        {
          p = out.leaders[p];
        }
        std::ranges::sort(points);
        for (std::size_t i = 1; i < points.size(); ++i)
        {
          if (points[i] == points[i - 1])
          {
            std::atomic_ref<char>(collapsed[points[i]]).store(1, std::memory_order_relaxed);
          }
        }
      }
    });
    for (Index p = 0; p < out.leaders.size(); ++p)
    {
      out.leaders[p] = collapsed[out.leaders[p]] ? p : out.leaders[p];
    }
  }

  /// Returns the cosine between the normal of a boundary face and the direction out of its cell.
  double outwardness(std::size_t face) const
  {
    Vec3 middle = Vec3::Zero();
    const auto own = cellFaces.of(mesh.owner[face]);
    for (const Index f : own)
    {
      middle += measurePolygon(mesh.points, mesh.face(f)).centroid;
    }
    middle /= static_cast<double>(own.size());
    const PolygonMeasure measure = measurePolygon(mesh.points, mesh.face(face));
    const Vec3 way = measure.centroid - middle;
    return measure.area.dot(way) / (measure.area.norm() * way.norm() + rootVSmall);
  }

  void collectFaces()
  {
    const std::size_t first = mesh.internalFaceCount();
    std::vector<std::vector<Index>> keys(mesh.faceCount() - first);
    std::vector<double> outward(keys.size());
    context.executor.forEach(keys.size(), 1024, [&](std::size_t i) {
      for (const Index p : mesh.face(first + i))
      {
        keys[i].push_back(out.leaders[p]);
      }
      std::ranges::sort(keys[i]);
      outward[i] = outwardness(first + i);
    });
    std::vector<Index> order(keys.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, [&](Index a, Index b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
    for (std::size_t i = 0; i < order.size();)
    {
      const Index face = order[i];
      double sum = 0.0;
      std::array<Index, 2> patch{noIndex, 0};
      for (; i < order.size() && keys[order[i]] == keys[face]; ++i)
      {
        sum += outward[order[i]];
        const Index own = patches.empty() ? 0 : patches[order[i]];
        patch = {std::min(patch[0], own), std::max(patch[1], own)};
      }
      out.faces.push_back(static_cast<Index>(first + face));
      turnedOver.push_back(sum < 0.0 ? 1 : 0);
      patchesOf.push_back(patch);
      const Vec3 area = measurePolygon(mesh.points, mesh.face(first + face)).area;
      const double length = area.norm();
      normals.push_back(length > rootVSmall ? Vec3(area / length) : Vec3(Vec3::Zero()));
    }
  }

  void findEdges()
  {
    std::vector<Side> sides;
    std::vector<std::array<Index, 2>> uses;
    for (Index f = 0; f < out.faces.size(); ++f)
    {
      const auto points = mesh.face(out.faces[f]);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Index a = out.leaders[points[i]];
        const Index b = out.leaders[points[(i + 1) % points.size()]];
        uses.push_back({a, f});
        if (a != b)
        {
          sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
      }
    }
    std::ranges::sort(sides, [](const Side& x, const Side& y) {
      return std::tuple(x.a, x.b, x.face, x.forward) < std::tuple(y.a, y.b, y.face, y.forward);
    });
    out.facesAbout = makeLists(mesh.points.size(), uses);
    UnionFind charts(out.faces.size());
    std::vector<std::array<Index, 2>> edgeUses;
    for (std::size_t i = 0; i < sides.size();)
    {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].sameEdge(sides[i]))
      {
        ++end;
      }
      const bool isSmooth = end - i == 2 && areSmooth(sides[i], sides[i + 1]);
      if (isSmooth)
      {
        charts.join(sides[i].face, sides[i + 1].face);
      }
      else
      {
        const auto edge = static_cast<Index>(out.edges.size());
        out.edges.push_back({sides[i].a, sides[i].b});
        facesAtEdge.push_back(static_cast<Index>(end - i));
        edgeUses.push_back({sides[i].a, edge});
        edgeUses.push_back({sides[i].b, edge});
      }
      i = end;
    }
    out.edgesAbout = makeLists(mesh.points.size(), edgeUses);
    out.charts.resize(out.faces.size());
    for (Index f = 0; f < out.charts.size(); ++f)
    {
      out.charts[f] = charts.find(f);
    }
  }

  bool areSmooth(const Side& x, const Side& y) const
  {
    if (x.face == y.face || patchesOf[x.face] != patchesOf[y.face])
    {
      return false;
    }
    const Vec3& a = normals[x.face];
    const Vec3& b = normals[y.face];
    if (a.isZero() || b.isZero())
    {
      return true;
    }
    const double cosine = (x.forward == y.forward ? -1.0 : 1.0) * a.dot(b);
    return cosine >= smooth || (cosine <= -folded && turnedOver[x.face] != turnedOver[y.face]);
  }

  void classifyPoints()
  {
    out.kinds.assign(mesh.points.size(), BoundaryKind::inside);
    context.executor.forEach(out.kinds.size(), 4096, [&](std::size_t p) {
      if (!out.facesAbout.of(p).empty())
      {
        out.kinds[p] = kindOf(static_cast<Index>(p));
      }
    });
  }

  BoundaryKind kindOf(Index p) const
  {
    const auto edges = out.edgesAbout.of(p);
    if (edges.empty())
    {
      return fansAbout(p) == 1 && !isPointed(p) ? BoundaryKind::surface : BoundaryKind::corner;
    }
    const bool passes = edges.size() == 2 && facesAtEdge[edges[0]] == facesAtEdge[edges[1]] &&
                        fansAbout(p) == facesAtEdge[edges[0]] && isStraight(p, edges[0], edges[1]);
    return passes ? BoundaryKind::curve : BoundaryKind::corner;
  }

  /// Returns the number of sets of faces around a point that are connected through edges at the point that are not
  /// kept.
  std::size_t fansAbout(Index p) const
  {
    const auto about = out.facesAbout.of(p);
    UnionFind fans(about.size());
    // One entry per face: the other ends of its two edges at the point.
    std::vector<std::array<Index, 2>> ends;
    for (const Index f : about)
    {
      const auto points = mesh.face(out.faces[f]);
      const std::size_t size = points.size();
      std::size_t i = 0;
      while (out.leaders[points[i]] != p)
      {
        ++i;
      }
      ends.push_back({out.leaders[points[(i + 1) % size]], out.leaders[points[(i + size - 1) % size]]});
    }
    const auto isKept = [&](Index end) {
      return std::ranges::any_of(out.edgesAbout.of(p),
                                 [&](Index e) { return out.edges[e][0] == end || out.edges[e][1] == end; });
    };
    for (Index i = 0; i < ends.size(); ++i)
    {
      for (Index j = 0; j < i; ++j)
      {
        for (const Index end : ends[i])
        {
          if ((end == ends[j][0] || end == ends[j][1]) && !isKept(end))
          {
            fans.join(i, j);
          }
        }
      }
    }
    std::size_t count = 0;
    for (Index i = 0; i < ends.size(); ++i)
    {
      count += fans.find(i) == i ? 1 : 0;
    }
    return count;
  }

  /// True if the normals around a point differ from their mean by more than the feature angle, as at the tip of a cone.
  bool isPointed(Index p) const
  {
    const auto about = out.facesAbout.of(p);
    Vec3 mean = Vec3::Zero();
    for (const Index f : about)
    {
      mean += normals[f].dot(normals[about[0]]) < 0.0 ? Vec3(-normals[f]) : normals[f];
    }
    mean.normalize();
    return std::ranges::any_of(
        about, [&](Index f) { return !normals[f].isZero() && std::abs(normals[f].dot(mean)) < smooth; });
  }

  /// True if the path over two edges turns little at a point, or goes back along itself as in a tangled mesh.
  bool isStraight(Index p, Index first, Index second) const
  {
    const auto wayAlong = [&](Index edge) {
      const auto& [a, b] = out.edges[edge];
      return Vec3(mesh.points[a == p ? b : a] - mesh.points[p]);
    };
    const Vec3 back = wayAlong(first);
    const Vec3 on = wayAlong(second);
    const double cosine = -back.dot(on) / (back.norm() * on.norm() + rootVSmall);
    return cosine >= smooth || cosine <= -folded;
  }

  const FaceMesh& mesh;
  const CellFaces& cellFaces;
  std::span<const Index> patches;
  double smooth; ///< cosine of the feature angle
  const RunContext& context;
  BoundaryFeatures out;
  /// One entry per face in out.faces.
  std::vector<char> turnedOver;
  std::vector<std::array<Index, 2>> patchesOf;
  std::vector<Vec3> normals;
  /// One entry per edge in out.edges.
  std::vector<Index> facesAtEdge;
};

} // namespace

BoundaryFeatures findBoundaryFeatures(const FaceMesh& mesh, const CellFaces& cellFaces, std::span<const Index> patches,
                                      double featureAngle, const RunContext& context)
{
  return FeatureSearch(mesh, cellFaces, patches, featureAngle, context).run();
}

} // namespace atria
