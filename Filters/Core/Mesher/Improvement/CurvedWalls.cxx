// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/CurvedWalls.h"

#include "Mesher/Improvement/LayerCells.h"
#include "Support/Angles.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// A wall is flat if its chart is; at a point if its faces there turn by less than a quarter of a degree.
constexpr double flatCosine = 1.0 - 1e-5;
/// A wall is smooth if its faces turn by less than this, or are at an edge of the domain. Elements at other walls,
/// where octants are coarse or a wall stands on the ground, hardly improve: half of the whole time wins one degree in
/// the mean.
const double smoothCosine = cosOfDegrees(12.01);
/// Factor by which the layer is thicker on curved walls where nothing beside it needs the room.
constexpr double thicker = 5.0 / 3.0;

/// Returns marks of the charts that are not flat. Ignores triangles so thin that rounding may turn them.
std::vector<char> findBent(const SurfaceModel& model)
{
  const double leastHeight = latticeRounding / std::sqrt(2.0 * (1.0 - flatCosine));
  std::vector<Index> widest;
  std::vector<double> areas;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const std::size_t chart = model.charts[t];
    if (chart >= widest.size())
    {
      widest.resize(chart + 1, noIndex);
      areas.resize(chart + 1, -1.0);
    }
    if (const double area = model.normal(t).squaredNorm(); area > areas[chart])
    {
      widest[chart] = t;
      areas[chart] = area;
    }
  }
  std::vector<char> bent(widest.size(), 0);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const std::size_t chart = model.charts[t];
    const Vec3 normal = model.normal(t);
    const Vec3 across = model.normal(widest[chart]).normalized();
    const double longest = model.bounds(t).size().norm();
    if (normal.norm() > leastHeight * longest && std::abs(normal.normalized().dot(across)) < flatCosine)
    {
      bent[chart] = 1;
    }
  }
  return bent;
}

} // namespace

CurvedWalls::CurvedWalls(ImproverState& state, const CurvedWallTargets& wanted) : state_(state), wanted_(wanted)
{
  const std::vector<char> bent = findBent(state_.context.model);
  curved_.assign(state_.layer.plainPoints, straight);
  state_.context.executor.forEach(curved_.size(), 4096, [&](std::size_t p) {
    const BoundaryFace* first = nullptr;
    Vec3 normalOfFirst;
    for (const Index f : state_.walls.graph.facesAt(static_cast<Index>(p)))
    {
      if (state_.walls.roles[f] != FaceRole::wall)
      {
        continue;
      }
      const BoundaryFace& face = state_.plain.boundaryFaces[f];
      const Vec3 normal = wallNormal(state_.plain, face).normalized();
      if (!first)
      {
        first = &face;
        normalOfFirst = normal;
      }
      const double cosine = normal.dot(normalOfFirst);
      const bool onSides = face.chart == noIndex && first->chart == noIndex;
      const bool isBent = cosine < flatCosine && face.chart != noIndex && bent[face.chart];
      if (isBent || (cosine < smoothCosine && onSides))
      {
        curved_[p] |= cosine > smoothCosine || onSides ? curved : curved | edged;
      }
      else if (cosine < smoothCosine)
      {
        curved_[p] |= edged;
      }
    }
  });
  if (std::ranges::all_of(curved_, [](std::uint8_t bend) { return (bend & curved) == 0; }))
  {
    curved_.clear();
  }
}

bool CurvedWalls::isAwayFromCreases(Index cell) const
{
  return std::ranges::all_of(state_.layer.mesh.corners[cell], [&](Index p) {
    const VertexClass vertexClass = state_.classification.classes[state_.vertexOf[state_.layer.wallPointOf(p)]];
    return vertexClass == VertexClass::free || vertexClass == VertexClass::surface;
  });
}

bool CurvedWalls::hasCurved(Index cell) const
{
  return std::ranges::any_of(state_.layer.mesh.corners[cell],
                             [&](Index p) { return (curved_[state_.layer.wallPointOf(p)] & curved) != 0; });
}

/// True if a cell is at a curved wall, and its points on walls are away from creases and boundary edges.
bool CurvedWalls::isAtCurved(Index cell) const { return hasCurved(cell) && isAwayFromCreases(cell); }

bool CurvedWalls::isHexahedronAtCurved(Index cell) const
{
  std::array<Index, 8> corners = state_.layer.mesh.corners[cell];
  std::ranges::sort(corners);
  return isAtCurved(cell) && std::ranges::adjacent_find(corners) == corners.end();
}

