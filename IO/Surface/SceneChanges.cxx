// SPDX-License-Identifier: GPL-3.0-or-later
#include "SceneChanges.h"

#include "Support/Error.h"
#include "Surface/Triangles/CoincidentFaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace atria::scene {

namespace {

/// Area that a surface loses to another one, square meters.
struct MergedArea
{
  Index keeps;
  double area = 0.0;
  double equalArea = 0.0; ///< the part of it lost to a surface of the same size
  double sameArea = 0.0;  ///< the part of equalArea that faces the same way
};

Vec3 areaOf(const Scene& scene, std::size_t triangle)
{
  const auto& [a, b, c] = scene.triangles[triangle];
  return 0.5 * (scene.points[b] - scene.points[a]).cross(scene.points[c] - scene.points[a]);
}

/// Returns, for each surface that loses faces, the surfaces it loses them to, largest area first.
std::map<Index, std::vector<MergedArea>> mergedAreas(const Scene& scene, const CoincidentFaces& found,
                                                     const std::vector<Index>& surfaces)
{
  std::map<Index, std::vector<MergedArea>> merged;
  for (std::size_t i = 0; i < found.kept.size(); ++i)
  {
    const Index by = found.kept[i];
    if (surfaces[by] == surfaces[i])
    {
      continue;
    }
    std::vector<MergedArea>& all = merged[surfaces[i]];
    auto entry = std::ranges::find(all, surfaces[by], &MergedArea::keeps);
    if (entry == all.end())
    {
      entry = all.insert(all.end(), {surfaces[by]});
    }
    const Vec3 area = areaOf(scene, i);
    entry->area += area.norm();
    if (!found.isByOrder.empty() && found.isByOrder[i])
    {
      entry->equalArea += area.norm();
      entry->sameArea += area.dot(areaOf(scene, by)) > 0.0 ? area.norm() : 0.0;
    }
  }
  for (auto& [gives, all] : merged)
  {
    std::ranges::stable_sort(all, std::ranges::greater(), &MergedArea::area);
  }
  return merged;
}

std::string squareMeters(double area)
{
  std::ostringstream text;
  text.precision(4);
  text << area << " square meters";
  return text.str();
}

/// Notes the area that each surface loses to others.
void noteMerged(const std::map<Index, std::vector<MergedArea>>& merged, const std::vector<std::string>& names,
                const std::vector<char>& isLeft, Diagnostics& diagnostics)
{
  constexpr std::size_t mostNamed = 3;
  for (const auto& [gives, all] : merged)
  {
    std::string text = (isLeft[gives] ? "faces of '" : "all faces of '") + names[gives] +
                       "' coincide with those of others and are left out: ";
    for (std::size_t k = 0; k < std::min(mostNamed, all.size()); ++k)
    {
      const bool isEqual = all[k].equalArea > 0.5 * all[k].area;
      text += (k == 0 ? "" : ", ") + squareMeters(all[k].area) + " with '" + names[all[k].keeps] +
              (isEqual ? "', which is as large and comes first" : "', which is smaller");
    }
    text += all.size() > mostNamed ? ", and " + std::to_string(all.size() - mostNamed) + " more" : "";
    diagnostics.note(text);
  }
}

/// Gives one warning for all surfaces that are equally large and face the same way. Backs of sheets face the other way,
/// and so do solids that touch.
void warnOfEqual(const std::map<Index, std::vector<MergedArea>>& merged, const std::vector<std::string>& names,
                 Diagnostics& diagnostics)
{
  std::size_t pairs = 0;
  const MergedArea* largest = nullptr;
  Index gives = noIndex;
  for (const auto& [surface, all] : merged)
  {
    for (const MergedArea& entry : all)
    {
      pairs += entry.sameArea > 0.0 ? 1 : 0;
      if (entry.sameArea > (largest ? largest->sameArea : 0.0))
      {
        largest = &entry;
        gives = surface;
      }
    }
  }
  if (largest)
  {
    const std::string more =
        pairs > 1 ? "; so it is with " + std::to_string(pairs - 1) + " more pairs of surfaces" : "";
    diagnostics.warn("'" + names[largest->keeps] + "' and '" + names[gives] + "' have " +
                     squareMeters(largest->sameArea) +
                     " in common and neither is smaller: the first of them keeps "
                     "these faces, the other is left without" +
                     more + "; delete one of two that are the same");
  }
}

std::vector<char> surfacesIn(const std::vector<Index>& ids, const std::vector<Index>& kept, std::size_t count)
{
  std::vector<char> isLeft(count, 0);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    isLeft[ids[i]] |= kept[i] == i ? 1 : 0;
  }
  return isLeft;
}

} // namespace

std::size_t mergeDuplicateFaces(Scene& scene, SurfaceBy by, Diagnostics& diagnostics)
{
  by = by == SurfaceBy::connected ? SurfaceBy::shape : by;
  Surfaces surfaces = makeSurfaces(scene, by, 0.0);
  const CoincidentFaces found = findCoincidentFaces(scene.points, scene.triangles, scene.faceIds, surfaces.ids);
  if (found.faces == 0)
  {
    return 0;
  }
  diagnostics.note(std::to_string(found.faces) + " faces coincide with others and were merged with them, " +
                   std::to_string(found.opposite) + " of them facing the other way");
  const std::map<Index, std::vector<MergedArea>> merged = mergedAreas(scene, found, surfaces.ids);
  const std::vector<char> isLeft = surfacesIn(surfaces.ids, found.kept, surfaces.surfaces.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < found.kept.size(); ++i)
  {
    if (found.kept[i] == i)
    {
      scene.triangles[next] = scene.triangles[i];
      scene.shapeIds[next] = scene.shapeIds[i];
      scene.faceIds[next] = scene.faceIds[i];
      surfaces.ids[next] = surfaces.ids[i];
      ++next;
    }
  }
  scene.triangles.resize(next);
  scene.shapeIds.resize(next);
  scene.faceIds.resize(next);
  if (!merged.empty())
  {
    // Names are numbered without the surfaces that are gone.
    std::vector<std::string> names;
    std::ranges::transform(surfaces.surfaces, std::back_inserter(names), &Surface::name);
    const Surfaces left = makeSurfaces(scene, by, 0.0);
    for (std::size_t i = 0; i < next; ++i)
    {
      names[surfaces.ids[i]] = left.surfaces[left.ids[i]].name;
    }
    noteMerged(merged, names, isLeft, diagnostics);
    warnOfEqual(merged, names, diagnostics);
  }
  return found.faces;
}

Vec3 place(Scene& scene, const Placement& placement)
{
  Box3 box;
  for (Vec3& p : scene.points)
  {
    if (placement.upAxis == 1)
    {
      p = Vec3(p.x(), -p.z(), p.y());
    }
    p *= placement.scale;
    box.extend(p);
  }
  if (!box.empty() && !(box.min.allFinite() && box.max.allFinite()))
  {
    throw Error("coordinates grow beyond all numbers when they are scaled; check Scale");
  }
  Vec3 offset = Vec3::Zero();
  if (placement.recenter && !box.empty())
  {
    constexpr double grain = 100.0;
    const double length = box.size().norm();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double center = box.center()[axis];
      offset[axis] = std::abs(center) > length ? grain * std::round(center / grain) : 0.0;
    }
    for (Vec3& p : scene.points)
    {
      p -= offset;
    }
  }
  return offset;
}

} // namespace atria::scene
