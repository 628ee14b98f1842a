// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/BoxQuality.h"

#include "Quality/Checks/CellWindow.h"
#include "Quality/Checks/RegularBoxes.h"
#include "Support/Error.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Faces per cell to reserve memory for: those of a hexahedron, and some more for larger neighbors. Reserved memory
/// that is not used takes no space.
constexpr std::size_t facesOfCell = 4;

bool areSound(const CellArrays& cells)
{
  if (cells.types.size() >= noIndex || cells.offsets.size() != cells.types.size() + 1)
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

/// Adds the points of cells that are not own ones.
void addPointsOfOthers(const CellArrays& cells, const CountedPart& part, std::vector<std::int64_t>& points)
{
  for (std::size_t c = 0; c < cells.types.size(); ++c)
  {
    for (std::int64_t i = cells.offsets[c]; !part.isOwn[c] && i < cells.offsets[c + 1]; ++i)
    {
      points.push_back(cells.connectivity[static_cast<std::size_t>(i)]);
    }
  }
}

/// Measures one window after the other and collects the metrics of its cells and faces.
class WindowMetrics
{
public:
  WindowMetrics(const RegularBoxes& regularBoxes, const CountedPart* countedPart, QualityMetrics& target)
      : boxes(regularBoxes), part(countedPart), out(target)
  {
    const auto others = static_cast<std::size_t>(std::ranges::count(boxes.isRegular, 0));
    std::ranges::for_each(cellMetrics, [&](QualityList metric) { (out.*metric).reserve(others); });
    std::ranges::for_each(faceMetrics, [&](QualityList metric) { (out.*metric).reserve(facesOfCell * others); });
    out.valid.reserve(others);
  }

  /// Adds the metrics of a window. Returns false if a requested face is missing or exists twice.
  bool add(const CellWindow& window, const RunContext& context)
  {
    const FaceMesh& mesh = window.mesh();
    if (!window.hasAskedFaces(context.executor))
    {
      return false;
    }
    const QualityMetrics some = computeQuality(mesh, window.arrays(), context);
    for (std::size_t i = 0; i < window.cells().size(); ++i)
    {
      const Index cell = window.cells()[i];
      if (window.isOwn(i) && !boxes.isRegular[cell])
      {
        for (const QualityList metric : cellMetrics)
        {
          (out.*metric).push_back((some.*metric)[i]);
        }
        out.valid.push_back(some.valid[i]);
        out.invalidCells += some.valid[i] || !isOwn(cell) ? 0 : 1;
      }
    }
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    {
      if (!window.isOwn(mesh.owner[f]) || !isMeasured(window, f) || !isCounted(window, f))
      {
        continue;
      }
      for (const QualityList metric : faceMetrics)
      {
        if (f < (some.*metric).size())
        {
          (out.*metric).push_back((some.*metric)[f]);
        }
      }
      boundaryFaces += f < mesh.internalFaceCount() ? 0 : 1;
    }
    return true;
  }

  /// True if the number of counted boundary faces equals the number of patch faces of own cells.
  bool patchesAreTheBoundary(const AskedFaces& asked) const
  {
    return boundaryFaces == static_cast<std::size_t>(std::ranges::count_if(
                                asked.patches, [&](const BoundaryFaceKey& face) { return isOwn(face.cell); }));
  }

private:
  bool isOwn(std::size_t cell) const { return !part || part->isOwn[cell]; }

  bool isCounted(const CellWindow& window, std::size_t f) const
  {
    const FaceMesh& mesh = window.mesh();
    const Index owner = window.cells()[mesh.owner[f]];
    return !part ||
           (f < mesh.internalFaceCount() ? part->countsFace(owner, window.cells()[mesh.neighbor[f]]) : isOwn(owner));
  }

  /// True if the face does not count as ideal.
  bool isMeasured(const CellWindow& window, std::size_t f) const
  {
    const FaceMesh& mesh = window.mesh();
    const bool isRegular = boxes.isRegular[window.cells()[mesh.owner[f]]] &&
                           (f >= mesh.internalFaceCount() || boxes.isRegular[window.cells()[mesh.neighbor[f]]]);
    return !isRegular ||
           std::ranges::all_of(mesh.face(f), [&](Index p) { return boxes.isTouched[window.pointOf(p)] != 0; });
  }

  const RegularBoxes& boxes;
  const CountedPart* part;
  QualityMetrics& out;
  std::size_t boundaryFaces = 0;
};

/// Measures all windows. Returns false if faces are wrong.
bool measure(CellWindows& windows, const AskedFaces& asked, const RegularBoxes& boxes, const CountedPart* part,
             QualityMetrics& out, const RunContext& context)
{
  WindowMetrics metrics(boxes, part, out);
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(windows.count(), 1));
  for (std::size_t i = 0; i < windows.count(); ++i)
  {
    const double done = share * static_cast<double>(i);
    context.progress.report(done, "Finding faces");
    const CellWindow window = windows.window(i, context.executor);
    if (!metrics.add(window, context.part(done + 0.3 * share, done + share)))
    {
      return false;
    }
  }
  return !asked.patchesAreTheBoundary || metrics.patchesAreTheBoundary(asked);
}

} // namespace

std::optional<QualityByBoxes> computeQualityByBoxes(std::span<const Vec3> points, const CellArrays& cells,
                                                    const AskedFaces& asked, const RunContext& context,
                                                    std::size_t length, const CountedPart* part)
{
  if (!areSound(cells))
  {
    return std::nullopt;
  }
  context.progress.report(0.0, "Finding boxes");
  std::vector<std::int64_t> apart = pointsOf(asked);
  if (part)
  {
    addPointsOfOthers(cells, *part, apart);
  }
  RegularBoxes boxes = findRegularBoxes(points, cells, apart, context.executor);
  release(apart);
  if (!part && 2 * boxes.measured.size() > cells.types.size() && boxes.measured.size() < 2 * length)
  {
    return std::nullopt;
  }
  QualityByBoxes out;
  try
  {
    CellWindows windows(points, cells, boxes.measured, asked, length, context.executor);
    if (!measure(windows, asked, boxes, part, out.metrics, context.part(0.2, 1.0)))
    {
      return std::nullopt;
    }
  }
  catch (const Error&)
  {
    return std::nullopt; // its cell numbers are not those of the whole mesh
  }
  out.others = std::move(boxes.measured);
  std::erase_if(out.others, [&](Index c) { return boxes.isRegular[c] != 0; });
  out.isRegular = std::move(boxes.isRegular);
  out.volumes = std::move(boxes.volumes);
  out.aspectRatios = std::move(boxes.aspectRatios);
  out.regularCount = out.isRegular.size() - out.others.size();
  out.idealFaces = boxes.idealFaces;
  return out;
}

} // namespace atria
