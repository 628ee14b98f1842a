// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the measures of a region while its points move. EvaluatorScores.cxx judges them.
#include "Optimize/Kernel/QualityEvaluator.h"

#include <algorithm>

namespace atria {

namespace {

constexpr std::size_t grain = 256;

/// Lists the numbers below `count`, first those for which `isFirst` is true. Returns how many these are.
template <typename IsFirst> std::size_t listFirst(std::vector<Index>& list, std::size_t count, IsFirst&& isFirst)
{
  list.clear();
  for (Index i = 0; i < count; ++i)
  {
    if (isFirst(i))
    {
      list.push_back(i);
    }
  }
  const std::size_t first = list.size();
  for (Index i = 0; i < count && list.size() < count; ++i)
  {
    if (!isFirst(i))
    {
      list.push_back(i);
    }
  }
  return first;
}

} // namespace

QualityEvaluator::QualityEvaluator(Region& region, const QualityTargets& targets, const RunContext& context)
    : region_(region), targets_(targets), faces(region.faceCount()), cells(region.cellCount()),
      sizes(region.cellCount()), cornerScales(sizes.size()), cellScores(region.judgedCount()), faceScores(faces.size())
{
  std::vector<double> perimeters(faces.size());
  context.executor.forEach(faces.size(), grain, [&](std::size_t f) {
    measure(static_cast<Index>(f));
    const auto points = region.face(f);
    perimeters[f] = perimeterOf(points.size(), [&](std::size_t i) -> const Vec3& { return region.points[points[i]]; });
  });
  const std::size_t judged = region.judgedCount();
  context.executor.forEach(judged, grain, [&](std::size_t c) {
    measureOne(static_cast<Index>(c));
    sizes[c] = meanEdgeOf(static_cast<Index>(c), perimeters);
  });
  for (std::size_t g = 0; g < region.ghosts.size(); ++g)
  {
    cells[judged + g] = region.ghosts[g].measure;
    sizes[judged + g] = region.ghosts[g].size;
  }
  std::ranges::transform(sizes, cornerScales.begin(), [&](double size) {
    return 2.0 / (size * size * size + rootVSmall) / targets.cornerVolume.target;
  });
  judgeAll(context);
}

void QualityEvaluator::measure(Index face)
{
  const auto points = region_.face(face);
  faces[face] = measureAnyFace(points.size(), [&](std::size_t i) -> const Vec3& { return region_.points[points[i]]; });
}

void QualityEvaluator::measureOne(Index cell)
{
  cells[cell] = measureCell([&](auto&& visit) {
    for (const Index f : region_.facesOf(cell))
    {
      visit(faces[f].centroid, sign(cell, f) * faces[f].area);
    }
  });
}

double QualityEvaluator::meanEdgeOf(Index cell, const std::vector<double>& perimeters) const
{
  double length = 0.0;
  std::size_t count = 0;
  for (const Index f : region_.facesOf(cell))
  {
    length += perimeters[f];
    count += region_.face(f).size();
  }
  return length / std::max(static_cast<double>(count), 1.0);
}

/// The sum is an upper bound: faces between two cells around the point are counted twice.
bool QualityEvaluator::isGood(std::size_t movable, double penalty) const
{
  double sum = 0.0;
  for (const Index cell : region_.cellsAbout(movable))
  {
    sum += cellScores[cell].penalty;
    for (const Index f : region_.facesOf(cell))
    {
      sum += faceScores[f].penalty;
    }
    if (sum > 0.0 && sum >= penalty)
    {
      return false;
    }
  }
  return true;
}

void QualityEvaluator::enter(std::size_t movable, VertexStar& star) const
{
  star.point = region_.movable[movable];
  const auto members = region_.membersOf(movable);
  star.points.assign(members.begin(), members.end());
  const auto shares = region_.sharesOf(movable);
  star.shares.assign(shares.begin(), shares.end());
  const auto about = region_.cellsAbout(movable);
  star.cells.assign(about.begin(), about.end());
  star.faces.clear();
  star.slots.clear();
  star.offsets.clear();
  star.size = 0.0;
  star.entries.resize(faces.size());
  star.stars.resize(region_.points.size());
  ++star.number;
  for (const Index point : star.points)
  {
    star.stars[point] = star.number;
  }
  for (const Index cell : about)
  {
    star.offsets.push_back(static_cast<Index>(star.slots.size()));
    for (const Index f : region_.facesOf(cell))
    {
      VertexStar::Entry& entry = star.entries[f];
      if (entry.star != star.number)
      {
        entry = {star.number, static_cast<Index>(star.faces.size())};
        star.faces.push_back(f);
      }
      star.slots.push_back(entry.place);
    }
    star.size += sizes[cell] / static_cast<double>(about.size());
  }
}

void QualityEvaluator::prepare(VertexStar& star) const
{
  star.origin = region_.points[star.point];
  star.pointsBefore.clear();
  for (const Index point : star.points)
  {
    star.pointsBefore.push_back(region_.points[point]);
  }
  star.moving.clear();
  star.facesBefore.clear();
  if (star.shapes.size() < star.faces.size())
  {
    star.shapes.resize(star.faces.size());
  }
  star.parts.assign(star.faces.size(), QuadShape::none);
  const auto isOfStar = [&](Index point) { return star.stars[point] == star.number; };
  for (Index i = 0; i < star.faces.size(); ++i)
  {
    if (std::ranges::any_of(region_.face(star.faces[i]), isOfStar))
    {
      star.moving.push_back(i);
    }
  }
  findFirst(star);
  for (const Index i : star.moving)
  {
    star.facesBefore.push_back(faces[star.faces[i]]);
  }
  star.cellsBefore.clear();
  for (const Index cell : star.cells)
  {
    star.cellsBefore.push_back(cells[cell]);
  }
}

/// Sets the order of judging. Lists first the cells and faces that shortfalls depend on: those of a cell depend on its
/// faces, those of a face on the cells on both sides.
void QualityEvaluator::findFirst(VertexStar& star) const
{
  const auto cellCount = static_cast<Index>(star.cells.size());
  star.marks.clear();
  for (const Index cell : star.cells)
  {
    star.marks.push_back(cellScores[cell].penalty > 0.0 ? 1 : 0);
  }
  for (const Index face : star.faces)
  {
    star.marks.push_back(faceScores[face].penalty > 0.0 ? 1 : 0);
  }
  star.firstInOrder = listFirst(star.order, star.marks.size(), [&](Index i) { return star.marks[i] != 0; });
  const auto slotsOf = [&](Index i) {
    return std::span(star.slots).subspan(star.offsets[i], region_.facesOf(star.cells[i]).size());
  };
  star.firstMeasured = listFirst(star.measured, cellCount, [&](Index i) {
    return star.marks[i] ||
           std::ranges::any_of(slotsOf(i), [&](Index slot) { return star.marks[cellCount + slot] != 0; });
  });
  // From here on, marks are of faces: 1 if a face is listed first.
  star.marks.assign(star.faces.size(), 0);
  for (std::size_t i = 0; i < star.firstMeasured; ++i)
  {
    for (const Index slot : slotsOf(star.measured[i]))
    {
      star.marks[slot] = 1;
    }
  }
  star.firstMoving = static_cast<std::size_t>(
      std::partition(star.moving.begin(), star.moving.end(), [&](Index slot) { return star.marks[slot] != 0; }) -
      star.moving.begin());
}

void QualityEvaluator::place(VertexStar& star, const Vec3& p)
{
  for (std::size_t i = 0; i < star.points.size(); ++i)
  {
    const double share = star.shares[i];
    region_.points[star.points[i]] = share == 1.0 ? p : Vec3(star.pointsBefore[i] + share * (p - star.origin));
  }
  for (const Index i : star.moving)
  {
    star.parts[i] = QuadShape::none;
  }
}

void QualityEvaluator::measureFirst(const VertexStar& star)
{
  for (std::size_t i = 0; i < star.firstMoving; ++i)
  {
    measure(star.faces[star.moving[i]]);
  }
  for (std::size_t i = 0; i < star.firstMeasured; ++i)
  {
    measureOne(star.cells[star.measured[i]]);
  }
}

void QualityEvaluator::measureRest(const VertexStar& star)
{
  for (std::size_t i = star.firstMoving; i < star.moving.size(); ++i)
  {
    measure(star.faces[star.moving[i]]);
  }
  for (std::size_t i = star.firstMeasured; i < star.measured.size(); ++i)
  {
    measureOne(star.cells[star.measured[i]]);
  }
}

void QualityEvaluator::move(VertexStar& star, const Vec3& p)
{
  place(star, p);
  measureFirst(star);
  measureRest(star);
}

void QualityEvaluator::moveForResiduals(VertexStar& star, const Vec3& p)
{
  place(star, p);
  measureFirst(star);
}

/// The running sum has another order than the sum that is returned, so it may differ by rounding.
Score QualityEvaluator::look(VertexStar& star, const Vec3& p, const LookLimits& limits)
{
  constexpr double surely = 1.0 + 1e-9;
  place(star, p);
  measureFirst(star);
  star.scores.assign(star.order.size(), {});
  Score running;
  for (std::size_t i = 0; i < star.order.size(); ++i)
  {
    if (i == star.firstInOrder)
    {
      measureRest(star);
    }
    judgeInOrder(star, star.order[i]);
    running.add(star.scores[star.order[i]]);
    if (running.penalty > surely * limits.penalty || running.worst < limits.worst)
    {
      return running;
    }
  }
  Score sum;
  for (const Score& score : star.scores)
  {
    sum.add(score);
  }
  return sum;
}

void QualityEvaluator::restore(const VertexStar& star)
{
  for (std::size_t i = 0; i < star.points.size(); ++i)
  {
    region_.points[star.points[i]] = star.pointsBefore[i];
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

void QualityEvaluator::accept(const VertexStar& star)
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

Score QualityEvaluator::scoreOf(const VertexStar& star) const
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
