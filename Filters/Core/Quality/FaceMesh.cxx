// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/FaceMesh.h"

#include "Quality/HalfFaces.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <string>

namespace atria {

namespace {

/// Stands in `mates` for a half-face that must stay on the boundary.
constexpr Index keptApart = noIndex - 1;

/// A half-face among those that have the same smallest point: the next smallest three points (the last is
/// noIndex in a triangle). Only polygons of more than four points can agree in all three and still differ.
struct Key
{
  std::array<Index, 3> points;
  Index halfFace;
};

std::array<Index, 4> smallestPoints(std::span<const Index> face)
{
  std::array<Index, 4> smallest{noIndex, noIndex, noIndex, noIndex};
  for (Index point : face)
  {
    for (Index& held : smallest)
    {
      if (point < held)
      {
        std::swap(point, held);
      }
    }
  }
  return smallest;
}

/// Finds which half-faces are the two sides of one face.
class Matcher
{
public:
  explicit Matcher(const HalfFaces& faces) : halves(faces), mates(faces.count(), noIndex) {}

  void keepApart(std::span<const BoundaryFaceKey> boundaryFaces)
  {
    std::vector<Index> points;
    for (const BoundaryFaceKey& key : boundaryFaces)
    {
      if (key.cell + std::size_t{1} >= halves.cellOffsets.size())
      {
        continue;
      }
      points.assign(key.points.begin(), key.points.end());
      for (Index h = halves.cellOffsets[key.cell]; h < halves.cellOffsets[key.cell + 1]; ++h)
      {
        if (samePoints(halves.face(h), points))
        {
          mates[h] = keptApart;
        }
      }
    }
  }

  std::vector<Index> run(std::size_t pointCount)
  {
    sortIntoBuckets(pointCount);
    for (std::size_t b = 0; b + 1 < bucketOffsets.size(); ++b)
    {
      matchBucket({bucketed.data() + bucketOffsets[b], bucketed.data() + bucketOffsets[b + 1]});
    }
    return std::move(mates);
  }

private:
  Index smallestPoint(std::size_t h) const
  {
    const auto face = halves.face(h);
    return *std::min_element(face.begin(), face.end());
  }

  /// Counting sort by the smallest point. A bucket holds a handful of faces, so sorting it costs next to
  /// nothing.
  void sortIntoBuckets(std::size_t pointCount)
  {
    // Counted two places up and summed one place up, an offset serves as its bucket's cursor, and ends as its
    // begin.
    bucketOffsets.assign(pointCount + 2, 0);
    for (std::size_t h = 0; h < halves.count(); ++h)
    {
      bucketOffsets[smallestPoint(h) + 2] += mates[h] == keptApart ? 0 : 1;
    }
    for (std::size_t b = 2; b < bucketOffsets.size(); ++b)
    {
      bucketOffsets[b] += bucketOffsets[b - 1];
    }
    bucketed.resize(bucketOffsets.back());
    for (std::size_t h = 0; h < halves.count(); ++h)
    {
      if (mates[h] != keptApart)
      {
        bucketed[bucketOffsets[smallestPoint(h) + 1]++] = static_cast<Index>(h);
      }
    }
    bucketOffsets.pop_back();
  }

  std::vector<Index> sortedPoints(Index h) const
  {
    const auto face = halves.face(h);
    std::vector<Index> points(face.begin(), face.end());
    std::sort(points.begin(), points.end());
    return points;
  }

  bool largerFacesLess(Index a, Index b) const
  {
    const std::size_t sizeA = halves.face(a).size();
    const std::size_t sizeB = halves.face(b).size();
    if (sizeA != sizeB)
    {
      return sizeA < sizeB;
    }
    return sizeA > 4 && sortedPoints(a) < sortedPoints(b);
  }

  bool sameFace(const Key& a, const Key& b) const
  {
    return a.points == b.points && samePoints(halves.face(a.halfFace), halves.face(b.halfFace));
  }

  void matchBucket(std::span<const Index> halfFaces)
  {
    bucket.clear();
    for (const Index h : halfFaces)
    {
      const std::array<Index, 4> points = smallestPoints(halves.face(h));
      bucket.push_back({{points[1], points[2], points[3]}, h});
    }
    std::sort(bucket.begin(), bucket.end(), [this](const Key& a, const Key& b) {
      if (a.points != b.points)
      {
        return a.points < b.points;
      }
      const bool less = largerFacesLess(a.halfFace, b.halfFace);
      return less || (a.halfFace < b.halfFace && !largerFacesLess(b.halfFace, a.halfFace));
    });
    for (std::size_t i = 0; i < bucket.size();)
    {
      std::size_t end = i + 1;
      while (end < bucket.size() && sameFace(bucket[i], bucket[end]))
      {
        ++end;
      }
      join({bucket.data() + i, bucket.data() + end});
      i = end;
    }
  }

