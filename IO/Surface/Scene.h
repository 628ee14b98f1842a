// SPDX-License-Identifier: GPL-3.0-or-later
/// The result of evaluating a scene: triangles, and the shapes, groups and materials they come from.
#pragma once

#include "Support/Types.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace atria::scene {

/// The look of a shape; two with the same values are one.
struct Material
{
  std::string name; ///< DEF name of the material, else of its appearance; UTF-8, empty without
  Vec3 diffuse = Vec3::Constant(0.8);
  double transparency = 0.0;

  friend bool operator<(const Material& a, const Material& b)
  {
    const auto key = [](const Material& m) {
      return std::tie(m.name, m.diffuse[0], m.diffuse[1], m.diffuse[2], m.transparency);
    };
    return key(a) < key(b);
  }
};

/// A use of a node with a DEF name, or of a file, with all nodes inside.
struct Group
{
  std::string name;
  Index parent = noIndex;
  std::size_t depth = 0; ///< groups around it
};

/// A Shape met, or a geometry node of VRML 1.0. One that is used several times is met as often.
struct Shape
{
  std::string name;         ///< its own, by DEF; UTF-8, empty without
  Index group = noIndex;    ///< the innermost one around it
  Index material = noIndex; ///< none where the file gives none
};

struct Scene
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> shapeIds; ///< per triangle
  std::vector<Index> faceIds;  ///< per triangle: the polygon it was cut from; ascending
  std::vector<Shape> shapes;   ///< shapes with triangles
  std::vector<Group> groups;
  std::vector<Material> materials;
  /// Number of nodes met that make no surface, keyed by type.
  std::map<std::string, std::size_t> skipped;
};

} // namespace atria::scene
