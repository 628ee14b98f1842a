// SPDX-License-Identifier: GPL-3.0-or-later
// How the measures of cells and faces are judged.
#include "Optimize/Kernel/EvaluatorShapes.h"
#include "Optimize/Kernel/QualityEvaluator.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t grain = 256;
constexpr double tiny = 1e-150;
/// Over the cube of the mean edge.
constexpr double flatVolume = 0.004;
/// Of what is flat but for rounding.
constexpr double flatSine = 1e-7;
/// Skewness is not more than this, so that one wild face does not drown the others.
constexpr double wild = 8.0;
/// Most measures are far above their target. What is above it by more than rounding can make is not divided, and no
/// root is taken.
constexpr double clearly = 1.0001;

/// Whether a component along a unit vector is above this share of the vector's length.
bool isAbove(double along, double share, const Vec3& vector)
{
  return along > 0.0 && along * along >= share * share * vector.squaredNorm();
}

Vec3 cross(const Vec3& u, const Vec3& v)
{
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

} // namespace

void QualityEvaluator::judgeAll(const RunContext& context)
{
  const ShapesOnDemand shapes(*this);
  context.executor.forEach(cellScores.size(), grain,
                           [&](std::size_t c) { judgeCell(static_cast<Index>(c), shapes, cellScores[c]); });
  context.executor.forEach(faceScores.size(), grain,
                           [&](std::size_t f) { judgeFace(static_cast<Index>(f), shapes, faceScores[f]); });
}

Score QualityEvaluator::scoreBy(const QualityTargets& targets, Index cell)
{
  const QualityTargets own = std::exchange(targets_, targets);
  const ShapesOnDemand shapes(*this);
  Score score;
  judgeCell(cell, shapes, score);
  for (const Index f : region_.facesOf(cell))
  {
    judgeFace(f, shapes, score);
  }
  targets_ = own;
  return score;
}

void QualityEvaluator::judgeInOrder(VertexStar& star, Index place) const
{
  const auto count = static_cast<Index>(star.cells.size());
  if (place < count)
  {
    judgeCell(star.cells[place], ShapesOfVertexStar(*this, star, star.slots.data() + star.offsets[place]),
              star.scores[place]);
    return;
  }
  const Index slot = place - count;
  judgeFace(star.faces[slot], ShapesOfVertexStar(*this, star, &slot), star.scores[place]);
}

template <typename Sink> void QualityEvaluator::judgeShort(VertexStar& star, Sink& out) const
{
  for (std::size_t i = 0; i < star.cells.size(); ++i)
  {
    if (cellScores[star.cells[i]].penalty > 0.0)
    {
      judgeCell(star.cells[i], ShapesOfVertexStar(*this, star, star.slots.data() + star.offsets[i]), out);
    }
  }
  for (Index i = 0; i < star.faces.size(); ++i)
  {
    if (faceScores[star.faces[i]].penalty > 0.0)
    {
      judgeFace(star.faces[i], ShapesOfVertexStar(*this, star, &i), out);
    }
  }
}

void QualityEvaluator::residualsOf(VertexStar& star, Residuals& out) const
{
  out.values.clear();
  judgeShort(star, out);
}

void QualityEvaluator::residualsBeside(VertexStar& star, const Residuals& before, std::vector<double>& out) const
{
  out.clear();
  ResidualsBeside sink{before, out};
  judgeShort(star, sink);
}

/// Of a face's edge and its centroid.
Vec3 QualityEvaluator::fanTriangle(Index face, std::size_t i) const
{
  const auto points = region_.face(face);
  const Vec3& centroid = faces[face].centroid;
  return cross(region_.points[points[i]] - centroid,
               region_.points[points[i + 1 < points.size() ? i + 1 : 0]] - centroid);
}

/// Of a quadrilateral.
std::array<Vec3, 4> QualityEvaluator::fanOf(Index face) const
{
  const auto points = region_.face(face);
  std::array<Vec3, 4> to;
  for (int i = 0; i < 4; ++i)
  {
    to[i] = region_.points[points[i]] - faces[face].centroid;
  }
  return {cross(to[0], to[1]), cross(to[1], to[2]), cross(to[2], to[3]), cross(to[3], to[0])};
}

