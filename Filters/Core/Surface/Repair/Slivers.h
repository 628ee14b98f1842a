// SPDX-License-Identifier: GPL-3.0-or-later
/// Aligns the points on the edges of triangles without width.
#pragma once

#include "Surface/Repair/Contacts.h"

namespace atria {

/// Adds contacts so that the long edge of a triangle without width gets the same points as the two others. Such a
/// triangle has a corner on its own long edge, by the contacts. When it is cut, its outline then goes to and fro, and
/// nothing of it is left. With points on one of its edges only it would be cut into more slivers, and these into more.
/// Contacts are sorted and stay so.
void alignSlivers(const TriangleSoup& soup, std::vector<EdgeContact>& contacts);

} // namespace atria
