// SPDX-License-Identifier: GPL-3.0-or-later
/// How well a mesh keeps what its model has: area, openings, curves, names.
#pragma once

#include "Support/BoxIndex.h"
#include "Support/MeshIt.h"
#include "Support/Opening.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace atria::testing {

/// Area of a surface in the model and in the mesh, square meters. Faces count as triangles about the mean of their
/// points.
struct SurfaceArea
{
  std::string name;
  double model = 0.0; ///< of its triangles
  double front = 0.0; ///< of the mesh's faces on the front
  double back = 0.0;
  double once = 0.0; ///< of front and back as one sheet: faces in the same place count once
};

struct OpeningFigures
{
  std::string name;
  double area = 0.0;
  /// Area that boundary faces within `depth` of the opening's plane cover, looking along its normal. By one jittered
  /// sample in each square of `spacing`, which is free of bias.
  double blocked = 0.0;
  /// Fraction of the outline within the tolerance of feature edges of the mesh.
  double outline = 0.0;
  /// Largest distance of a corner of the outline to feature edges of the mesh; at most the size of the finest octants.
  double corner = 0.0;
};

/// Lengths of model curves, meters.
struct CurveFigures
{
  double length = 0.0;
  double onFeature = 0.0; ///< within the tolerance of a feature edge of the mesh
  double onAny = 0.0;     ///< within the tolerance of any edge of a boundary face
  double featureRatio() const { return length > 0.0 ? onFeature / length : 1.0; }
  double anyRatio() const { return length > 0.0 ? onAny / length : 1.0; }
};

/// One feature edge of the model that the mesh does not follow all along.
struct CurveMiss
{
  Index edge; ///< index into the model's feature edges
  CurveKind kind;
  double length;
  double missed;   ///< length farther than the tolerance from feature edges of the mesh
  double farthest; ///< largest distance from these; at most the size of the finest octants
  Vec3 begin;
  Vec3 end;
  Vec3 middle;       ///< of what is missed
  std::string names; ///< of the surfaces that meet there
};

struct CurveCoverage
{
  CurveFigures total;
  std::array<CurveFigures, 4> ofKind; ///< by CurveKind
  std::vector<CurveMiss> misses;      ///< longest first
};
inline constexpr std::array<const char*, 4> curveKindNames{"boundary", "crease", "junction", "border"};

/// Fraction of a surface's area whose nearest boundary face is its own (within the tolerance, as others may meet it
/// there).
struct NameCoverage
{
  std::string name;
  double front = 0.0;
  double back = 0.0;
  double either = 0.0;
};

/// Lengths in meters.
struct FeatureTolerances
{
  double curve = 0.05;        ///< a curve is met where mesh edges are this near
  double curveSpacing = 0.02; ///< of samples along curves
  double angle = 20.0;        ///< degrees between faces from which their edge is a feature of the mesh
  double openingDepth = 0.25; ///< faces this near to an opening's plane block it
  double openingSpacing = 0.01;
  double surfaceSpacing = 0.25;
  double surface = std::numeric_limits<double>::infinity(); ///< a surface is covered by faces this near only
};

/// The boundary of a mesh beside its model. A *piece* is a place with one boundary face or, on a sheet, two. A feature
/// edge of the mesh is an edge of pieces that is not the smooth inside of one surface: one piece ends there, three or
/// more meet, their tags differ, or they meet at an angle. Points of copies made at sheets count as one if their
/// coordinates are the same, bit for bit.
class FeatureChecks
{
public:
  FeatureChecks(const DualMesh& mesh, const SurfaceModel& model, const GridFrame& frame,
                const FeatureTolerances& tolerances = {});
  explicit FeatureChecks(const Meshed& meshed, const FeatureTolerances& tolerances = {})
      : FeatureChecks(meshed.mesh(), meshed.model, meshed.frame, tolerances)
  {
  }

  /// By surface id.
  std::vector<SurfaceArea> areas() const;
  std::vector<OpeningFigures> openings(const std::vector<Opening>& openings) const;
  /// Of the model's feature edges inside the domain; what lies on two domain planes is left out.
  CurveCoverage curves() const;
  /// By surface id.
  std::vector<NameCoverage> names() const;

private:
  class SegmentIndex;
  struct Piece
  {
    std::array<Index, 4> points; ///< places, as in the first face; the last is noIndex in a triangle
    int faces = 0;
    std::array<Index, 2> tags{noIndex, noIndex}; ///< of its one or two faces
    std::array<SheetSide, 2> sides{};
    Vec3 normal = Vec3::Zero(); ///< of unit length, or zero
    double area = 0.0;
    int count() const { return points[3] == noIndex ? 3 : 4; }
    bool has(Index tag, SheetSide side) const;
  };
  struct Segment
  {
    Index a;
    Index b;
    bool feature;
  };

  void findPieces();
  void findSegments();
  Vec3 modelPoint(Index point) const { return frame_.toModel(model_.points[point]); }
  double distanceTo(const Piece& piece, const Vec3& p) const;
  bool covers(const Piece& piece, const Vec3& p, const Vec3& normal) const;
  BoxIndex indexOfPieces(double margin) const;
  /// f(a, b, c) for the triangles about the mean of its points.
  template <typename F> void eachTriangle(const Piece& piece, F&& f) const
  {
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < piece.count(); ++i)
    {
      middle += places_[piece.points[i]] / piece.count();
    }
    for (int i = 0; i < piece.count(); ++i)
    {
      f(middle, places_[piece.points[i]], places_[piece.points[(i + 1) % piece.count()]]);
    }
  }

  const DualMesh& mesh_;
  const SurfaceModel& model_;
  const GridFrame& frame_;
  FeatureTolerances tolerances_;
  std::vector<Vec3> places_;
  std::vector<Piece> pieces_;
  std::vector<Segment> segments_;
};

} // namespace atria::testing
