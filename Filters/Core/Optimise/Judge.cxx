// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/Judge.h"

#include "Quality/CellShapes.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

constexpr std::size_t grain = 1024;
constexpr double tiny = 1e-150;
/// Over the cube of the mean edge.
constexpr double flatVolume = 0.004;
/// Of what is flat but for rounding.
constexpr double flatSine = 1e-7;
/// Skewness is not more than this, so that one wild face does not drown the others.
constexpr double wild = 8.0;

/// Whether a component along a unit vector is above this share of the vector's length: most measures are far above
/// their target, and this spares the root.
bool isAbove(double along, double share, const Vec3& vector)
{
  return along > 0.0 && along * along >= share * share * vector.squaredNorm();
}

/// Twice the area vector.
Vec3 triangle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

} // namespace

Judge::Judge(Region& region, const QualityTargets& targets, const RunContext& context)
    : region_(region), targets_(targets), faces(region.faceCount()), fans(region.facePoints.size()),
      halves(region.facePoints.size()), cells(region.cellCount()), sizes(region.judgedCount()),
      cornerScales(sizes.size()), flatVolumes(sizes.size()), cellScores(sizes.size()), faceScores(faces.size())
{
  context.executor.forEach(faces.size(), grain, [&](std::size_t f) { measure(static_cast<Index>(f)); });
  context.executor.forEach(sizes.size(), grain, [&](std::size_t c) {
    measureOne(static_cast<Index>(c));
    double length = 0.0;
    double count = 0.0;
    for (const Index f : region_.facesOf(c))
    {
      const auto points = region_.face(f);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        length += (region_.points[points[i]] - region_.points[points[(i + 1) % points.size()]]).norm();
        count += 1.0;
      }
    }
    sizes[c] = length / std::max(count, 1.0);
    const double cube = sizes[c] * sizes[c] * sizes[c];
    cornerScales[c] = 2.0 / (cube + tiny) / targets_.cornerVolume.target;
    flatVolumes[c] = flatVolume * cube;
  });
  for (std::size_t g = 0; g < region.ghostVolumes.size(); ++g)
  {
    cells[sizes.size() + g] = {region.ghostCentroids[g], region.ghostVolumes[g], region.ghostCentroids[g]};
  }
  context.executor.forEach(cellScores.size(), grain,
                           [&](std::size_t c) { judgeCell(static_cast<Index>(c), cellScores[c]); });
  context.executor.forEach(faceScores.size(), grain,
                           [&](std::size_t f) { judgeFace(static_cast<Index>(f), faceScores[f]); });
}

void Judge::measure(Index face)
{
  const auto points = region_.face(face);
  const std::size_t size = points.size();
  const auto at = [&](std::size_t i) -> const Vec3& { return region_.points[points[i]]; };
  faces[face] = measureFace(size, at);
  Vec3* fan = fans.data() + region_.faceOffsets[face];
  for (std::size_t i = 0; i < size; ++i)
  {
    fan[i] = triangle(faces[face].centroid, at(i), at(i + 1 < size ? i + 1 : 0));
  }
  if (size == 4)
  {
    Vec3* half = halves.data() + region_.faceOffsets[face];
    half[0] = triangle(at(0), at(1), at(2));
    half[1] = triangle(at(0), at(2), at(3));
    half[2] = triangle(at(1), at(2), at(3));
    half[3] = triangle(at(1), at(3), at(0));
  }
}

void Judge::measureOne(Index cell)
{
  cells[cell] = measureCell([&](auto&& visit) {
    for (const Index f : region_.facesOf(cell))
    {
      visit(faces[f].centroid, sign(cell, f) * faces[f].area);
    }
  });
}

void Judge::enter(std::size_t movable, Star& star) const
{
  star.point = region_.movable[movable];
  const auto members = region_.membersOf(movable);
  star.points.assign(members.begin(), members.end());
  const auto about = region_.cellsAbout(movable);
  star.cells.assign(about.begin(), about.end());
  star.faces.clear();
  star.moving.clear();
  star.size = 0.0;
  for (const Index cell : about)
  {
    const auto own = region_.facesOf(cell);
    star.faces.insert(star.faces.end(), own.begin(), own.end());
    star.size += sizes[cell] / static_cast<double>(about.size());
  }
  std::sort(star.faces.begin(), star.faces.end());
  star.faces.erase(std::unique(star.faces.begin(), star.faces.end()), star.faces.end());
  for (const Index face : star.faces)
  {
    if (std::ranges::find_first_of(region_.face(face), star.points) != region_.face(face).end())
    {
      star.moving.push_back(face);
    }
  }
}

