// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sweeps.h"

#include <algorithm>

namespace atria::vrml {

namespace {

using Frame = Eigen::Matrix3d; ///< columns: the axes of a cross-section's plane in space

/// Returns the turn from the default cross-section's normal to the direction of a straight spine.
Frame straightFrame(const Vec3& direction)
{
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), direction).toRotationMatrix();
}

/// Neighbors along the spine; at the ends of a closed one, across the seam.
struct Neighbors
{
  const Vec3& before;
  const Vec3& after;
};
Neighbors neighborsOf(const std::vector<Vec3>& spine, std::size_t i, bool closed)
{
  const std::size_t last = spine.size() - 1;
  const std::size_t before = i > 0 ? i - 1 : closed ? last - 1 : 0;
  const std::size_t after = i < last ? i + 1 : closed ? 1 : last;
  return {spine[before], spine[after]};
}

Vec3 unitOrZero(const Vec3& v)
{
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// Returns directions along the spine. Coincident points have that of the point before.
std::vector<Vec3> tangents(const std::vector<Vec3>& spine, bool closed)
{
  std::vector<Vec3> out(spine.size());
  Vec3 known = Vec3::Zero();
  for (std::size_t i = 0; i < spine.size(); ++i)
  {
    const auto [before, after] = neighborsOf(spine, i, closed);
    out[i] = unitOrZero(after - before);
    out[i] = out[i].isZero() ? known : out[i];
    known = out[i];
  }
  // Leading coincident points take the first direction that exists.
  const auto first = std::find_if(out.begin(), out.end(), [](const Vec3& t) { return !t.isZero(); });
  std::fill(out.begin(), first, first == out.end() ? Vec3(Vec3::UnitY()) : *first);
  return out;
}

/// Returns the z axes of the cross-sections' planes: normals of the spine's bends, none turned against the one before.
std::vector<Vec3> bends(const std::vector<Vec3>& spine, bool closed)
{
  constexpr double straight = 1e-9;
  std::vector<Vec3> out(spine.size(), Vec3::Zero());
  for (std::size_t i = 0; i < spine.size(); ++i)
  {
    const auto [before, after] = neighborsOf(spine, i, closed);
    const Vec3 z = unitOrZero(after - spine[i]).cross(unitOrZero(before - spine[i]));
    out[i] = z.norm() > straight ? z.normalized() : Vec3(Vec3::Zero());
  }
  const auto first = std::find_if(out.begin(), out.end(), [](const Vec3& z) { return !z.isZero(); });
  if (first == out.end())
  {
    return out;
  }
  std::fill(out.begin(), first, *first);
  for (std::size_t i = 1; i < out.size(); ++i)
  {
    out[i] = out[i].isZero() ? out[i - 1] : out[i];
    out[i] = out[i].dot(out[i - 1]) < 0.0 ? Vec3(-out[i]) : out[i];
  }
  return out;
}

std::vector<Frame> framesOf(const std::vector<Vec3>& spine, bool closed)
{
  const std::vector<Vec3> y = tangents(spine, closed);
  const std::vector<Vec3> z = bends(spine, closed);
  std::vector<Frame> out(spine.size());
  for (std::size_t i = 0; i < spine.size(); ++i)
  {
    if (z[i].isZero())
    {
      out[i] = straightFrame(y[0]);
      continue;
    }
    // A bend taken over from a neighbor need not be normal to the direction here.
    const Vec3 x = unitOrZero(y[i].cross(z[i]));
    if (x.isZero())
    {
      out[i] = straightFrame(y[i]);
      continue;
    }
    out[i] << x, y[i], x.cross(y[i]);
  }
  return out;
}

template <class T> const T& atOrLast(const std::vector<T>& values, std::size_t i)
{
  return values[std::min(i, values.size() - 1)];
}

class Sweep
{
public:
  explicit Sweep(const Extrusion& source)
      : in(source), builder(!source.ccw),
        sectionClosed(source.crossSection.size() > 2 && source.crossSection.front() == source.crossSection.back()),
        width(source.crossSection.size() - (sectionClosed ? 1 : 0))
  {
  }

  LocalSurface run()
  {
    const bool spineClosed = in.spine.size() > 2 && in.spine.front() == in.spine.back();
    const std::vector<Frame> frames = framesOf(in.spine, spineClosed);
    for (std::size_t i = 0; i < in.spine.size(); ++i)
    {
      rings.push_back(ring(i, frames[i]));
    }
    const bool joined = spineClosed && atOrLast(in.scale, rings.size() - 1) == in.scale.front() &&
                        atOrLast(in.orientation, rings.size() - 1).coeffs() == in.orientation.front().coeffs();
    if (joined)
    {
      rings.back() = rings.front();
    }
    for (std::size_t i = 1; i < rings.size(); ++i)
    {
      band(rings[i - 1], rings[i]);
    }
    if (in.beginCap && !joined)
    {
      builder.polygon(std::vector<Index>(rings.front().rbegin(), rings.front().rend()));
    }
    if (in.endCap && !joined)
    {
      builder.polygon(rings.back());
    }
    return builder.take();
  }

private:
  std::vector<Index> ring(std::size_t i, const Frame& frame)
  {
    const Eigen::Matrix3d turn = frame * atOrLast(in.orientation, i).toRotationMatrix();
    const Eigen::Vector2d scale = atOrLast(in.scale, i);
    std::vector<Index> ids;
    for (std::size_t k = 0; k < width; ++k)
    {
      const Eigen::Vector2d p = in.crossSection[k].cwiseProduct(scale);
      ids.push_back(builder.point(in.spine[i] + turn * Vec3(p.x(), 0.0, p.y())));
    }
    return ids;
  }

  void band(const std::vector<Index>& lower, const std::vector<Index>& upper)
  {
    for (std::size_t k = 0; k + (sectionClosed ? 0 : 1) < width; ++k)
    {
      const std::size_t next = (k + 1) % width;
      builder.quad(lower[k], lower[next], upper[next], upper[k]);
    }
  }

  const Extrusion& in;
  SurfaceBuilder builder;
  bool sectionClosed;
  std::size_t width; ///< different points of the cross-section
  std::vector<std::vector<Index>> rings;
};

} // namespace

Eigen::Quaterniond rotationOf(const double* axisAndAngle)
{
  const Vec3 axis = unitOrZero(Vec3(axisAndAngle[0], axisAndAngle[1], axisAndAngle[2]));
  return axis.isZero() ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(Eigen::AngleAxisd(axisAndAngle[3], axis));
}

LocalSurface makeElevationGrid(const ElevationGrid& grid)
{
  SurfaceBuilder builder(!grid.ccw);
  for (int z = 0; z < grid.zDimension; ++z)
  {
    for (int x = 0; x < grid.xDimension; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(z) * grid.xDimension + x;
      builder.point({x * grid.xSpacing, grid.height[i], z * grid.zSpacing});
    }
  }
  const auto width = static_cast<Index>(grid.xDimension);
  for (Index z = 0; z + 1 < static_cast<Index>(grid.zDimension); ++z)
  {
    for (Index x = 0; x + 1 < width; ++x)
    {
      const Index a = z * width + x;
      builder.quad(a, a + width, a + width + 1, a + 1);
    }
  }
  return builder.take();
}

LocalSurface makeExtrusion(const Extrusion& extrusion) { return Sweep(extrusion).run(); }

} // namespace atria::vrml
