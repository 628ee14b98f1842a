// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/MeshAudit.h"

#include "Dual/Mesh/FaceFlux.h"
#include "Support/ExactSum.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atria {

namespace {

/// Sums of a surface.
enum SurfaceSum : std::uint8_t
{
  wetArea,       ///< faces on either side of the surface
  zoneArea,      ///< faces within the mesh
  sizeTimesArea, ///< size of the element times area, over both kinds of faces
  surfaceSums
};

/// Sums of the mesh.
enum WholeSum : std::uint8_t
{
  airVolume,
  topArea, ///< faces on the domain's top
  wholeSums
};

/// Areas of one surface in the model, in square model units.
struct ModelAreas
{
  /// Areas that see air on one side, and on both.
  double oneSide = 0.0;
  double bothSides = 0.0;
  ViewAreas hidden{};
};

/// Returns the entry of `areas` that a part without air counts toward. A part between a room and a solid counts as in
/// the room, and a part between a solid and the ground as under the ground.
double& hiddenArea(ViewAreas& areas, const TriangleViews& views)
{
  const auto [less, more] = std::minmax(views[0], views[1]);
  return areas[static_cast<std::size_t>(more == View::solid && less == View::ground ? less : more)];
}

class Auditor
{
public:
  Auditor(const DualMesh& m, const SeenModel& seen, const OwnElements& p, const MeshingContext& c)
      : mesh(m), views(seen.views), airParts(seen.airParts), part(p), context(c), frame(c.octree.frame()),
        count(c.model.names.size()), areas(std::pow(frame.domain.size().maxCoeff(), 2)),
        volumes(std::pow(frame.domain.size().maxCoeff(), 3))
  {
  }

  MeshAudit run(const SeenModel& seen)
  {
    out.surfaces.resize(count);
    measureFaces();
    measureModel(seen.unreached);
    const std::vector<SurfaceDistances> distances = measureDistances(mesh, seen.samples, part, context);
    for (std::size_t i = 0; i < count; ++i)
    {
      out.surfaces[i].distances = distances[i];
    }
    return std::move(out);
  }

private:
  void measureFaces()
  {
    std::vector<ExactSum> sums(count * surfaceSums + wholeSums);
    ExactSum* const whole = sums.data() + count * surfaceSums;
    std::vector<std::uint8_t> coarsest(count, std::numeric_limits<std::uint8_t>::max());
    const Vec3 origin = frame.domain.center();
    const auto add = [&](const auto& face, const FaceFlux& flux, SurfaceSum what) {
      const double area = flux.area.norm();
      const std::uint8_t level = mesh.levels[face.element];
      sums[face.tag * surfaceSums + what].add(area, areas);
      sums[face.tag * surfaceSums + sizeTimesArea].add(area * frame.sizeOf(level), areas);
      coarsest[face.tag] = std::min(coarsest[face.tag], level);
    };
    for (const BoundaryFace& face : mesh.boundaryFaces)
    {
      if (part.owns(face.element))
      {
        const FaceFlux flux = fluxOf(mesh, face.element, face.direction, origin);
        whole[airVolume].add(flux.volume, volumes);
        const double area = flux.area.norm();
        // Faces of sides may be in any direction of their elements.
        const bool isOnTop = face.onDomainSide && flux.area[2] > 0.5 * area;
        whole[topArea].add(isOnTop ? area : 0.0, areas);
        if (face.tag < count)
        {
          add(face, flux, wetArea);
        }
      }
    }
    for (const ZoneFace& face : mesh.zoneFaces)
    {
      if (part.owns(face.element))
      {
        add(face, fluxOf(mesh, face.element, face.direction, origin), zoneArea);
      }
    }
    takeSums(addAll(part.exchange, std::move(sums), [](const ExactSum& more, ExactSum& sum) { sum.add(more); }),
             std::move(coarsest));
  }

  void takeSums(const std::vector<ExactSum>& sums, std::vector<std::uint8_t> coarsest)
  {
    for (const std::vector<std::uint8_t>& some : gatherAll(part.exchange, coarsest))
    {
      std::ranges::transform(some, coarsest, coarsest.begin(), [](auto l, auto r) { return std::min(l, r); });
    }
    out.volumes.air = sums[count * surfaceSums + airVolume].value();
    top = sums[count * surfaceSums + topArea].value();
    wet.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      SurfaceAudit& surface = out.surfaces[i];
      wet[i] = sums[i * surfaceSums + wetArea].value();
      surface.meshArea = sums[i * surfaceSums + zoneArea].value();
      if (const double all = wet[i] + surface.meshArea; all > 0.0)
      {
        surface.meanSize = sums[i * surfaceSums + sizeTimesArea].value() / all;
        surface.largestSize = frame.sizeOf(coarsest[i]);
      }
    }
  }

