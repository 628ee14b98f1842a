// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/DomainCheck.h"

#include "Domain/Domain.h"
#include "Support/Error.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

using Polygon = std::vector<Vec3>;

double planeOf(const Box3& box, int side) { return isUpper(side) ? box.max[axisOf(side)] : box.min[axisOf(side)]; }

/// Returns the distance of a point from a side, inward; negative beyond the side.
double distanceWithin(const Vec3& p, const Box3& box, int side)
{
  return isUpper(side) ? planeOf(box, side) - p[axisOf(side)] : p[axisOf(side)] - planeOf(box, side);
}

/// Returns the part of a polygon where the linear function `within` is not negative (Sutherland and Hodgman). `onto`
/// puts points where edges are cut exactly on the border.
template <typename Within, typename Onto>
Polygon partWithin(const Polygon& polygon, const Within& within, const Onto& onto)
{
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[(i + 1) % polygon.size()];
    const double dp = within(p);
    const double dq = within(q);
    if (dp >= 0.0)
    {
      out.push_back(p);
    }
    if ((dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0))
    {
      out.push_back(p + dp / (dp - dq) * (q - p));
      onto(out.back());
    }
  }
  return out;
}

Polygon cutAt(const Polygon& polygon, const Box3& box, int side)
{
  return partWithin(
      polygon, [&](const Vec3& p) { return distanceWithin(p, box, side); },
      [&](Vec3& p) { p[axisOf(side)] = planeOf(box, side); });
}

Polygon cutAt(const Polygon& polygon, const PrismSide& side)
{
  return partWithin(
      polygon, [&](const Vec3& p) { return -side.beyond(p.head<2>()); },
      [&](Vec3& p) { p.head<2>() = side.foot(p.head<2>()); });
}

/// Returns twice the area vector.
Vec3 normalOf(const Polygon& polygon)
{
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
  {
    normal += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  }
  return normal;
}

/// Contacts of one surface's faces with the sides, as bits by Direction.
struct Meeting
{
  unsigned reached = 0; ///< sides that any face comes near to
  unsigned cut = 0;
  unsigned blocked = 0; ///< sides near faces that are not square to them
};

class ContactSearch
{
public:
  ContactSearch(const TriangleSurface& model, const SitePlan& sitePlan, double size)
      : surface(model), plan(sitePlan), box(plan.domain.bounds), onSide(coincidentRatio * size), near(0.5 * size),
        leastArea(1e-6 * onSide * onSide), meetings(model.names.size())
  {
  }

  DomainContacts run()
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      look(t);
    }
    const Box3& b = buildings;
    out.isBuried = !plan.hasTerrain && !b.empty() && out.holdsBuildings && box.min[2] > 0.5 * (b.min[2] + b.max[2]);
    for (int side = 0; side < 6; ++side)
    {
      if (side != zMin)
      {
        sumUp(side);
      }
    }
    return std::move(out);
  }

