// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/CheckQuantities.h"

#include "Quality/Faces/InOrder.h"
#include "Support/Angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// OpenFOAM's SMALL and GREAT.
constexpr double small = 1e-15;
constexpr double great = 1e15;
constexpr double minTetQuality = small * small;
constexpr double leastConcaveDegrees = 10.0;
constexpr std::size_t grain = 4096;

constexpr std::array<CheckQuantityInfo, checkQuantityCount> infos{{
    {CheckQuantity::Openness, "Openness", false, true, false},
    {CheckQuantity::AreaAspectRatio, "AreaAspectRatio", false, true, false},
    {CheckQuantity::Determinant, "Determinant", false, false, false},
    {CheckQuantity::Concavity, "Concavity", false, true, false},
    {CheckQuantity::FaceWeight, "FaceWeight", true, false, true},
    {CheckQuantity::VolumeRatio, "VolumeRatio", true, false, true},
    {CheckQuantity::FaceFlatness, "FaceFlatness", true, false, false},
    {CheckQuantity::FaceConcaveAngle, "FaceConcaveAngle", true, true, false},
    {CheckQuantity::TetQuality, "TetQuality", true, false, false},
    {CheckQuantity::EdgeLength, "EdgeLength", true, false, false},
}};

/// Calls use(from, to) for the edges of a face, one after the other.
template <typename F> void forEdges(const MeasuredMesh& m, std::size_t f, F&& use)
{
  const auto face = m.mesh.face(f);
  for (std::size_t i = 0; i < face.size(); ++i)
  {
    use(m.mesh.points[face[i]], m.mesh.points[face[i + 1 < face.size() ? i + 1 : 0]]);
  }
}

/// Sums over the faces of a cell: of outward A, and of the magnitudes of its components.
struct AreaSums
{
  Vec3 vectors = Vec3::Zero();
  Vec3 sizes = Vec3::Zero();
};

AreaSums sumAreas(const MeasuredMesh& m, std::size_t cell)
{
  AreaSums sums;
  for (const Index f : m.cellFaces.of(cell))
  {
    const Vec3& area = m.geometry.faceAreas[f];
    sums.vectors += m.mesh.owner[f] == cell ? area : Vec3(-area);
    sums.sizes += area.cwiseAbs();
  }
  return sums;
}

double openness(const MeasuredMesh& m, std::size_t cell)
{
  const AreaSums sums = sumAreas(m, cell);
  double worst = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    worst = std::max(worst, std::abs(sums.vectors[axis]) / (sums.sizes[axis] + rootVSmall));
  }
  return worst;
}

double areaAspectRatio(const MeasuredMesh& m, std::size_t cell)
{
  const Vec3 sizes = sumAreas(m, cell).sizes;
  const double ofAxes = sizes.maxCoeff() / (sizes.minCoeff() + rootVSmall);
  const double volume = std::max(rootVSmall, m.geometry.cellVolumes[cell]);
  const double sum = sizes[0] + sizes[1] + sizes[2];
  return std::max(ofAxes, 1.0 / 6.0 * sum / std::pow(volume, 2.0 / 3.0));
}

double determinant(const MeasuredMesh& m, std::size_t cell)
{
  const std::size_t internalFaces = m.mesh.internalFaceCount();
  double mean = 0.0;
  int count = 0;
  for (const Index f : m.cellFaces.of(cell))
  {
    if (f < internalFaces)
    {
      mean += lengthInOrder(m.geometry.faceAreas[f]);
      ++count;
    }
  }
  if (count == 0 || mean < rootVSmall)
  {
    return 0.0;
  }
  mean /= count;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Index f : m.cellFaces.of(cell))
  {
    if (f < internalFaces)
    {
      const Vec3 a = m.geometry.faceAreas[f] / mean;
      xx += a[0] * a[0];
      xy += a[0] * a[1];
      xz += a[0] * a[2];
      yy += a[1] * a[1];
      yz += a[1] * a[2];
      zz += a[2] * a[2];
    }
  }
  const double det = xx * yy * zz + xy * yz * xz + xz * xy * yz - xx * yz * yz - xy * xy * zz - xz * yy * xz;
  return std::abs(det) / 8.0;
}

