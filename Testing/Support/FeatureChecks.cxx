// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/FeatureChecks.h"

#include "Support/BoxIndex.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace atria::testing {

namespace {

/// Number of each point's place; equal coordinates are one place.
std::vector<Index> placesOf(const std::vector<Vec3>& points, std::vector<Vec3>& places)
{
  std::map<std::array<double, 3>, Index> known;
  std::vector<Index> out(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto [found, isNew] =
        known.try_emplace({points[i][0], points[i][1], points[i][2]}, static_cast<Index>(places.size()));
    if (isNew)
    {
      places.push_back(points[i]);
    }
    out[i] = found->second;
  }
  return out;
}

/// Triangles' points spread evenly, at about `spacing`; at most some ten thousand.
template <typename F> void sampleTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double spacing, F&& f)
{
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, 200);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n - i; ++j)
    {
      const double s = (i + 1.0 / 3.0) / n;
      const double t = (j + 1.0 / 3.0) / n;
      f(Vec3(a + s * (b - a) + t * (c - a)));
      if (i + j < n - 1)
      {
        f(Vec3(a + (s + 1.0 / (3.0 * n)) * (b - a) + (t + 1.0 / (3.0 * n)) * (c - a)));
      }
    }
  }
}

} // namespace

FeatureChecks::FeatureChecks(const DualMesh& mesh, const SurfaceModel& model, const GridFrame& frame,
                             const FeatureTolerances& tolerances)
    : mesh_(mesh), model_(model), frame_(frame), tolerances_(tolerances)
{
  findPieces();
  findSegments();
}

void FeatureChecks::findPieces()
{
  const std::vector<Index> placeOf = placesOf(mesh_.points, places_);
  std::map<std::array<Index, 4>, Index> known;
  for (const BoundaryFace& face : mesh_.boundaryFaces)
  {
    const ReducedFace corners = faceOf(mesh_.corners[face.element], face.direction);
    Piece piece;
    piece.points.fill(noIndex);
    int count = 0;
    for (int i = 0; i < corners.count; ++i)
    {
      const Index place = placeOf[corners.points[i]];
      if (std::find(piece.points.begin(), piece.points.end(), place) == piece.points.end())
      {
        piece.points[count++] = place;
      }
    }
    if (count < 3)
    {
      continue; // its neighbors meet in its place
    }
    eachTriangle(piece, [&](const Vec3& m, const Vec3& a, const Vec3& b) {
      const Vec3 twice = (a - m).cross(b - m);
      piece.normal += twice;
      piece.area += 0.5 * twice.norm();
    });
    piece.normal.normalize();
    std::array<Index, 4> key = piece.points;
    std::sort(key.begin(), key.end());
    const auto [found, isNew] = known.try_emplace(key, static_cast<Index>(pieces_.size()));
    if (isNew)
    {
      pieces_.push_back(piece);
    }
    Piece& place = pieces_[found->second];
    if (place.faces < 2)
    {
      place.tags[place.faces] = face.tag;
      place.sides[place.faces++] = face.side;
    }
  }
}

void FeatureChecks::findSegments()
{
  std::map<std::pair<Index, Index>, std::vector<Index>> uses;
  for (Index i = 0; i < pieces_.size(); ++i)
  {
    for (int k = 0; k < pieces_[i].count(); ++k)
    {
      uses[std::minmax(pieces_[i].points[k], pieces_[i].points[(k + 1) % pieces_[i].count()])].push_back(i);
    }
  }
  const auto sameTags = [](const Piece& p, const Piece& q) {
    return p.faces == q.faces && std::is_permutation(p.tags.begin(), p.tags.end(), q.tags.begin());
  };
  const double smooth = std::cos(tolerances_.angle * std::numbers::pi / 180.0);
  for (const auto& [edge, of] : uses)
  {
    // A piece's normal points away from the element of its first face, whichever side that is on.
    const bool feature = of.size() != 2 || !sameTags(pieces_[of[0]], pieces_[of[1]]) ||
                         std::abs(pieces_[of[0]].normal.dot(pieces_[of[1]].normal)) < smooth;
    segments_.push_back({edge.first, edge.second, feature});
  }
}

