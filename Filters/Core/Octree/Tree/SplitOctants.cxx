// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/SplitOctants.h"

#include "Support/Sums.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace atria {

namespace {

// Coordinates in an octant count from its outer corner, which is a corner of its parent, in 1/512 of its size. They are
// odd for caps, so that no cap lies in a plane of the domain.
constexpr int whole = 512;
constexpr int half = 256;
constexpr std::array<int, 3> capOf{65, 129, 193};
constexpr std::array<int, 6> steps{0, capOf[0], capOf[1], capOf[2], half, whole};
using Local = std::array<int, 3>;

/// True if the octants across these axes (bits) from the outer corner are refined.
bool isFiner(unsigned finer, unsigned axes) { return (finer >> axes & 1) != 0; }

/// True if refined octants beyond the outer corner split an octant: all but one that only touches the corner.
bool splits(unsigned finer) { return (finer & 0x7e) != 0; }

/// Returns the part at a place between the steps, in doubled coordinates.
unsigned partAt(unsigned finer, const Local& doubled)
{
  unsigned part = 0;
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    const bool nearB = doubled[b] < 2 * capOf[a];
    const bool nearC = doubled[c] < 2 * capOf[a];
    const bool isNear = (nearB && isFiner(finer, 1u << b)) || (nearC && isFiner(finer, 1u << c)) ||
                        (nearB && nearC && isFiner(finer, 1u << b | 1u << c));
    part |= doubled[a] > 2 * half && isNear ? 1u << a : 0u;
  }
  return part;
}

/// How octants with the same refined ones beyond their outer corner are split.
struct Scheme
{
  struct Part
  {
    Local low{whole, whole, whole};
    Local high{0, 0, 0};
    Vec3 moment = Vec3::Zero();
    double volume = 0.0;
  };
  std::array<Part, 8> parts;
  /// Points where surfaces meet, except for those of the octree's grid.
  std::vector<Local> points;
};

/// Places for the vertices of parts beside finer octants on one face alone, in halves of the octant, by part: in no
/// slab, in the slab of the shallower cap, in that of the deeper one, in both. Coordinates are along the axes of the
/// slab with the shallower cap, of the one with the deeper cap, and off the face. They maximize the least of scaled
/// Jacobians and of edges over halves between two regions of octants, as a search found.
constexpr std::array<std::array<double, 3>, 4> flatPlaces{
    {{1.024, 1.097, 1.158}, {1.654, 0.739, 0.366}, {1.145, 1.622, 0.656}, {1.621, 1.394, 0.163}}};

/// Returns the axis of the only face beyond which octants are finer; -1 if there is none or are several.
int flatAxis(unsigned finer)
{
  const unsigned faces = (finer >> 1 & 1) | (finer >> 1 & 2) | (finer >> 2 & 4);
  if (!std::has_single_bit(faces))
  {
    return -1;
  }
  const unsigned others = 7 & ~faces;
  return isFiner(finer, others) ? -1 : std::countr_zero(faces);
}

/// Returns where the vertex of a part is best, in shares of the octant from its outer corner.
Vec3 placeOfFlat(unsigned part, int normal)
{
  const int shallow = normal == 0 ? 1 : 0;
  const int deep = normal == 2 ? 1 : 2;
  const std::array<double, 3>& place = flatPlaces[(part >> shallow & 1) | (part >> deep & 1) << 1];
  Vec3 out;
  out[shallow] = 0.5 * place[0];
  out[deep] = 0.5 * place[1];
  out[normal] = 0.5 * place[2];
  return out;
}

void addBox(const Local& at, unsigned finer, Scheme& scheme)
{
  const Local low{steps[at[0]], steps[at[1]], steps[at[2]]};
  const Local high{steps[at[0] + 1], steps[at[1] + 1], steps[at[2] + 1]};
  Scheme::Part& part = scheme.parts[partAt(finer, {low[0] + high[0], low[1] + high[1], low[2] + high[2]})];
  double volume = 1.0;
  Vec3 center;
  for (int axis = 0; axis < 3; ++axis)
  {
    part.low[axis] = std::min(part.low[axis], low[axis]);
    part.high[axis] = std::max(part.high[axis], high[axis]);
    volume *= high[axis] - low[axis];
    center[axis] = 0.5 * (low[axis] + high[axis]);
  }
  part.moment += volume * center;
  part.volume += volume;
}