  /// Measures areas by what sees them, the mesh's area with both sides counted once, and the enclosed volume.
  void measureModel(const std::vector<ViewAreas>& unreached)
  {
    const SurfaceModel& model = context.model;
    const ConvexRegion region(frame.domain, frame.latticeUnit());
    const double bottom = frame.domain.min[2];
    const Vec3 size = frame.domain.size();
    std::vector<ModelAreas> ofSurface(count);
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      const auto at = [&](int i) { return frame.toModel(model.corner(t, i)); };
      const ConvexRegion::Part inside = region.within(at(0), at(1), at(2), bottom);
      if (inside.area > 0.0)
      {
        addVolume(t, inside);
        if (!model.isTurnedSide(t))
        {
          addArea(t, inside.area, airParts.empty() ? 1.0 : airParts[t], ofSurface[model.surfaceIds[t]]);
        }
      }
    }
    const auto& turned = frame.turnedDomain;
    out.volumes.domain = turned ? turned->volume() : size.prod();
    // Solids reach the top where air does not.
    out.volumes.displacedByModel += out.volumes.domain - top * size[2];
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t view = 0; view < viewCount && !unreached.empty(); ++view)
      {
        ofSurface[i].hidden[view] += unreached[i][view];
      }
      takeAreas(ofSurface[i], wet[i], out.surfaces[i]);
    }
  }

  void addArea(Index triangle, double area, double airPart, ModelAreas& of) const
  {
    const auto [front, back] = views[triangle];
    if (front == View::air && back == View::air)
    {
      of.bothSides += area;
    }
    else if (front == View::air || back == View::air)
    {
      of.oneSide += airPart * area;
      of.hidden[static_cast<std::size_t>(View::narrow)] += (1.0 - airPart) * area;
    }
    else
    {
      // A part on a side of the domain that sees no air is the side of a solid, or its base.
      const std::int8_t side = context.model.domainSides[triangle];
      const View beside = side == zMin ? View::ground : View::solid;
      hiddenArea(of.hidden, side == SurfaceModel::noSide ? views[triangle] : TriangleViews{beside, beside}) += area;
    }
  }

  static void takeAreas(const ModelAreas& of, double wet, SurfaceAudit& surface)
  {
    const double airArea = of.oneSide + of.bothSides;
    const double wetArea = of.oneSide + 2.0 * of.bothSides;
    surface.meshArea += wetArea > 0.0 ? wet * airArea / wetArea : wet;
    const auto hidden = [&](View view) { return of.hidden[static_cast<std::size_t>(view)]; };
    surface.underGround = hidden(View::ground);
    surface.inSolid = hidden(View::solid) + hidden(View::narrow);
    surface.inRoom = hidden(View::room);
    surface.placedArea = std::accumulate(of.hidden.begin(), of.hidden.end(), airArea);
  }

  /// Integrates heights above the bottom to the volume. Upright sides add nothing, and the bottom has none.
  void addVolume(Index triangle, const ConvexRegion::Part& inside)
  {
    const auto [front, back] = views[triangle];
    const Vec3 normal = context.model.normal(triangle);
    if ((front == View::air) != (back == View::air) && !context.model.isPermeable(triangle) &&
        context.model.domainSides[triangle] == SurfaceModel::noSide)
    {
      const double up = normal[2] / normal.norm();
      out.volumes.displacedByModel += (front == View::air ? up : -up) * inside.heightTimesArea;
    }
  }

  const DualMesh& mesh;
  const std::vector<TriangleViews>& views;
  const std::vector<float>& airParts;
  const OwnElements& part;
  const MeshingContext& context;
  const GridFrame& frame;
  std::size_t count;
  SumUnits areas;
  SumUnits volumes;
  std::vector<double> wet;
  double top = 0.0;
  MeshAudit out;
};

} // namespace

double SurfaceAudit::coverage() const
{
  const double wanted = drawnArea - underGround - inSolid - inRoom - shared;
  return wanted > 0.0 ? std::min(1.0, meshArea / wanted) : 1.0;
}

MeshAudit auditMesh(const DualMesh& mesh, const SeenModel& seen, const OwnElements& part, const MeshingContext& context)
{
  return Auditor(mesh, seen, part, context).run(seen);
}

std::vector<ViewAreas> areasOf(const UnreachedParts& parts, const SurfaceModel& whole, const GridFrame& frame)
{
  std::vector<ViewAreas> areas;
  if (parts.any())
  {
    const ConvexRegion region(frame.domain, frame.latticeUnit());
    areas.resize(whole.names.size());
    for (Index t = 0; t < whole.triangles.size(); ++t)
    {
      if (parts.isUnreached[t])
      {
        const auto at = [&](int i) { return frame.toModel(whole.corner(t, i)); };
        hiddenArea(areas[whole.surfaceIds[t]], parts.views[t]) += region.within(at(0), at(1), at(2), 0.0).area;
      }
    }
  }
  return areas;
}

void finishAudit(const DrawnSurfaces& drawn, const SurfaceRepairReport& repair, MeshAudit& audit)
{
  for (const HiddenDetail& detail : repair.hidden)
  {
    audit.surfaces[detail.surface].leftOut = detail.leftOutArea;
  }
  for (const SharedArea& shared : repair.shared)
  {
    audit.surfaces[shared.gives].shared += shared.area;
  }
  for (std::size_t i = 0; i < audit.surfaces.size(); ++i)
  {
    SurfaceAudit& surface = audit.surfaces[i];
    // Openings that were found by rule are not drawn.
    const bool isDrawn = i < drawn.areas.size();
    surface.drawnArea = isDrawn ? drawn.areas[i] : surface.meshArea;
    surface.outside = isDrawn ? drawn.outside[i] : 0.0;
    surface.extent = isDrawn ? drawn.extents[i] : 0.0;
    surface.lost = std::max(0.0, surface.drawnArea - surface.meshArea - surface.underGround - surface.inSolid -
                                     surface.inRoom - surface.shared - surface.leftOut);
  }
}

void placeInModel(MeshAudit& audit, const Placement& placement)
{
  for (SurfaceAudit& surface : audit.surfaces)
  {
    for (FarthestPlace* place : {&surface.distances.ofFaces, &surface.distances.ofSurface})
    {
      place->at = placement.toModel(place->at);
    }
  }
}

} // namespace atria