std::vector<SurfaceArea> FeatureChecks::areas() const
{
  std::vector<SurfaceArea> out(model_.names.size());
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    out[i].name = model_.names[i];
  }
  const double unit = frame_.latticeUnit() * frame_.latticeUnit();
  for (Index t = 0; t < model_.triangles.size(); ++t)
  {
    out[model_.surfaceIds[t]].model += 0.5 * model_.normal(t).norm() * unit;
  }
  for (const Piece& piece : pieces_)
  {
    for (int i = 0; i < piece.faces; ++i)
    {
      if (piece.tags[i] < out.size())
      {
        SurfaceArea& area = out[piece.tags[i]];
        area.once += piece.area / piece.faces;
        (piece.sides[i] == SheetSide::front ? area.front : area.back) += piece.area;
      }
    }
  }
  return out;
}

double FeatureChecks::distanceTo(const Piece& piece, const Vec3& p) const
{
  double nearest = std::numeric_limits<double>::infinity();
  eachTriangle(piece, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    nearest = std::min(nearest, (nearestOnTriangle(p, a, b, c) - p).squaredNorm());
  });
  return std::sqrt(nearest);
}

bool FeatureChecks::Piece::has(Index tag, SheetSide side) const
{
  return (tags[0] == tag && sides[0] == side) || (tags[1] == tag && sides[1] == side);
}

BoxIndex FeatureChecks::indexOfPieces(double margin) const
{
  BoxIndex index(frame_.finestSize);
  for (Index i = 0; i < pieces_.size(); ++i)
  {
    Box3 box;
    for (int k = 0; k < pieces_[i].count(); ++k)
    {
      box.extend(places_[pieces_[i].points[k]]);
    }
    index.add(i, box, margin);
  }
  return index;
}

std::vector<NameCoverage> FeatureChecks::names() const
{
  constexpr double never = std::numeric_limits<double>::infinity();
  const double search = frame_.finestSize;
  const BoxIndex index = indexOfPieces(search);
  std::vector<NameCoverage> out(model_.names.size());
  std::vector<double> total(model_.names.size(), 0.0);
  for (Index t = 0; t < model_.triangles.size(); ++t)
  {
    const Index tag = model_.surfaceIds[t];
    std::array<std::size_t, 4> hits{}; // samples; front, back, either
    const auto& [a, b, c] = model_.triangles[t];
    sampleTriangle(modelPoint(a), modelPoint(b), modelPoint(c), tolerances_.surfaceSpacing, [&](const Vec3& p) {
      double nearest = search, front = never, back = never;
      for (const Index i : index.at(p))
      {
        const double d = distanceTo(pieces_[i], p);
        nearest = std::min(nearest, d);
        front = pieces_[i].has(tag, SheetSide::front) ? std::min(front, d) : front;
        back = pieces_[i].has(tag, SheetSide::back) ? std::min(back, d) : back;
      }
      const double enough = std::min(nearest + tolerances_.curve, tolerances_.surface);
      hits[0] += 1;
      hits[1] += front <= enough ? 1 : 0;
      hits[2] += back <= enough ? 1 : 0;
      hits[3] += std::min(front, back) <= enough ? 1 : 0;
    });
    const double weight = model_.normal(t).norm() / static_cast<double>(hits[0]);
    total[tag] += model_.normal(t).norm();
    out[tag].front += weight * static_cast<double>(hits[1]);
    out[tag].back += weight * static_cast<double>(hits[2]);
    out[tag].either += weight * static_cast<double>(hits[3]);
  }
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    out[i].name = model_.names[i];
    for (double* sum : {&out[i].front, &out[i].back, &out[i].either})
    {
      *sum = total[i] > 0.0 ? *sum / total[i] : 1.0;
    }
  }
  return out;
}

} // namespace atria::testing
