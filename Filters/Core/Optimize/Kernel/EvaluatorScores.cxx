// SPDX-License-Identifier: GPL-3.0-or-later
// Judges the measures of cells and faces.
#include "Optimize/Kernel/EvaluatorShapes.h"
#include "Optimize/Kernel/QualityEvaluator.h"
#include "Quality/Checks/CheckLimits.h"

#include <algorithm>
#include <cmath>

/// Inlines all calls within a function.
#ifdef __GNUC__
#define ATRIA_FLATTEN [[gnu::flatten]]
#else
#define ATRIA_FLATTEN
#endif

namespace atria {

namespace {

constexpr std::size_t grain = 256;
/// Volume, over the cube of the mean edge, below which a cell is nearly flat.
constexpr double flatVolume = 0.004;
/// Sine of an angle that is 0 up to rounding.
constexpr double flatSine = 1e-7;
/// Upper bound of skewness, so that one extreme face does not outweigh the others.
constexpr double wild = 8.0;

/// True if a component along a unit vector is positive and at least this share of the vector's length.
bool isAbove(double along, double share, const Vec3& vector)
{
  return along > 0.0 && along * along >= share * share * vector.squaredNorm();
}

/// True if a boundary face of a cell is far enough behind the plane of another one, or if both lie in one plane.
/// Writers merge faces in one plane, see mergedPlanarSine.
bool isBehindOrFlat(double inside, double length, const Vec3& normal, const Vec3& other)
{
  return inside > 2.0 * checkLimits::concaveSine * length ||
         (inside >= -flatSine * length && (normal - other).norm() < checkLimits::concaveSine);
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

std::array<double, Measure::kinds> QualityEvaluator::leastOf(Index cell) const
{
  struct Least
  {
    std::array<double, Measure::kinds> values;
    void add(const Measure& measure, double q) { values[measure.kind] = std::min(values[measure.kind], q); }
    void add(const Measure& measure, double q, double /*least*/) { add(measure, q); }
  } least;
  least.values.fill(std::numeric_limits<double>::infinity());
  const ShapesOnDemand shapes(*this);
  judgeCell(cell, shapes, least);
  for (const Index f : region_.facesOf(cell))
  {
    judgeFace(f, shapes, least);
  }
  return least.values;
}

ATRIA_FLATTEN void QualityEvaluator::judgeInOrder(VertexStar& star, Index place) const
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

ATRIA_FLATTEN void QualityEvaluator::residualsOf(VertexStar& star, Residuals& out) const
{
  out.measures.clear();
  out.values.clear();
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

ATRIA_FLATTEN void QualityEvaluator::residualsBeside(VertexStar& star, const Residuals& before,
                                                     std::vector<double>& out) const
{
  const ShapesOfVertexStar shapes(*this, star, nullptr);
  out.clear();
  for (const Measure& measure : before.measures)
  {
    out.push_back(shortfallOf(measureOf(measure, shapes)));
  }
}

/// Returns a relative measure in the current state.
template <typename Shapes> double QualityEvaluator::measureOf(const Measure& measure, const Shapes& shapes) const
{
  const Index face = measure.face;
  const auto owner = [&]() -> const CellMeasure& { return cells[region_.owner[face]]; };
  const auto across = [&]() -> const CellMeasure& { return cells[region_.neighbor[face]]; };
  switch (measure.kind)
  {
    case Measure::pyramidCosine:
      return pyramidOf(face, measure.cell);
    case Measure::corners:
      return cornersOf(face, measure.cell, middleOf(measure.cell), shapes, measure.slot);
    case Measure::convexity:
      return convexityOf(face, measure.other, measure.cell);
    case Measure::determinant:
      return targets_.determinantRoot.of(std::sqrt(std::sqrt(determinantOf(measure.cell))));
    case Measure::jacobian:
      return jacobianRange().of(jacobiansOf(measure.cell).values[measure.part]);
    case Measure::fans:
      return fansOf(face, shapes, measure.slot);
    case Measure::boundaryShape:
      return boundaryShapeOf(face, measure.part, shapes, measure.slot);
    case Measure::faceCosine:
      return orthogonalityOf(face);
    case Measure::skewness:
      return straightnessOf(face);
    case Measure::weight:
      return targets_.weight.of(weightOf(faces[face], owner(), across()));
    case Measure::volumeRatio:
      return targets_.volumeRatio.of(volumeRatioOf(owner(), across()));
    case Measure::kinds:
      break;
  }
  return 1.0;
}

template <typename Shapes, typename Sink>
void QualityEvaluator::judgeCell(Index cell, const Shapes& shapes, Sink& score) const
{
  const auto own = region_.facesOf(cell);
  const Vec3 centroid = cells[cell].centroid;
  const Vec3 middle = middleOf(cell);
  const bool looksAtPairs = targets_.convex && !isClearlyConvex(cell);
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    const Index f = own[k];
    const Index slot = shapes.slotOf(k);
    const Vec3 toFace = faces[f].centroid - centroid;
    if (!isAbove(sign(cell, f) * faces[f].normal.dot(toFace), targets_.pyramidCosine.target, toFace))
    {
      score.add({Measure::pyramidCosine, 0, cell, f}, pyramidOf(f, cell));
    }
    score.add({Measure::corners, 0, cell, f, noIndex, slot}, cornersOf(f, cell, middle, shapes, slot));
    if (looksAtPairs)
    {
      judgeConvexity(f, cell, score);
    }
  }
  if (targets_.decomposed)
  {
    const double determinant = determinantOf(cell);
    const double good = Score::farAbove * targets_.determinantRoot.target;
    if (determinant < good * good * good * good)
    {
      score.add({Measure::determinant, 0, cell}, targets_.determinantRoot.of(std::sqrt(std::sqrt(determinant))),
                targets_.leastOfDeterminant);
    }
  }
  if (targets_.scaledJacobian > 0.0)
  {
    // Adds all terms, not only the smallest one, which has a kink where another term becomes the smallest.
    const JacobianTerms terms = jacobiansOf(cell);
    for (std::uint8_t i = 0; i < terms.count; ++i)
    {
      score.add({Measure::jacobian, i, cell}, jacobianRange().of(terms.values[i]), targets_.leastOfJacobian);
    }
  }
}

double QualityEvaluator::pyramidOf(Index face, Index cell) const
{
  const Vec3 toFace = faces[face].centroid - cells[cell].centroid;
  return targets_.pyramidCosine.of(sign(cell, face) * faces[face].normal.dot(toFace) / (toFace.norm() + rootVSmall));
}

/// Returns the relative measure of how far face `other` of a cell lies behind the plane of `face`; 1 for boundary faces
/// that may lie so.
double QualityEvaluator::convexityOf(Index face, Index other, Index cell) const
{
  const Vec3 between = faces[other].centroid - faces[face].centroid;
  const double inside = -sign(cell, face) * faces[face].normal.dot(between);
  const bool onBoundary = region_.neighbor[face] == noIndex && region_.neighbor[other] == noIndex;
  // The cell owns both faces, so that their normals point out of it.
  if (onBoundary && isBehindOrFlat(inside, between.norm(), faces[face].normal, faces[other].normal))
  {
    return 1.0;
  }
  return targets_.convexity.of(inside / (between.norm() + rootVSmall));
}

template <typename Sink> void QualityEvaluator::judgeConvexity(Index face, Index cell, Sink& score) const
{
  const Vec3 normal = sign(cell, face) * faces[face].normal;
  for (const Index g : region_.facesOf(cell))
  {
    const Vec3 between = faces[g].centroid - faces[face].centroid;
    if (face != g && !isAbove(-normal.dot(between), targets_.convexity.target, between))
    {
      score.add({Measure::convexity, 0, cell, face, g}, convexityOf(face, g, cell));
    }
  }
}

/// True if no two faces fall short in judgeConvexity(). This is faster, as it tests both directions of a pair together.
/// Always false for cells with more than 8 faces.
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
      const bool onBoundary = own[i].onBoundary && own[j].onBoundary;
      if (onBoundary ? !isBehindOrFlat(least, between.norm(), own[i].normal, own[j].normal)
                     : !isAbove(least, targets_.convexity.target, between))
      {
        return false;
      }
    }
  }
  return true;
}