double concavity(const MeasuredMesh& m, std::size_t cell)
{
  const auto faces = m.cellFaces.of(cell);
  double worst = -1.0;
  for (const Index f : faces)
  {
    Vec3 normal = m.geometry.faceAreas[f];
    normal /= std::max(lengthInOrder(normal), vSmall);
    if (m.mesh.owner[f] != cell)
    {
      normal *= -1.0;
    }
    for (const Index other : faces)
    {
      if (other != f)
      {
        Vec3 way = m.geometry.faceCentroids[other] - m.geometry.faceCentroids[f];
        way /= std::max(lengthInOrder(way), vSmall);
        worst = std::max(worst, dotInOrder(way, normal));
      }
    }
  }
  return worst;
}

double weight(const MeasuredMesh& m, std::size_t f)
{
  if (f >= m.mesh.internalFaceCount())
  {
    return 1.0;
  }
  const Vec3& area = m.geometry.faceAreas[f];
  const Vec3& center = m.geometry.faceCentroids[f];
  const double own = std::abs(dotInOrder(area, center - m.geometry.cellCentroids[m.mesh.owner[f]]));
  const double next = std::abs(dotInOrder(area, m.geometry.cellCentroids[m.mesh.neighbor[f]] - center));
  return std::min(next, own) / (next + own + vSmall);
}

double volumeRatio(const MeasuredMesh& m, std::size_t f)
{
  if (f >= m.mesh.internalFaceCount())
  {
    return 1.0;
  }
  const double own = m.geometry.cellVolumes[m.mesh.owner[f]];
  const double next = m.geometry.cellVolumes[m.mesh.neighbor[f]];
  return std::min(own, next) / (std::max(own, next) + vSmall);
}

double flatness(const MeasuredMesh& m, std::size_t f)
{
  const double area = lengthInOrder(m.geometry.faceAreas[f]);
  if (m.mesh.face(f).size() == 3 || area <= rootVSmall)
  {
    return 1.0;
  }
  const Vec3& center = m.geometry.faceCentroids[f];
  double sum = 0.0;
  forEdges(m, f,
           [&](const Vec3& here, const Vec3& next) { sum += lengthInOrder(0.5 * (next - here).cross(center - here)); });
  return area / (sum + rootVSmall);
}

double concaveAngle(const MeasuredMesh& m, std::size_t f)
{
  const double leastSine = std::sin(radians(leastConcaveDegrees));
  const auto face = m.mesh.face(f);
  const Vec3 normal = m.geometry.faceAreas[f] / (lengthInOrder(m.geometry.faceAreas[f]) + rootVSmall);
  const auto unitEdge = [](const Vec3& from, const Vec3& to, double& length) {
    const Vec3 edge = to - from;
    length = lengthInOrder(edge);
    return Vec3(edge / (length + rootVSmall));
  };
  double previousLength = 0.0;
  Vec3 previous = unitEdge(m.mesh.points[face.back()], m.mesh.points[face.front()], previousLength);
  double worst = 0.0;
  forEdges(m, f, [&](const Vec3& from, const Vec3& to) {
    double length = 0.0;
    const Vec3 edge = unitEdge(from, to, length);
    if (previousLength > small && length > small)
    {
      const Vec3 turn = previous.cross(edge);
      const double sine = lengthInOrder(turn);
      if (sine >= leastSine && dotInOrder(turn / sine, normal) < small)
      {
        worst = std::max(worst, sine);
      }
    }
    previous = edge;
    previousLength = length;
  });
  return std::asin(std::min(1.0, worst)) / radians(1.0);
}

/// Returns the signed volume over that of the regular tetrahedron of the same circumradius.
double tetQuality(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s)
{
  const Vec3 a = q - p;
  const Vec3 b = r - p;
  const Vec3 c = s - p;
  const double lambda = dotInOrder(c, c) - dotInOrder(a, c);
  const double mu = dotInOrder(b, b) - dotInOrder(a, b);
  const Vec3 ba = b.cross(a);
  const Vec3 ca = c.cross(a);
  const double denominator = dotInOrder(c, ba);
  const double radius =
      std::abs(denominator) < rootVSmall ? great : lengthInOrder(0.5 * (a + (lambda * ba - mu * ca) / denominator));
  const double volume = (1.0 / 6.0) * dotInOrder(a.cross(b), c);
  const double bounded = std::min(radius, great);
  return volume / (8.0 / (9.0 * std::sqrt(3.0)) * (bounded * bounded * bounded) + rootVSmall);
}

