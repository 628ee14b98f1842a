// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/NativeCells.h"

#include "Quality/Faces/CellShapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace atria {

namespace {

double volumeOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex)
{
  return (b - a).cross(c - a).dot(apex - a) / 6.0;
}

/// True if the fan from a corner covers the polygon without folding over.
bool fanFits(std::span<const Vec3> points, std::span<const Index> face, std::size_t from, const Vec3& normal)
{
  const Vec3& center = points[face[from]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
  {
    const Vec3& a = points[face[(from + i) % face.size()]];
    const Vec3& b = points[face[(from + i + 1) % face.size()]];
    if (!((a - center).cross(b - center).dot(normal) > 0.0))
    {
      return false;
    }
  }
  return true;
}

/// Cuts polyhedra one by one.
class PolyhedronCutter
{
public:
  PolyhedronCutter(const FaceMesh& faceMesh, const CellFaces& facesOfCells, NativeCells& result)
      : mesh(faceMesh), cellFaces(facesOfCells), out(result)
  {
  }

  void cut(std::size_t cell)
  {
    collectBases(cell);
    const Vec3 centroid = centroidOf(cell);
    const Vec3 apex = placeThatSeesAll(centroid).value_or(centroid);
    const auto id = static_cast<Index>(mesh.points.size() + out.apices.size());
    out.apices.push_back(apex);
    out.invertedCells += invertedPartsAt(apex);
    ++out.dividedPolyhedra;
    for (const std::vector<Index>& base : bases)
    {
      out.types.push_back(base.size() == 3 ? tetrahedronCell : pyramidCell);
      out.corners.insert(out.corners.end(), base.begin(), base.end());
      out.corners.push_back(id);
      out.offsets.push_back(out.corners.size());
    }
  }

private:
  /// Collects the triangles and quadrilaterals of a cell's faces, with normals into the cell.
  void collectBases(std::size_t cell)
  {
    bases.clear();
    for (const Index f : cellFaces.of(cell))
    {
      divideFace(mesh.points, mesh.face(f), [&](std::span<const Index> part) {
        bases.emplace_back(part.begin(), part.end());
        if (mesh.owner[f] == cell)
        {
          std::ranges::reverse(bases.back());
        }
      });
    }
  }

  Vec3 centroidOf(std::size_t cell) const
  {
    const auto faces = cellFaces.of(cell);
    return measureCellInOrder(faces.size(),
                              [&](std::size_t i) {
                                PolygonMeasure face = measurePolygon(mesh.points, mesh.face(faces[i]));
                                if (mesh.owner[faces[i]] != cell)
                                {
                                  face.area = -face.area;
                                }
                                return face;
                              })
        .centroid;
  }

  /// Returns a position that sees all bases. Starts at `place` and moves away from the plane that it is deepest behind,
  /// by less at each step. If such a position exists, it is reached in twenty steps three times in four, in a hundred
  /// nearly always.
  std::optional<Vec3> placeThatSeesAll(Vec3 place) const
  {
    constexpr int mostSteps = 100;
    constexpr double firstStep = 0.3; // as a share of the cell's radius
    constexpr double decrease = 0.7;  // power of the step number: steps shrink to nothing, but can reach any position
    if (invertedPartsAt(place) == 0)
    {
      return place;
    }
    const std::vector<Plane> planes = planesOfBases();
    double radius = 0.0;
    for (const Plane& plane : planes)
    {
      radius = std::max(radius, (plane.point - place).norm());
    }
    for (int step = 1; step <= mostSteps; ++step)
    {
      const auto worst =
          std::ranges::min_element(planes, {}, [&](const Plane& at) { return at.normal.dot(place - at.point); });
      place += firstStep * radius * std::pow(step, -decrease) * worst->normal;
      if (invertedPartsAt(place) == 0)
      {
        return place;
      }
    }
    return std::nullopt;
  }

  struct Plane
  {
    Vec3 point;
    Vec3 normal; ///< into the cell; zero if the corner is straight
  };

  /// Returns the planes at each corner of each base.
  std::vector<Plane> planesOfBases() const
  {
    std::vector<Plane> planes;
    for (const std::vector<Index>& base : bases)
    {
      for (std::size_t i = 0; i < base.size(); ++i)
      {
        const Vec3& point = mesh.points[base[i]];
        const Vec3& next = mesh.points[base[(i + 1) % base.size()]];
        const Vec3& second = mesh.points[base[(i + 2) % base.size()]];
        planes.push_back({point, (next - point).cross(second - point).normalized()});
      }
    }
    return planes;
  }

  std::size_t invertedPartsAt(const Vec3& apex) const
  {
    return static_cast<std::size_t>(std::ranges::count_if(bases, [&](const std::vector<Index>& base) {
      // Each corner is tested, so that a bent quadrilateral counts if it would for either diagonal.
      for (std::size_t i = 0; i < base.size(); ++i)
      {
        const auto at = [&](std::size_t k) -> const Vec3& { return mesh.points[base[(i + k) % base.size()]]; };
        if (!(volumeOf(at(0), at(1), at(2), apex) > 0.0))
        {
          return true;
        }
      }
      return false;
    }));
  }

  const FaceMesh& mesh;
  const CellFaces& cellFaces;
  NativeCells& out;
  std::vector<std::vector<Index>> bases;
};

} // namespace

