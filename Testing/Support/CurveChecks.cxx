// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/BoxIndex.h"
#include "Support/FeatureChecks.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace atria::testing {

namespace {

/// f(point, length) for samples along a segment.
template <typename F> void sampleSegment(const Vec3& a, const Vec3& b, double spacing, F&& f)
{
  const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing)));
  for (int k = 0; k < n; ++k)
  {
    f(Vec3(a + (k + 0.5) / n * (b - a)), (b - a).norm() / n);
  }
}

/// Where the line through p along d passes the triangle: signed distance from p, or infinity.
double passesAt(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  const Vec3 e = b - a, f = c - a, h = d.cross(f);
  const double determinant = e.dot(h);
  if (std::abs(determinant) < 1e-9 * e.norm() * f.norm())
  {
    return never;
  }
  const Vec3 s = p - a, q = s.cross(e);
  const double x = s.dot(h) / determinant;
  const double y = d.dot(q) / determinant;
  return x < 0.0 || y < 0.0 || x + y > 1.0 ? never : f.dot(q) / determinant;
}

bool outsideOrOnDomainEdge(const GridFrame& frame, const Vec3& p)
{
  const double tolerance = 2.0 * frame.latticeUnit() + 1e-4;
  int planes = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const double outside = (isUpper(direction) ? 1.0 : -1.0) * (p[axisOf(direction)] - frame.planeOf(direction));
    if (outside > tolerance)
    {
      return true;
    }
    planes += outside > -tolerance ? 1 : 0;
  }
  return planes >= 2;
}

} // namespace

/// The edges of the mesh's boundary by place.
class FeatureChecks::SegmentIndex
{
public:
  explicit SegmentIndex(const FeatureChecks& checks)
      : checks_(checks), search_(checks.frame_.finestSize), index_(search_)
  {
    for (Index i = 0; i < checks.segments_.size(); ++i)
    {
      Box3 box;
      box.extend(checks.places_[checks.segments_[i].a]);
      box.extend(checks.places_[checks.segments_[i].b]);
      index_.add(i, box, search_);
    }
  }

  struct Distances
  {
    double feature;
    double any;
  };
  /// At most the search distance, a finest octant's size.
  Distances distances(const Vec3& p) const
  {
    Distances out{search_, search_};
    for (const Index i : index_.at(p))
    {
      const Segment& s = checks_.segments_[i];
      const double d = (nearestOnSegment(p, checks_.places_[s.a], checks_.places_[s.b]) - p).norm();
      out.any = std::min(out.any, d);
      out.feature = s.feature ? std::min(out.feature, d) : out.feature;
    }
    return out;
  }

private:
  const FeatureChecks& checks_;
  double search_;
  BoxIndex index_;
};

CurveCoverage FeatureChecks::curves() const
{
  const SegmentIndex segments(*this);
  const std::vector<std::vector<Index>> surfaces = surfacesOfCurves(model_);
  CurveCoverage out;
  for (Index e = 0; e < model_.featureEdges.size(); ++e)
  {
    const FeatureEdge& edge = model_.featureEdges[e];
    CurveFigures& kind = out.ofKind[static_cast<int>(model_.kindOf(edge))];
    CurveMiss miss{e, model_.kindOf(edge), 0.0, 0.0, 0.0, modelPoint(edge.a), modelPoint(edge.b), Vec3::Zero(), {}};
    sampleSegment(miss.begin, miss.end, tolerances_.curveSpacing, [&](const Vec3& p, double length) {
      if (outsideOrOnDomainEdge(frame_, p))
      {
        return;
      }
      const auto distance = segments.distances(p);
      kind.length += length;
      kind.onAny += distance.any <= tolerances_.curve ? length : 0.0;
      kind.onFeature += distance.feature <= tolerances_.curve ? length : 0.0;
      miss.length += length;
      miss.farthest = std::max(miss.farthest, distance.feature);
      if (distance.feature > tolerances_.curve)
      {
        miss.missed += length;
        miss.middle += length * p;
      }
    });
    if (miss.missed > 0.0)
    {
      miss.middle /= miss.missed;
      for (const Index s : surfaces[edge.curve])
      {
        miss.names += (miss.names.empty() ? "" : " + ") + model_.names[s];
      }
      out.misses.push_back(miss);
    }
  }
  for (const CurveFigures& kind : out.ofKind)
  {
    out.total.length += kind.length;
    out.total.onFeature += kind.onFeature;
    out.total.onAny += kind.onAny;
  }
  std::stable_sort(out.misses.begin(), out.misses.end(),
                   [](const CurveMiss& l, const CurveMiss& r) { return l.missed > r.missed; });
  return out;
}

bool FeatureChecks::covers(const Piece& piece, const Vec3& p, const Vec3& normal) const
{
  bool found = false;
  eachTriangle(piece, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    found = found || std::abs(passesAt(p, normal, a, b, c)) <= tolerances_.openingDepth;
  });
  return found;
}

std::vector<OpeningFigures> FeatureChecks::openings(const std::vector<Opening>& openings) const
{
  const BoxIndex pieces = indexOfPieces(tolerances_.openingDepth);
  const SegmentIndex segments(*this);
  std::vector<OpeningFigures> out;
  for (const Opening& opening : openings)
  {
    const FlatOpening flat(opening);
    OpeningFigures figures{opening.name, flat.area, 0.0, 0.0, 0.0};
    double samples = 0.0, blocked = 0.0;
    flat.sample(tolerances_.openingSpacing, [&](const Vec3& p) {
      const auto& near = pieces.at(p);
      samples += 1.0;
      blocked += std::any_of(near.begin(), near.end(), [&](Index i) { return covers(pieces_[i], p, flat.normal); })
                     ? 1.0
                     : 0.0;
    });
    figures.blocked = samples > 0.0 ? flat.area * blocked / samples : 0.0;
    double length = 0.0;
    for (std::size_t i = 0; i < opening.outline.size(); ++i)
    {
      const Vec3& a = opening.outline[i];
      figures.corner = std::max(figures.corner, segments.distances(a).feature);
      sampleSegment(a, opening.outline[(i + 1) % opening.outline.size()], tolerances_.curveSpacing,
                    [&](const Vec3& p, double part) {
                      length += part;
                      figures.outline += segments.distances(p).feature <= tolerances_.curve ? part : 0.0;
                    });
    }
    figures.outline /= length;
    out.push_back(figures);
  }
  return out;
}

} // namespace atria::testing
