// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surfaces.h"

#include "Surface/SmoothPieces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>

namespace atria::vrml {

namespace {

/// A name asked for, and the group above from which it gets distinguished.
struct Wanted
{
  std::string leaf;
  Index group = noIndex;
};

/// From the outside to the inside; left empty in files nested deeper than anybody names things, where it would take
/// the square of the time.
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

/// The names that still repeat get their first difference from the others ahead of them.
std::vector<std::string> qualified(const Scene& scene, const std::vector<Wanted>& wanted)
{
  std::unordered_map<std::string, std::vector<std::size_t>> byLeaf;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    byLeaf[wanted[i].leaf].push_back(i);
  }
  std::vector<std::string> names(wanted.size());
  for (const auto& [leaf, members] : byLeaf)
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
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      const std::string& ahead = name(k, level);
      names[members[k]] = ahead.empty() ? leaf : std::string(ahead).append("/").append(leaf);
    }
  }
  return names;
}

/// `Name`, then `Name_2`, `Name_3`, …, passing over names that something else has.
void number(std::vector<std::string>& names)
{
  std::unordered_map<std::string, int> last;
  for (const std::string& name : names)
  {
    last.try_emplace(name, 0);
  }
  for (std::string& name : names)
  {
    if (last[name]++ == 0)
    {
      continue;
    }
    const std::string wanted = name;
    do
    {
      name = wanted + "_" + std::to_string(last[wanted]++);
    } while (last.count(name) != 0);
    --last[wanted];
    last[name] = 1;
  }
}

std::string colourName(const Material& material)
{
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))); };
  char text[32];
  std::snprintf(text, sizeof text, "Material_%02X%02X%02X", byte(material.diffuse[0]), byte(material.diffuse[1]),
                byte(material.diffuse[2]));
  return material.transparency > 0.0 ? std::string(text) + "_Transparent" : text;
}

/// The innermost named group; what is in none has a group of its own.
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
  return {look.name.empty() ? colourName(look) : look.name, noIndex};
}

/// What the triangles of one surface have in common, as a number.
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
  std::unordered_map<Index, Index> idOfKey;
  for (std::size_t i = 0, last = 0; i < out.ids.size(); ++i)
  {
    if (i > 0 && keys[i] == keys[i - 1] && scene.shapeIds[i] == scene.shapeIds[i - 1])
    {
      out.ids[i] = static_cast<Index>(last);
      continue;
    }
    const Shape& shape = scene.shapes[scene.shapeIds[i]];
    const auto [found, isNew] = idOfKey.try_emplace(keys[i], static_cast<Index>(wanted.size()));
    if (isNew)
    {
      wanted.push_back(by == SurfaceBy::group      ? groupName(scene, shape.group)
                       : by == SurfaceBy::material ? materialName(scene, shape.material)
                                                   : shapeName(scene, shape));
      materials.push_back(shape.material);
    }
    last = found->second;
    out.ids[i] = found->second;
    Index& material = materials[found->second];
    material = material == noIndex ? shape.material : material;
  }
  std::vector<std::string> names = qualified(scene, wanted);
  number(names);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    out.surfaces.push_back({names[i], materials[i] == noIndex ? Material{} : scene.materials[materials[i]]});
  }
  return out;
}

} // namespace atria::vrml
