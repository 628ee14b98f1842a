// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/WidePiece.h"

#include "Quality/Faces/CellShapes.h"
#include "Support/Buckets.h"
#include "Support/Buffer.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace atria {

namespace {

/// Cells for another rank, and their points.
struct Parcel
{
  std::vector<std::int64_t> ids;
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<Index> corners;
  std::vector<std::int64_t> streamOffsets{0};
  std::vector<std::int64_t> stream; ///< faces of polyhedra, as in PolyhedronFaces
  std::vector<std::int64_t> labels; ///< all labels of a cell, one cell after the other
  std::vector<Index> faceCounts;    ///< number of patch faces, one entry per cell
  std::vector<Index> patchOf;       ///< one entry per face
  std::vector<Index> faceSizes;
  std::vector<Index> facePoints;
  std::vector<std::int64_t> pointIds; ///< rising
  std::vector<Vec3> points;

  Bytes pack() const
  {
    return bytesOf(ids, types, offsets, corners, streamOffsets, stream, labels, faceCounts, patchOf, faceSizes,
                   facePoints, pointIds, points);
  }
  static Parcel unpack(const Bytes& bytes)
  {
    Parcel out;
    readBytes(bytes, out.ids, out.types, out.offsets, out.corners, out.streamOffsets, out.stream, out.labels,
              out.faceCounts, out.patchOf, out.faceSizes, out.facePoints, out.pointIds, out.points);
    return out;
  }
};

/// Replaces the points in a cell's stream of faces by `change(point)`.
template <typename Change> void changeStream(std::span<std::int64_t> stream, Change&& change)
{
  std::size_t next = 1;
  for (std::int64_t faces = stream.empty() ? 0 : stream[0]; faces > 0; --faces)
  {
    for (std::int64_t corners = stream[next++]; corners > 0; --corners)
    {
      stream[next] = change(stream[next]);
      ++next;
    }
  }
}

/// The cells of a rank, ready to be sent to others.
class OwnCells
{
public:
  OwnCells(const NarrowPiece& narrowPiece, std::size_t ranks) : piece(narrowPiece), placeOf(piece.pointIds.size())
  {
    std::iota(placeOf.begin(), placeOf.end(), Index{0});
    std::ranges::sort(placeOf, {}, [this](Index p) { return piece.pointIds[p]; });
    for (Index cell = 0; cell < piece.isOwn.size(); ++cell)
    {
      if (piece.isOwn[cell])
      {
        own.push_back(cell);
      }
    }
    facesOf = fillInOrder(piece.isOwn.size(), SerialExecutor(), [&](auto&& use) {
      for (Index face = 0; face < piece.faces.size(); ++face)
      {
        use(piece.faces[face].cell, face);
      }
    });
    sent.resize(ranks);
  }

  Parcel all() const { return parcelOf(own); }

  /// Returns the points that cells of other ranks have, too.
  std::vector<std::int64_t> sharedPoints() const
  {
    std::vector<char> isOwnPoint(piece.points.size(), 0);
    std::ranges::for_each(own, [&](Index cell) { forCorners(cell, [&](std::size_t p) { isOwnPoint[p] = 1; }); });
    std::vector<std::int64_t> shared;
    for (Index cell = 0; cell < piece.isOwn.size(); ++cell)
    {
      const auto add = [&](std::size_t p) {
        if (isOwnPoint[p])
        {
          shared.push_back(piece.pointIds[p]);
        }
      };
      if (!piece.isOwn[cell])
      {
        forCorners(cell, add);
      }
    }
    sortUnique(shared);
    return shared;
  }