/// Of a quadrilateral.
std::array<Vec3, 4> QualityEvaluator::halvesOf(Index face) const
{
  const auto points = region_.face(face);
  const auto way = [&](int a, int b) -> Vec3 { return region_.points[points[b]] - region_.points[points[a]]; };
  const Vec3 diagonal = way(0, 2);
  const Vec3 other = way(1, 3);
  return {cross(way(0, 1), diagonal), cross(diagonal, way(0, 3)), cross(way(1, 2), other), cross(other, way(1, 0))};
}

template <typename Shapes, typename Sink>
void QualityEvaluator::judgeCell(Index cell, const Shapes& shapes, Sink& score) const
{
  const auto own = region_.facesOf(cell);
  const CellMeasure& measure = cells[cell];
  // Residuals keep a place for each measure.
  const bool looksAtPairs = targets_.convex && (!std::is_same_v<Sink, Score> || !isClearlyConvex(cell));
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    const Index f = own[k];
    const Vec3 normal = sign(cell, f) * faces[f].normal;
    const Vec3 toFace = faces[f].centroid - measure.centroid;
    if (score.wantsNext() && !isAbove(normal.dot(toFace), targets_.pyramidCosine.target, toFace))
    {
      score.add(targets_.pyramidCosine.of(normal.dot(toFace) / (toFace.norm() + tiny)));
    }
    else
    {
      score.addGood();
    }
    scoreCorners(f, cell, shapes, k, score);
    if (looksAtPairs)
    {
      scoreConvexity(f, cell, score);
    }
  }
  if (targets_.decomposed)
  {
    score.add(targets_.determinantRoot.of(std::sqrt(std::sqrt(determinantOf(cell)))), targets_.leastOfDeterminant);
  }
  if (targets_.scaledJacobian > 0.0)
  {
    // All that are below the target: the least alone has a kink where another one takes over.
    const JacobianTerms terms = jacobiansOf(cell);
    const QualityRange jacobian{targets_.jacobianLimit, targets_.scaledJacobian};
    for (std::size_t i = 0; i < terms.count; ++i)
    {
      score.add(jacobian.of(terms.values[i]), targets_.leastOfJacobian);
    }
  }
}

/// How far the cell's other faces lie behind the plane of one.
template <typename Sink> void QualityEvaluator::scoreConvexity(Index face, Index cell, Sink& score) const
{
  const Vec3 normal = sign(cell, face) * faces[face].normal;
  for (const Index g : region_.facesOf(cell))
  {
    if (face == g)
    {
      continue;
    }
    if (!score.wantsNext())
    {
      score.addGood();
      continue;
    }
    const Vec3 between = faces[g].centroid - faces[face].centroid;
    const double inside = -normal.dot(between);
    // Two faces on the boundary may lie in one plane.
    const bool mayBeFlat = region_.neighbor[face] == noIndex && region_.neighbor[g] == noIndex;
    if (mayBeFlat ? inside < -flatSine * between.norm() : !isAbove(inside, targets_.convexity.target, between))
    {
      score.add(targets_.convexity.of(inside / (between.norm() + tiny)));
    }
    else
    {
      score.addGood();
    }
  }
}

/// Whether no two faces fall short in scoreConvexity: a quicker look at both ways at once. May be false for cells of
/// many faces.
bool QualityEvaluator::isClearlyConvex(Index cell) const
{
  struct Face
  {
    Vec3 centroid;
    Vec3 normal;
    bool onBoundary;
  };
  constexpr std::size_t most = 8;
  std::array<Face, most> own;
  const auto of = region_.facesOf(cell);
  if (of.size() > most)
  {
    return false;
  }
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    const Index f = of[i];
    own[i] = {faces[f].centroid, sign(cell, f) * faces[f].normal, region_.neighbor[f] == noIndex};
    for (std::size_t j = 0; j < i; ++j)
    {
      const Vec3 between = own[j].centroid - own[i].centroid;
      const double one = -own[i].normal.dot(between);
      const double other = own[j].normal.dot(between);
      const double least = std::min(one, other);
      const bool mayBeFlat = own[i].onBoundary && own[j].onBoundary;
      if (mayBeFlat ? least < -flatSine * between.norm() : !isAbove(least, targets_.convexity.target, between))
      {
        return false;
      }
    }
  }
  return true;
}