  void join(std::span<const Key> sides)
  {
    if (sides.size() == 1)
    {
      return;
    }
    const Index a = sides[0].halfFace;
    const Index b = sides[1].halfFace;
    if (sides.size() > 2 || halves.cell[a] == halves.cell[b])
    {
      fail(sides);
    }
    mates[a] = b;
    mates[b] = a;
  }

  [[noreturn]] void fail(std::span<const Key> sides) const
  {
    std::string text = "the mesh is not a manifold: the face of points";
    for (const Index point : halves.face(sides[0].halfFace))
    {
      text += ' ' + std::to_string(point);
    }
    text += sides.size() > 2 ? " is shared by the cells" : " is there twice in the cells";
    for (const Key& side : sides)
    {
      text += ' ' + std::to_string(halves.cell[side.halfFace]);
    }
    throw Error(text);
  }

  const HalfFaces& halves;
  std::vector<Index> mates;
  std::vector<Index> bucketOffsets;
  std::vector<Index> bucketed; ///< half-faces by their smallest point
  std::vector<Key> bucket;     ///< the one at hand
};

std::vector<Index> findMates(const HalfFaces& halves, std::size_t pointCount,
                             std::span<const BoundaryFaceKey> boundaryFaces)
{
  Matcher matcher(halves);
  matcher.keepApart(boundaryFaces);
  return matcher.run(pointCount);
}

/// Appends half-faces to a mesh as its faces.
class Assembler
{
public:
  Assembler(const HalfFaces& faces, const std::vector<Index>& matesOfFaces) : halves(faces), mates(matesOfFaces) {}

  void run(FaceMesh& mesh)
  {
    reserve(mesh);
    for (std::size_t cell = 0; cell < mesh.cellCount; ++cell)
    {
      addInternalFaces(mesh, static_cast<Index>(cell));
    }
    for (std::size_t h = 0; h < halves.count(); ++h)
    {
      if (mates[h] >= keptApart)
      {
        add(mesh, static_cast<Index>(h));
      }
    }
  }

private:
  bool ownsInternal(Index h) const { return mates[h] < keptApart && halves.cell[h] < halves.cell[mates[h]]; }

  void reserve(FaceMesh& mesh) const
  {
    std::size_t internal = 0;
    std::size_t faces = 0;
    std::size_t corners = 0;
    for (std::size_t h = 0; h < halves.count(); ++h)
    {
      const bool isInternal = ownsInternal(static_cast<Index>(h));
      if (isInternal || mates[h] >= keptApart)
      {
        ++faces;
        internal += isInternal ? 1 : 0;
        corners += halves.face(h).size();
      }
    }
    mesh.owner.reserve(faces);
    mesh.neighbour.reserve(internal);
    mesh.faceOffsets.reserve(faces + 1);
    mesh.facePoints.reserve(corners);
  }

  void add(FaceMesh& mesh, Index h) const
  {
    const auto face = halves.face(h);
    mesh.facePoints.insert(mesh.facePoints.end(), face.begin(), face.end());
    mesh.faceOffsets.push_back(static_cast<Index>(mesh.facePoints.size()));
    mesh.owner.push_back(halves.cell[h]);
  }

  void addInternalFaces(FaceMesh& mesh, Index cell)
  {
    owned.clear();
    for (Index h = halves.cellOffsets[cell]; h < halves.cellOffsets[cell + 1]; ++h)
    {
      if (ownsInternal(h))
      {
        owned.push_back({halves.cell[mates[h]], h});
      }
    }
    std::sort(owned.begin(), owned.end());
    for (const auto& [neighbour, h] : owned)
    {
      add(mesh, h);
      mesh.neighbour.push_back(neighbour);
    }
  }

  const HalfFaces& halves;
  const std::vector<Index>& mates;
  std::vector<std::pair<Index, Index>> owned;
};

} // namespace

FaceMesh makeFaceMesh(std::span<const Vec3> points, const CellArrays& cells,
                      std::span<const BoundaryFaceKey> boundaryFaces)
{
  const HalfFaces halves = takeApart(cells, points.size());
  const std::vector<Index> mates = findMates(halves, points.size(), boundaryFaces);
  FaceMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.cellCount = cells.types.size();
  Assembler(halves, mates).run(mesh);
  return mesh;
}

std::vector<Index> findBoundaryFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys)
{
  std::vector<Index> found(keys.size(), noIndex);
  std::vector<Index> points;
  const auto first = mesh.owner.begin() + static_cast<std::ptrdiff_t>(mesh.internalFaceCount());
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    points.assign(keys[k].points.begin(), keys[k].points.end());
    const auto range = std::equal_range(first, mesh.owner.end(), keys[k].cell);
    for (auto it = range.first; it != range.second && found[k] == noIndex; ++it)
    {
      const auto face = static_cast<std::size_t>(it - mesh.owner.begin());
      if (samePoints(mesh.face(face), points))
      {
        found[k] = static_cast<Index>(face);
      }
    }
  }
  return found;
}

} // namespace atria
