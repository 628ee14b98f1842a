// SPDX-License-Identifier: GPL-3.0-or-later
/// excludeSurfaces of Surfaces.h.
#include "Surfaces.h"

#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/Text.h"

#include <algorithm>
#include <functional>

namespace atria::scene {

namespace {

std::vector<std::string> namesOf(const Surfaces& surfaces)
{
  std::vector<std::string> names;
  std::ranges::transform(surfaces.surfaces, std::back_inserter(names), &Surface::name);
  return names;
}

/// Returns, for each surface, true if a pattern matches it. Warns of patterns that match none.
std::vector<char> matching(const Surfaces& surfaces, const std::vector<std::string>& patterns, Diagnostics& diagnostics)
{
  const std::vector<std::string> names = namesOf(surfaces);
  std::vector<char> matches(names.size(), 0);
  for (const std::string& pattern : patterns)
  {
    const std::vector<char> some = matchingNames(pattern, names);
    std::ranges::transform(matches, some, matches.begin(), std::bit_or<>());
    if (std::ranges::find(some, 1) == some.end())
    {
      diagnostics.warn("no surface matches '" + pattern + "', which is to be left out; " +
                       namesInstead(pattern, names));
    }
  }
  return matches;
}

void keepTriangles(Scene& scene, Surfaces& surfaces, const std::vector<Index>& newIds)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < surfaces.ids.size(); ++i)
  {
    if (const Index id = newIds[surfaces.ids[i]]; id != noIndex)
    {
      surfaces.ids[next] = id;
      scene.triangles[next++] = scene.triangles[i];
    }
  }
  surfaces.ids.resize(next);
  scene.triangles.resize(next);
}

void dropUnusedPoints(Scene& scene)
{
  std::vector<Index> newIds(scene.points.size(), noIndex);
  for (const auto& triangle : scene.triangles)
  {
    for (const Index p : triangle)
    {
      newIds[p] = 0;
    }
  }
  Index next = 0;
  for (std::size_t p = 0; p < newIds.size(); ++p)
  {
    if (newIds[p] != noIndex)
    {
      scene.points[next] = scene.points[p];
      newIds[p] = next++;
    }
  }
  scene.points.resize(next);
  for (auto& triangle : scene.triangles)
  {
    std::ranges::transform(triangle, triangle.begin(), [&](Index p) { return newIds[p]; });
  }
}

} // namespace

void excludeSurfaces(Scene& scene, Surfaces& surfaces, const std::vector<std::string>& patterns,
                     Diagnostics& diagnostics)
{
  const std::vector<char> out = matching(surfaces, patterns, diagnostics);
  if (std::ranges::find(out, 1) == out.end())
  {
    return;
  }
  std::vector<Index> newIds(out.size(), noIndex);
  std::vector<Surface> kept;
  std::vector<std::string> gone;
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    if (out[i])
    {
      gone.push_back(surfaces.surfaces[i].name);
      continue;
    }
    newIds[i] = static_cast<Index>(kept.size());
    kept.push_back(surfaces.surfaces[i]);
  }
  if (kept.empty())
  {
    throw Error("all surfaces of the model are to be left out; " + namesInstead(patterns.front(), gone));
  }
  surfaces.surfaces = std::move(kept);
  keepTriangles(scene, surfaces, newIds);
  dropUnusedPoints(scene);
  diagnostics.note(std::to_string(gone.size()) + (gone.size() == 1 ? " surface is" : " surfaces are") +
                   " left out as requested: " + joined(gone));
}

} // namespace atria::scene