/// The centroid of a cell that is nearly flat or inside out may lie anywhere.
const Vec3& QualityEvaluator::middleOf(Index cell) const
{
  const auto isFlat = [&] { return cells[cell].volume < flatVolume * (sizes[cell] * sizes[cell] * sizes[cell]); };
  const bool trusted = cell >= sizes.size() || (targets_.decomposed && !isFlat());
  return trusted ? cells[cell].centroid : cells[cell].mean;
}

/// Six times the volumes over the halves of a quadrilateral.
std::array<double, 4> QualityEvaluator::halfVolumes(Index face, const std::array<Vec3, 4>& half,
                                                    const Vec3& middle) const
{
  const auto points = region_.face(face);
  const Vec3 first = region_.points[points[0]] - middle;
  const Vec3 second = region_.points[points[1]] - middle;
  return {half[0].dot(first), half[1].dot(first), half[2].dot(second), half[3].dot(second)};
}

/// OpenFOAM takes a face apart into triangles about its centroid. In the tetrahedra of these, a parallelepiped has 24.
template <typename Shapes, typename Sink>
void QualityEvaluator::scoreCorners(Index face, Index cell, const Shapes& shapes, std::size_t k, Sink& score) const
{
  if (!score.wantsNext())
  {
    score.addGood();
    return;
  }
  const std::size_t size = region_.face(face).size();
  const Vec3& middle = middleOf(cell);
  const double scale = sign(cell, face) * cornerScales[cell];
  const Vec3 toFace = faces[face].centroid - middle;
  double least = std::numeric_limits<double>::infinity();
  if (size == 3)
  {
    score.add(scale * 2.0 * faces[face].area.dot(toFace));
  }
  else if (size > 4)
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      least = std::min(least, scale * fanTriangle(face, i).dot(toFace));
    }
    score.add(0.5 * static_cast<double>(size) * least);
  }
  else if (targets_.decomposed)
  {
    for (const Vec3& part : shapes.fan(face, k))
    {
      least = std::min(least, scale * part.dot(toFace));
    }
    score.add(2.0 * least);
  }
  else
  {
    const std::array<double, 4> part = halfVolumes(face, shapes.halves(face, k), middle);
    score.add(std::max(std::min(scale * part[0], scale * part[1]), std::min(scale * part[2], scale * part[3])));
  }
}

/// OpenFOAM also takes a face apart into triangles about one of its corners, the same for the cells on both sides. In
/// a quadrilateral there are two ways.
template <typename Shapes, typename Sink>
void QualityEvaluator::scoreFans(Index face, const Shapes& shapes, Sink& score) const
{
  if (region_.face(face).size() != 4 || !targets_.decomposed)
  {
    return;
  }
  if (!score.wantsNext())
  {
    score.addGood();
    return;
  }
  std::array<double, 2> least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto& half = shapes.halves(face, 0);
  const auto look = [&](const Vec3& middle, double scale) {
    const std::array<double, 4> part = halfVolumes(face, half, middle);
    for (std::size_t fan = 0; fan < 2; ++fan)
    {
      least[fan] = std::min({least[fan], scale * part[2 * fan], scale * part[2 * fan + 1]});
    }
  };
  const Index own = region_.owner[face];
  const Index across = region_.neighbor[face];
  look(middleOf(own), cornerScales[own]);
  if (across != noIndex)
  {
    look(middleOf(across), -cornerScales[across < sizes.size() ? across : own]);
  }
  score.add(std::max(least[0], least[1]));
}

template <typename Shapes, typename Sink>
void QualityEvaluator::judgeFace(Index face, const Shapes& shapes, Sink& score) const
{
  const FaceMeasure& f = faces[face];
  const CellMeasure& own = cells[region_.owner[face]];
  const Index across = region_.neighbor[face];
  scoreFans(face, shapes, score);
  if (across == noIndex)
  {
    const double height = f.normal.dot(f.centroid - own.centroid);
    scoreSkewness(face, height * f.normal, score);
    scoreBoundary(face, shapes, score);
    return;
  }
  const CellMeasure& other = cells[across];
  const Vec3 d = other.centroid - own.centroid;
  if (!isAbove(f.normal.dot(d), targets_.faceCosine.target, d))
  {
    score.add(targets_.faceCosine.of(f.normal.dot(d) / (d.norm() + tiny)), targets_.leastOfFaceCosine);
  }
  else
  {
    score.addGood();
  }
  scoreSkewness(face, d, score);
  scoreSizes(f, own, other, score);
}

