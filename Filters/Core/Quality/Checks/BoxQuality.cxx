// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/BoxQuality.h"

#include "Quality/Checks/RegularBoxes.h"
#include "Support/Error.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Share of cells to be measured above which the mesh is measured as a whole: choosing some of its cells copies them.
constexpr double mostMeasured = 0.5;

/// Some cells of a mesh, with its points.
class ChosenCells
{
public:
  ChosenCells(const CellArrays& cells, std::span<const Index> chosen)
  {
    for (const Index c : chosen)
    {
      types.push_back(cells.types[c]);
      for (std::int64_t i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i)
      {
        connectivity.push_back(cells.connectivity[static_cast<std::size_t>(i)]);
      }
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      if (c < cells.faceLocations.size())
      {
        faceLocations.push_back(cells.faceLocations[c]);
      }
    }
    arrays = {types, offsets, connectivity, cells.faceStream, faceLocations};
  }
  ChosenCells(const ChosenCells&) = delete;
  ChosenCells& operator=(const ChosenCells&) = delete;

  const CellArrays& view() const { return arrays; }

private:
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> faceLocations;
  CellArrays arrays;
};

bool areSound(const CellArrays& cells)
{
  if (cells.offsets.size() != cells.types.size() + 1)
  {
    return false;
  }
  const auto size = static_cast<std::int64_t>(cells.connectivity.size());
  std::int64_t last = 0;
  for (std::size_t c = 0; c <= cells.types.size(); ++c)
  {
    if (cells.offsets[c] < last || cells.offsets[c] > size)
    {
      return false;
    }
    last = cells.offsets[c];
  }
  return true;
}

std::vector<std::int64_t> pointsOf(const AskedFaces& asked)
{
  std::vector<std::int64_t> points;
  for (const std::span<const BoundaryFaceKey> faces : {asked.patches, asked.zones})
  {
    for (const BoundaryFaceKey& face : faces)
    {
      points.insert(points.end(), face.points.begin(), face.points.end());
    }
  }
  return points;
}

/// Of a cell among those chosen; noIndex where it is not.
Index newNumber(std::span<const Index> chosen, Index cell)
{
  const auto found = std::ranges::lower_bound(chosen, cell);
  return found != chosen.end() && *found == cell ? static_cast<Index>(found - chosen.begin()) : noIndex;
}

std::vector<BoundaryFaceKey> renumbered(std::span<const BoundaryFaceKey> faces, std::span<const Index> chosen)
{
  std::vector<BoundaryFaceKey> out(faces.begin(), faces.end());
  for (BoundaryFaceKey& face : out)
  {
    face.cell = newNumber(chosen, face.cell);
  }
  return out;
}

/// Whether all faces are there, and none twice.
bool haveAll(std::vector<Index> found)
{
  std::ranges::sort(found);
  return std::ranges::adjacent_find(found) == found.end() && (found.empty() || found.back() != noIndex);
}

/// Whether a face of the cells that are measured is not among those that are counted as ideal.
bool isMeasured(const FaceMesh& mesh, const RegularBoxes& boxes, std::size_t f)
{
  const bool isRegular = boxes.isRegular[boxes.measured[mesh.owner[f]]] &&
                         (f >= mesh.internalFaceCount() || boxes.isRegular[boxes.measured[mesh.neighbor[f]]]);
  return !isRegular || std::ranges::all_of(mesh.face(f), [&](Index p) { return boxes.isTouched[p] != 0; });
}

void keepMeasured(const FaceMesh& mesh, const RegularBoxes& boxes, Buffer<double>& values)
{
  std::size_t kept = 0;
  for (std::size_t f = 0; f < values.size(); ++f)
  {
    if (isMeasured(mesh, boxes, f))
    {
      values[kept++] = values[f];
    }
  }
  values.resize(kept);
}

