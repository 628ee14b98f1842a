// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/FaceMesh.h"

#include "Quality/Faces/HalfFaces.h"
#include "Support/Error.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <string>
#include <utility>

namespace atria {

namespace {

/// Entry of `mates` for a half-face that must stay on the boundary.
constexpr Index keptApart = noIndex - 1;

/// Key of a half-face among those with the same smallest point: the next smallest two points as one number, and the
/// third (noIndex in a triangle). Only polygons of more than four points can agree in all three and still differ.
struct Key
{
  std::uint64_t second;
  Index third;
  Index halfFace;

  bool hasPointsOf(const Key& other) const { return second == other.second && third == other.third; }
};

constexpr std::size_t smallestCount = 4;

void putInOrder(Index& a, Index& b)
{
  const Index less = std::min(a, b);
  b = std::max(a, b);
  a = less;
}

std::array<Index, smallestCount> smallestPoints(std::span<const Index> face)
{
  std::array<Index, smallestCount> smallest{noIndex, noIndex, noIndex, noIndex};
  if (face.size() <= smallestCount)
  {
    copyPoints(face, smallest.data());
    putInOrder(smallest[0], smallest[1]);
    putInOrder(smallest[2], smallest[3]);
    putInOrder(smallest[0], smallest[2]);
    putInOrder(smallest[1], smallest[3]);
    putInOrder(smallest[1], smallest[2]);
    return smallest;
  }
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

/// Finds the pairs of half-faces that are the two sides of one face.
class Matcher
{
public:
  Matcher(const HalfFaces& faces, const Executor& threads) : halves(faces), executor(threads), mates(faces.count())
  {
    executor.forEach(mates.size(), Pieces::length, [&](std::size_t h) { mates[h] = noIndex; });
  }

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

  Buffer<Index> run(std::size_t pointCount)
  {
    const Buffer<Index> bySmallest = linkBySmallestPoint(pointCount);
    FirstError error;
    executor.forRanges(pointCount, Pieces::length, [&](std::size_t begin, std::size_t end) {
      std::vector<Key> bucket;
      std::size_t b = begin;
      try
      {
        for (; b < end; ++b)
        {
          matchBucket(bySmallest[b], bucket);
        }
      }
      catch (const Error& problem)
      {
        error.note(b, problem.what());
      }
    });
    error.rethrow();
    return std::move(mates);
  }

private:
  Index smallestPoint(std::size_t h) const
  {
    const auto face = halves.face(h);
    Index smallest = face[0];
    for (const Index point : face)
    {
      smallest = std::min(smallest, point);
    }
    return smallest;
  }

  /// First of the few half-faces with each smallest point; they are sorted when they are matched. Until then `mates`
  /// links them: buckets would take as much memory again as all mates.
  Buffer<Index> linkBySmallestPoint(std::size_t pointCount)
  {
    Buffer<Index> heads(pointCount);
    executor.forEach(pointCount, Pieces::length, [&](std::size_t p) { heads[p] = noIndex; });
    executor.forEach(halves.count(), Pieces::length, [&](std::size_t h) {
      if (mates[h] != keptApart)
      {
        std::atomic_ref<Index> head(heads[smallestPoint(h)]);
        mates[h] = head.exchange(static_cast<Index>(h), std::memory_order_relaxed);
      }
    });
    return heads;
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
    return sizeA > smallestCount && sortedPoints(a) < sortedPoints(b);
  }

  bool keysTellAll(const Key& a, const Key& b) const
  {
    return halves.face(a.halfFace).size() <= smallestCount && halves.face(b.halfFace).size() <= smallestCount;
  }

  bool sameFace(const Key& a, const Key& b) const
  {
    return a.hasPointsOf(b) && (keysTellAll(a, b) || samePoints(halves.face(a.halfFace), halves.face(b.halfFace)));
  }

  void matchBucket(Index first, std::vector<Key>& bucket)
  {
    bucket.clear();
    for (Index h = first; h != noIndex; h = std::exchange(mates[h], noIndex))
    {
      const std::array<Index, smallestCount> points = smallestPoints(halves.face(h));
      bucket.push_back({std::uint64_t{points[1]} << 32 | points[2], points[3], h});
    }
    std::sort(bucket.begin(), bucket.end(), [this](const Key& a, const Key& b) {
      if (!a.hasPointsOf(b))
      {
        return a.second != b.second ? a.second < b.second : a.third < b.third;
      }
      if (keysTellAll(a, b))
      {
        return a.halfFace < b.halfFace;
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
  const Executor& executor;
  Buffer<Index> mates;
};

Buffer<Index> findMates(const HalfFaces& halves, std::size_t pointCount, std::span<const BoundaryFaceKey> boundaryFaces,
                        const Executor& executor)
{
  Matcher matcher(halves, executor);
  matcher.keepApart(boundaryFaces);
  return matcher.run(pointCount);
}

/// Counts of faces and of their corners, internal and on the boundary; or the places of the next ones.
struct Place
{
  std::size_t internalFaces = 0;
  std::size_t internalCorners = 0;
  std::size_t boundaryFaces = 0;
  std::size_t boundaryCorners = 0;

  Place operator+(const Place& other) const
  {
    return {internalFaces + other.internalFaces, internalCorners + other.internalCorners,
            boundaryFaces + other.boundaryFaces, boundaryCorners + other.boundaryCorners};
  }
};

/// Turns half-faces into the faces of a mesh.
class Assembler
{
public:
  Assembler(const HalfFaces& faces, const Buffer<Index>& matesOfFaces, FaceMesh& target)
      : halves(faces), mates(matesOfFaces), mesh(target)
  {
  }

  void run(const Executor& executor)
  {
    const Pieces pieces(mesh.cellCount);
    std::vector<Place> places(pieces.count);
    executor.forEach(pieces.count, 1,
                     [&](std::size_t piece) { places[piece] = count(pieces.begin(piece), pieces.end(piece)); });
    const Place all = scan(places);
    mesh.owner.resize(all.internalFaces + all.boundaryFaces);
    mesh.neighbor.resize(all.internalFaces);
    mesh.faceOffsets.resize(mesh.owner.size() + 1);
    mesh.facePoints.resize(all.internalCorners + all.boundaryCorners);
    executor.forEach(pieces.count, 1, [&](std::size_t piece) {
      Place place = places[piece];
      place.boundaryFaces += all.internalFaces;
      place.boundaryCorners += all.internalCorners;
      fill(pieces.begin(piece), pieces.end(piece), place);
    });
  }

private:
  bool ownsInternal(Index h) const { return mates[h] < keptApart && halves.cell[h] < halves.cell[mates[h]]; }

  Place count(std::size_t firstCell, std::size_t lastCell) const
  {
    Place sum;
    for (Index h = halves.cellOffsets[firstCell]; h < halves.cellOffsets[lastCell]; ++h)
    {
      if (ownsInternal(h))
      {
        sum = sum + Place{1, halves.face(h).size(), 0, 0};
      }
      else if (mates[h] >= keptApart)
      {
        sum = sum + Place{0, 0, 1, halves.face(h).size()};
      }
    }
    return sum;
  }

  void fill(std::size_t firstCell, std::size_t lastCell, Place place) const
  {
    std::vector<std::pair<Index, Index>> owned;
    for (std::size_t cell = firstCell; cell < lastCell; ++cell)
    {
      owned.clear();
      for (Index h = halves.cellOffsets[cell]; h < halves.cellOffsets[cell + 1]; ++h)
      {
        if (ownsInternal(h))
        {
          owned.push_back({halves.cell[mates[h]], h});
        }
        else if (mates[h] >= keptApart)
        {
          put(h, place.boundaryFaces, place.boundaryCorners);
        }
      }
      std::sort(owned.begin(), owned.end());
      for (const auto& [neighbor, h] : owned)
      {
        mesh.neighbor[place.internalFaces] = neighbor;
        put(h, place.internalFaces, place.internalCorners);
      }
    }
  }

  /// Writes a face and advances.
  void put(Index h, std::size_t& face, std::size_t& corner) const
  {
    const auto points = halves.face(h);
    copyPoints(points, mesh.facePoints.data() + corner);
    mesh.owner[face] = halves.cell[h];
    corner += points.size();
    mesh.faceOffsets[++face] = static_cast<Index>(corner);
  }

  const HalfFaces& halves;
  const Buffer<Index>& mates;
  FaceMesh& mesh;
};

} // namespace

FaceMesh makeFaceMesh(std::vector<Vec3> points, const CellArrays& cells, std::span<const BoundaryFaceKey> boundaryFaces,
                      const Executor& executor, const std::function<void()>& whenRead)
{
  const std::size_t cellCount = cells.types.size();
  const HalfFaces halves = takeApart(cells, points.size(), executor);
  if (whenRead)
  {
    whenRead();
  }
  const Buffer<Index> mates = findMates(halves, points.size(), boundaryFaces, executor);
  FaceMesh mesh;
  mesh.points = std::move(points);
  mesh.cellCount = cellCount;
  Assembler(halves, mates, mesh).run(executor);
  return mesh;
}

namespace {

/// Returns one entry per key: the first of its faces that has its points and for which isWanted(key, face) is true. The
/// owner of a key's faces is ownerOf(key); all are internal, or all on the boundary.
template <typename OwnerOf, typename IsWanted>
std::vector<Index> findFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys, bool onBoundary,
                             const Executor& executor, const OwnerOf& ownerOf, const IsWanted& isWanted)
{
  std::vector<Index> found(keys.size(), noIndex);
  const auto middle = mesh.owner.begin() + static_cast<std::ptrdiff_t>(mesh.internalFaceCount());
  executor.forRanges(keys.size(), Pieces::length, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> points;
    for (std::size_t k = begin; k < end; ++k)
    {
      points.assign(keys[k].points.begin(), keys[k].points.end());
      const auto range = std::equal_range(onBoundary ? middle : mesh.owner.begin(),
                                          onBoundary ? mesh.owner.end() : middle, ownerOf(k));
      for (auto it = range.first; it != range.second && found[k] == noIndex; ++it)
      {
        const auto face = static_cast<Index>(it - mesh.owner.begin());
        found[k] = isWanted(k, face) && samePoints(mesh.face(face), points) ? face : noIndex;
      }
    }
  });
  return found;
}

} // namespace

std::vector<Index> findBoundaryFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     const Executor& executor)
{
  const auto ownerOf = [&](std::size_t k) { return keys[k].cell; };
  return findFaces(mesh, keys, true, executor, ownerOf, [](std::size_t, Index) { return true; });
}

std::vector<Index> findInternalFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     std::span<const Index> neighbors, const Executor& executor)
{
  const auto ownerOf = [&](std::size_t k) { return std::min(keys[k].cell, neighbors[k]); };
  return findFaces(mesh, keys, false, executor, ownerOf, [&](std::size_t k, Index face) {
    return mesh.neighbor[face] == std::max(keys[k].cell, neighbors[k]);
  });
}

OrderedFace orderFace(Index face, Index owner, Index neighbor)
{
  return {owner == noIndex || neighbor == noIndex, std::min(owner, neighbor), std::max(owner, neighbor), face,
          owner > neighbor};
}

void appendFace(FaceMesh& mesh, const OrderedFace& face, std::span<const Index> loop)
{
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    mesh.facePoints.push_back(loop[face.turned ? loop.size() - 1 - i : i]);
  }
  mesh.faceOffsets.push_back(static_cast<Index>(mesh.facePoints.size()));
  mesh.owner.push_back(face.owner);
  if (!face.onBoundary)
  {
    mesh.neighbor.push_back(face.neighbor);
  }
}

} // namespace atria
