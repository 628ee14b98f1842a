// SPDX-License-Identifier: GPL-3.0-or-later
/// Gives elements room that cannot be made valid where the model wants their vertices.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// A vertex that is not where the model wants it, as no element would be valid there otherwise.
struct DetachedVertex
{
  Index point;
  Vec3 wanted;
};

/// A vertex that left its pieces of the model, by its leader.
struct LeftVertex
{
  Index point;
  Vec3 before; ///< where it was then
  /// Where it ought to be, seen from a place. Looked up again where it is at another one.
  Vec3 from = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 wanted = before;
};

/// Vertices leave curves for the surfaces that meet there; they leave surfaces; they start again from the centers of
/// their octants, where the plain mesh is valid; the layer is left out. Then each goes back as far as it can.
class VertexDetachment
{
public:
  /// Some vertices are not where the model wants them yet, in rising order.
  explicit VertexDetachment(ImproverState& state, const std::vector<DetachedVertex>& away = {});

  /// Improves cells by the first stage, and takes all room steps that bad ones need. Whether vertices left.
  bool improveAndMend();
  /// Takes vertices back to where the model wants them, as far as elements stay valid; their neighbors make room.
  void putBack();
  /// Lets the points of cells leave their curves, and their surfaces by `reach` octants.
  void detach(const std::vector<ShortCell>& cells, double reach);
  /// Forgets the points that are back; the others stay where they are.
  void keepThoseAway();
  /// Those that did not get back, in rising order of points.
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
  /// By leader: whether it is on a side of the domain that is bare there.
  std::vector<char> isOnSide_;
  /// Each once.
  std::vector<LeftVertex> left_;
  std::vector<char> isLeft_;
  std::vector<DetachedVertex> detached_;
};

} // namespace atria