std::size_t countBoundary(const FaceMesh& mesh, const RegularBoxes& boxes)
{
  std::size_t count = 0;
  for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
  {
    count += isMeasured(mesh, boxes, f) ? 1 : 0;
  }
  return count;
}

/// Leaves out the values of regular boxes among the measured cells.
template <typename T> void keepOthers(const RegularBoxes& boxes, Buffer<T>& values)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!boxes.isRegular[boxes.measured[i]])
    {
      values[kept++] = values[i];
    }
  }
  values.resize(kept);
}

void keepOthers(const FaceMesh& mesh, const RegularBoxes& boxes, QualityMetrics& metrics)
{
  for (auto* ofCells :
       {&metrics.cellSquish, &metrics.faceSquish, &metrics.aspectRatio, &metrics.inverseAspectRatio,
        &metrics.orthogonalQuality, &metrics.nonOrthogonality, &metrics.skewness, &metrics.volume,
        &metrics.facePyramids, &metrics.scaledJacobian})
  {
    keepOthers(boxes, *ofCells);
  }
  keepOthers(boxes, metrics.valid);
  for (auto* ofFaces : {&metrics.squishOfFaces, &metrics.nonOrthogonalityOfFaces, &metrics.skewnessOfFaces})
  {
    keepMeasured(mesh, boxes, *ofFaces);
  }
}

/// The faces of the cells that are measured; nothing where something is wrong.
std::optional<FaceMesh> facesOf(std::vector<Vec3> points, const CellArrays& chosenCells,
                                std::span<const Index> chosen, const AskedFaces& asked, const Executor& executor)
{
  const std::vector<BoundaryFaceKey> patches = renumbered(asked.patches, chosen);
  const std::vector<BoundaryFaceKey> zones = renumbered(asked.zones, chosen);
  std::vector<Index> neighbors(asked.neighbors.begin(), asked.neighbors.end());
  std::ranges::for_each(neighbors, [&](Index& cell) { cell = newNumber(chosen, cell); });
  try
  {
    FaceMesh mesh = makeFaceMesh(std::move(points), chosenCells, patches, executor);
    if (haveAll(findBoundaryFaces(mesh, patches, executor)) && haveAll(findInternalFaces(mesh, zones, neighbors, executor)))
    {
      return mesh;
    }
  }
  catch (const Error&)
  {
    // It names other cells than the whole mesh has.
  }
  return std::nullopt;
}

} // namespace

std::optional<QualityByBoxes> computeQualityByBoxes(std::vector<Vec3> points, const CellArrays& cells,
                                                    const AskedFaces& asked, const RunContext& context)
{
  if (!areSound(cells))
  {
    return std::nullopt;
  }
  context.progress.report(0.0, "Finding boxes");
  RegularBoxes boxes = findRegularBoxes(points, cells, pointsOf(asked), context.executor);
  if (static_cast<double>(boxes.measured.size()) > mostMeasured * static_cast<double>(cells.types.size()))
  {
    return std::nullopt;
  }
  context.progress.report(0.3, "Finding faces");
  const ChosenCells chosen(cells, boxes.measured);
  std::optional<FaceMesh> mesh = facesOf(std::move(points), chosen.view(), boxes.measured, asked, context.executor);
  if (!mesh || (asked.patchesAreTheBoundary && countBoundary(*mesh, boxes) != asked.patches.size()))
  {
    return std::nullopt;
  }
  QualityByBoxes out;
  out.metrics = computeQuality(*mesh, chosen.view(), context.part(0.5, 1.0));
  keepOthers(*mesh, boxes, out.metrics);
  out.volumes = std::move(boxes.volumes);
  out.aspectRatios = std::move(boxes.aspectRatios);
  out.others = std::move(boxes.measured);
  std::erase_if(out.others, [&](Index c) { return boxes.isRegular[c] != 0; });
  out.isRegular = std::move(boxes.isRegular);
  out.regularCount = out.isRegular.size() - out.others.size();
  out.idealFaces = boxes.idealFaces;
  return out;
}

} // namespace atria