/// True if no point of a cell is on a wall that is curved but not smooth.
bool CurvedWalls::isAtSmooth(Index cell) const
{
  return std::ranges::all_of(state_.layer.mesh.corners[cell],
                             [&](Index p) { return (curved_[state_.layer.wallPointOf(p)] & edged) == 0; });
}

/// Returns points whose copies have only hexahedra at curved walls around them.
std::vector<Index> CurvedWalls::pointsAtCurved() const
{
  std::vector<char> others(state_.layer.plainPoints, 0);
  for (Index e = 0; e < state_.layer.mesh.elementCount(); ++e)
  {
    const auto& corners = state_.layer.mesh.corners[e];
    if (std::ranges::any_of(corners, [&](Index p) { return state_.layer.isNew(p); }) && !isHexahedronAtCurved(e))
    {
      for (const Index p : corners)
      {
        others[state_.layer.wallPointOf(p)] = 1;
      }
    }
  }
  std::vector<Index> points;
  for (Index p = 0; p < state_.layer.plainPoints; ++p)
  {
    if (state_.layer.copies[p] != noIndex && !others[p] && !state_.walls.settled.has(p))
    {
      points.push_back(p);
    }
  }
  return points;
}

/// Moves copies back to where they were, as long as cells at their points fall short.
void CurvedWalls::takeBack(std::vector<WantedPlace> thick)
{
  while (!thick.empty())
  {
    std::vector<char> back(state_.layer.plainPoints, 0);
    markPoints(state_.layer, state_.findShort(baseTargets(state_.traits)), back);
    std::vector<char> moved(state_.layer.mesh.points.size(), 0);
    const std::size_t wentBack = std::erase_if(thick, [&](const WantedPlace& was) {
      if (back[was.point])
      {
        state_.layer.mesh.points[state_.layer.copies[was.point]] = was.place;
        moved[state_.layer.copies[was.point]] = 1;
      }
      return back[was.point] != 0;
    });
    if (wentBack == 0)
    {
      break;
    }
    state_.outdate(cellsWithMarked(DualSource(state_.layer.mesh), moved, state_.context));
  }
}

void CurvedWalls::thicken()
{
  if (curved_.empty())
  {
    return;
  }
  std::vector<WantedPlace> thick; // former places of copies
  for (const Index p : pointsAtCurved())
  {
    Vec3& copy = state_.layer.mesh.points[state_.layer.copies[p]];
    thick.push_back({p, copy});
    copy = state_.layer.mesh.points[p] + thicker * (copy - state_.layer.mesh.points[p]);
  }
  takeBack(std::move(thick));
}

/// Returns the elements at smooth walls that are below a share of the targets.
std::vector<ShortCell> CurvedWalls::farAtSmooth(const QualityTargets& wanted, float share)
{
  QualityTargets by = wanted;
  by.leastOfFaceCosine = by.leastOfSkewness = -std::numeric_limits<double>::infinity();
  std::vector<ShortCell> found = state_.findShort(by, share);
  std::erase_if(found, [&](const ShortCell& cell) { return !isAtSmooth(cell.cell) || !isAtCurved(cell.cell); });
  return found;
}

void CurvedWalls::improve()
{
  if (curved_.empty())
  {
    return;
  }
  const ImproverStage stage = curvedStage(state_.traits, wanted_);
  std::vector<ShortCell> cells = state_.findShort(stage.options.targets, stage.below);
  std::erase_if(cells,
                [&](const ShortCell& cell) { return !isHexahedronAtCurved(cell.cell) || !isAtSmooth(cell.cell); });
  state_.run(stage, cells);
  if (std::ranges::none_of(curved_, [](std::uint8_t bend) { return (bend & edged) != 0; }))
  {
    bringClose();
  }
}

/// Repeats the stages as long as a third of the cells beyond the last limit gets within it.
void CurvedWalls::bringClose()
{
  const std::array<ImproverStage, 2> stages = closeStages(state_.traits, wanted_);
  std::size_t before;
  std::size_t beyond = std::numeric_limits<std::size_t>::max() / 3;
  do
  {
    before = beyond;
    for (const ImproverStage& stage : stages)
    {
      state_.run(stage, farAtSmooth(stage.options.targets, stage.below));
    }
    beyond = farAtSmooth(stages.back().options.targets, 0.0F).size();
  } while (beyond > 0 && 3 * beyond <= 2 * before);
}

} // namespace atria
