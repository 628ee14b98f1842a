// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/DirtySoups.h"

#include "Support/UnionFind.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <random>

namespace atria::testing {

namespace {

constexpr double h = 0.25; ///< size of the finest octants

/// A rectangle in the plane of a wall: u0, v0, u1, v1.
using Rectangle = std::array<double, 4>;

enum class Weakness
{
  opening, ///< a hole of three octants or more
  crack,   ///< far below an octant: closed
  gap      ///< well above an octant: open
};

class Builder
{
public:
  explicit Builder(unsigned seed) : random_(seed) {}

  DirtySoup build();

private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  void note(const std::string& text) { soup_.description += (soup_.description.empty() ? "" : ", ") + text; }

  Index addName(const std::string& name)
  {
    soup_.surface.names.push_back(name);
    return static_cast<Index>(soup_.surface.names.size() - 1);
  }
  Index newSpace()
  {
    spaceOf_.push_back(static_cast<int>(spaceOf_.size()));
    return static_cast<Index>(spaceOf_.size() - 1);
  }
  void connect(Index a, Index b) { links_.push_back({a, b}); }

  void addTriangle(Index name, Vec3 a, Vec3 b, Vec3 c);
  void addRectangle(Index name, int axis, double at, const Rectangle& r, const std::optional<Rectangle>& hole);
  void addRoom(const Box3& box, const std::string& name, int sharedSide, const std::optional<Rectangle>& door,
               Index neighbor);
  void addPartition(const Box3& box, const std::string& name, Index low, Index high);
  void addSheets(const Box3& box, const std::string& name);
  Rectangle holeIn(const Rectangle& r);
  std::optional<Rectangle> weaken(Rectangle& wall, Index inside);
  void place();