private:
  /// Returns the triangle's corners along the domain's axes. Coordinates within tolerance of a side are put on it.
  Polygon cornersOf(std::size_t triangle) const
  {
    Polygon corners;
    for (const Index i : surface.triangles[triangle])
    {
      Vec3 p = plan.domain.axes.fromModel(surface.points[i]);
      for (int side = 0; side < 6; ++side)
      {
        const bool on = std::abs(distanceWithin(p, box, side)) <= onSide;
        p[axisOf(side)] = on ? planeOf(box, side) : p[axisOf(side)];
      }
      corners.push_back(p);
    }
    return corners;
  }

  /// Returns true if a triangle lies away from all sides, as most do. Then notes only that it is there.
  bool isInside(std::size_t triangle)
  {
    const auto& t = surface.triangles[triangle];
    const Vec3 a = plan.domain.axes.fromModel(surface.points[t[0]]);
    const Vec3 b = plan.domain.axes.fromModel(surface.points[t[1]]);
    const Vec3 c = plan.domain.axes.fromModel(surface.points[t[2]]);
    const Vec3 low = a.cwiseMin(b).cwiseMin(c);
    const Vec3 high = a.cwiseMax(b).cwiseMax(c);
    if (!((low - box.min).array() > near).all() || !((box.max - high).array() > near).all())
    {
      return false;
    }
    const bool isBuilding = !plan.isGround[surface.surfaceIds[triangle]];
    const bool hasArea = (b - a).cross(c - a).norm() > leastArea;
    out.hasBuildings |= isBuilding;
    out.holdsModel |= hasArea;
    out.holdsBuildings |= hasArea && isBuilding;
    if (isBuilding)
    {
      buildings.extend(low);
      buildings.extend(high);
    }
    return true;
  }

  void look(std::size_t triangle)
  {
    if (isInside(triangle))
    {
      return;
    }
    const Index id = surface.surfaceIds[triangle];
    const Polygon corners = cornersOf(triangle);
    Box3 bounds;
    std::for_each(corners.begin(), corners.end(), [&](const Vec3& p) { bounds.extend(p); });
    const bool isFloor = bounds.min[2] == box.min[2] && bounds.max[2] == box.min[2];
    const bool isBuilding = !plan.isGround[id] && !isFloor;
    out.hasBuildings = out.hasBuildings || isBuilding;
    if (isBuilding)
    {
      lookBeyond(bounds);
    }
    if (!bounds.touches(box))
    {
      return;
    }
    Polygon part = corners;
    for (int side = 0; side < 6 && part.size() > 2; ++side)
    {
      part = cutAt(part, box, side);
    }
    const Vec3 normal = normalOf(part);
    if (part.size() < 3 || !(normal.norm() > leastArea))
    {
      return;
    }
    out.holdsModel = true;
    if (isBuilding)
    {
      out.holdsBuildings = true;
      meet(corners, part, normal, meetings[id]);
    }
  }

  /// Notes the sides beyond which a face goes on, in front of them.
  void lookBeyond(const Box3& bounds)
  {
    std::array<bool, 3> overlaps;
    for (int axis = 0; axis < 3; ++axis)
    {
      overlaps[axis] = bounds.min[axis] < box.max[axis] && bounds.max[axis] > box.min[axis];
    }
    for (int side = 0; side < 6; ++side)
    {
      const int axis = axisOf(side);
      const bool inFront = overlaps[(axis + 1) % 3] && overlaps[(axis + 2) % 3];
      const bool isBeyond = isUpper(side) ? bounds.max[axis] > box.max[axis] : bounds.min[axis] < box.min[axis];
      goesOn[side] = goesOn[side] || (inFront && isBeyond);
    }
    if (overlaps[0] && overlaps[1])
    {
      buildings.extend(bounds.min);
      buildings.extend(bounds.max);
    }
  }

  void meet(const Polygon& corners, const Polygon& part, const Vec3& normal, Meeting& meeting)
  {
    constexpr double square = 0.02;
    for (int side = 0; side < 6; ++side)
    {
      const auto within = [&](const Polygon& polygon) {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        for (const Vec3& p : polygon)
        {
          least = std::min(least, distanceWithin(p, box, side));
          most = std::max(most, distanceWithin(p, box, side));
        }
        return std::pair(least, most);
      };
      const auto [least, most] = within(part);
      if (least > near)
      {
        continue;
      }
      const unsigned bit = 1u << side;
      const bool isSquare = std::abs(normal[axisOf(side)]) <= square * normal.norm();
      meeting.reached |= bit;
      meeting.cut |= least <= 0.0 && within(corners).first < 0.0 ? bit : 0u;
      meeting.blocked |= isSquare ? 0u : bit;
      areas[side] += most <= 0.0 ? 0.5 * normal.norm() : 0.0;
    }
  }

  void sumUp(int side)
  {
    constexpr double wallShare = 0.5;
    Vec3 size = box.size();
    size[axisOf(side)] = 1.0;
    const bool isWall = areas[side] >= wallShare * size.prod();
    const unsigned bit = 1u << side;
    const unsigned across = 1u << opposite(side);
    for (Index id = 0; id < meetings.size(); ++id)
    {
      const Meeting& m = meetings[id];
      if ((m.cut & bit) != 0)
      {
        out.cut[side].push_back(id);
      }
      else if (!isWall && (m.reached & bit) != 0 &&
               ((m.blocked & bit) != 0 || (m.reached & across) == 0 || goesOn[side]))
      {
        out.touching[side].push_back(id);
      }
    }
    if (!out.cut[side].empty())
    {
      out.touching[side].clear(); // surfaces that are cut are too near anyhow
    }
  }

  const TriangleSurface& surface;
  const SitePlan& plan;
  Box3 box;
  double onSide;
  double near;
  double leastArea; ///< twice the least area of a face
  std::vector<Meeting> meetings;
  /// One entry per side: true if buildings have faces beyond it, in front of it.
  std::array<bool, 6> goesOn{};
  /// Bounds of buildings over, in or under the domain.
  Box3 buildings;
  /// Area of faces of buildings in each side.
  std::array<double, 6> areas{};
  DomainContacts out;
};

