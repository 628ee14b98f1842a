// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a domain suits its model.
#pragma once

#include "Domain/PlacedModel.h"

namespace atria {

/// How the buildings, which are all surfaces that are no ground, lie at the domain's sides; of a prism of other than
/// four sides those of the box about it. The bottom is the ground:
/// what is below it does not count.
struct DomainContacts
{
  /// Whether any face has area in the domain or on its sides.
  bool holdsModel = false;
  /// Whether there are faces of buildings that do not lie on the height of the bottom, as ground without a name does;
  /// and whether any of them has area in the domain or on its sides.
  bool hasBuildings = false;
  bool holdsBuildings = false;
  /// By side: surfaces that go on beyond it, by id.
  std::array<std::vector<Index>, 6> cut;
  /// By side that cuts nothing: surfaces that end on it, or less than half an octant before it, so that there is no air
  /// beside or above them. Left out are walls of the domain, as of a room: on a side of which faces of the model make
  /// up half or more; and partitions: faces square to the side of a surface that reaches the side across as well,
  /// unless the model goes on beyond the side.
  std::array<std::vector<Index>, 6> touching;
  /// More than half of the height of the buildings above or below the domain lies below its bottom.
  bool isBuried = false;
};

/// `sizeMin` is the edge length of octants at features. O(n).
DomainContacts findDomainContacts(const TriangleSurface& surface, const SitePlan& plan, double sizeMin);

/// What a user should know of the domain: one sentence or more each. Nothing where it follows from the model, in modes
/// `surfaces` and `automatic`, and without a model. Throws Error where the domain holds nothing of the model.
std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, DomainMode mode,
                                     double sizeMin);

} // namespace atria