  std::mt19937 random_;
  DirtySoup soup_;
  double octant_ = h;     ///< size of octants at walls
  double reversed_ = 0.0; ///< chances of a triangle
  double repeated_ = 0.0;
  double sliver_ = 0.0;
  std::vector<int> spaceOf_{0};
  std::vector<std::pair<Index, Index>> links_;
  std::vector<std::pair<Vec3, Index>> inSpace_;
};

void Builder::addTriangle(Index name, Vec3 a, Vec3 b, Vec3 c)
{
  const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    auto& s = soup_.surface;
    const auto base = static_cast<Index>(s.points.size());
    s.points.insert(s.points.end(), {p, q, r});
    const bool turned = chance(reversed_);
    s.triangles.push_back({base, base + (turned ? 2 : 1), base + (turned ? 1 : 2)});
    s.surfaceIds.push_back(name);
  };
  add(a, b, c);
  if (chance(repeated_))
  {
    add(b, c, a);
  }
  if (chance(sliver_))
  {
    add(a, b, a + uniform(0.2, 0.8) * (b - a) + uniform(1e-6, 1e-3) * (c - a));
  }
}

Vec3 inPlane(int axis, double at, double u, double v)
{
  Vec3 p;
  p[axis] = at;
  p[(axis + 1) % 3] = u;
  p[(axis + 2) % 3] = v;
  return p;
}

/// A rectangle normal to an axis, cut into triangles at random.
void Builder::addRectangle(Index name, int axis, double at, const Rectangle& r, const std::optional<Rectangle>& hole)
{
  std::vector<double> us{r[0], r[2]}, vs{r[1], r[3]};
  if (hole)
  {
    us.insert(us.end(), {(*hole)[0], (*hole)[2]});
    vs.insert(vs.end(), {(*hole)[1], (*hole)[3]});
  }
  for (int i = below(3); i > 0; --i)
  {
    us.push_back(uniform(r[0], r[2]));
    vs.push_back(uniform(r[1], r[3]));
  }
  std::sort(us.begin(), us.end());
  std::sort(vs.begin(), vs.end());
  for (std::size_t i = 0; i + 1 < us.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    {
      const double u = 0.5 * (us[i] + us[i + 1]);
      const double v = 0.5 * (vs[j] + vs[j + 1]);
      if (hole && u > (*hole)[0] && u < (*hole)[2] && v > (*hole)[1] && v < (*hole)[3])
      {
        continue;
      }
      const Vec3 a = inPlane(axis, at, us[i], vs[j]), b = inPlane(axis, at, us[i + 1], vs[j]),
                 c = inPlane(axis, at, us[i + 1], vs[j + 1]), d = inPlane(axis, at, us[i], vs[j + 1]);
      if (chance(0.5))
      {
        addTriangle(name, a, b, c);
        addTriangle(name, a, c, d);
      }
      else
      {
        addTriangle(name, a, b, d);
        addTriangle(name, b, c, d);
      }
    }
  }
}

/// Three octants or more, and one and more away from the rectangle's sides.
Rectangle Builder::holeIn(const Rectangle& r)
{
  Rectangle hole{};
  for (int i = 0; i < 2; ++i)
  {
    const double room = r[i + 2] - r[i] - 2.0 * octant_;
    const double size = uniform(3.0 * h, std::max(3.0 * h, room));
    hole[i] = r[i] + octant_ + uniform(0.0, std::max(0.0, room - size));
    hole[i + 2] = hole[i] + size;
  }
  return hole;
}

/// Gives a wall of a space a hole, or cuts it short on one side by little or by much.
std::optional<Rectangle> Builder::weaken(Rectangle& wall, Index inside)
{
  const auto weakness = static_cast<Weakness>(below(3));
  if (weakness != Weakness::crack)
  {
    connect(inside, 0);
  }
  switch (weakness)
  {
    case Weakness::opening:
      note("opening");
      return holeIn(wall);
    case Weakness::crack:
      note("crack");
      wall[2 + below(2)] -= uniform(0.002, 0.02) * h;
      break;
    case Weakness::gap:
      note("gap");
      wall[2 + below(2)] -= uniform(2.5, 4.0) * h;
      break;
  }
  return {};
}

/// Six walls about a space, which a partition across x may divide in two. Walls across x may be open. `sharedSide` is
/// the direction of the wall that the neighbor has too, with `door` in both; the way to `neighbor` is open if that is
/// given.
void Builder::addRoom(const Box3& box, const std::string& name, int sharedSide, const std::optional<Rectangle>& door,
                      Index neighbor)
{
  const bool divided = box.size()[0] >= 10.0 * octant_ && chance(0.6);
  const bool oneName = chance(0.3);
  const Index whole = oneName ? addName(name) : noIndex;
  const Index low = newSpace();
  const Index high = divided ? newSpace() : low;
  const Vec3 quarter(0.25 * box.size()[0], 0.0, 0.0);
  inSpace_.push_back({divided ? Vec3(box.center() - quarter) : box.center(), low});
  if (divided)
  {
    inSpace_.push_back({box.center() + quarter, high});
  }
  for (int side = 0; side < 6; ++side)
  {
    const int axis = axisOf(side), ua = (axis + 1) % 3, va = (axis + 2) % 3;
    const double at = isUpper(side) ? box.max[axis] : box.min[axis];
    Rectangle r{box.min[ua], box.min[va], box.max[ua], box.max[va]};
    const Index wall = oneName ? whole : addName(name + sideNames[side]);
    const Index inside = side == xMax ? high : low;
    std::optional<Rectangle> hole;
    if (side == sharedSide)
    {
      hole = door;
      if (door && neighbor != noIndex)
      {
        connect(inside, neighbor);
      }
    }
    else if (axis == 0 && chance(0.4))
    {
      hole = weaken(r, inside);
    }
    addRectangle(wall, axis, at, r, hole);
    const bool doubled = !hole && chance(0.15);
    if (oneName || (!doubled && side != sharedSide))
    {
      soup_.large.push_back(wall);
    }
    if (doubled)
    {
      const bool inPlace = chance(0.5);
      addRectangle(addName(name + "Again" + sideNames[side]), axis, at + (inPlace ? 0.0 : 1e-3 * h), r, {});
      note(inPlace ? "wall doubled in place" : "wall doubled beside");
    }
  }
  if (divided)
  {
    addPartition(box, name, low, high);
  }
  addSheets(box, name);
}

void Builder::addPartition(const Box3& box, const std::string& name, Index low, Index high)
{
  const double x = box.center()[0] + uniform(-0.1, 0.1) * octant_;
  Rectangle r{box.min[1], box.min[2], box.max[1], box.max[2]};
  for (int i = 0; i < 4; ++i)
  {
    const double outwards = i < 2 ? -1.0 : 1.0;
    const int kind = below(3);
    r[i] += outwards * (kind == 0 ? 0.0 : kind == 1 ? uniform(0.0, 0.9) * h : -uniform(0.002, 0.02) * h);
  }
  std::optional<Rectangle> door;
  if (chance(0.4))
  {
    door = holeIn({box.min[1], box.min[2], box.max[1], box.max[2]});
    connect(low, high);
  }
  note(door ? "partition with door" : "partition");
  const Index wall = addName(name + "Partition");
  soup_.large.push_back(wall);
  addRectangle(wall, 0, x, r, door);
}

/// Furniture within the room, which divides nothing, and a sheet through a wall that has no openings.
void Builder::addSheets(const Box3& box, const std::string& name)
{
  if (chance(0.4))
  {
    const Vec3 at = box.min + Vec3(0.25 * box.size()[0], 0.5 * box.size()[1], 1.3 * octant_);
    const double size = 0.6 * h * uniform(0.2, 1.5);
    const Vec3 u(uniform(-size, size), uniform(-size, size), uniform(-0.3, 0.3) * h);
    const Vec3 v(uniform(-size, size), uniform(-size, size), uniform(-0.3, 0.3) * h);
    const Index furniture = addName(name + "Furniture");
    addTriangle(furniture, at, at + u, at + v);
    addTriangle(furniture, at + u, at + u + v, at + v);
    note("furniture");
  }
  if (chance(0.4))
  {
    const Vec3 at(box.center()[0] + uniform(-1.0, 1.0) * h, box.center()[1] + uniform(-1.0, 1.0) * h, box.max[2]);
    const Vec3 u(uniform(1.0, 3.0) * h, uniform(-1.0, 1.0) * h, 0.0);
    const double depth = uniform(0.0, 0.9) * h;
    const Vec3 out(uniform(-0.5, 0.5) * h, uniform(-0.5, 0.5) * h, uniform(3.0, 6.0) * h);
    const Index chimney = addName(name + "Through");
    addTriangle(chimney, at - Vec3(0, 0, depth), at + u - Vec3(0, 0, depth), at + out);
    addTriangle(chimney, at + u - Vec3(0, 0, depth), at + u + out, at + out);
    note("sheet through wall");
  }
}

/// Turns and moves everything; sets the domain about it.
void Builder::place()
{
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const int kind = below(4);
  if (kind == 1)
  {
    turn = Eigen::AngleAxisd(uniform(0.0, 2.0 * std::numbers::pi), Vec3::UnitZ()).toRotationMatrix();
    note("turned about z");
  }
  else if (kind >= 2)
  {
    Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1));
    turn = q.normalized().toRotationMatrix();
    note("turned");
  }
  const double far = std::array<double, 4>{0.0, 1.0, 1e3, 2e5}[below(4)];
  const Vec3 offset(uniform(-far, far), uniform(-far, far), uniform(-far, far));
  note("offset by " + std::to_string(offset.norm()));
  Box3& domain = soup_.grid.domain;
  for (Vec3& p : soup_.surface.points)
  {
    p = turn * p + offset;
    domain.extend(p);
  }
  const double margin = 4.0 * octant_;
  domain.min.array() -= margin;
  domain.max.array() += margin;
  UnionFind spaces(spaceOf_.size());
  for (const auto& [a, b] : links_)
  {
    spaces.join(a, b);
  }
  for (const auto& [p, space] : inSpace_)
  {
    soup_.seeds.push_back({turn * p + offset, static_cast<int>(spaces.find(space))});
  }
  soup_.seeds.push_back({domain.min + Vec3::Constant(1.5 * octant_), 0});
  soup_.seeds.push_back({domain.max - Vec3::Constant(1.5 * octant_), 0});
}

