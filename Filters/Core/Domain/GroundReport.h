// SPDX-License-Identifier: GPL-3.0-or-later
/// Report on how the bodies of a model stand on its ground.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// A connected part of the model, and its distance from the ground.
struct BodyAtGround
{
  /// Name of the surface that has most of its base.
  std::string name;
  /// Distance between its base and the ground, in model units; positive.
  double distance = 0.0;
  /// Volume of the air below a base that hovers, in cubic model units.
  double airBelow = 0.0;
  /// A place of its base as drawn, along the model's axes.
  Vec3 place = Vec3::Zero();
  /// True if it hovers by less than an element or a quarter of its height, so that it may have been meant to stand.
  bool isDoubtful = false;
};

struct GroundReport
{
  /// Height of the ground if there is neither terrain nor site.
  double floor = 0.0;
  /// Number of bodies that reach the ground as drawn, including those that reach below it.
  std::size_t standing = 0;
  /// Bodies whose bases were moved down to the ground, the greatest distance first.
  std::vector<BodyAtGround> letDown;
  /// Bodies with air between their bases and the ground, and with nothing else below them; the smallest gap first.
  std::vector<BodyAtGround> hovering;
  /// Bodies that reach below the ground, as cellars do; the deepest first.
  std::vector<BodyAtGround> belowGround;
  /// Closed ground surfaces, such as slabs. Only their upper side is meshed.
  std::vector<std::string> slabs;
  /// Warnings for the user about bodies that hover; a sentence or more each.
  std::vector<std::string> warnings;
  /// Notes on changes made, and on things that are as they should be; a sentence each.
  std::vector<std::string> notes;

  double greatestLetDown() const { return letDown.empty() ? 0.0 : letDown.front().distance; }
};

} // namespace atria