void Judge::move(const Star& star, const Vec3& p)
{
  for (const Index point : star.points)
  {
    region_.points[point] = p;
  }
  for (const Index face : star.moving)
  {
    measure(face);
  }
  for (const Index cell : star.cells)
  {
    measureOne(cell);
  }
}

bool Judge::isGood(std::size_t movable) const
{
  return std::ranges::all_of(region_.cellsAbout(movable), [&](Index cell) {
    return cellScores[cell].penalty == 0.0 &&
           std::ranges::all_of(region_.facesOf(cell), [&](Index f) { return faceScores[f].penalty == 0.0; });
  });
}

Score Judge::look(Star& star, double enough) const
{
  star.scores.assign(star.cells.size() + star.faces.size(), {});
  Score sum;
  auto next = star.scores.begin();
  for (std::size_t i = 0; i < star.cells.size() && sum.penalty <= enough; ++i, ++next)
  {
    judgeCell(star.cells[i], *next);
    sum.add(*next);
  }
  for (std::size_t i = 0; i < star.faces.size() && sum.penalty <= enough; ++i, ++next)
  {
    judgeFace(star.faces[i], *next);
    sum.add(*next);
  }
  return sum;
}

void Judge::accept(const Star& star)
{
  auto next = star.scores.begin();
  for (const Index cell : star.cells)
  {
    cellScores[cell] = *next++;
  }
  for (const Index face : star.faces)
  {
    faceScores[face] = *next++;
  }
}

Score Judge::scoreOf(const Star& star) const
{
  Score sum;
  for (const Index cell : star.cells)
  {
    sum.add(cellScores[cell]);
  }
  for (const Index face : star.faces)
  {
    sum.add(faceScores[face]);
  }
  return sum;
}

void Judge::residualsOf(const Star& star, Residuals& out) const
{
  out.values.clear();
  for (const Index cell : star.cells)
  {
    if (cellScores[cell].penalty > 0.0)
    {
      judgeCell(cell, out);
    }
  }
  for (const Index face : star.faces)
  {
    if (faceScores[face].penalty > 0.0)
    {
      judgeFace(face, out);
    }
  }
}

