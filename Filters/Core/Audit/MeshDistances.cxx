// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/MeshDistances.h"

#include "Support/Pieces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace atria {

namespace {

/// Distance, in local element sizes, up to which a surface counts as lying on its faces.
constexpr double nearRatio = 0.1;

struct Measured
{
  Vec3 at = Vec3::Zero();
  double distance = 0.0;
  float size = 1.0F;
  Index surface = noIndex;
};

bool isFarther(const FarthestPlace& l, const FarthestPlace& r)
{
  return std::tuple(l.inElements, l.distance, l.at[0], l.at[1], l.at[2]) >
         std::tuple(r.inElements, r.distance, r.at[0], r.at[1], r.at[2]);
}

void take(const FarthestPlace& place, FarthestPlace& farthest)
{
  farthest = isFarther(place, farthest) ? place : farthest;
}

FarthestPlace placeOf(const Measured& measured)
{
  return {measured.distance, measured.distance / static_cast<double>(measured.size), measured.at};
}

/// Searches a surface, place after place. Most places lie on the triangle on which the one before lay.
class SurfaceSearch
{
public:
  SurfaceSearch(const TriangleTree& searched, const SurfaceModel& of, const GridFrame& gridFrame)
      : tree(searched), model(of), frame(gridFrame), unit(frame.latticeUnit()), whole(frame.rootSize() / unit)
  {
  }

  /// Returns the distance to the nearest place on one surface, in model units. It is infinite if the tree has no
  /// triangle of the surface, and 0 for a place on the surface within rounding.
  double distanceTo(Index surface, const Vec3& at, double size)
  {
    const Vec3 p = (at - frame.origin) / unit;
    const double nothing = rounding * size / unit;
    if (last != noIndex && model.surfaceIds[last] == surface && (tree.nearestOn(last, p) - p).norm() <= nothing)
    {
      return 0.0;
    }
    const TriangleTree::AnyPlaceOn onSurface([&](Index t) { return model.surfaceIds[t] == surface; });
    double reach = nearRatio * size / unit; // nearly always it is found at once
    auto found = tree.nearest(p, reach, onSurface);
    while (!found && reach < whole)
    {
      reach *= reachGrowth;
      found = tree.nearest(p, reach < whole ? reach : std::numeric_limits<double>::infinity(), onSurface);
    }
    if (!found)
    {
      return std::numeric_limits<double>::infinity();
    }
    last = found->triangle;
    const double distance = std::sqrt(found->squaredDistance);
    return distance <= nothing ? 0.0 : unit * distance;
  }

private:
  static constexpr double rounding = 1e-6; ///< in element sizes
  /// Factor by which the search radius grows. Nearer places on other surfaces are skipped one by one.
  static constexpr double reachGrowth = 4.0;

  const TriangleTree& tree;
  const SurfaceModel& model;
  const GridFrame& frame;
  double unit;
  double whole; ///< how long the domain is, in lattice units
  Index last = noIndex;
};

/// Faces of own elements on surfaces, those within the mesh among them.
struct OwnFaces
{
  OwnFaces(const DualMesh& mesh, std::size_t surfaceCount, const OwnElements& part)
  {
    const auto add = [&](const auto& face) {
      if (face.tag < surfaceCount && part.owns(face.element))
      {
        elements.push_back(face.element);
        directions.push_back(face.direction);
        tags.push_back(face.tag);
      }
    };
    std::ranges::for_each(mesh.boundaryFaces, add);
    std::ranges::for_each(mesh.zoneFaces, add);
  }

  std::vector<Index> elements;
  std::vector<std::uint8_t> directions;
  std::vector<Index> tags;
};

class DistanceFinder
{
public:
  DistanceFinder(const DualMesh& m, const OwnElements& p, const MeshingContext& c)
      : mesh(m), part(p), context(c), frame(c.octree.frame()), faces(m, c.model.names.size(), p),
        out(c.model.names.size())
  {
  }

  std::vector<SurfaceDistances> run(const std::vector<SurfaceSample>& samples)
  {
    measureFaces();
    joinFaces();
    measureSamples(samples);
    return std::move(out);
  }

private:
  float sizeOf(std::size_t face) const { return static_cast<float>(frame.sizeOf(mesh.levels[faces.elements[face]])); }

