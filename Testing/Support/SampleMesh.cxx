// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/SampleMesh.h"

#include "Quality/Faces/CellShapes.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace atria::testing {

namespace {

using Ids = std::vector<std::int64_t>;

class Builder
{
public:
  Builder(std::array<int, 3> counts, unsigned seed, double distance) : n(counts), random(seed)
  {
    std::uniform_real_distribution<double> move(-distance, distance);
    for (int k = 0; k <= n[2]; ++k)
    {
      for (int j = 0; j <= n[1]; ++j)
      {
        for (int i = 0; i <= n[0]; ++i)
        {
          const bool inside = i > 0 && j > 0 && k > 0 && i < n[0] && j < n[1] && k < n[2];
          const Vec3 offset(move(random), move(random), move(random));
          mesh.points.push_back(Vec3(i, j, k) + (inside && distance > 0.0 ? offset : Vec3(Vec3::Zero())));
        }
      }
    }
  }

  SampleMesh hexahedra()
  {
    forEachColumn([this](int i, int j) {
      for (int k = 0; k < n[2]; ++k)
      {
        mesh.addCell(hexahedronCell, cube(i, j, k));
      }
    });
    return std::move(mesh);
  }

  SampleMesh mixed()
  {
    forEachColumn([this](int i, int j) {
      if ((i + j) % 2 == 0)
      {
        addWholeColumn(i, j);
      }
      else
      {
        addSplitColumn(i, j);
      }
    });
    return std::move(mesh);
  }

private:
  template <typename F> void forEachColumn(F&& f)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        f(i, j);
      }
    }
  }

  std::int64_t node(int i, int j, int k) const { return i + (n[0] + 1) * (j + (n[1] + 1) * std::int64_t{k}); }

  Ids cube(int i, int j, int k) const
  {
    return {node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
  }

  std::int64_t addMiddle(const Ids& ids)
  {
    Vec3 sum = Vec3::Zero();
    for (const std::int64_t id : ids)
    {
      sum += mesh.points[id];
    }
    mesh.points.push_back(sum / static_cast<double>(ids.size()));
    return static_cast<std::int64_t>(mesh.points.size()) - 1;
  }

  /// Cells from each face of a shape to a point in its middle.
  void addCone(const Ids& ids, unsigned char type)
  {
    const std::int64_t apex = addMiddle(ids);
    for (const LocalFace& face : shapeOf(type).faces)
    {
      Ids base;
      for (int c = 0; c < face.size; ++c)
      {
        base.insert(base.begin(), ids[face.corners[c]]); // turned, so that its normal points to the apex
      }
      base.push_back(apex);
      mesh.addCell(face.size == 4 ? pyramidCell : tetrahedronCell, base);
    }
  }

  void addWholeColumn(int i, int j)
  {
    for (int k = 0; k < n[2]; ++k)
    {
      const Ids c = cube(i, j, k);
      switch ((turn++ + random() / 7) % 3)
      {
        case 0:
          mesh.addCell(hexahedronCell, c);
          break;
        case 1:
          mesh.addCell(voxelCell, {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
          break;
        default:
          addCone(c, hexahedronCell);
      }
    }
  }

  /// Wedges on top of each other, some cut further; the topmost cube is one polyhedron with its lower face in
  /// two.
  void addSplitColumn(int i, int j)
  {
    for (int k = 0; k + 1 < n[2]; ++k)
    {
      const Ids c = cube(i, j, k);
      // Points 0, 1, 2 clockwise seen from 3, 4, 5: VTK's wedge has its base's normal outward.
      const Ids first{c[0], c[2], c[1], c[4], c[6], c[5]};
      const Ids second{c[0], c[3], c[2], c[4], c[7], c[6]};
      mesh.addCell(wedgeCell, first);
      if (random() % 2 == 0)
      {
        mesh.addCell(wedgeCell, second);
      }
      else
      {
        addCone(second, wedgeCell);
      }
    }
    const Ids c = cube(i, j, n[2] - 1);
    mesh.addPolyhedron({{c[0], c[4], c[7], c[3]},
                        {c[1], c[2], c[6], c[5]},
                        {c[0], c[1], c[5], c[4]},
                        {c[3], c[7], c[6], c[2]},
                        {c[0], c[2], c[1]},
                        {c[0], c[3], c[2]},
                        {c[4], c[5], c[6], c[7]}});
  }

  std::array<int, 3> n;
  std::mt19937 random;
  unsigned turn = 0;
  SampleMesh mesh;
};

} // namespace

void SampleMesh::addCell(unsigned char type, const std::vector<std::int64_t>& ids)
{
  types.push_back(type);
  connectivity.insert(connectivity.end(), ids.begin(), ids.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  faceLocations.push_back(-1);
}

void SampleMesh::addPolyhedron(const std::vector<std::vector<std::int64_t>>& faces)
{
  Ids ids;
  const auto location = static_cast<std::int64_t>(faceStream.size());
  faceStream.push_back(static_cast<std::int64_t>(faces.size()));
  for (const Ids& face : faces)
  {
    faceStream.push_back(static_cast<std::int64_t>(face.size()));
    faceStream.insert(faceStream.end(), face.begin(), face.end());
    ids.insert(ids.end(), face.begin(), face.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  addCell(polyhedronCell, ids);
  faceLocations.back() = location;
}

SampleMesh singleCell(unsigned char type, const std::vector<Vec3>& points)
{
  SampleMesh mesh;
  mesh.points = points;
  std::vector<std::int64_t> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  mesh.addCell(type, ids);
  return mesh;
}

SampleMesh hexahedra(std::array<int, 3> n) { return Builder(n, 0, 0.0).hexahedra(); }

SampleMesh mixedCells(std::array<int, 3> n, unsigned seed, double distance)
{
  return Builder(n, seed, distance).mixed();
}

} // namespace atria::testing
