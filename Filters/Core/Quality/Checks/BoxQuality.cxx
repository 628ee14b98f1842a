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
/// Windows that a thread measures before their metrics are collected.
constexpr std::size_t windowsOfThread = 4;

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

/// Metrics of a window's own cells and of the faces that count there.
struct WindowMetrics
{
  QualityMetrics metrics;
  std::size_t boundaryFaces = 0;
};

/// Measures windows.
class WindowMeter
{
public:
  WindowMeter(const CellWindows& cellWindows, const RegularBoxes& regularBoxes, const CountedPart* countedPart)
      : windows(cellWindows), boxes(regularBoxes), part(countedPart)
  {
  }

  /// Returns nullopt if a requested face is missing or exists twice.
  std::optional<WindowMetrics> measure(std::size_t number) const
  {
    const CellWindow window = windows.window(number);
    if (!window.hasAskedFaces())
    {
      return std::nullopt;
    }
    SilentMonitor silent;
    const SerialExecutor serial;
    const QualityMetrics all =
        computeQuality(window.mesh(), window.arrays(), RunContext{serial, ProgressRange(silent)});
    WindowMetrics out;
    takeCells(window, all, out);
    takeFaces(window, all, out);
    return out;
  }

  /// True if the number of counted boundary faces equals the number of patch faces of own cells.
  bool areThePatches(std::size_t boundaryFaces, const AskedFaces& asked) const
  {
    return boundaryFaces == static_cast<std::size_t>(std::ranges::count_if(
                                asked.patches, [&](const BoundaryFaceKey& face) { return isOwn(face.cell); }));
  }

private:
  bool isOwn(std::size_t cell) const { return !part || part->isOwn[cell]; }

  void takeCells(const CellWindow& window, const QualityMetrics& all, WindowMetrics& out) const
  {
    for (std::size_t i = 0; i < window.cells().size(); ++i)
    {
      const Index cell = window.cells()[i];
      if (!window.isOwn(i) || boxes.isRegular[cell])
      {
        continue;
      }
      for (const QualityList metric : cellMetrics)
      {
        (out.metrics.*metric).push_back((all.*metric)[i]);
      }
      out.metrics.valid.push_back(all.valid[i]);
      out.metrics.invalidCells += all.valid[i] || !isOwn(cell) ? 0 : 1;
    }
  }

  void takeFaces(const CellWindow& window, const QualityMetrics& all, WindowMetrics& out) const
  {
    const FaceMesh& mesh = window.mesh();
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    {
      if (!window.isOwn(mesh.owner[f]) || !isMeasured(window, f) || !isCounted(window, f))
      {
        continue;
      }
      for (const QualityList metric : faceMetrics)
      {
        if (f < (all.*metric).size())
        {
          (out.metrics.*metric).push_back((all.*metric)[f]);
        }
      }
      out.boundaryFaces += f < mesh.internalFaceCount() ? 0 : 1;
    }
  }

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

  const CellWindows& windows;
  const RegularBoxes& boxes;
  const CountedPart* part;
};

void append(const QualityMetrics& some, QualityMetrics& out)
{
  const auto appendAll = [&](const auto& lists) {
    for (const QualityList metric : lists)
    {
      (out.*metric).insert((out.*metric).end(), (some.*metric).begin(), (some.*metric).end());
    }
  };
  appendAll(cellMetrics);
  appendAll(faceMetrics);
  out.valid.insert(out.valid.end(), some.valid.begin(), some.valid.end());
  out.invalidCells += some.invalidCells;
}

/// Measures all windows, some at a time on several threads, and collects their metrics in order. Returns false if faces
/// are wrong.
bool measure(const CellWindows& windows, const AskedFaces& asked, const RegularBoxes& boxes, const CountedPart* part,
             QualityMetrics& out, const RunContext& context)
{
  const auto others = static_cast<std::size_t>(std::ranges::count(boxes.isRegular, 0));
  std::ranges::for_each(cellMetrics, [&](QualityList metric) { (out.*metric).reserve(others); });
  std::ranges::for_each(faceMetrics, [&](QualityList metric) { (out.*metric).reserve(facesOfCell * others); });
  out.valid.reserve(others);
  const WindowMeter meter(windows, boxes, part);
  std::size_t boundaryFaces = 0;
  const std::size_t atOnce = windowsOfThread * static_cast<std::size_t>(context.executor.threads());
  for (std::size_t first = 0; first < windows.count(); first += atOnce)
  {
    std::vector<std::optional<WindowMetrics>> some(std::min(atOnce, windows.count() - first));
    context.executor.forEach(some.size(), 1, [&](std::size_t i) { some[i] = meter.measure(first + i); });
    for (const std::optional<WindowMetrics>& one : some)
    {
      if (!one)
      {
        return false;
      }
      append(one->metrics, out);
      boundaryFaces += one->boundaryFaces;
    }
    context.progress.report(static_cast<double>(first + some.size()) / static_cast<double>(windows.count()),
                            "Judging elements");
  }
  return !asked.patchesAreTheBoundary || meter.areThePatches(boundaryFaces, asked);
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
    const CellWindows windows(points, cells, boxes.measured, asked, length, context.executor);
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