template <typename Sink> void Judge::judgeCell(Index cell, Sink& score) const
{
  const auto own = region_.facesOf(cell);
  const CellMeasure& measure = cells[cell];
  for (const Index f : own)
  {
    const double side = sign(cell, f);
    const Vec3 normal = side * faces[f].normal;
    const Vec3 toFace = faces[f].centroid - measure.centroid;
    if (!isAbove(normal.dot(toFace), targets_.pyramidCosine.target, toFace))
    {
      score.add(targets_.pyramidCosine.of(normal.dot(toFace) / (toFace.norm() + tiny)));
    }
    else
    {
      score.addGood();
    }
    scoreCorners(f, cell, score);
    for (const Index g : targets_.convex ? own : std::span<const Index>())
    {
      if (f == g)
      {
        continue;
      }
      const Vec3 between = faces[g].centroid - faces[f].centroid;
      const double inside = -normal.dot(between);
      // Two faces on the boundary may lie in one plane.
      const bool mayBeFlat = region_.neighbour[f] == noIndex && region_.neighbour[g] == noIndex;
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
  if (targets_.decomposed)
  {
    score.add(targets_.determinantRoot.of(std::sqrt(std::sqrt(determinantOf(cell)))), targets_.leastOfDeterminant);
  }
  if (targets_.scaledJacobian > 0.0)
  {
    // All that are below the target: the least alone has a kink where another one takes over.
    const JacobianTerms terms = jacobiansOf(cell);
    for (std::size_t i = 0; i < terms.count; ++i)
    {
      score.add(terms.values[i] / targets_.scaledJacobian, targets_.leastOfJacobian);
    }
  }
}

double Judge::determinantOf(Index cell) const
{
  std::array<double, 6> sum{};
  double mean = 0.0;
  int count = 0;
  for (const Index f : region_.facesOf(cell))
  {
    if (region_.neighbour[f] != noIndex)
    {
      const Vec3& a = faces[f].area;
      sum[0] += a[0] * a[0];
      sum[1] += a[1] * a[1];
      sum[2] += a[2] * a[2];
      sum[3] += a[1] * a[2];
      sum[4] += a[0] * a[2];
      sum[5] += a[0] * a[1];
      mean += faces[f].length;
      ++count;
    }
  }
  if (mean <= tiny)
  {
    return 0.0;
  }
  mean /= count;
  const double square = mean * mean;
  const auto& [xx, yy, zz, yz, xz, xy] = sum;
  const double determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  return std::abs(determinant) / (8.0 * square * square * square);
}

/// The centroid of a cell that is nearly flat or inside out may lie anywhere.
const Vec3& Judge::middleOf(Index cell) const
{
  const bool trusted = cell >= sizes.size() || (targets_.decomposed && cells[cell].volume >= flatVolumes[cell]);
  return trusted ? cells[cell].centroid : cells[cell].mean;
}

/// Six times the volumes over the halves of a quadrilateral.
std::array<double, 4> Judge::halfVolumes(Index face, const Vec3& middle) const
{
  const auto points = region_.face(face);
  const Vec3* half = halves.data() + region_.faceOffsets[face];
  const Vec3 first = region_.points[points[0]] - middle;
  const Vec3 second = region_.points[points[1]] - middle;
  return {half[0].dot(first), half[1].dot(first), half[2].dot(second), half[3].dot(second)};
}

/// OpenFOAM takes a face apart into triangles about its centroid. In the tetrahedra of these, a parallelepiped has 24.
template <typename Sink> void Judge::scoreCorners(Index face, Index cell, Sink& score) const
{
  const std::size_t size = region_.face(face).size();
  const Vec3& middle = middleOf(cell);
  const double scale = sign(cell, face) * cornerScales[cell];
  const Vec3 toFace = faces[face].centroid - middle;
  if (size == 3)
  {
    score.add(scale * 2.0 * faces[face].area.dot(toFace));
  }
  else if (targets_.decomposed || size > 4)
  {
    const Vec3* fan = fans.data() + region_.faceOffsets[face];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size; ++i)
    {
      least = std::min(least, scale * fan[i].dot(toFace));
    }
    score.add(0.5 * static_cast<double>(size) * least);
  }
  else
  {
    const std::array<double, 4> part = halfVolumes(face, middle);
    score.add(std::max(std::min(scale * part[0], scale * part[1]), std::min(scale * part[2], scale * part[3])));
  }
}

/// OpenFOAM also takes a face apart into triangles about one of its corners, the same for the cells on both sides. In
/// a quadrilateral there are two ways.
template <typename Sink> void Judge::scoreFans(Index face, Sink& score) const
{
  if (region_.face(face).size() != 4 || !targets_.decomposed)
  {
    return;
  }
  std::array<double, 2> least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto look = [&](const Vec3& middle, double scale) {
    const std::array<double, 4> part = halfVolumes(face, middle);
    for (std::size_t fan = 0; fan < 2; ++fan)
    {
      least[fan] = std::min({least[fan], scale * part[2 * fan], scale * part[2 * fan + 1]});
    }
  };
  const Index own = region_.owner[face];
  const Index across = region_.neighbour[face];
  look(middleOf(own), cornerScales[own]);
  if (across != noIndex)
  {
    look(middleOf(across), -cornerScales[across < sizes.size() ? across : own]);
  }
  score.add(std::max(least[0], least[1]));
}

template <typename Sink> void Judge::judgeFace(Index face, Sink& score) const
{
  const FaceMeasure& f = faces[face];
  const CellMeasure& own = cells[region_.owner[face]];
  const Index across = region_.neighbour[face];
  scoreFans(face, score);
  if (across == noIndex)
  {
    const double height = f.normal.dot(f.centroid - own.centroid);
    scoreSkewness(face, height * f.normal, score);
    scoreBoundary(face, score);
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
  score.add(targets_.weight.of(weightOf(f, own, other)));
  score.add(targets_.volumeRatio.of(volumeRatioOf(own, other)));
}

template <typename Sink> void Judge::scoreBoundary(Index face, Sink& score) const
{
  const auto points = region_.face(face);
  const FaceMeasure& f = faces[face];
  const double mean = f.length / static_cast<double>(points.size()) + tiny;
  for (std::size_t i = 0; i < points.size() && points.size() > 3; ++i)
  {
    score.add(targets_.boundaryShape.of(0.5 * fans[region_.faceOffsets[face] + i].dot(f.normal) / mean));
  }
}

template <typename Sink> void Judge::scoreSkewness(Index face, const Vec3& d, Sink& score) const
{
  const double skewness = faces[face].normal.isZero() ? wild : skewnessOf(face, d, targets_.skewness.target);
  score.add(targets_.skewness.of(std::min(skewness, wild)));
}

/// As in Quality/Metrics.h; what is below `good` is not computed to the end.
double Judge::skewnessOf(Index face, const Vec3& d, double good) const
{
  const FaceMeasure& f = faces[face];
  const bool internal = region_.neighbour[face] != noIndex;
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

JacobianTerms Judge::jacobiansOf(Index cell) const
{
  const NativeCell& native = region_.natives[cell];
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < shapeOf(native.type).corners; ++i)
  {
    corners[i] = region_.points[native.corners[i]];
  }
  return jacobianTerms(native.type, corners);
}

} // namespace atria