/// True if an octant has another part on each side of a place that is in the octant: two at an edge, four at a face,
/// eight within.
bool isMeetingPoint(const Local& place, unsigned finer)
{
  unsigned met = 0;
  int sides = 0;
  for (unsigned direction = 0; direction < 8; ++direction)
  {
    Local doubled{};
    bool isWithin = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      doubled[axis] = 2 * place[axis] + ((direction >> axis & 1) != 0 ? 1 : -1);
      isWithin = isWithin && doubled[axis] > 0 && doubled[axis] < 2 * whole;
    }
    if (isWithin)
    {
      met |= 1u << partAt(finer, doubled);
      ++sides;
    }
  }
  return std::popcount(met) == sides;
}

bool isOctreePoint(const Local& place)
{
  return std::ranges::all_of(place, [](int c) { return c == 0 || c == half || c == whole; });
}

Scheme makeScheme(unsigned finer)
{
  Scheme scheme;
  for (int z = 0; z < 6; ++z)
  {
    for (int y = 0; y < 6; ++y)
    {
      for (int x = 0; x < 6; ++x)
      {
        const Local place{steps[x], steps[y], steps[z]};
        if (!isOctreePoint(place) && isMeetingPoint(place, finer))
        {
          scheme.points.push_back(place);
        }
        if (x < 5 && y < 5 && z < 5)
        {
          addBox({x, y, z}, finer, scheme);
        }
      }
    }
  }
  return scheme;
}

const Scheme& schemeOf(unsigned finer)
{
  static const std::array<Scheme, 128> schemes = [] {
    std::array<Scheme, 128> all;
    for (unsigned i = 0; i < all.size(); ++i)
    {
      all[i] = makeScheme(2 * i);
    }
    return all;
  }();
  return schemes[finer / 2];
}

/// Returns the child that an octant is of its parent: bits x 1, y 2, z 4.
unsigned childOf(MortonKey key) { return static_cast<unsigned>(key & 7); }
unsigned childOf(const Octree& octree, Index leaf) { return childOf(octree.key(leaf)); }

/// Returns bits 1 to 7 for the octants beyond the outer corner of an octant, across axes x 1, y 2, z 4, that are
/// refined.
template <typename IsRefined> unsigned finerBeyond(MortonKey key, int level, IsRefined&& isRefined)
{
  const GridCell cell = gridCell(key);
  const std::uint32_t end = 1u << level;
  unsigned finer = 0;
  for (unsigned across = 1; level > 0 && across < 8; ++across)
  {
    GridCell other = cell;
    bool isInRoot = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((across >> axis & 1) != 0)
      {
        other[axis] += (childOf(key) >> axis & 1) != 0 ? 1u : ~0u;
        isInRoot = isInRoot && other[axis] < end;
      }
    }
    finer |= isInRoot && isRefined(mortonKey(other)) ? 1u << across : 0u;
  }
  return finer;
}

LatticePoint placeIn(MortonKey key, int level, const GridFrame& frame, const Local& local)
{
  const GridCell cell = gridCell(key);
  const std::int64_t size = frame.latticeSize(level);
  LatticePoint place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isUpperOuter = (childOf(key) >> axis & 1) != 0;
    const std::int64_t way = local[axis] * size / whole;
    place[axis] = cell[axis] * size + (isUpperOuter ? size - way : way);
  }
  return place;
}

/// Returns in eighths how much of a point belongs to an octant: octants that share it have the same share.
unsigned eighthsOf(const Local& local)
{
  unsigned eighths = 8;
  for (const int c : local)
  {
    eighths /= c == 0 || c == whole ? 2 : 1;
  }
  return eighths;
}

/// Returns in eighths how many points inside the domain belong to an octant that is not refined.
unsigned pointEighthsOf(MortonKey key, int level, const std::vector<MortonKey>& refined, const GridFrame& frame)
{
  const unsigned finer =
      finerBeyond(key, level, [&](MortonKey other) { return std::ranges::binary_search(refined, other); });
  if (!splits(finer))
  {
    return 0;
  }
  unsigned eighths = 0;
  for (const Local& local : schemeOf(finer).points)
  {
    eighths += frame.inDomain(placeIn(key, level, frame, local)) ? eighthsOf(local) : 0;
  }
  return eighths;
}

} // namespace

