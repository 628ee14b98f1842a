// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of a region, kept while points of it move. How they are judged is in JudgeScores.cxx.
#include "Optimise/Judge.h"

#include <algorithm>

namespace atria {

namespace {

constexpr std::size_t grain = 1024;
constexpr double tiny = 1e-150;

} // namespace

Judge::Judge(Region& region, const QualityTargets& targets, const RunContext& context)
    : region_(region), targets_(targets), faces(region.faceCount()), cells(region.cellCount()),
      sizes(region.judgedCount()), cornerScales(sizes.size()), cellScores(sizes.size()), faceScores(faces.size())
{
  context.executor.forEach(faces.size(), grain, [&](std::size_t f) { measure(static_cast<Index>(f)); });
  context.executor.forEach(sizes.size(), grain, [&](std::size_t c) {
    measureOne(static_cast<Index>(c));
    measureSize(static_cast<Index>(c));
  });
  for (std::size_t g = 0; g < region.ghostVolumes.size(); ++g)
  {
    cells[sizes.size() + g] = {region.ghostCentroids[g], region.ghostVolumes[g], region.ghostCentroids[g]};
  }
  judgeAll(context);
}

void Judge::measure(Index face)
{
  const auto points = region_.face(face);
  faces[face] = measureAnyFace(points.size(), [&](std::size_t i) -> const Vec3& { return region_.points[points[i]]; });
}

void Judge::measureOne(Index cell)
{
  cells[cell] = measureCell([&](auto&& visit) {
    for (const Index f : region_.facesOf(cell))
    {
      visit(faces[f].centroid, sign(cell, f) * faces[f].area);
    }
  });
}

void Judge::measureSize(Index cell)
{
  double length = 0.0;
  double count = 0.0;
  for (const Index f : region_.facesOf(cell))
  {
    const auto points = region_.face(f);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t next = i + 1 < points.size() ? i + 1 : 0;
      length += (region_.points[points[i]] - region_.points[points[next]]).norm();
      count += 1.0;
    }
  }
  sizes[cell] = length / std::max(count, 1.0);
  const double cube = sizes[cell] * sizes[cell] * sizes[cell];
  cornerScales[cell] = 2.0 / (cube + tiny) / targets_.cornerVolume.target;
}

bool Judge::isGood(std::size_t movable) const
{
  return std::ranges::all_of(region_.cellsAbout(movable), [&](Index cell) {
    return cellScores[cell].penalty == 0.0 &&
           std::ranges::all_of(region_.facesOf(cell), [&](Index f) { return faceScores[f].penalty == 0.0; });
  });
}

void Judge::enter(std::size_t movable, Star& star) const
{
  star.point = region_.movable[movable];
  const auto members = region_.membersOf(movable);
  star.points.assign(members.begin(), members.end());
  const auto about = region_.cellsAbout(movable);
  star.cells.assign(about.begin(), about.end());
  star.faces.clear();
  star.offsets.clear();
  star.size = 0.0;
  for (const Index cell : about)
  {
    const auto own = region_.facesOf(cell);
    star.offsets.push_back(static_cast<Index>(star.faces.size()));
    star.faces.insert(star.faces.end(), own.begin(), own.end());
    star.size += sizes[cell] / static_cast<double>(about.size());
  }
  star.slots = star.faces;
  std::sort(star.faces.begin(), star.faces.end());
  star.faces.erase(std::unique(star.faces.begin(), star.faces.end()), star.faces.end());
}

void Judge::prepare(Star& star) const
{
  star.origin = region_.points[star.point];
  for (Index& slot : star.slots)
  {
    slot = static_cast<Index>(std::ranges::lower_bound(star.faces, slot) - star.faces.begin());
  }
  star.moving.clear();
  star.facesBefore.clear();
  star.shapes.resize(star.faces.size());
  for (Index i = 0; i < star.faces.size(); ++i)
  {
    const Index face = star.faces[i];
    if (std::ranges::find_first_of(region_.face(face), star.points) != region_.face(face).end())
    {
      star.moving.push_back(i);
      star.facesBefore.push_back(faces[face]);
    }
    star.shapes[i] = quadShapeOf(face);
  }
  star.cellsBefore.clear();
  star.order.clear();
  std::vector<Index>& order = star.order;
  const auto count = static_cast<Index>(star.cells.size());
  for (const bool wasShort : {true, false})
  {
    for (Index i = 0; i < count + star.faces.size(); ++i)
    {
      const Score& score = i < count ? cellScores[star.cells[i]] : faceScores[star.faces[i - count]];
      if ((score.penalty > 0.0) == wasShort)
      {
        order.push_back(i);
      }
    }
  }
  for (const Index cell : star.cells)
  {
    star.cellsBefore.push_back(cells[cell]);
  }
}

void Judge::move(Star& star, const Vec3& p)
{
  for (const Index point : star.points)
  {
    region_.points[point] = p;
  }
  for (const Index i : star.moving)
  {
    measure(star.faces[i]);
    star.shapes[i] = quadShapeOf(star.faces[i]);
  }
  for (const Index cell : star.cells)
  {
    measureOne(cell);
  }
}

void Judge::restore(const Star& star)
{
  for (const Index point : star.points)
  {
    region_.points[point] = star.origin;
  }
  for (std::size_t i = 0; i < star.moving.size(); ++i)
  {
    faces[star.faces[star.moving[i]]] = star.facesBefore[i];
  }
  for (std::size_t i = 0; i < star.cells.size(); ++i)
  {
    cells[star.cells[i]] = star.cellsBefore[i];
  }
}

void Judge::accept(const Star& star)
{
  auto next = star.scores.begin();
  for (const Index cell : star.cells)
  {
    cellScores[cell] = *next++;
  }
  for (const Index face : star.faces)
  {
    faceScores[face] = *next++;
  }
}

Score Judge::scoreOf(const Star& star) const
{
  Score sum;
  for (const Index cell : star.cells)
  {
    sum.add(cellScores[cell]);
  }
  for (const Index face : star.faces)
  {
    sum.add(faceScores[face]);
  }
  return sum;
}

} // namespace atria