/// Returns the apex of the tetrahedra by which a cell is judged: its centroid, or the mean of its face centroids if
/// `decomposed` is false or the cell is nearly flat or inverted. The centroid of such a cell may lie anywhere.
const Vec3& QualityEvaluator::middleOf(Index cell) const
{
  const auto isFlat = [&] { return cells[cell].volume < flatVolume * (sizes[cell] * sizes[cell] * sizes[cell]); };
  const bool trusted = targets_.decomposed && !isFlat();
  return trusted ? cells[cell].centroid : cells[cell].mean;
}

/// Returns six times the volumes of the tetrahedra from `middle` over the halves of a quadrilateral.
std::array<double, 4> QualityEvaluator::halfVolumes(Index face, const std::array<Vec3, 4>& half,
                                                    const Vec3& middle) const
{
  const auto points = region_.face(face);
  const Vec3 first = region_.points[points[0]] - middle;
  const Vec3 second = region_.points[points[1]] - middle;
  return {half[0].dot(first), half[1].dot(first), half[2].dot(second), half[3].dot(second)};
}

/// Returns the smallest relative volume of the tetrahedra of a cell over a face. OpenFOAM divides a face into triangles
/// around its centroid, so that a parallelepiped has 24 tetrahedra. If `decomposed` is false, a quadrilateral is
/// divided by the better one of its diagonals.
template <typename Shapes>
double QualityEvaluator::cornersOf(Index face, Index cell, const Vec3& middle, const Shapes& shapes, Index slot) const
{
  const std::size_t size = region_.face(face).size();
  const double scale = sign(cell, face) * cornerScales[cell];
  const Vec3 toFace = faces[face].centroid - middle;
  double least = std::numeric_limits<double>::infinity();
  if (size == 3)
  {
    return scale * 2.0 * faces[face].area.dot(toFace);
  }
  if (size > 4)
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      least = std::min(least, scale * fanTriangle(face, i).dot(toFace));
    }
    return 0.5 * static_cast<double>(size) * least;
  }
  if (targets_.decomposed)
  {
    for (const Vec3& part : shapes.fan(face, slot))
    {
      least = std::min(least, scale * part.dot(toFace));
    }
    return 2.0 * least;
  }
  const std::array<double, 4> part = halfVolumes(face, shapes.halves(face, slot), middle);
  return std::max(std::min(scale * part[0], scale * part[1]), std::min(scale * part[2], scale * part[3]));
}