void divideFace(std::span<const Vec3> points, std::span<const Index> face,
                const std::function<void(std::span<const Index>)>& put)
{
  if (face.size() <= 4)
  {
    put(face);
    return;
  }
  const Vec3 normal = measurePolygon(points, face).area;
  std::size_t lowest = static_cast<std::size_t>(std::ranges::min_element(face) - face.begin());
  std::size_t from = face.size();
  for (std::size_t i = 0; i < face.size(); ++i)
  {
    if ((from == face.size() || face[i] < face[from]) && fanFits(points, face, i, normal))
    {
      from = i;
    }
  }
  from = from == face.size() ? lowest : from;
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
  {
    put(std::array{face[from], face[(from + i) % face.size()], face[(from + i + 1) % face.size()]});
  }
}

NativeCells makeNativeCells(const FaceMesh& mesh, const CellFaces& cellFaces, const CellArrays& cells,
                            std::span<const Index> newPoint, const ProgressRange& progress)
{
  NativeCells out;
  out.types.reserve(cells.types.size());
  out.offsets.reserve(cells.types.size() + 1);
  out.corners.reserve(8 * cells.types.size());
  PolyhedronCutter cutter(mesh, cellFaces, out);
  for (std::size_t cell = 0; cell < cells.types.size(); ++cell)
  {
    constexpr std::size_t piece = 65536;
    if (cell % piece == 0)
    {
      progress.report(static_cast<double>(cell) / static_cast<double>(cells.types.size()), "Dividing polyhedra");
    }
    const unsigned char type = cells.types[cell];
    if (type == polyhedronCell)
    {
      cutter.cut(cell);
      continue;
    }
    for (std::int64_t i = cells.offsets[cell]; i < cells.offsets[cell + 1]; ++i)
    {
      const auto point = static_cast<Index>(cells.connectivity[static_cast<std::size_t>(i)]);
      out.corners.push_back(newPoint.empty() ? point : newPoint[point]);
    }
    if (type == voxelCell)
    {
      std::swap(out.corners[out.corners.size() - 2], out.corners[out.corners.size() - 1]);
      std::swap(out.corners[out.corners.size() - 6], out.corners[out.corners.size() - 5]);
    }
    out.types.push_back(type == voxelCell ? static_cast<unsigned char>(hexahedronCell) : type);
    out.offsets.push_back(out.corners.size());
  }
  return out;
}

} // namespace atria