  /// Returns own cells at some points, except cells sent to that rank before.
  Parcel at(const std::vector<std::int64_t>& pointIds, std::size_t rank)
  {
    std::vector<char> isAsked(piece.points.size(), 0);
    bool any = false;
    for (const std::int64_t id : pointIds)
    {
      const auto found = std::ranges::lower_bound(placeOf, id, {}, [this](Index p) { return piece.pointIds[p]; });
      if (found != placeOf.end() && piece.pointIds[*found] == id)
      {
        isAsked[*found] = 1;
        any = true;
      }
    }
    std::vector<Index> cells;
    for (std::size_t i = 0; any && i < own.size(); ++i)
    {
      bool isAt = false;
      forCorners(own[i], [&](std::size_t p) { isAt = isAt || isAsked[p]; });
      if (isAt && !std::ranges::binary_search(sent[rank], own[i]))
      {
        cells.push_back(own[i]);
      }
    }
    mergeUnique(sent[rank], cells);
    return parcelOf(cells);
  }

private:
  template <typename F> void forCorners(Index cell, F&& body) const
  {
    for (std::int64_t i = piece.cells.offsets[cell]; i < piece.cells.offsets[cell + std::size_t{1}]; ++i)
    {
      body(static_cast<std::size_t>(piece.cells.connectivity[static_cast<std::size_t>(i)]));
    }
  }

  Parcel parcelOf(const std::vector<Index>& cells) const
  {
    Parcel out;
    const std::vector<Index> newPoint = takePoints(cells, out);
    reserve(cells, out);
    for (const Index cell : cells)
    {
      out.ids.push_back(piece.cellIds[cell]);
      out.types.push_back(piece.cells.types[cell]);
      forCorners(cell, [&](std::size_t p) { out.corners.push_back(newPoint[p]); });
      out.offsets.push_back(static_cast<std::int64_t>(out.corners.size()));
      addStream(cell, newPoint, out);
      std::ranges::for_each(piece.labels, [&](const IdView& label) { out.labels.push_back(label[cell]); });
      addFaces(cell, newPoint, out);
    }
    return out;
  }

  /// Reserves memory, as growing lists leave holes as large as themselves.
  void reserve(const std::vector<Index>& cells, Parcel& out) const
  {
    std::size_t corners = 0;
    std::ranges::for_each(cells, [&](Index cell) { forCorners(cell, [&](std::size_t) { ++corners; }); });
    out.ids.reserve(cells.size());
    out.types.reserve(cells.size());
    out.corners.reserve(corners);
    out.offsets.reserve(cells.size() + 1);
    out.streamOffsets.reserve(cells.size() + 1);
    out.labels.reserve(cells.size() * piece.labels.size());
    out.faceCounts.reserve(cells.size());
  }

  /// Copies the points of cells to `out`. Returns the number that each point of the piece has there.
  std::vector<Index> takePoints(const std::vector<Index>& cells, Parcel& out) const
  {
    std::vector<Index> newPoint(piece.points.size(), noIndex);
    std::ranges::for_each(cells, [&](Index cell) { forCorners(cell, [&](std::size_t p) { newPoint[p] = 0; }); });
    const std::size_t count = newPoint.size() - static_cast<std::size_t>(std::ranges::count(newPoint, noIndex));
    out.pointIds.reserve(count);
    out.points.reserve(count);
    for (const Index p : placeOf)
    {
      if (newPoint[p] != noIndex)
      {
        newPoint[p] = static_cast<Index>(out.points.size());
        out.pointIds.push_back(piece.pointIds[p]);
        out.points.push_back(piece.points[p]);
      }
    }
    return newPoint;
  }

  void addStream(Index cell, const std::vector<Index>& newPoint, Parcel& out) const
  {
    if (piece.cells.types[cell] == polyhedronCell)
    {
      appendFaces(
          piece.cells.faces, cell, [&](std::int64_t p) { return newPoint[static_cast<std::size_t>(p)]; }, out.stream);
    }
    out.streamOffsets.push_back(static_cast<std::int64_t>(out.stream.size()));
  }

  void addFaces(Index cell, const std::vector<Index>& newPoint, Parcel& out) const
  {
    out.faceCounts.push_back(static_cast<Index>(facesOf.of(cell).size()));
    for (const Index face : facesOf.of(cell))
    {
      out.patchOf.push_back(piece.patchOf[face]);
      out.faceSizes.push_back(static_cast<Index>(piece.faces[face].points.size()));
      std::ranges::transform(piece.faces[face].points, std::back_inserter(out.facePoints),
                             [&](std::int64_t p) { return newPoint[static_cast<std::size_t>(p)]; });
    }
  }