/// Returns the smallest relative volume of the tetrahedra over the halves of a quadrilateral, by the better one of its
/// diagonals. OpenFOAM also divides a face into triangles around one of its corners, the same for the cells on both
/// sides.
template <typename Shapes> double QualityEvaluator::fansOf(Index face, const Shapes& shapes, Index slot) const
{
  std::array<double, 2> least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto& half = shapes.halves(face, slot);
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
    look(middleOf(across), -cornerScales[across]);
  }
  return std::max(least[0], least[1]);
}

template <typename Shapes, typename Sink>
void QualityEvaluator::judgeFace(Index face, const Shapes& shapes, Sink& score) const
{
  const FaceMeasure& f = faces[face];
  const CellMeasure& own = cells[region_.owner[face]];
  const Index across = region_.neighbor[face];
  const Index slot = shapes.slotOf(0);
  if (targets_.decomposed && region_.face(face).size() == 4)
  {
    score.add({Measure::fans, 0, noIndex, face, noIndex, slot}, fansOf(face, shapes, slot));
  }
  const Vec3 d = wayAcross(face);
  if (across != noIndex && !isAbove(f.normal.dot(d), targets_.faceCosine.target, d))
  {
    score.add({Measure::faceCosine, 0, noIndex, face}, orthogonalityOf(face), targets_.leastOfFaceCosine);
  }
  if (!isClearlyStraight(face, d))
  {
    score.add({Measure::skewness, 0, noIndex, face}, straightnessOf(face), targets_.leastOfSkewness);
  }
  if (across == noIndex)
  {
    judgeBoundary(face, shapes, slot, score);
  }
  else
  {
    judgeSizes(f, {Measure::weight, 0, noIndex, face}, own, cells[across], score);
  }
}

/// Returns the vector from the owner's centroid to that of the cell across, or along the normal to the plane of a
/// boundary face.
Vec3 QualityEvaluator::wayAcross(Index face) const
{
  const FaceMeasure& f = faces[face];
  const CellMeasure& own = cells[region_.owner[face]];
  const Index across = region_.neighbor[face];
  return across == noIndex ? Vec3(f.normal.dot(f.centroid - own.centroid) * f.normal)
                           : Vec3(cells[across].centroid - own.centroid);
}

