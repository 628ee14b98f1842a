// SPDX-License-Identifier: GPL-3.0-or-later
/// What ranks that share a mesh have to say of it, brought together.
#pragma once

#include "Dual/Zones/Cracks.h"
#include "Dual/Zones/ZoneSummary.h"
#include "Mesher/DualImprover.h"
#include "Mesher/PlainDual.h"
#include "Mesher/Shares/SharedPiece.h"

namespace atria {

/// Each rank tells what is at its own elements. The first rank then has everything, in the order of one process.
class SharedReport
{
public:
  explicit SharedReport(const RankShare& share) : share_(share) {}

  /// Of the zones of all ranks; on all of them. See findZoneFacts.
  ZoneFacts findFacts(const Zones& zones, const GridPlaces& places, const Crossings& crossings,
                      const SharedPoints& points, std::size_t surfaceCount, const std::vector<char>& isGround,
                      const MeshingContext& context) const;
  /// See findCracks. `kept` has an entry more, for points of no zone that is known here.
  void addCracks(const CrossedGrid& grid, const Zones& zones, const std::vector<char>& kept, const SharedPoints& points,
                 const MeshingContext& context);
  /// What was found at plain elements; `keys` has their grid points.
  void addPlain(const std::vector<Diagnostic>& found, const std::vector<PointKey>& keys);
  /// Elements that are not in the mesh any more; `layers` is from before.
  void addLeftOut(const ImprovedMesh& improved, const SharedLayers& layers);
  void addDetached(const ImprovedMesh& improved, const SharedPiece& piece);

  /// The elements beside what was told, whose numbers finish() asks for.
  std::vector<SharedElement> elements() const;
  /// All diagnostics, on the first rank; empty on others.
  std::vector<Diagnostic> finish(const std::vector<std::uint64_t>& numbers) const;

private:
  /// What follows each other in the diagnostics of one process.
  enum class Group : std::uint8_t
  {
    cracks,
    merged,
    unresolved,
    leftOut,
    detached
  };
  struct Entry
  {
    Group group;
    Diagnostic::Kind kind;
    Vec3 begin;
    Vec3 end;
    double width;
    /// In its group and rank.
    std::uint64_t place;
    std::uint64_t element; ///< its number in the mesh of all, where it is known already
    SharedElement beside;  ///< else noElement where there is none
  };
  static constexpr SharedElement noElement{noKey, noIndex, 0};
  static Diagnostic diagnosticOf(const Entry& entry);

  const RankShare& share_;
  std::vector<Entry> entries_;
  std::vector<std::vector<Vec3>> paths_; ///< of cracks, which the first rank alone has
};

} // namespace atria
