// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts triangles at their contacts.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/Contacts.h"

#include <set>

namespace atria {

/// Divides the triangles that have points on them into pieces, with the segments that two triangles have in common as
/// edges. The contacts' points are points of the soup. Afterwards `changes` marks the pieces of triangles that were
/// cut, and `sourceIsSplit` their sources. Edges of `meetings` that were cut are replaced by their pieces, and the
/// segments are added.
void cutTriangles(TriangleSoup& soup, const Contacts& contacts, double reach, std::vector<Change>& changes,
                  std::vector<char>& sourceIsSplit, std::set<EdgeKey>& meetings, const RunContext& context);

} // namespace atria