DirtySoup Builder::build()
{
  octant_ = chance(0.5) ? h : 2.0 * h;
  soup_.grid.sizeMin = h;
  soup_.grid.sizeMid = octant_;
  soup_.grid.sizeMax = 4.0 * h;
  soup_.grid.startLevel = 1;
  reversed_ = chance(0.5) ? 0.3 : 0.0;
  repeated_ = chance(0.3) ? 0.2 : 0.0;
  sliver_ = chance(0.3) ? 0.2 : 0.0;
  const auto size = [&] {
    return Vec3(uniform(5.0, 12.0) * octant_, uniform(6.0, 9.0) * octant_, uniform(6.0, 8.0) * octant_);
  };
  const Vec3 first = size();
  const Box3 a{Vec3::Zero(), first};
  const int others = below(3);
  std::optional<Rectangle> door;
  if (others == 2 && chance(0.4))
  {
    door = holeIn({0.0, 0.0, 5.0 * octant_, 5.0 * octant_}); // in the low half of rooms that are divided
    note("door");
  }
  const Index spaceOfA = 1;
  addRoom(a, "A", others == 2 ? yMax : -1, door, noIndex);
  if (others > 0)
  {
    const double y = first[1] + (others == 2 ? 0.0 : uniform(3.0, 6.0) * octant_);
    const Vec3 corner(0.0, y, 0.0);
    note(others == 2 ? "room beside" : "second room");
    addRoom({corner, corner + size()}, "B", others == 2 ? yMin : -1, door, spaceOfA);
  }
  place();
  return std::move(soup_);
}

} // namespace

DirtySoup dirtySoup(unsigned seed) { return Builder(seed).build(); }

} // namespace atria::testing
