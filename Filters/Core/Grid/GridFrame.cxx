// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/GridFrame.h"

#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace atria {

namespace {

/// Bits that hold any lattice difference; products of three then fit 128 bits (see Predicates.h).
constexpr int latticeBits = 40;

template <typename... Parts> std::string text(const Parts&... parts)
{
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

void checkOptions(const GridOptions& o)
{
  if (!(o.sizeMin > 0.0) || !(o.sizeMid >= o.sizeMin) || !(o.sizeMax >= o.sizeMid) || !std::isfinite(o.sizeMin) ||
      !std::isfinite(o.sizeMid))
  {
    throw Error(text("sizes must be positive and SizeMin <= SizeMid <= SizeMax; they are ", o.sizeMin, ", ", o.sizeMid,
                     ", ", o.sizeMax));
  }
  if (o.domain.empty() || !o.domain.min.allFinite() || !o.domain.max.allFinite())
  {
    throw Error("the domain is empty: give bounds with min < max on every axis, or surfaces to take them from");
  }
  const Vec3 size = o.domain.size();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(size[axis] >= (1.0 - 1e-9) * 2.0 * o.sizeMin))
    {
      throw Error(text("the domain is ", size[axis], " long in ", "xyz"[axis], ", less than two octants of SizeMin ",
                       o.sizeMin, ": enlarge the domain or lower SizeMin"));
    }
  }
}

/// Returns the level whose octants come closest to `size`.
int levelClosestTo(double size, const GridFrame& frame)
{
  int best = frame.depth;
  for (int level = frame.depth; level >= 0; --level)
  {
    if (std::abs(frame.sizeOf(level) - size) < std::abs(frame.sizeOf(best) - size))
    {
      best = level;
    }
  }
  return best;
}

/// Returns how often sizeMin is halved to reach the finest requested size.
int levelsBelow(const GridOptions& o)
{
  constexpr double rounding = 1.0 + 1e-9;
  int levels = 0;
  while (levels <= GridFrame::maximumDepth && std::ldexp(o.sizeMin, -levels) > o.finestAsked * rounding)
  {
    ++levels;
  }
  return levels;
}

/// Returns the number of finest octants between the lower planes of the root and the domain: half of the spare length
/// of the smallest octant at the root's lower end that is as long as the domain. So planes between large octants do not
/// cut through a flat domain, whose parts are then neighbors in the Morton order. If there are levels below SizeMin and
/// there is room, the domain's plane is next to the centers of octants of SizeMin.
double marginOf(double octants, double rootOctants, int below)
{
  const double period = std::ldexp(1.0, below);
  double room = rootOctants;
  while (0.5 * room >= octants + 1.0)
  {
    room *= 0.5;
  }
  for (;; room *= 2.0)
  {
    const double spare = room - octants - 1.0;
    const double half = std::max(0.0, std::floor(0.5 * spare + 1e-9));
    const double margin = below > 0 ? period * std::floor(half / period) + 0.5 * period : half;
    if (margin <= spare + 1e-9)
    {
      return margin;
    }
    if (room >= rootOctants)
    {
      return half;
    }
  }
}

} // namespace

int coarsestLevelFor(const GridFrame& frame)
{
  const double thinnest = frame.domain.size().minCoeff();
  int level = 0;
  while (level < frame.depth && 2.0 * frame.sizeOf(level) > thinnest)
  {
    ++level;
  }
  return level;
}

LatticePoint GridFrame::toLattice(const Vec3& p) const
{
  const double scale = 1.0 / latticeUnit();
  LatticePoint out;
  for (int axis = 0; axis < 3; ++axis)
  {
    out[axis] = std::llround((p[axis] - origin[axis]) * scale);
  }
  return out;
}

Vec3 GridFrame::toModel(const LatticePoint& p) const
{
  const double unit = latticeUnit();
  return {origin[0] + static_cast<double>(p[0]) * unit, origin[1] + static_cast<double>(p[1]) * unit,
          origin[2] + static_cast<double>(p[2]) * unit};
}

bool GridFrame::inDomain(const LatticePoint& p) const
{
  return p[0] > domainLow[0] && p[0] < domainHigh[0] && p[1] > domainLow[1] && p[1] < domainHigh[1] &&
         p[2] > domainLow[2] && p[2] < domainHigh[2];
}

unsigned GridFrame::domainPlanes(const LatticePoint& low, const LatticePoint& high) const
{
  unsigned planes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Grid points on a plane are outside, so the edges that cross it are those of the octant on its inner side.
    planes |= (low[axis] <= domainLow[axis] && domainLow[axis] < high[axis]) ? 1u << (2 * axis) : 0u;
    planes |= (low[axis] < domainHigh[axis] && domainHigh[axis] <= high[axis]) ? 1u << (2 * axis + 1) : 0u;
  }
  return planes;
}

void fitLattice(GridFrame& frame, const Box3& extent)
{
  Box3 all{frame.origin, frame.origin + Vec3::Constant(frame.rootSize())};
  if (!extent.empty())
  {
    all.extend(extent.min);
    all.extend(extent.max);
  }
  const double reach = all.size().maxCoeff();
  const double reachOctants = 2.0 * reach / frame.finestSize;
  frame.subBits = latticeBits - static_cast<int>(std::ceil(std::log2(std::max(reachOctants, 2.0)))) - 1;
  if (frame.subBits < 8)
  {
    throw Error(
        text("the surfaces and the domain reach over ", reach, ", too far for octants of ", frame.finestSize,
             ": remove stray geometry, raise SizeMin or the finer requested size, or move the model to the origin"));
  }
  frame.subBits = std::min(frame.subBits, 30);
  frame.domainLow = frame.toLattice(frame.domain.min);
  frame.domainHigh = frame.toLattice(frame.domain.max);
}

GridFrame makeGridFrame(const GridOptions& options, const Box3& extent)
{
  checkOptions(options);
  GridFrame frame;
  frame.domain = options.domain;
  const int below = levelsBelow(options);
  frame.finestSize = std::ldexp(options.sizeMin, -below);
  const Vec3 octants = options.domain.size() / frame.finestSize;
  // One octant is added to the length, as half of one reaches out at either end.
  const double needed = octants.maxCoeff() + 1.0 - 1e-9 * octants.maxCoeff();
  while (frame.depth <= GridFrame::maximumDepth && static_cast<double>(std::int64_t{1} << frame.depth) < needed)
  {
    ++frame.depth;
  }
  if (frame.depth > GridFrame::maximumDepth)
  {
    throw Error(text("the domain is ", octants.maxCoeff(), " times as long as the finest octants of ", frame.finestSize,
                     " (SizeMin, or a finer requested size); at most ", std::int64_t{1} << GridFrame::maximumDepth,
                     " is possible: raise the size or shrink the domain"));
  }
  const double rootOctants = static_cast<double>(std::int64_t{1} << frame.depth);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double margin = marginOf(octants[axis], rootOctants, below);
    frame.origin[axis] = options.domain.min[axis] - (margin + 0.5) * frame.finestSize;
  }
  frame.featureLevel = std::max(frame.depth - below, 0);
  frame.startLevel = std::clamp(std::max(options.startLevel, coarsestLevelFor(frame)), 0, frame.depth);
  frame.midLevel = std::max(levelClosestTo(options.sizeMid, frame), frame.startLevel);
  frame.topLevel = std::max(levelClosestTo(std::min(options.sizeMax, frame.rootSize()), frame), frame.startLevel);

  fitLattice(frame, extent);
  return frame;
}

} // namespace atria
