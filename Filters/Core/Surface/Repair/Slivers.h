// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Repair/Contacts.h"

namespace atria {

/// A triangle without width has a corner on its own long edge, by the contacts. Its long edge and the two others get
/// the same points: cut, its outline then goes to and fro, and nothing of it is left. With points on one of its edges
/// only it would be cut into more of its kind, and these into more. Contacts are sorted and stay so.
void alignSlivers(const TriangleSoup& soup, std::vector<EdgeContact>& contacts);

} // namespace atria