/// Interpolation weight and ratio of volumes.
template <typename Sink>
void QualityEvaluator::scoreSizes(const FaceMeasure& face, const CellMeasure& own, const CellMeasure& other,
                                  Sink& score) const
{
  const double here = std::abs(face.normal.dot(face.centroid - own.centroid));
  const double there = std::abs(face.normal.dot(other.centroid - face.centroid));
  if (std::min(here, there) > clearly * targets_.weight.target * (here + there + tiny))
  {
    score.addGood();
  }
  else
  {
    score.add(targets_.weight.of(weightOf(face, own, other)));
  }
  const double larger = std::max(std::abs(own.volume), std::abs(other.volume));
  if (std::min(own.volume, other.volume) > clearly * targets_.volumeRatio.target * (larger + tiny))
  {
    score.addGood();
  }
  else
  {
    score.add(targets_.volumeRatio.of(volumeRatioOf(own, other)));
  }
}

template <typename Shapes, typename Sink>
void QualityEvaluator::scoreBoundary(Index face, const Shapes& shapes, Sink& score) const
{
  const FaceMeasure& f = faces[face];
  const std::size_t size = region_.face(face).size();
  const double mean = f.length / static_cast<double>(size) + tiny;
  const auto add = [&](const Vec3& part) { score.add(targets_.boundaryShape.of(0.5 * part.dot(f.normal) / mean)); };
  if (size == 4)
  {
    for (const Vec3& part : shapes.fan(face, 0))
    {
      add(part);
    }
  }
  for (std::size_t i = 0; size > 4 && i < size; ++i)
  {
    add(fanTriangle(face, i));
  }
}

template <typename Sink> void QualityEvaluator::scoreSkewness(Index face, const Vec3& d, Sink& score) const
{
  if (!score.wantsNext() || isClearlyStraight(face, d))
  {
    score.addGood();
    return;
  }
  const double skewness = faces[face].normal.isZero() ? wild : skewnessOf(face, d, targets_.skewness.target);
  score.add(targets_.skewness.of(std::min(skewness, wild)), targets_.leastOfSkewness);
}

/// Whether the skewness is below its target, as far as that can be seen without roots and division.
bool QualityEvaluator::isClearlyStraight(Index face, const Vec3& d) const
{
  constexpr double notAlong = 1e-3;
  const FaceMeasure& f = faces[face];
  const Vec3 toFace = f.centroid - cells[region_.owner[face]].centroid;
  const double along = f.normal.dot(d);
  const double square = along * along;
  const double length = d.squaredNorm();
  const double least = (region_.neighbor[face] != noIndex ? 0.2 : 0.4) * targets_.skewness.target;
  return square > notAlong * notAlong * length &&
         clearly * (along * toFace - f.normal.dot(toFace) * d).squaredNorm() < least * least * length * square;
}

/// As in Quality/Metrics.h; what is below `good` is not computed to the end.
double QualityEvaluator::skewnessOf(Index face, const Vec3& d, double good) const
{
  const FaceMeasure& f = faces[face];
  const bool internal = region_.neighbor[face] != noIndex;
  const Vec3 toFace = f.centroid - cells[region_.owner[face]].centroid;
  const double along = f.normal.dot(d);
  const bool hasArea = !f.normal.isZero();
  if (hasArea && std::abs(along) < tiny)
  {
    return std::numeric_limits<double>::infinity();
  }
  const Vec3 offset = hasArea ? Vec3(toFace - (f.normal.dot(toFace) / along) * d) : toFace;
  const double distance = offset.norm();
  double extent = (internal ? 0.2 : 0.4) * d.norm() + tiny;
  if (distance <= good * extent)
  {
    return distance / extent;
  }
  for (const Index point : region_.face(face))
  {
    extent = std::max(extent, std::abs(offset.dot(region_.points[point] - f.centroid)) / distance);
  }
  return distance / extent;
}

} // namespace atria
