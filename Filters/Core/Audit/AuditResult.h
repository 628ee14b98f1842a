// SPDX-License-Identifier: GPL-3.0-or-later
/// Differences between a mesh and the model it was made of.
#pragma once

#include "Support/Types.h"

#include <vector>

namespace atria {

/// The place farthest from what it should lie on.
struct FarthestPlace
{
  /// Distance in model units, and in sizes of the elements there.
  double distance = 0.0;
  double inElements = 0.0;
  /// Along the grid's axes until the mesh is placed in the model.
  Vec3 at = Vec3::Zero();
};

struct SurfaceDistances
{
  /// Farthest place from the surface among corners and middles of its faces.
  FarthestPlace ofFaces;
  /// Farthest place of the surface from the nearest of its faces; 0 below a tenth of an element. A surface without
  /// faces has none.
  FarthestPlace ofSurface;
};

/// A body with air inside of it.
struct AiredBody
{
  Index surface;
  /// Volume of the air in a closed body or of the box around an open one, in cubic model units.
  double volume;
  /// Along the model's axes.
  Vec3 place;
};

struct BodyAudit
{
  /// Number of closed bodies that reach into the domain, and their volume within it, where overlaps count once. Bodies
  /// of ground surfaces are not counted.
  std::size_t closed = 0;
  double volume = 0.0;
  /// The sum of the bodies' volumes within the domain beyond `volume`: what n bodies share counts n − 1 times.
  double overlap = 0.0;
  /// True if no ground surface rises above the domain's bottom by more than half of `sizeMin`: solids alone are left
  /// out of the domain.
  bool isOnFlatGround = false;
  /// Closed bodies around a zone that is meshed.
  std::vector<AiredBody> hollow;
  /// Bodies that are open, but enclose most directions seen from their middles, and hold no zone that is left out.
  std::vector<AiredBody> open;
};

/// The model's and the mesh's areas of one surface, and the elements there. Areas are in square model units.
struct SurfaceAudit
{
  /// Area as drawn, within the domain.
  double drawnArea = 0.0;
  /// Area as drawn, beyond the domain's sides or below its bottom.
  double outside = 0.0;
  /// Area in the model that is meshed, with extended terrain and without faces that another surface keeps.
  double placedArea = 0.0;
  /// Area of the surface's faces in the mesh. Faces with elements on both sides count once.
  double meshArea = 0.0;
  /// Areas of parts that see no air: on or under the ground, in solids, in closed rooms that are not meshed.
  double underGround = 0.0;
  double inSolid = 0.0;
  double inRoom = 0.0;
  /// Area of parts that lie upon others, where one is dropped, and of small parts that the repair left out.
  double shared = 0.0;
  double leftOut = 0.0;
  /// The remaining area, which is finer than the mesh.
  double lost = 0.0;
  /// Elements at the surface, in model units: the mean by area, the largest, and the size that was requested.
  double meanSize = 0.0;
  double largestSize = 0.0;
  double requestedSize = 0.0;
  /// The diagonal of the surface's bounds.
  double extent = 0.0;
  SurfaceDistances distances;

  /// Returns the area that air sees, which should be in the mesh.
  double seenArea() const { return placedArea - underGround - inSolid - inRoom; }
  /// Returns the part of the area that should be in the mesh and is; 1 if none should.
  double coverage() const;
};

/// Volumes in cubic model units.
struct VolumeAudit
{
  double domain = 0.0;
  /// Volume of the elements.
  double air = 0.0;
  /// Returns the rest of the domain: solids, rooms that are not meshed, and the space under the ground.
  double displaced() const { return domain - air; }
  /// The same by the model: the volume enclosed by faces that see air on one side.
  double displacedByModel = 0.0;
};

struct MeshAudit
{
  /// One entry per surface.
  std::vector<SurfaceAudit> surfaces;
  VolumeAudit volumes;
  BodyAudit bodies;
};

} // namespace atria