std::string textOf(const Box3& box)
{
  std::ostringstream text;
  text.precision(6);
  for (int axis = 0; axis < 3; ++axis)
  {
    text << (axis > 0 ? ", " : "") << "xyz"[axis] << " from " << box.min[axis] << " to " << box.max[axis];
  }
  return text.str();
}

/// Returns text such as "'Roof', 'Wall' and 3 more"; empty without any.
std::string textOf(const std::vector<Index>& ids, const std::vector<std::string>& names)
{
  constexpr std::size_t most = 4;
  std::string list;
  for (std::size_t i = 0; i < std::min(most, ids.size()); ++i)
  {
    list += (i > 0 ? ", '" : "'") + names[ids[i]] + "'";
  }
  return list + (ids.size() > most ? " and " + std::to_string(ids.size() - most) + " more" : "");
}

/// Surfaces at a side of the domain.
struct AtSide
{
  std::string side;
  std::vector<Index> ids;
};

std::vector<AtSide> namedSides(const std::array<std::vector<Index>, 6>& bySide)
{
  std::vector<AtSide> named;
  for (Index side = 0; side < 6; ++side)
  {
    named.push_back({sideName(side), bySide[side]});
  }
  return named;
}

/// Returns text such as "zMax ('Roof', 'Wall' and 3 more) and xMin ('Wall')"; empty without any.
std::string textOf(const std::vector<AtSide>& sides, const std::vector<std::string>& names)
{
  constexpr std::size_t most = 6;
  std::vector<std::string> parts;
  for (const auto& [side, ids] : sides)
  {
    if (!ids.empty())
    {
      parts.push_back(side + " (" + textOf(ids, names) + ")");
    }
  }
  if (parts.size() > most)
  {
    parts[most - 1] = std::to_string(parts.size() - most + 1) + " other sides";
    parts.resize(most);
  }
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  }
  return text;
}

/// True if the part of a polygon that is within all other sides lies on both sides of this one.
bool cuts(const PrismSide& side, Polygon polygon, const PlacedPrism& domain, double tolerance)
{
  for (const PrismSide& other : domain.sides())
  {
    polygon = other.number == side.number ? std::move(polygon) : cutAt(polygon, other);
  }
  const auto beyond = [&](const Vec3& p) { return side.beyond(p.head<2>()); };
  return std::ranges::any_of(polygon, [&](const Vec3& p) { return beyond(p) < -tolerance; }) &&
         std::ranges::any_of(polygon, [&](const Vec3& p) { return beyond(p) > tolerance; });
}