SplitOctants::SplitOctants(const Octree& octree, const RunContext& context) : octree_(octree)
{
  finer_.resize(octree.leafCount());
  context.executor.forEach(octree.leafCount(), 4096, [&](std::size_t leaf) {
    const unsigned finer = finerAround(static_cast<Index>(leaf));
    finer_[leaf] = static_cast<std::uint8_t>(splits(finer) ? finer : 0);
  });
}

unsigned SplitOctants::finerAround(Index leaf) const
{
  const int level = octree_.level(leaf);
  return finerBeyond(octree_.key(leaf), level,
                     [&](MortonKey other) { return !Octree::isLeaf(octree_.nodeAt(other, level)); });
}

LatticePoint SplitOctants::outerCorner(Index leaf) const { return octree_.cornerOf(leaf, childOf(octree_, leaf)); }

SplitCell SplitOctants::cellAt(Index leaf, const LatticePoint& point, unsigned direction) const
{
  const SplitCell cell = SplitCell{leaf} << 3;
  if (!isSplit(leaf))
  {
    return cell;
  }
  const std::int64_t size = octree_.frame().latticeSize(octree_.level(leaf));
  const LatticePoint outer = outerCorner(leaf);
  const unsigned child = childOf(octree_, leaf);
  Local doubled{};
  for (int axis = 0; axis < 3; ++axis)
  {
    // Inwards is away from the outer corner.
    const bool isInwards = (direction >> axis & 1) != (child >> axis & 1);
    const auto local = static_cast<int>(std::abs(point[axis] - outer[axis]) * whole / size);
    doubled[axis] = 2 * local + (isInwards ? 1 : -1);
  }
  return cell | partAt(finer_[leaf], doubled);
}

LatticePoint SplitOctants::placeOf(Index leaf, const Local& local) const
{
  return placeIn(octree_.key(leaf), octree_.level(leaf), octree_.frame(), local);
}

std::vector<LatticePoint> SplitOctants::pointsOf(Index leaf) const
{
  std::vector<LatticePoint> places;
  for (const Local& local : schemeOf(finer_[leaf]).points)
  {
    places.push_back(placeOf(leaf, local));
  }
  return places;
}

LatticeBox SplitOctants::boundsOf(SplitCell cell) const
{
  const Scheme::Part& part = schemeOf(finer_[leafOf(cell)]).parts[partOf(cell)];
  return atria::boundsOf(placeOf(leafOf(cell), part.low), placeOf(leafOf(cell), part.high));
}

Vec3 SplitOctants::centerOf(SplitCell cell) const
{
  const Index leaf = leafOf(cell);
  const Scheme::Part& part = schemeOf(finer_[leaf]).parts[partOf(cell)];
  const int normal = flatAxis(finer_[leaf]);
  const Vec3 local = normal >= 0 ? placeOfFlat(partOf(cell), normal) : Vec3(part.moment / (part.volume * whole));
  const auto size = static_cast<double>(octree_.frame().latticeSize(octree_.level(leaf)));
  const unsigned child = childOf(octree_, leaf);
  Vec3 place = toVector(outerCorner(leaf));
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] += ((child >> axis & 1) != 0 ? -size : size) * local[axis];
  }
  return place;
}

std::size_t countSplitPoints(const RefinedSets& refined, const GridFrame& frame, const RunContext& context)
{
  static const std::vector<MortonKey> none;
  std::size_t eighths = 0;
  for (std::size_t above = 0; above < refined.size(); ++above)
  {
    const std::vector<MortonKey>& finer = above + 1 < refined.size() ? refined[above + 1] : none;
    eighths += sumOver(refined[above].size(), context, [&](std::size_t i) {
      std::size_t sum = 0;
      for (MortonKey key = refined[above][i] << 3, end = key + 8; key < end; ++key)
      {
        const bool isLeaf = !std::ranges::binary_search(finer, key);
        sum += isLeaf ? pointEighthsOf(key, static_cast<int>(above) + 1, finer, frame) : 0;
      }
      return sum;
    });
  }
  return eighths / 8;
}

} // namespace atria
