// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerDirections.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

/// Unit vectors projected onto a plane have no direction if they get shorter than this.
constexpr double tiny = 1e-6;
/// Sine of the slope above which faces of a side are off its plane.
constexpr double sideSlope = 1e-5;
/// Sine below which an angle of a wall face is straight: within 6 degrees of 180.
constexpr double straightSine = 0.1;
/// Distance by which directions lean there, as a share of the height; chosen for the prism's intended convexity.
constexpr double lean = 0.25;

/// Removes directions from space until a plane, a line or a point is left.
class Subspace
{
public:
  /// Keeps the plane across `normal`, unless `normal` adds nothing new.
  void cut(const Vec3& normal)
  {
    const Vec3 rest = project(normal);
    if (rest.norm() > 1e-3 && count < 3)
    {
      cuts[count++] = rest.normalized();
    }
  }

  Vec3 project(Vec3 v) const
  {
    for (int i = 0; i < count; ++i)
    {
      v -= cuts[i].dot(v) * cuts[i];
    }
    return v;
  }

private:
  std::array<Vec3, 3> cuts;
  int count = 0;
};

/// Normals of one sheet differ a little from face to face; only directions that most of them agree on make a plane.
void cutSheets(Subspace& space, const std::vector<Vec3>& sheets)
{
  if (sheets.empty())
  {
    return;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& normal : sheets)
  {
    const Vec3 inside = space.project(normal);
    spread += inside * inside.transpose() / static_cast<double>(sheets.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  for (int i = 2; i >= 0; --i)
  {
    if (solver.eigenvalues()[i] > sheetSpread)
    {
      space.cut(solver.eigenvectors().col(i));
    }
  }
}

void appendDistinct(std::vector<Vec3>& out, const Vec3& v)
{
  if (v.norm() > tiny && std::none_of(out.begin(), out.end(), [&](const Vec3& o) { return (o - v).norm() < tiny; }))
  {
    out.push_back(v);
  }
}

/// Returns the direction that maximizes the smallest product with `vectors`.
class Search
{
public:
  explicit Search(const std::vector<Vec3>& v) : vectors(v) {}

  Vec3 run()
  {
    const std::size_t count = vectors.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      take(vectors[i]);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = i + 1; j < count; ++j)
      {
        // Direction across the line through both, in their plane.
        const Vec3 along = vectors[j] - vectors[i];
        take(vectors[i] - along * (vectors[i].dot(along) / along.squaredNorm()));
        for (std::size_t k = j + 1; k < count; ++k)
        {
          const Vec3 across = along.cross(vectors[k] - vectors[i]);
          take(across);
          take(-across);
        }
      }
    }
    return best;
  }

private:
  void take(const Vec3& candidate)
  {
    const double length = candidate.norm();
    if (length < tiny * tiny)
    {
      return;
    }
    const Vec3 d = candidate / length;
    double least = 2.0;
    for (const Vec3& v : vectors)
    {
      least = std::min(least, v.dot(d));
      if (least <= bestLeast)
      {
        return;
      }
    }
    bestLeast = least;
    best = d;
  }

  const std::vector<Vec3>& vectors;
  Vec3 best = Vec3::Zero();
  double bestLeast = -2.0;
};

double leastCosine(const Vec3& direction, std::span<const Index> faces, const std::vector<Vec3>& normals)
{
  double least = 1.0;
  for (const Index f : faces)
  {
    least = std::min(least, direction.dot(normals[f].normalized()));
  }
  return least;
}

} // namespace

LayerDirection solveDirection(const DirectionProblem& problem)
{
  Subspace space;
  for (const Vec3& side : problem.sides)
  {
    space.cut(side);
  }
  cutSheets(space, problem.sheets);
  std::vector<Vec3> vectors;
  for (const auto* group : {&problem.walls, &problem.ways})
  {
    for (const Vec3& v : *group)
    {
      appendDistinct(vectors, space.project(v));
    }
  }
  LayerDirection out;
  // The projection is repeated, as rounding must not take a point off its side.
  out.direction = space.project(Search(vectors).run());
  if (out.direction.norm() < tiny)
  {
    return {};
  }
  out.direction.normalize();
  out.cosine = 1.0;
  for (const auto* group : {&problem.walls, &problem.sheets})
  {
    for (const Vec3& v : *group)
    {
      out.cosine = std::min(out.cosine, v.dot(out.direction));
    }
  }
  return out;
}

/// True if the faces of domain sides around a point lie in their planes. Their other points may be on a surface close
/// to a turned side; copies that slide along the side would then change the space inside.
bool LayerDirections::liesInSides(const DualMesh& mesh, Index point) const
{
  return std::ranges::all_of(walls_.graph.facesAt(point), [&](Index f) {
    return walls_.roles[f] != FaceRole::slide ||
           normals_[f].cross(sideNormal(mesh.boundaryFaces[f], options_)).norm() <= sideSlope * normals_[f].norm();
  });
}