/// Returns the surfaces of buildings with faces on both sides of the upright sides of a prism, between its bottom and
/// its top.
std::vector<AtSide> cutByPrism(const TriangleSurface& surface, const SitePlan& plan, double tolerance)
{
  std::vector<std::vector<char>> isCut(plan.domain.sides().size(), std::vector<char>(surface.names.size(), 0));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const Index id = surface.surfaceIds[t];
    Polygon polygon;
    for (const Index i : surface.triangles[t])
    {
      polygon.push_back(plan.domain.axes.fromModel(surface.points[i]));
    }
    const auto isBeyond = [&](const Vec3& p) { return plan.domain.beyond(p.head<2>()) > tolerance; };
    if (plan.isGround[id] || std::ranges::none_of(polygon, isBeyond))
    {
      continue;
    }
    polygon = cutAt(cutAt(polygon, plan.domain.bounds, zMin), plan.domain.bounds, zMax);
    for (std::size_t s = 0; s < isCut.size(); ++s)
    {
      isCut[s][id] |= cuts(plan.domain.sides()[s], polygon, plan.domain, tolerance) ? 1 : 0;
    }
  }
  std::vector<AtSide> found;
  for (std::size_t s = 0; s < isCut.size(); ++s)
  {
    found.push_back({sideName(plan.domain.sides()[s].number), {}});
    for (Index id = 0; id < isCut[s].size(); ++id)
    {
      if (isCut[s][id])
      {
        found.back().ids.push_back(id);
      }
    }
  }
  return found;
}

/// Returns text on the surfaces that the domain's sides cut. A prism that is no box is tested by its own upright sides.
std::string textOfCuts(const TriangleSurface& surface, const SitePlan& plan, const DomainContacts& contacts,
                       double tolerance)
{
  std::vector<AtSide> sides = namedSides(contacts.cut);
  if (!plan.domain.isBox())
  {
    sides.erase(sides.begin(), sides.begin() + zMin);
    const std::vector<AtSide> upright = cutByPrism(surface, plan, tolerance);
    sides.insert(sides.begin(), upright.begin(), upright.end());
  }
  return textOf(sides, surface.names);
}

constexpr const char* otherDomains =
    "make the domain larger (DomainBounds), or take the one that follows from the buildings (DomainMode Automatic)";

void refuseEmpty(const TriangleSurface& surface, const SitePlan& plan)
{
  areaOf(surface); // throws if there is no area
  const bool turned = plan.domain.axes.angle() != 0.0;
  throw Error("the domain holds nothing of the model: it reaches " + textOf(plan.domain.bounds) + ", the model " +
              textOf(boundsOf(surface, plan.domain.axes)) + (turned ? ", along the domain's axes" : "") +
              ". Check unit and place of the model and DomainBounds, or take the domain that follows from "
              "the buildings (DomainMode Automatic)");
}

} // namespace

DomainContacts findDomainContacts(const TriangleSurface& surface, const SitePlan& plan, double sizeMin)
{
  return ContactSearch(surface, plan, sizeMin).run();
}

std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, DomainMode mode,
                                     double sizeMin)
{
  std::vector<std::string> warnings;
  if (mode == DomainMode::surfaces || mode == DomainMode::automatic || surface.triangles.empty())
  {
    return warnings;
  }
  const DomainContacts contacts = findDomainContacts(surface, plan, sizeMin);
  if (!contacts.holdsModel)
  {
    refuseEmpty(surface, plan);
  }
  if (contacts.hasBuildings && !contacts.holdsBuildings)
  {
    warnings.push_back("the domain holds no building, only ground: it reaches " + textOf(plan.domain.bounds) +
                       ", the buildings " + textOf(boundsOfBuildings(surface, plan.isGround, plan.domain.axes)) + ": " +
                       otherDomains);
  }
  const std::string cut = textOfCuts(surface, plan, contacts, coincidentRatio * sizeMin);
  if (!cut.empty())
  {
    warnings.push_back("the domain cuts through surfaces at " + cut + ", and leaves out what lies beyond: " +
                       otherDomains + "; name those that are ground by SiteName or TerrainName");
  }
  if (const std::string touching = textOf(namedSides(contacts.touching), surface.names); !touching.empty())
  {
    warnings.push_back("surfaces end on the domain's sides, without air between: " + touching + "; " + otherDomains +
                       ". Where the model's walls are to be the sides take its bounds (DomainMode FromSurfaces)");
  }
  if (contacts.isBuried)
  {
    warnings.push_back("most of the buildings' height lies below the domain's bottom: lower zMin (DomainBounds)");
  }
  return warnings;
}

} // namespace atria
