// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surfaces.h"

#include "Support/IndexTable.h"
#include "Surface/Triangles/SmoothPieces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <unordered_set>

namespace atria::scene {

namespace {

/// A requested name, and the group above that distinguishes it from equal ones.
struct Wanted
{
  std::string leaf;
  Index group = noIndex;
};

/// Returns the groups from the outside to the inside. Empty in files nested deeper than anybody names things, where it
/// would take quadratic time.
std::vector<Index> pathOf(const Scene& scene, Index group)
{
  constexpr std::size_t deepest = 256;
  std::vector<Index> path;
  if (group != noIndex && scene.groups[group].depth > deepest)
  {
    return path;
  }
  for (; group != noIndex; group = scene.groups[group].parent)
  {
    path.push_back(group);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// Returns, for each text, the first that is the same.
template <class TextOf> std::vector<Index> firstsOf(std::size_t count, const TextOf& textOf)
{
  IndexTable table(count);
  std::vector<Index> firsts(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string& text = textOf(i);
    firsts[i] = table.findOrAdd(mixed(std::hash<std::string>{}(text)), static_cast<Index>(i),
                                [&](Index other) { return textOf(other) == text; });
  }
  return firsts;
}

/// Returns the first difference, from the outside, between the groups ahead of some names. Empty for a name without
/// one.
std::vector<std::string> differences(const Scene& scene, const std::vector<Wanted>& wanted,
                                     const std::vector<std::size_t>& members)
{
  std::vector<std::vector<Index>> paths;
  for (const std::size_t i : members)
  {
    paths.push_back(pathOf(scene, wanted[i].group));
  }
  const auto name = [&](std::size_t path, std::size_t level) -> const std::string& {
    static const std::string none;
    return level < paths[path].size() ? scene.groups[paths[path][level]].name : none;
  };
  std::size_t level = 0;
  const auto agree = [&] {
    return std::all_of(paths.begin(), paths.end(), [&](const auto& path) {
      return level < path.size() && scene.groups[path[level]].name == name(0, level);
    });
  };
  while (agree())
  {
    ++level;
  }
  std::vector<std::string> out;
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    out.push_back(name(k, level));
  }
  return out;
}

/// Puts the first difference ahead of names that repeat. Returns true if there were any.
bool qualify(const Scene& scene, const std::vector<Wanted>& wanted, std::vector<std::string>& names)
{
  const std::vector<Index> firsts =
      firstsOf(wanted.size(), [&](std::size_t i) -> const std::string& { return wanted[i].leaf; });
  std::map<Index, std::vector<std::size_t>> repeated;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (firsts[i] != i)
    {
      std::vector<std::size_t>& members = repeated[firsts[i]];
      members.insert(members.end(), members.empty() ? 1 : 0, firsts[i]);
      members.push_back(i);
    }
  }
  names.reserve(wanted.size());
  for (const Wanted& each : wanted)
  {
    names.push_back(each.leaf);
  }
  for (const auto& [first, members] : repeated)
  {
    const std::vector<std::string> ahead = differences(scene, wanted, members);
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      names[members[k]].insert(0, ahead[k].empty() ? "" : ahead[k] + "/");
    }
  }
  return !repeated.empty();
}

/// Numbers equal names: `Name`, then `Name_2`, `Name_3`, …, without numbers that other names already have.
void number(std::vector<std::string>& names)
{
  const std::vector<Index> firsts =
      firstsOf(names.size(), [&](std::size_t i) -> const std::string& { return names[i]; });
  std::vector<Index> repeats;
  std::unordered_set<std::string_view> given; // names that stay
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (firsts[i] != i)
    {
      repeats.push_back(static_cast<Index>(i));
    }
  }
  for (std::size_t i = 0; i < names.size() && !repeats.empty(); ++i)
  {
    if (firsts[i] == i)
    {
      given.insert(names[i]);
    }
  }
  std::vector<int> count(repeats.empty() ? 0 : names.size(), 1);
  for (const Index i : repeats)
  {
    const std::string& name = names[firsts[i]];
    do
    {
      names[i] = name + "_" + std::to_string(++count[firsts[i]]);
    } while (given.count(names[i]) != 0);
  }
}

