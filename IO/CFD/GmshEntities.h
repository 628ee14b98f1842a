// SPDX-License-Identifier: GPL-3.0-or-later
/// The surfaces and volumes that a Gmsh file consists of.
#pragma once

#include "ElementMesh.h"

#include <string>
#include <vector>

namespace atria {

/// A physical surface or volume: what the user selects by name.
struct GmshGroup
{
  int dimension;
  std::size_t tag;
  std::string word; ///< in the file
  std::string name; ///< as the input has it
};

/// A surface is a patch. A volume is the cells that are in the same zones, such as in a room and in a tree.
struct GmshEntity
{
  std::vector<Index> members; ///< faces or cells
  std::vector<Index> groups;  ///< tags of its groups; the one of fewest cells, as of a tree in a room, comes first
  std::vector<Index> bounds;  ///< tags of the surfaces around a volume
  std::vector<Index> points;  ///< each point of the mesh is in one entity, and rather in a surface than in a volume
  Vec3 low;
  Vec3 high;
};

/// Tags of entities are their places in the lists, from 1 on. Tags of groups differ also between dimensions.
struct GmshEntities
{
  std::vector<GmshGroup> groups;
  std::vector<GmshEntity> surfaces;
  std::vector<GmshEntity> volumes;
};

GmshEntities gmshEntitiesOf(const ElementMesh& mesh);

} // namespace atria
