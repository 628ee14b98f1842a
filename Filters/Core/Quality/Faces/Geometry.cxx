// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/Geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

} // namespace

PolygonMeasure measurePolygon(std::span<const Vec3> points, std::span<const Index> face)
{
  const std::size_t size = face.size();
  const auto point = [&](std::size_t i) -> const Vec3& { return points[face[i]]; };
  if (size == 3)
  {
    return {0.5 * (point(1) - point(0)).cross(point(2) - point(0)), (1.0 / 3.0) * (point(0) + point(1) + point(2))};
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < size; ++i)
  {
    mean += point(i);
  }
  mean /= static_cast<double>(size);
  Vec3 areaSum = Vec3::Zero();
  Vec3 momentSum = Vec3::Zero();
  double magnitudeSum = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Vec3& here = point(i);
    const Vec3& next = point(i + 1 < size ? i + 1 : 0);
    const Vec3 area = (next - here).cross(mean - here);
    const double magnitude = lengthInOrder(area);
    areaSum += area;
    magnitudeSum += magnitude;
    momentSum += magnitude * (here + next + mean);
  }
  const bool flat = magnitudeSum < rootVSmall;
  return {flat ? Vec3(Vec3::Zero()) : Vec3(0.5 * areaSum), flat ? mean : Vec3((1.0 / 3.0) * momentSum / magnitudeSum)};
}

namespace {

void measureCell(const FaceMesh& mesh, std::span<const Index> faces, std::size_t cell, MeshGeometry& out)
{
  const CellMeasureInOrder measure = measureCellInOrder(faces.size(), [&](std::size_t i) {
    const Vec3& area = out.faceAreas[faces[i]];
    return PolygonMeasure{mesh.owner[faces[i]] == cell ? area : Vec3(-area), out.faceCentroids[faces[i]]};
  });
  out.cellCentroids[cell] = measure.centroid;
  out.cellVolumes[cell] = measure.volume;
}

} // namespace

CellFaces makeCellFaces(const FaceMesh& mesh, const Executor& executor)
{
  // Faces that a cell is the neighbor of get numbers after all others for sorting.
  const auto faceCount = static_cast<Index>(mesh.faceCount());
  CellFaces out = fillInOrder(mesh.cellCount, executor, [&](auto&& use) {
    executor.forEach(faceCount, grain, [&](std::size_t f) { use(mesh.owner[f], static_cast<Index>(f)); });
    executor.forEach(mesh.internalFaceCount(), grain,
                     [&](std::size_t f) { use(mesh.neighbor[f], faceCount + static_cast<Index>(f)); });
  });
  executor.forEach(out.entries.size(), grain,
                   [&](std::size_t i) { out.entries[i] -= out.entries[i] < faceCount ? 0U : faceCount; });
  return out;
}

MeshGeometry computeGeometry(const FaceMesh& mesh, const CellFaces& cellFaces, const RunContext& context)
{
  MeshGeometry out;
  out.faceAreas.resize(mesh.faceCount());
  out.faceCentroids.resize(mesh.faceCount());
  out.cellCentroids.resize(mesh.cellCount);
  out.cellVolumes.resize(mesh.cellCount);
  context.progress.report(0.0, "Measuring faces");
  context.executor.forEach(mesh.faceCount(), grain, [&](std::size_t f) {
    const PolygonMeasure face = measurePolygon(mesh.points, mesh.face(f));
    out.faceAreas[f] = face.area;
    out.faceCentroids[f] = face.centroid;
  });
  context.progress.report(0.5, "Measuring cells");
  context.executor.forEach(mesh.cellCount, grain, [&](std::size_t c) { measureCell(mesh, cellFaces.of(c), c, out); });
  return out;
}

MeasuredMesh measureMesh(const FaceMesh& mesh, const RunContext& context)
{
  MeasuredMesh out{mesh, makeCellFaces(mesh, context.executor), {}};
  out.geometry = computeGeometry(mesh, out.cellFaces, context);
  return out;
}

} // namespace atria