/// Returns the constraints from the faces around a point.
DirectionProblem LayerDirections::problemAt(const DualMesh& mesh, Index point) const
{
  DirectionProblem problem;
  const auto star = walls_.graph.facesAt(point);
  for (const Index f : star)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    const double area = normals_[f].norm();
    if (walls_.roles[f] == FaceRole::slide)
    {
      problem.sides.push_back(sideNormal(face, options_));
    }
    if (walls_.roles[f] != FaceRole::wall || area == 0.0)
    {
      continue;
    }
    const Vec3 normal = normals_[f] / area;
    const Index behind = faceBehind(mesh, face);
    if (behind == noIndex || std::find(star.begin(), star.end(), behind) == star.end())
    {
      problem.walls.push_back(normal);
      continue;
    }
    problem.sheets.push_back(normal);
    for (int i = 0; i < 4; ++i)
    {
      const Index a = cornerOf(mesh, face, i);
      const Index b = cornerOf(mesh, face, i + 1);
      const Index code = walls_.graph.across[f][i];
      const bool boundaryEdge = BoundaryGraph::isEdge(code) && BoundaryGraph::faceOf(code) == behind;
      if (boundaryEdge && (a == point || b == point))
      {
        // The face runs round the normal out of the fluid.
        const Vec3 out = normal.cross(mesh.points[b] - mesh.points[a]);
        appendDistinct(problem.ways, out.norm() > 0.0 ? Vec3(out.normalized()) : Vec3(Vec3::Zero()));
      }
    }
  }
  return problem;
}

/// Returns the direction out of the wall faces that have an angle of nearly 180 degrees at a point; zero without such a
/// face. The directions of several faces are added up.
Vec3 LayerDirections::wayFromStraight(const DualMesh& mesh, Index point) const
{
  Vec3 way = Vec3::Zero();
  for (const Index f : walls_.graph.facesAt(point))
  {
    const std::array<Index, 4> corners = cornersOf(mesh, mesh.boundaryFaces[f]);
    for (std::size_t i = 0; i < 4 && walls_.roles[f] == FaceRole::wall; ++i)
    {
      const Vec3 before = mesh.points[corners[(i + 3) % 4]] - mesh.points[corners[i]];
      const Vec3 after = mesh.points[corners[(i + 1) % 4]] - mesh.points[corners[i]];
      const double length = before.norm() * after.norm();
      if (corners[i] == point && before.dot(after) < 0.0 && before.cross(after).norm() < straightSine * length)
      {
        way += normals_[f].cross(after - before).normalized();
      }
    }
  }
  return way;
}

LayerDirection LayerDirections::find(const DualMesh& mesh, Index point) const
{
  if (!liesInSides(mesh, point))
  {
    return {};
  }
  LayerDirection upright = solveDirection(problemAt(mesh, point));
  const auto star = walls_.graph.facesAt(point);
  if (upright.cosine < feasibleCosine ||
      std::ranges::any_of(star, [&](Index f) { return walls_.roles[f] != FaceRole::wall; }))
  {
    return upright;
  }
  const Vec3 out = wayFromStraight(mesh, point);
  const Vec3 way = out - upright.direction.dot(out) * upright.direction;
  if (way.isZero())
  {
    return upright;
  }
  const Vec3 leaning = (upright.direction + lean / std::max(1.0, way.norm()) * way).normalized();
  const double cosine = leastCosine(leaning, star, normals_);
  return cosine >= feasibleCosine ? LayerDirection{leaning, cosine} : upright;
}

/// Measures faces of points that moved, and forgets the directions at their points.
void LayerDirections::forgetMoved(const DualMesh& mesh, const RunContext& context)
{
  const bool isFirst = points_.empty();
  normals_.resize(mesh.boundaryFaces.size());
  directions_.resize(mesh.points.size());
  isKnown_.resize(mesh.points.size(), 0);
  std::vector<char> isOutdated(normals_.size());
  context.executor.forEach(normals_.size(), 4096, [&](std::size_t f) {
    const std::array<Index, 4> corners = cornersOf(mesh, mesh.boundaryFaces[f]);
    isOutdated[f] = isFirst || std::ranges::any_of(corners, [&](Index p) { return points_[p] != mesh.points[p]; });
    normals_[f] = isOutdated[f] ? wallNormal(mesh, mesh.boundaryFaces[f]) : normals_[f];
  });
  for (std::size_t f = 0; f < isOutdated.size(); ++f)
  {
    for (int i = 0; i < 4 && isOutdated[f]; ++i)
    {
      isKnown_[cornerOf(mesh, mesh.boundaryFaces[f], i)] = 0;
    }
  }
  points_ = mesh.points;
}

void LayerDirections::update(const DualMesh& mesh, const std::vector<Index>& counts, const RunContext& context)
{
  forgetMoved(mesh, context);
  context.executor.forRanges(counts.size(), 1024, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    for (std::size_t p = begin; p < end; ++p)
    {
      if (counts[p] > 0 && !isKnown_[p])
      {
        directions_[p] = find(mesh, static_cast<Index>(p));
        isKnown_[p] = 1;
      }
    }
  });
}

} // namespace atria
