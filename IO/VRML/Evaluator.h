// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Geometry.h"
#include "Instances.h"
#include "Library.h"

#include <Eigen/Geometry>

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace atria::vrml {

/// A model as one list of triangles in the coordinates of the file.
struct Model
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> surfaceIds; ///< per triangle
  std::vector<std::string> surfaceNames;
  std::vector<std::string> materialNames;
  /// Nodes met that make no surface, by type.
  std::map<std::string, std::size_t> skipped;
};

/// Walks through a VRML97 scene and collects its surfaces, one for each Shape met. Does not recurse.
class Evaluator
{
public:
  Evaluator(Library& files, Diagnostics& messages, const ProgressRange& monitor, double tessellationDegrees);

  /// Throws Error where nodes multiply without end, Aborted where the caller stops it.
  Model run(const Document& document);

private:
  using Transform = Eigen::Affine3d;
  struct Visit
  {
    NodeRef ref;
    Transform transform;
    std::string_view name; ///< the nearest DEF name above
    bool leave = false;    ///< the end of a visit: the node is no longer on the path
  };

  void visit(const Visit& at);
  bool enter(const Visit& at);
  void visitGroup(const Visit& at);
  void visitInline(const Visit& at);
  void pushChildren(const Visit& at, const std::vector<NodeRef>& children);
  Transform transformOf(const NodeRef& ref) const;
  void addShape(const Visit& at);
  void addGeometry(const Visit& at, const NodeRef& geometry, std::string_view name, const std::string& material);
  const LocalSurface& localSurface(const NodeRef& geometry);
  std::string uniqueName(const std::string& wanted);
  void warn(const Node& node, const std::string& text);

  Library& library;
  Diagnostics& diagnostics;
  ProgressRange progress;
  Instances instances;
  Geometry geometries;
  std::vector<Visit> open;
  std::set<std::pair<const Node*, const Context*>> path; ///< shared nodes and files being visited, against cycles
  std::unordered_map<const Node*, LocalSurface> cache;   ///< of geometry used more than once
  LocalSurface current;
  std::unordered_map<std::string, int> names; ///< names in use, with the last number given to each
  Model model;
};

} // namespace atria::vrml
