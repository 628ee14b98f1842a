// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks that a domain suits its model.
#pragma once

#include "Domain/PlacedModel.h"

namespace atria {

/// Contacts of the buildings with the domain's sides. Buildings are all surfaces that are not ground. A prism of other
/// than four sides is judged by the sides of the box around it. Parts below the bottom do not count, as the bottom is
/// the ground.
struct DomainContacts
{
  /// True if any face has area in the domain or on its sides.
  bool holdsModel = false;
  /// True if buildings have faces other than at the bottom's height, where faces count as ground without a name; and
  /// true if any of these faces has area in the domain or on its sides.
  bool hasBuildings = false;
  bool holdsBuildings = false;
  /// One entry per side: ids of surfaces that go on beyond it.
  std::array<std::vector<Index>, 6> cut;
  /// One entry per side that cuts nothing: ids of surfaces that end on it, or less than half an octant before it, so
  /// that there is no air beside or above them. Two kinds are left out:
  /// - walls of the domain, as of a room: on a side of which faces of the model make up half or more;
  /// - partitions: faces square to the side, of a surface that reaches the opposite side as well, unless the model goes
  ///   on beyond the side.
  std::array<std::vector<Index>, 6> touching;
  /// True if more than half of the height of the buildings above or below the domain lies below its bottom.
  bool isBuried = false;
};

/// Returns the contacts of buildings with the domain's sides. `sizeMin` is the edge length of octants at features.
/// O(n).
DomainContacts findDomainContacts(const TriangleSurface& surface, const SitePlan& plan, double sizeMin);

/// Returns warnings about the domain for the user, one sentence or more each. The list is empty in modes `surfaces` and
/// `automatic`, where the domain follows from the model, and without a model. Throws Error if the domain holds nothing
/// of the model.
std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, DomainMode mode,
                                     double sizeMin);

} // namespace atria