  const NarrowPiece& piece;
  std::vector<Index> placeOf; ///< points, sorted by their numbers in the whole mesh
  std::vector<Index> own;
  Buckets facesOf;                      ///< one entry per cell
  std::vector<std::vector<Index>> sent; ///< one list per rank, rising
};

/// A parcel, its rank and its ring.
struct Received
{
  Parcel parcel;
  Index rank;
  Index ring;
};

/// Joins parcels into a wide piece.
class Joiner
{
public:
  explicit Joiner(const std::vector<Received>& receivedParcels, std::size_t labelCount) : received(receivedParcels)
  {
    out.labels.resize(labelCount);
    joinPoints();
  }

  WidePiece run()
  {
    reserve();
    std::vector<Place> order;
    order.reserve(cellCount());
    for (Index i = 0; i < received.size(); ++i)
    {
      const Parcel& parcel = received[i].parcel;
      std::size_t face = 0;
      std::size_t facePoint = 0;
      for (Index cell = 0; cell < parcel.ids.size(); ++cell)
      {
        order.push_back({parcel.ids[cell], i, cell, face, facePoint});
        for (Index count = parcel.faceCounts[cell]; count > 0; --count)
        {
          facePoint += parcel.faceSizes[face++];
        }
      }
    }
    std::ranges::sort(order, {}, &Place::id);
    for (const Place& place : order)
    {
      add(place);
    }
    return std::move(out);
  }

private:
  struct Place
  {
    std::int64_t id;
    Index parcel;
    Index cell;
    std::size_t face; ///< first of its patch faces, and first of their points
    std::size_t facePoint;
  };

  std::size_t cellCount() const
  {
    std::size_t count = 0;
    std::ranges::for_each(received, [&](const Received& some) { count += some.parcel.ids.size(); });
    return count;
  }

  void reserve()
  {
    const std::size_t cells = cellCount();
    std::size_t corners = 0;
    std::size_t stream = 0;
    for (const Received& some : received)
    {
      corners += some.parcel.corners.size();
      stream += some.parcel.stream.size();
    }
    out.cellIds.reserve(cells);
    out.ranks.reserve(cells);
    out.rings.reserve(cells);
    out.types.reserve(cells);
    out.connectivity.reserve(corners);
    out.offsets.reserve(cells + 1);
    out.faceLocations.reserve(cells);
    out.faceStream.reserve(stream);
    std::ranges::for_each(out.labels, [&](std::vector<std::int64_t>& label) { label.reserve(cells); });
  }

  void joinPoints()
  {
    std::size_t count = 0;
    std::ranges::for_each(received, [&](const Received& some) { count += some.parcel.pointIds.size(); });
    std::vector<std::pair<std::int64_t, std::pair<Index, Index>>> all;
    all.reserve(count);
    for (Index i = 0; i < received.size(); ++i)
    {
      const std::vector<std::int64_t>& ids = received[i].parcel.pointIds;
      for (Index p = 0; p < ids.size(); ++p)
      {
        all.push_back({ids[p], {i, p}});
      }
      newPoint.emplace_back(ids.size());
    }
    std::ranges::sort(all);
    out.pointIds.reserve(count);
    out.points.reserve(count);
    for (const auto& [id, at] : all)
    {
      if (out.pointIds.empty() || out.pointIds.back() != id)
      {
        out.pointIds.push_back(id);
        out.points.push_back(received[at.first].parcel.points[at.second]);
      }
      newPoint[at.first][at.second] = static_cast<Index>(out.pointIds.size() - 1);
    }
  }

