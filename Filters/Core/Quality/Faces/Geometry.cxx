// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/Geometry.h"

#include "Support/Chains.h"
#include "Support/Pieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace atria {

namespace {

/// Below this a sum is taken for zero, as OpenFOAM does (its ROOTVSMALL).
constexpr double tinyArea = 1e-150;
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
  const bool flat = magnitudeSum < tinyArea;
  return {flat ? Vec3(Vec3::Zero()) : Vec3(0.5 * areaSum), flat ? mean : Vec3((1.0 / 3.0) * momentSum / magnitudeSum)};
}

namespace {

/// Those a cell owns are found side by side, as faces are sorted by owner; those it is the neighbor of are linked.
class CellFaceFinder
{
public:
  CellFaceFinder(const FaceMesh& source, const Executor& executor)
      : mesh(source), fromNeighbors(source.cellCount, executor), next(source.internalFaceCount())
  {
    executor.forEach(next.size(), grain,
                     [&](std::size_t f) { fromNeighbors.add(mesh.neighbor[f], static_cast<Index>(f), next[f]); });
  }

  /// Calls use(cell, faces) for cells in a row, faces as CellFaces has them.
  template <typename F> void forCells(std::size_t begin, std::size_t end, F&& use) const
  {
    std::size_t inside = firstOwned(0, next.size(), begin);
    std::size_t outside = firstOwned(next.size(), mesh.faceCount(), begin);
    std::vector<Index> faces;
    for (std::size_t cell = begin; cell < end; ++cell)
    {
      faces.clear();
      for (; inside < next.size() && mesh.owner[inside] == cell; ++inside)
      {
        faces.push_back(static_cast<Index>(inside));
      }
      for (; outside < mesh.faceCount() && mesh.owner[outside] == cell; ++outside)
      {
        faces.push_back(static_cast<Index>(outside));
      }
      const auto owned = static_cast<std::ptrdiff_t>(faces.size());
      for (Index f = fromNeighbors.first(cell); f != noIndex; f = next[f])
      {
        faces.push_back(f);
      }
      std::sort(faces.begin() + owned, faces.end());
      use(cell, std::span<const Index>(faces));
    }
  }

private:
  /// Of the faces from one to before another, the first of a cell or a later one.
  std::size_t firstOwned(std::size_t from, std::size_t to, std::size_t cell) const
  {
    const Index* const owners = mesh.owner.data();
    return static_cast<std::size_t>(std::lower_bound(owners + from, owners + to, cell) - owners);
  }

  const FaceMesh& mesh;
  Chains fromNeighbors;
  Buffer<Index> next;
};

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
  const CellFaceFinder finder(mesh, executor);
  const Pieces pieces(mesh.cellCount);
  std::vector<Index> starts(pieces.count);
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    finder.forCells(pieces.begin(piece), pieces.end(piece), [&](std::size_t, std::span<const Index> faces) {
      starts[piece] += static_cast<Index>(faces.size());
    });
  });
  CellFaces out;
  out.faces.resize(scan(starts));
  out.offsets.resize(mesh.cellCount + 1);
  executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    Index at = starts[piece];
    finder.forCells(pieces.begin(piece), pieces.end(piece), [&](std::size_t cell, std::span<const Index> faces) {
      std::copy(faces.begin(), faces.end(), out.faces.begin() + at);
      at += static_cast<Index>(faces.size());
      out.offsets[cell + 1] = at;
    });
  });
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
  context.executor.forRanges(mesh.faceCount(), grain, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    for (std::size_t f = begin; f < end; ++f)
    {
      const PolygonMeasure face = measurePolygon(mesh.points, mesh.face(f));
      out.faceAreas[f] = face.area;
      out.faceCentroids[f] = face.centroid;
    }
  });
  context.progress.report(0.5, "Measuring cells");
  context.executor.forRanges(mesh.cellCount, grain, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    for (std::size_t c = begin; c < end; ++c)
    {
      measureCell(mesh, cellFaces.of(c), c, out);
    }
  });
  return out;
}

MeasuredMesh measureMesh(const FaceMesh& mesh, const RunContext& context)
{
  MeasuredMesh out{mesh, makeCellFaces(mesh, context.executor), {}};
  out.geometry = computeGeometry(mesh, out.cellFaces, context);
  return out;
}

} // namespace atria
