// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/UnfoldFaces.h"

#include "Support/Buckets.h"
#include "Support/Sorting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace atria {

namespace {

/// Least share of a face's area that each of its triangles should have.
constexpr double leastPart = 0.05;
constexpr int mostSweeps = 30;
/// Lengths of steps over the size of the faces around a point. A point slides by no more than that size in all.
constexpr std::array<double, 4> steps{0.4, 0.15, 0.05, 0.02};
/// Least gain of a step, as a share of the penalty.
constexpr double leastGain = 1e-3;

class FaceUnfolder
{
public:
  FaceUnfolder(DualMesh& of, VertexConstraints& by, const RunContext& run) : mesh(of), constraints(by), context(run) {}

  void run()
  {
    const std::vector<Index> points = foldedPoints();
    if (!points.empty())
    {
      collectFaces();
      listFaces();
      unfold(points);
    }
  }

private:
  /// Returns the face; nothing for the second side of a sheet, as both sides are one face.
  ReducedFace reduced(const BoundaryFace& face) const
  {
    return face.opposite == noIndex || face.element < face.opposite ? faceOf(mesh.corners[face.element], face.direction)
                                                                    : ReducedFace{};
  }

  /// Returns the points of folded wall faces.
  std::vector<Index> foldedPoints() const
  {
    std::vector<char> folded(mesh.boundaryFaces.size());
    context.executor.forEach(folded.size(), 4096, [&](std::size_t f) {
      const BoundaryFace& face = mesh.boundaryFaces[f];
      folded[f] = !face.onDomainSide && isFolded(reduced(face)) ? 1 : 0;
    });
    std::vector<Index> points;
    for (std::size_t f = 0; f < folded.size(); ++f)
    {
      if (folded[f])
      {
        const auto& [p, count] = reduced(mesh.boundaryFaces[f]);
        points.insert(points.end(), p.begin(), p.begin() + count);
      }
    }
    return points;
  }

  void collectFaces()
  {
    for (const BoundaryFace& face : mesh.boundaryFaces)
    {
      if (const ReducedFace corners = reduced(face); corners.count >= 3)
      {
        faces.push_back(corners);
      }
    }
  }

  void unfold(std::vector<Index> points)
  {
    for (int sweep = 0; sweep < mostSweeps && !points.empty(); ++sweep)
    {
      context.progress.check();
      points = slide(std::move(points));
    }
  }

  Vec3 areaOf(const ReducedFace& face) const
  {
    const auto& [p, count] = face;
    Vec3 area = Vec3::Zero();
    for (int i = 2; i < count; ++i)
    {
      area += 0.5 * (at(p[i - 1]) - at(p[0])).cross(at(p[i]) - at(p[0]));
    }
    return area;
  }

  /// Calls use(share) for each triangle of a face, with its signed share of the face's area.
  template <typename F> void eachPart(const ReducedFace& face, const Vec3& area, F&& use) const
  {
    const auto& [p, count] = face;
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < count; ++i)
    {
      middle += at(p[i]) / count;
    }
    for (int i = 0; i < count; ++i)
    {
      const Vec3 part = 0.5 * (at(p[i]) - middle).cross(at(p[(i + 1) % count]) - middle);
      use(part.dot(area) / area.squaredNorm());
    }
  }

  bool isFolded(const ReducedFace& face) const
  {
    const Vec3 area = areaOf(face);
    bool folded = false;
    if (face.count >= 3 && area.squaredNorm() > 0.0)
    {
      eachPart(face, area, [&](double part) { folded = folded || part < 0.0; });
    }
    return folded;
  }

  double penaltyOf(const ReducedFace& face, const Vec3& area) const
  {
    double sum = 0.0;
    if (area.squaredNorm() > 0.0)
    {
      eachPart(face, area, [&](double part) { sum += std::pow(std::max(leastPart - part, 0.0), 2); });
    }
    return sum;
  }

  const Vec3& at(Index p) const { return mesh.points[p]; }

  void listFaces()
  {
    facesOf = fillBuckets(mesh.points.size(), SerialExecutor(), [&](auto&& use) {
      for (Index f = 0; f < faces.size(); ++f)
      {
        std::for_each(faces[f].points.begin(), faces[f].points.begin() + faces[f].count, [&](Index p) { use(p, f); });
      }
    });
    start = mesh.points;
  }

  /// Slides each point once. Returns the points of faces that fall short around those that moved.
  std::vector<Index> slide(std::vector<Index> points)
  {
    sortUnique(points);
    std::erase_if(points, [&](Index p) { return !constraints.isMovable(p); });
    constraints.prepare(points, context);
    std::vector<Index> next;
    for (const Index p : points)
    {
      if (slide(p))
      {
        for (const Index f : facesOf.of(p))
        {
          if (penaltyOf(faces[f], areaOf(faces[f])) > 0.0)
          {
            next.insert(next.end(), faces[f].points.begin(), faces[f].points.begin() + faces[f].count);
          }
        }
      }
    }
    return next;
  }

  bool slide(Index p)
  {
    std::vector<Vec3> areas;
    double before = 0.0;
    double size = 0.0;
    for (const Index f : facesOf.of(p))
    {
      areas.push_back(areaOf(faces[f]));
      before += penaltyOf(faces[f], areas.back());
      size = std::max(size, std::sqrt(areas.back().norm()));
    }
    if (before == 0.0)
    {
      return false;
    }
    const Vec3 from = at(p);
    Vec3 best = from;
    double least = (1.0 - leastGain) * before;
    for (const double step : steps)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        const Vec3 way = (isUpper(direction) ? step : -step) * size * Vec3::Unit(axisOf(direction));
        mesh.points[p] = constraints.place(p, from + way);
        const double there = (at(p) - start[p]).norm() <= size ? penaltyAt(p, areas) : before;
        if (there < least)
        {
          least = there;
          best = at(p);
        }
      }
    }
    mesh.points[p] = best;
    return best != from;
  }

  /// Returns the penalty of the faces around a point; infinite if a face is turned over as a whole.
  double penaltyAt(Index p, const std::vector<Vec3>& areas) const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
      const ReducedFace& face = faces[facesOf.of(p)[i]];
      const Vec3 area = areaOf(face);
      sum += area.dot(areas[i]) >= 0.0 ? penaltyOf(face, area) : std::numeric_limits<double>::infinity();
    }
    return sum;
  }

  DualMesh& mesh;
  VertexConstraints& constraints;
  const RunContext& context;
  std::vector<ReducedFace> faces;
  Buckets facesOf; ///< faces of each point
  std::vector<Vec3> start;
};

} // namespace

void unfoldFaces(DualMesh& mesh, VertexConstraints& constraints, const RunContext& context)
{
  FaceUnfolder(mesh, constraints, context).run();
}

} // namespace atria