  void add(const Place& place)
  {
    const auto& [parcel, rank, ring] = received[place.parcel];
    const auto pointOf = [&numbers = newPoint[place.parcel]](auto p) { return numbers[static_cast<std::size_t>(p)]; };
    const auto cell = static_cast<Index>(out.types.size());
    out.cellIds.push_back(place.id);
    out.ranks.push_back(rank);
    out.rings.push_back(ring);
    out.types.push_back(parcel.types[place.cell]);
    std::transform(parcel.corners.begin() + parcel.offsets[place.cell],
                   parcel.corners.begin() + parcel.offsets[place.cell + 1], std::back_inserter(out.connectivity),
                   pointOf);
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
    out.faceLocations.push_back(static_cast<std::int64_t>(out.faceStream.size()));
    out.faceStream.insert(out.faceStream.end(), parcel.stream.begin() + parcel.streamOffsets[place.cell],
                          parcel.stream.begin() + parcel.streamOffsets[place.cell + 1]);
    changeStream(std::span(out.faceStream).subspan(static_cast<std::size_t>(out.faceLocations.back())),
                 [&](std::int64_t p) { return std::int64_t{pointOf(p)}; });
    for (std::size_t label = 0; label < out.labels.size(); ++label)
    {
      out.labels[label].push_back(parcel.labels[place.cell * out.labels.size() + label]);
    }
    std::size_t point = place.facePoint;
    for (std::size_t face = place.face; face < place.face + parcel.faceCounts[place.cell]; ++face)
    {
      out.faceCells.push_back(cell);
      out.patchOf.push_back(parcel.patchOf[face]);
      for (Index i = 0; i < parcel.faceSizes[face]; ++i)
      {
        out.facePoints.push_back(pointOf(parcel.facePoints[point++]));
      }
      out.faceOffsets.push_back(out.facePoints.size());
    }
  }

  const std::vector<Received>& received;
  std::vector<std::vector<Index>> newPoint; ///< one list per parcel
  WidePiece out;
};

} // namespace

std::vector<BoundaryFaceKey> WidePiece::faceKeys() const
{
  std::vector<BoundaryFaceKey> keys;
  keys.reserve(faceCells.size());
  for (std::size_t f = 0; f < faceCells.size(); ++f)
  {
    keys.push_back({faceCells[f], std::span(facePoints).subspan(faceOffsets[f], faceOffsets[f + 1] - faceOffsets[f])});
  }
  return keys;
}

void WidePiece::releaseCells()
{
  release(types);
  release(offsets);
  release(connectivity);
  release(faceStream);
  release(faceLocations);
}

std::vector<char> WideNumbers::ownCells() const
{
  std::vector<char> isOwn(rings.size());
  std::ranges::transform(rings, isOwn.begin(), [](Index ring) { return ring == 0 ? 1 : 0; });
  return isOwn;
}

Index WideNumbers::findCell(std::int64_t id) const
{
  const auto found = std::ranges::lower_bound(cellIds, id);
  return found != cellIds.end() && *found == id ? static_cast<Index>(found - cellIds.begin()) : noIndex;
}

WidePiece widen(const NarrowPiece& piece, int rings, RankExchange& exchange)
{
  const auto ranks = static_cast<std::size_t>(exchange.ranks());
  const auto self = static_cast<std::size_t>(exchange.rank());
  OwnCells own(piece, ranks);
  std::vector<std::int64_t> asked = own.sharedPoints();
  std::vector<Received> received;
  received.push_back({own.all(), static_cast<Index>(self), 0});
  std::vector<std::int64_t> known = received.front().parcel.pointIds;
  for (int ring = 1; ring <= rings; ++ring)
  {
    const std::vector<std::vector<std::int64_t>> all = gatherAll(exchange, asked);
    std::vector<Bytes> answers(ranks);
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      answers[rank] = (rank == self ? Parcel() : own.at(all[rank], rank)).pack();
    }
    asked.clear();
    const std::vector<Bytes> parcels = exchange.exchange(std::move(answers));
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      Parcel parcel = Parcel::unpack(parcels[rank]);
      std::ranges::set_difference(parcel.pointIds, known, std::back_inserter(asked));
      received.push_back({std::move(parcel), static_cast<Index>(rank), static_cast<Index>(ring)});
    }
    sortUnique(asked);
    mergeUnique(known, asked);
  }
  WidePiece out = Joiner(received, piece.labels.size()).run();
  out.ringCount = static_cast<Index>(rings);
  return out;
}

} // namespace atria
