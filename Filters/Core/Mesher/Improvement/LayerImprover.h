// SPDX-License-Identifier: GPL-3.0-or-later
/// Grows the layer on walls and sees to it that every element at the boundary is valid.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/BoundaryLayers.h"
#include "Optimize/Constraints/ModelConstraints.h"
#include "Optimize/Kernel/Optimizer.h"

#include <optional>

namespace atria {

/// A vertex that is not where the model wants it, as no element would be valid there otherwise.
struct DetachedVertex
{
  Index point;
  Vec3 wanted;
};

/// Elements that the optimizer cannot mend get more room step by step: vertices leave
/// curves for the surfaces that meet there; they leave surfaces; they start again from the centers of their octants,
/// where the plain mesh is valid; the layer is left out. Then each vertex that left goes back as far as it can.
class LayerImprover
{
public:
  /// `vertexOf` gives for each point of the plain mesh the vertex of the anchors it stands for; points of one vertex
  /// are in one place and stay together, and the one with its number, the leader, is one of them. The plain mesh's
  /// points follow those of the layer's walls; where no layer is asked for, the plain mesh is taken.
  LayerImprover(const MeshingContext& context, const VertexClassification& classification,
                const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                const LayerOptions& options, const CurvedWallTargets& curvedWalls);

  /// The layers asked for; fewer at points where elements would not be valid. Without any asked for, the plain mesh
  /// made valid; its elements may be concave then.
  LayerMesh run();
  /// Those that did not get back, in rising order of points.
  const std::vector<DetachedVertex>& detached() const { return detached_; }

private:
  struct Constraints;
  enum class Step : std::uint8_t;
  /// How walls turn at a point, as bits.
  enum Bend : std::uint8_t
  {
    straight = 0,
    curved = 1, ///< as a curved wall does
    edged = 2   ///< as at an edge; with `curved`, as a wall that is curved but not smooth, or meets another
  };
  struct OrthogonalityStage;
  struct CurvedStage;

  void grow();
  void mend(const std::vector<ShortCell>& cells);
  bool prepare(Step step, const std::vector<ShortCell>& bad);
  void noteLeft(Index leader);
  void leaveCurve(Index leader);
  void leaveSurface(Index leader, double reach);
  void detach(const std::vector<ShortCell>& cells, double reach);
  void startAgain(const std::vector<ShortCell>& bad, double share);
  void growAgain(const std::vector<char>& fresh);
  void exclude(const std::vector<ShortCell>& bad);
  void putBack();
  void keepThoseAway();
  void findCurved();
  bool isAwayFromCreases(Index cell) const;
  bool isAtCurved(Index cell) const;
  bool isAtSmooth(Index cell) const;
  std::vector<Index> pointsAtCurved() const;
  void takeBack(std::vector<WantedPlace> thick, std::vector<ShortCell>& shortCells);
  std::vector<ShortCell> thicken();
  QualityTargets targetsAtCurved(const CurvedWallTargets& wanted) const;
  QualityTargets targetsOf(const CurvedStage& stage) const;
  std::vector<ShortCell> farAtCurved(const QualityTargets& wanted, float share,
                                     const std::vector<Index>& candidates) const;
  std::vector<Index> unsureAtSmooth() const;
  void improveAtCurved();
  void bringClose(const CurvedStage& stage, std::vector<Index>& candidates);
  void bringClose();
  void straighten();
  QualityTargets targetsOf(const OrthogonalityStage& stage) const;
  QualityTargets strictest() const;
  std::vector<ShortCell> findBelow(const QualityTargets& wanted, float share, const std::vector<Index>& cells) const;
  void straighten(std::span<const OrthogonalityStage> stages, float share, std::vector<char>& toEvaluate,
                  std::vector<Index>& candidates);
  void straightenOrDetach(std::span<const OrthogonalityStage> stages, float share, const QualityRange& largest,
                          std::vector<char>& toEvaluate, std::vector<Index>& candidates);
  void straightenDivided();
  void addCreaseSheets();
  LayerMesh divide(const LayerMesh& one) const;
  std::optional<LayerMesh> divideAndImprove(const LayerMesh& given) const;
  LayerMesh divideEvenly(const LayerMesh& one) const;
  std::vector<ShortCell> improveDivided(LayerMesh& divided, const std::vector<char>& toEvaluate,
                                        const std::vector<char>& held) const;
  void restore(const LayerMesh& given, const LayerMesh& divided, const std::vector<ShortCell>& bad,
               const std::vector<Index>& counts, LayerMesh& one, std::vector<char>& held,
               std::vector<char>& changed) const;
  std::vector<WantedPlace> wantedPlaces() const;
  std::vector<ShortCell> move(const std::vector<ShortCell>& cells, const OptimizerOptions& options,
                              std::vector<Index>* about = nullptr);
  std::vector<ShortCell> improve(std::vector<ShortCell> cells);
  std::vector<ShortCell> findAll();
  template <typename Visit> void eachLeaderOf(const std::vector<ShortCell>& cells, Visit&& visit) const;
  QualityTargets targets() const;
  void enter(double begin, double end, const char* phase);

  /// Its progress is the part of the phase that is entered.
  MeshingContext context_;
  ProgressRange whole_;
  /// What the model wants, and what is allowed now.
  const VertexClassification& wanted_;
  VertexClassification classification_;
  const std::vector<Index>& vertexOf_;
  DualMesh& plain_;
  const LayerWalls& walls_;
  const LayerOptions& options_;
  const CurvedWallTargets& curvedWalls_;
  bool layered_;
  /// Whether a height was asked for somewhere.
  bool hasHeights_;
  /// Whether there are several layers somewhere.
  bool divided_;
  /// Whether all octants at elements are of one size, so that these are hexahedra.
  bool uniform_;
  LayerMesh layer_;
  /// By point of the plain mesh.
  std::vector<char> mayLeave_;
  std::vector<char> letGo_;
  std::vector<char> excluded_;
  /// Of cells that fell short after a pass; also those in the second row from the walls.
  std::vector<char> suspect_;
  /// How walls are curved there. Empty where none are, or other than a single layer of no asked height is grown.
  std::vector<std::uint8_t> curved_;
  /// Cells, in order, that may fall short of strictest(), of those at the boundary and of the layer.
  std::vector<Index> unsure_;
  /// Leaders that were detached, each once, and where they were.
  std::vector<WantedPlace> left_;
  std::vector<char> isLeft_;
  std::vector<DetachedVertex> detached_;
};

} // namespace atria