std::string colorName(const Material& material)
{
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))); };
  char text[32];
  std::snprintf(text, sizeof text, "Material_%02X%02X%02X", byte(material.diffuse[0]), byte(material.diffuse[1]),
                byte(material.diffuse[2]));
  return material.transparency > 0.0 ? std::string(text) + "_Transparent" : text;
}

/// Returns the innermost named group. Shapes in none have a group of their own.
Wanted groupName(const Scene& scene, Index group)
{
  return group == noIndex ? Wanted{"Ungrouped", noIndex} : Wanted{scene.groups[group].name, scene.groups[group].parent};
}

Wanted shapeName(const Scene& scene, const Shape& shape)
{
  if (!shape.name.empty())
  {
    return {shape.name, shape.group};
  }
  if (shape.group != noIndex)
  {
    return groupName(scene, shape.group);
  }
  const bool named = shape.material != noIndex && !scene.materials[shape.material].name.empty();
  return {named ? scene.materials[shape.material].name : "Shape", noIndex};
}

Wanted materialName(const Scene& scene, Index material)
{
  if (material == noIndex)
  {
    return {"NoMaterial", noIndex};
  }
  const Material& look = scene.materials[material];
  return {look.name.empty() ? colorName(look) : look.name, noIndex};
}

/// Returns a number for each triangle, equal within a surface.
std::vector<Index> keysOf(const Scene& scene, SurfaceBy by, double splitAngle)
{
  if (by == SurfaceBy::connected)
  {
    return smoothPieces(scene.points, scene.triangles, scene.shapeIds, splitAngle);
  }
  std::vector<Index> keys = scene.shapeIds;
  if (by != SurfaceBy::shape)
  {
    for (Index& key : keys)
    {
      const Shape& shape = scene.shapes[key];
      key = by == SurfaceBy::group ? shape.group : shape.material;
    }
  }
  return keys;
}

} // namespace

Surfaces makeSurfaces(const Scene& scene, SurfaceBy by, double splitAngle)
{
  Surfaces out;
  const std::vector<Index> keys = keysOf(scene, by, splitAngle);
  out.ids.resize(keys.size());
  std::vector<Wanted> wanted;
  std::vector<Index> materials;
  std::vector<Index> idOfKey; // from noIndex + 1, which is 0
  for (std::size_t i = 0, last = 0; i < out.ids.size(); ++i)
  {
    if (i > 0 && keys[i] == keys[i - 1] && scene.shapeIds[i] == scene.shapeIds[i - 1])
    {
      out.ids[i] = static_cast<Index>(last);
      continue;
    }
    const Shape& shape = scene.shapes[scene.shapeIds[i]];
    const Index key = keys[i] + 1;
    idOfKey.resize(std::max<std::size_t>(idOfKey.size(), std::size_t{key} + 1), noIndex);
    Index& id = idOfKey[key];
    if (id == noIndex)
    {
      id = static_cast<Index>(wanted.size());
      wanted.push_back(by == SurfaceBy::group      ? groupName(scene, shape.group)
                       : by == SurfaceBy::material ? materialName(scene, shape.material)
                                                   : shapeName(scene, shape));
      materials.push_back(shape.material);
    }
    last = id;
    out.ids[i] = id;
    Index& material = materials[id];
    material = material == noIndex ? shape.material : material;
  }
  std::vector<std::string> names;
  if (qualify(scene, wanted, names))
  {
    number(names);
  }
  out.surfaces.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    out.surfaces.push_back({std::move(names[i]), materials[i] == noIndex ? Material{} : scene.materials[materials[i]]});
  }
  return out;
}

} // namespace atria::scene