/// Returns the least quality of the tetrahedra of `apex` and the triangles that fan out from corner `base` of a face.
double fanQuality(const MeasuredMesh& m, std::span<const Index> face, std::size_t base, const Vec3& apex, bool isOwner)
{
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
  {
    const Vec3& a = m.mesh.points[face[(base + i) % face.size()]];
    const Vec3& b = m.mesh.points[face[(base + i + 1) % face.size()]];
    const Vec3& corner = m.mesh.points[face[base]];
    worst = std::min(worst, isOwner ? tetQuality(apex, corner, a, b) : tetQuality(apex, corner, b, a));
  }
  return worst;
}

double faceTetQuality(const MeasuredMesh& m, std::size_t f)
{
  const auto face = m.mesh.face(f);
  const bool internal = f < m.mesh.internalFaceCount();
  const Vec3& own = m.geometry.cellCentroids[m.mesh.owner[f]];
  const Vec3& next = internal ? m.geometry.cellCentroids[m.mesh.neighbor[f]] : own;
  const Vec3& center = m.geometry.faceCentroids[f];
  double worst = std::numeric_limits<double>::infinity();
  forEdges(m, f, [&](const Vec3& a, const Vec3& b) {
    worst = std::min(worst, -tetQuality(a, b, center, own));
    if (internal)
    {
      worst = std::min(worst, tetQuality(a, b, center, next));
    }
  });
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t base = 0; base < face.size() && best <= minTetQuality; ++base)
  {
    double quality = fanQuality(m, face, base, own, true);
    if (internal && quality > minTetQuality)
    {
      quality = std::min(quality, fanQuality(m, face, base, next, false));
    }
    best = std::max(best, quality);
  }
  return best > minTetQuality ? worst : std::min(worst, best);
}

double edgeLength(const MeasuredMesh& m, std::size_t f)
{
  double least = std::numeric_limits<double>::infinity();
  forEdges(m, f, [&](const Vec3& here, const Vec3& next) {
    const Vec3 edge = here - next;
    least = std::min(least, dotInOrder(edge, edge));
  });
  return std::sqrt(least);
}

/// Descriptions, in the order of the quantities.
constexpr std::array<double (*)(const MeasuredMesh&, std::size_t), checkQuantityCount> valuesOf{
    openness,    areaAspectRatio, determinant,  concavity,      weight,
    volumeRatio, flatness,        concaveAngle, faceTetQuality, edgeLength};

} // namespace

const std::array<CheckQuantityInfo, checkQuantityCount>& checkQuantities() { return infos; }

const CheckQuantityInfo& describe(CheckQuantity quantity) { return infos[static_cast<std::size_t>(quantity)]; }

std::vector<double> measure(const MeasuredMesh& mesh, CheckQuantity quantity, const RunContext& context)
{
  std::vector<double> values(describe(quantity).ofFaces ? mesh.mesh.faceCount() : mesh.mesh.cellCount);
  const auto valueOf = valuesOf[static_cast<std::size_t>(quantity)];
  context.executor.forEach(values.size(), grain, [&](std::size_t i) { values[i] = valueOf(mesh, i); });
  return values;
}

std::vector<double> worstOverFaces(const MeasuredMesh& mesh, const std::vector<double>& values, bool greaterIsWorse,
                                   const RunContext& context)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> worst(mesh.mesh.cellCount, greaterIsWorse ? -infinity : infinity);
  context.executor.forEach(worst.size(), grain, [&](std::size_t c) {
    for (const Index f : mesh.cellFaces.of(c))
    {
      worst[c] = greaterIsWorse ? std::max(worst[c], values[f]) : std::min(worst[c], values[f]);
    }
  });
  return worst;
}

double pyramidVolume(const MeasuredMesh& mesh, std::size_t f, Index cell)
{
  const auto face = mesh.mesh.face(f);
  const auto point = [&](std::size_t i) -> const Vec3& { return mesh.mesh.points[face[i % face.size()]]; };
  Vec3 center = mesh.geometry.faceCentroids[f];
  if (face.size() > 3)
  {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      mean += point(i);
    }
    mean /= static_cast<double>(face.size());
    double areas = 0.0;
    Vec3 moments = Vec3::Zero();
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const double area = lengthInOrder((point(i) - mean).cross(point(i + 1) - mean));
      areas += area;
      moments += area * (point(i) + point(i + 1) + mean);
    }
    center = areas > vSmall ? Vec3(moments / (3.0 * areas)) : mean;
  }
  const double volume =
      (1.0 / 3.0) * dotInOrder(mesh.geometry.faceAreas[f], mesh.geometry.cellCentroids[cell] - center);
  return mesh.mesh.owner[f] == cell ? -volume : volume;
}

} // namespace atria
