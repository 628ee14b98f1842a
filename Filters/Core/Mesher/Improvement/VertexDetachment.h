// SPDX-License-Identifier: GPL-3.0-or-later
/// Gives room to elements that cannot be valid where the model wants their vertices.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// A vertex that is not where the model wants it, because elements would be invalid there.
struct DetachedVertex
{
  Index point;
  Vec3 wanted;
};

/// A vertex that left its pieces of the model.
struct LeftVertex
{
  Index point; ///< its leader
  Vec3 before; ///< its former place
  /// Place where the model wants it, as found from `from`. It is sought again once the vertex has moved.
  Vec3 from = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 wanted = before;
};

/// Lets vertices leave the model by the room steps (RoomStep), and moves each back as far as elements allow.
class VertexDetachment
{
public:
  /// Vertices in `away`, sorted by point, are not where the model wants them yet.
  explicit VertexDetachment(ImproverState& state, const std::vector<DetachedVertex>& away = {});

  /// Improves cells by the first stage, and makes all room steps that bad ones need. Returns true if vertices left.
  bool improveAndMend();
  /// Moves vertices back to where the model wants them, as far as elements stay valid; their neighbors make room.
  void putBack();
  /// Lets the points of cells leave their curves, and their surfaces by `reach` octants.
  void detach(const std::vector<ShortCell>& cells, double reach);
  /// Forgets vertices that are back, and fixes the others where they are.
  void keepThoseAway();
  /// Returns the vertices that did not get back, sorted by point.
  const std::vector<DetachedVertex>& detached() const { return detached_; }

private:
  std::vector<ShortCell> improve(std::vector<ShortCell> cells);
  std::vector<ShortCell> badAmong(const std::vector<ShortCell>& cells) const;
  void mend(const std::vector<ShortCell>& cells);
  void make(RoomStep step, const std::vector<ShortCell>& bad);
  void noteLeft(Index leader);
  void leaveCurve(Index leader);
  void leaveSurface(Index leader, double reach);
  void leaveSides();
  void startAgain(const std::vector<ShortCell>& bad, double share);
  void exclude(const std::vector<ShortCell>& bad);
  std::vector<WantedPlace> findWantedPlaces();
  template <typename Visit> void eachLeaderOf(const std::vector<ShortCell>& cells, Visit&& visit) const;

  ImproverState& state_;
  ImproverStage first_ = firstStage(state_.traits);
  /// One entry per leader: 1 if it is on a bare side of the domain.
  std::vector<char> isOnSide_;
  /// Vertices away from the model, each once.
  std::vector<LeftVertex> left_;
  std::vector<char> isLeft_;
  std::vector<DetachedVertex> detached_;
};

} // namespace atria