double QualityEvaluator::orthogonalityOf(Index face) const
{
  const Vec3 d = wayAcross(face);
  return targets_.faceCosine.of(faces[face].normal.dot(d) / (d.norm() + rootVSmall));
}

double QualityEvaluator::straightnessOf(Index face) const
{
  const double skewness =
      faces[face].normal.isZero() ? wild : skewnessOf(face, wayAcross(face), targets_.skewness.target);
  return targets_.skewness.of(std::min(skewness, wild));
}

/// Judges the interpolation weight and the volume ratio. Most are far above their target and need no division.
template <typename Sink>
void QualityEvaluator::judgeSizes(const FaceMeasure& face, const Measure& of, const CellMeasure& own,
                                  const CellMeasure& other, Sink& score) const
{
  const double here = std::abs(face.normal.dot(face.centroid - own.centroid));
  const double there = std::abs(face.normal.dot(other.centroid - face.centroid));
  if (std::min(here, there) <= Score::farAbove * targets_.weight.target * (here + there + rootVSmall))
  {
    score.add(of, targets_.weight.of(weightOf(face, own, other)));
  }
  const double larger = std::max(std::abs(own.volume), std::abs(other.volume));
  if (std::min(own.volume, other.volume) <= Score::farAbove * targets_.volumeRatio.target * (larger + rootVSmall))
  {
    score.add({Measure::volumeRatio, 0, noIndex, of.face}, targets_.volumeRatio.of(volumeRatioOf(own, other)));
  }
}

template <typename Shapes, typename Sink>
void QualityEvaluator::judgeBoundary(Index face, const Shapes& shapes, Index slot, Sink& score) const
{
  const std::size_t size = region_.face(face).size();
  for (std::size_t i = 0; size > 3 && i < size; ++i)
  {
    const Measure of{Measure::boundaryShape, static_cast<std::uint8_t>(i), noIndex, face, noIndex, slot};
    score.add(of, boundaryShapeOf(face, i, shapes, slot));
  }
}

template <typename Shapes>
double QualityEvaluator::boundaryShapeOf(Index face, std::size_t part, const Shapes& shapes, Index slot) const
{
  const FaceMeasure& f = faces[face];
  const std::size_t size = region_.face(face).size();
  const double mean = f.length / static_cast<double>(size) + rootVSmall;
  const Vec3 triangle = size == 4 ? Vec3(shapes.fan(face, slot)[part]) : fanTriangle(face, part);
  return targets_.boundaryShape.of(0.5 * triangle.dot(f.normal) / mean);
}

/// True only if the skewness is below its target. Needs no roots and divisions, but does not find all such faces.
bool QualityEvaluator::isClearlyStraight(Index face, const Vec3& d) const
{
  const FaceMeasure& f = faces[face];
  const Vec3 toFace = f.centroid - cells[region_.owner[face]].centroid;
  const double along = f.normal.dot(d);
  const double square = along * along;
  const double length = d.squaredNorm();
  const double least = (region_.neighbor[face] != noIndex ? 0.2 : 0.4) * targets_.skewness.target;
  return Score::farAbove * (along * toFace - f.normal.dot(toFace) * d).squaredNorm() < least * least * length * square;
}

/// Returns the skewness as in Quality/Checks/Metrics.h; or an upper bound of it, if that is not above `good`.
double QualityEvaluator::skewnessOf(Index face, const Vec3& d, double good) const
{
  const FaceMeasure& f = faces[face];
  const bool internal = region_.neighbor[face] != noIndex;
  const Vec3 toFace = f.centroid - cells[region_.owner[face]].centroid;
  const double along = f.normal.dot(d);
  const bool hasArea = !f.normal.isZero();
  if (hasArea && std::abs(along) < rootVSmall)
  {
    return std::numeric_limits<double>::infinity();
  }
  const Vec3 offset = hasArea ? Vec3(toFace - (f.normal.dot(toFace) / along) * d) : toFace;
  const double distance = offset.norm();
  double extent = (internal ? 0.2 : 0.4) * d.norm() + rootVSmall;
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