  /// The first face of each point measures that point; all others measure only their middle.
  void measureFaces()
  {
    std::vector<Index> firstFace(mesh.points.size(), noIndex);
    for (std::size_t f = faces.elements.size(); f-- > 0;)
    {
      const ReducedFace face = faceOf(mesh.corners[faces.elements[f]], faces.directions[f]);
      for (const Index p : face.loop())
      {
        firstFace[p] = static_cast<Index>(f);
      }
    }
    std::vector<FarthestPlace> ofFace(faces.elements.size());
    const TriangleTree& tree = context.tree.get();
    context.executor.forRanges(ofFace.size(), 1024, [&](std::size_t begin, std::size_t end) {
      SurfaceSearch search(tree, context.model, frame);
      for (std::size_t f = begin; f < end; ++f)
      {
        const ReducedFace face = faceOf(mesh.corners[faces.elements[f]], faces.directions[f]);
        Vec3 middle = Vec3::Zero();
        for (const Index p : face.loop())
        {
          middle += mesh.points[p] / face.count;
          if (firstFace[p] == f)
          {
            take(measure(mesh.points[p], f, search), ofFace[f]);
          }
        }
        take(measure(middle, f, search), ofFace[f]);
      }
    });
    for (std::size_t f = 0; f < ofFace.size(); ++f)
    {
      take(ofFace[f], out[faces.tags[f]].ofFaces);
    }
  }

  FarthestPlace measure(const Vec3& at, std::size_t face, SurfaceSearch& search) const
  {
    const float size = sizeOf(face);
    const double distance = search.distanceTo(faces.tags[face], at, static_cast<double>(size));
    // Parts of a surface that the repair put on another one are no place to measure from.
    return std::isfinite(distance) ? placeOf({at, distance, size}) : FarthestPlace{};
  }

  void joinFaces()
  {
    for (const std::vector<SurfaceDistances>& some : gatherAll(part.exchange, out))
    {
      for (std::size_t surface = 0; surface < out.size(); ++surface)
      {
        take(some[surface].ofFaces, out[surface].ofFaces);
      }
    }
  }

  /// Returns the faces as a model, to be searched.
  SurfaceModel surfaceOfFaces() const
  {
    SurfaceModel made;
    std::vector<Index> numbers(mesh.points.size(), noIndex);
    const auto numberOf = [&](Index p) {
      if (numbers[p] == noIndex)
      {
        numbers[p] = static_cast<Index>(made.points.size());
        made.points.push_back(frame.toLattice(mesh.points[p]));
      }
      return numbers[p];
    };
    for (std::size_t f = 0; f < faces.elements.size(); ++f)
    {
      const ReducedFace face = faceOf(mesh.corners[faces.elements[f]], faces.directions[f]);
      for (int i = 2; i < face.count; ++i)
      {
        made.triangles.push_back({numberOf(face.points[0]), numberOf(face.points[i - 1]), numberOf(face.points[i])});
        made.surfaceIds.push_back(faces.tags[f]);
      }
    }
    return made;
  }

  void measureSamples(const std::vector<SurfaceSample>& samples)
  {
    const SurfaceModel ofFaces = surfaceOfFaces();
    const TriangleTree tree(ofFaces);
    std::vector<char> hasFaces(out.size(), 0);
    std::ranges::for_each(faces.tags, [&](Index tag) { hasFaces[tag] = 1; });
    std::vector<double> distances(samples.size());
    const auto measureAll = [&](const auto& places, std::vector<double>& to) {
      context.executor.forRanges(places.size(), 1024, [&](std::size_t begin, std::size_t end) {
        SurfaceSearch search(tree, ofFaces, frame);
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto& place = places[i];
          to[i] = hasFaces[place.surface] ? search.distanceTo(place.surface, place.at, static_cast<double>(place.size))
                                          : std::numeric_limits<double>::infinity();
        }
      });
    };
    measureAll(samples, distances);
    std::vector<Measured> far;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      const SurfaceSample& sample = samples[i];
      if (distances[i] > nearRatio * static_cast<double>(sample.size))
      {
        far.push_back({sample.at, distances[i], sample.size, sample.surface});
      }
    }
    if (!part.isWhole())
    {
      far = nearestOfAll(std::move(far), measureAll);
    }
    for (const Measured& one : far)
    {
      if (std::isfinite(one.distance) && one.distance > nearRatio * static_cast<double>(one.size))
      {
        take(placeOf(one), out[one.surface].ofSurface);
      }
    }
  }

  /// Returns the places of all processes, with the least distance that any process measures.
  template <typename MeasureAll>
  std::vector<Measured> nearestOfAll(std::vector<Measured> own, MeasureAll&& measureAll) const
  {
    std::vector<Measured> all = joinAll(part.exchange, std::move(own));
    std::vector<double> here(all.size());
    measureAll(all, here);
    for (const std::vector<double>& some : gatherAll(part.exchange, here))
    {
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        all[i].distance = std::min(all[i].distance, some[i]);
      }
    }
    return all;
  }

  const DualMesh& mesh;
  const OwnElements& part;
  const MeshingContext& context;
  const GridFrame& frame;
  OwnFaces faces;
  std::vector<SurfaceDistances> out;
};

} // namespace

std::vector<SurfaceDistances> measureDistances(const DualMesh& mesh, const std::vector<SurfaceSample>& samples,
                                               const OwnElements& part, const MeshingContext& context)
{
  return DistanceFinder(mesh, part, context).run(samples);
}

} // namespace atria
