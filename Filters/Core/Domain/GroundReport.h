// SPDX-License-Identifier: GPL-3.0-or-later
/// How the bodies of a model stand on its ground.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// A connected part of the model, and how far it is from the ground.
struct BodyAtGround
{
  /// Of the surface that has most of its base.
  std::string name;
  /// Between its base and the ground, in model units; positive.
  double distance = 0.0;
  /// Of the air below a base that hovers; cubic model units.
  double airBelow = 0.0;
  /// A place of its base as drawn, along the model's axes.
  Vec3 place = Vec3::Zero();
  /// It hovers by less than an element or a quarter of its height, so that it may have been meant to stand.
  bool isDoubtful = false;
};

struct GroundReport
{
  /// Height of the ground where there is neither terrain nor site.
  double floor = 0.0;
  /// Bodies that reach the ground as drawn, those that reach below it among them.
  std::size_t standing = 0;
  /// Bodies whose bases were moved down to the ground, the greatest distance first.
  std::vector<BodyAtGround> letDown;
  /// Bodies with air between their bases and the ground and with nothing else below them, the smallest gap first.
  std::vector<BodyAtGround> hovering;
  /// Bodies that reach below the ground, as cellars do, the deepest first.
  std::vector<BodyAtGround> belowGround;
  /// Ground surfaces that are closed, as slabs are, of which the upper side alone is meshed.
  std::vector<std::string> slabs;
  /// What a user should know of bodies that hover; a sentence or more each.
  std::vector<std::string> warnings;
  /// What was done, or is as it should be; a sentence each.
  std::vector<std::string> notes;

  double greatestLetDown() const { return letDown.empty() ? 0.0 : letDown.front().distance; }
};

} // namespace atria
