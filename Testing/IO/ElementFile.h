// SPDX-License-Identifier: GPL-3.0-or-later
/// Small readers of formats of finite elements. They share no code with the writers.
#pragma once

#include "SolverMeshFacts.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace atria::testing {

/// A mesh as a file has it, by the file's own numbers.
struct ElementFile
{
  using Nodes = std::vector<std::int64_t>;
  std::map<std::int64_t, Vec3> points;
  /// Nodes in the order that Gmsh and Abaqus have in common. The number of nodes gives the type.
  std::map<std::int64_t, Nodes> elements;
  std::map<std::string, std::vector<Nodes>> surfaces;
  std::map<std::string, Nodes> zones; ///< elements
};

/// Reads Gmsh's format 4.1. Fails the test where counts are wrong and where a number is there twice.
ElementFile readGmsh(const std::string& file);

/// Reads an input file of Abaqus, with faces as Abaqus' manual numbers them. Fails the test at what Abaqus does not
/// take: long lines, numbers and names, and equal names.
ElementFile readAbaqus(const std::string& file);

/// Fails the test where an element is inside out, or surfaces are not the boundary of the elements, each face once.
/// `turned`: whether the surfaces' faces also have their normals outward.
MeshFacts factsOf(const ElementFile& mesh, bool turned);

/// The sum of the volumes of a zone's elements.
double volumeOf(const ElementFile& mesh, const std::string& zone);

} // namespace atria::testing
