// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/MeshChecks.h"

#include "Quality/Checks/CheckLimits.h"
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/Metrics.h"
#include "Quality/Checks/PartCounts.h"
#include "Quality/Faces/InOrder.h"
#include "Support/Angles.h"
#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace atria {

namespace {

/// OpenFOAM's SMALL.
constexpr double small = 1e-15;
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t grain = 4096;

struct Limit
{
  const char* name;
  const char* set;
  bool isError;
  bool greaterFails;
  double limit;
};

/// Runs the checks one after the other, so that at most one value per face is held.
class MeshChecker
{
public:
  MeshChecker(const MeasuredMesh& measured, const RunContext& within, const CheckedPart* checkedPart)
      : m(measured), context(within), counts(measured.mesh, checkedPart)
  {
  }

  MeshVerdict run()
  {
    judgeBoundary();
    judgeQuantity({"Openness", "nonClosedCells", true, true, 1e-6}, CheckQuantity::Openness);
    judgeQuantity({"AreaAspectRatio", "highAspectRatioCells", true, true, 1000.0}, CheckQuantity::AreaAspectRatio);
    judgeAreas();
    judge({"Volume", "zeroVolumeCells", true, false, vSmall}, MeshPart::Cells, m.geometry.cellVolumes);
    judgeOrthogonality();
    judgePyramids();
    judgeSkewness();
    judgeQuantity({"TetQuality", "lowQualityTetFaces", true, false, small * small}, CheckQuantity::TetQuality);
    judgeEdges();
    judgeNearPoints();
    judgeQuantity({"FaceConcaveAngle", "concaveFaces", false, true, 0.0}, CheckQuantity::FaceConcaveAngle);
    judgeQuantity({"FaceFlatness", "warpedFaces", false, false, 0.8}, CheckQuantity::FaceFlatness);
    judgeQuantity({"Determinant", "underdeterminedCells", true, false, checkLimits::determinant},
                  CheckQuantity::Determinant);
    judgeQuantity({"Concavity", "concaveCells", true, true, -checkLimits::concaveSine}, CheckQuantity::Concavity);
    judgeQuantity({"FaceWeight", "lowWeightFaces", true, false, checkLimits::faceWeight}, CheckQuantity::FaceWeight);
    judgeQuantity({"VolumeRatio", "lowVolRatioFaces", true, false, checkLimits::volumeRatio},
                  CheckQuantity::VolumeRatio);
    context.progress.report(1.0, "Mesh checked");
    return std::move(verdict);
  }

private:
  void step()
  {
    constexpr double steps = 16.0;
    context.progress.report(std::min(1.0, done++ / steps), "Checking the mesh");
  }

  template <typename F> std::vector<double> valuesOf(std::size_t count, F&& valueOf) const
  {
    std::vector<double> values(count);
    context.executor.forEach(count, grain, [&](std::size_t i) { values[i] = valueOf(i); });
    return values;
  }

  MeshCheck& judge(const Limit& limit, MeshPart part, std::span<const double> values, std::size_t judged)
  {
    step();
    MeshCheck check{limit.name, limit.set, part, limit.isError, limit.greaterFails, limit.limit, notANumber,
                    notANumber, {},        0,    Vec3::Zero()};
    std::size_t first = noIndex;
    CountedValues counted{limit.greaterFails};
    for (std::size_t i = 0; i < judged; ++i)
    {
      const bool fails = limit.greaterFails ? values[i] > limit.limit : values[i] < limit.limit;
      if (fails)
      {
        check.failing.push_back(static_cast<Index>(i));
      }
      if (counts(part, i))
      {
        counted.add(values[i], fails);
        first = fails && first == noIndex ? i : first;
      }
    }
    counts.addOthers(counted);
    if (counted.failing > 0)
    {
      check.first = counts.first(part, first, placeOf(part, first));
    }
    if (counted.count > 0)
    {
      check.worst = counted.worst;
      check.mean = counted.sum / static_cast<double>(counted.count);
    }
    check.failingCount = counted.failing;
    verdict.checks.push_back(std::move(check));
    return verdict.checks.back();
  }

  Vec3 placeOf(MeshPart part, std::size_t number) const
  {
    if (number == noIndex || (part != MeshPart::Cells && part != MeshPart::Faces))
    {
      return Vec3::Zero();
    }
    return part == MeshPart::Cells ? m.geometry.cellCentroids[number] : m.geometry.faceCentroids[number];
  }

  MeshCheck& judge(const Limit& limit, MeshPart part, std::span<const double> values)
  {
    return judge(limit, part, values, values.size());
  }

  void judgeQuantity(const Limit& limit, CheckQuantity quantity)
  {
    const std::vector<double> values = measure(m, quantity, context);
    const CheckQuantityInfo& info = describe(quantity);
    judge(limit, info.ofFaces ? MeshPart::Faces : MeshPart::Cells, values,
          info.needsTwoCells ? m.mesh.internalFaceCount() : values.size());
  }

  void judgeBoundary()
  {
    Vec3 sum = Vec3::Zero();
    double size = 0.0;
    for (std::size_t f = m.mesh.internalFaceCount(); f < m.mesh.faceCount(); ++f)
    {
      if (counts(MeshPart::Faces, f))
      {
        sum += m.geometry.faceAreas[f];
        size += lengthInOrder(m.geometry.faceAreas[f]);
      }
    }
    counts.addOthers(sum, size);
    const double openness = (sum / (size + vSmall)).cwiseAbs().maxCoeff();
    judge({"BoundaryOpenness", "", true, true, 1e-6}, MeshPart::Mesh, {&openness, 1});
  }

  void judgeAreas()
  {
    const auto area = [this](std::size_t f) { return lengthInOrder(m.geometry.faceAreas[f]); };
    judge({"FaceArea", "zeroAreaFaces", true, false, vSmall}, MeshPart::Faces, valuesOf(m.mesh.faceCount(), area));
  }

  /// checkMesh's set holds faces beyond 70 degrees; the check fails only beyond 90.
  void judgeOrthogonality()
  {
    const std::vector<double> cosines =
        valuesOf(m.mesh.internalFaceCount(), [this](std::size_t f) { return faceCosine(m, f); });
    constexpr double severe = 70.0;
    const double severeCosine = cosOfDegrees(severe);
    inDegrees(judge({"NonOrthogonality", "nonOrthoFaces", false, false, severeCosine}, MeshPart::Faces, cosines),
              severe);
    // The next number above SMALL: a cosine of SMALL itself fails too.
    inDegrees(judge({"NonOrthogonalityError", "", true, false, std::nextafter(small, 1.0)}, MeshPart::Faces, cosines),
              90.0);
  }

  static void inDegrees(MeshCheck& check, double limit)
  {
    check.greaterFails = true;
    check.limit = limit;
    check.worst = degreesOfCosine(check.worst);
    check.mean = degreesOfCosine(check.mean);
  }

  void judgePyramids()
  {
    const auto least = [this](std::size_t f) {
      const double own = pyramidVolume(m, f, m.mesh.owner[f]);
      return f < m.mesh.internalFaceCount() ? std::min(own, pyramidVolume(m, f, m.mesh.neighbor[f])) : own;
    };
    judge({"FacePyramids", "wrongOrientedFaces", true, false, -small}, MeshPart::Faces,
          valuesOf(m.mesh.faceCount(), least));
  }

  void judgeSkewness()
  {
    const auto skewness = [this](std::size_t f) { return faceSkewness(m, f); };
    judge({"Skewness", "skewFaces", true, true, checkLimits::skewness}, MeshPart::Faces,
          valuesOf(m.mesh.faceCount(), skewness));
  }

  double leastDistanceSquared()
  {
    Box3 box;
    for (const Vec3& p : m.mesh.points)
    {
      box.extend(p);
    }
    counts.addOthers(box);
    const Vec3 least = 1e-6 * box.size();
    return dotInOrder(least, least);
  }

  void addNote(const Limit& limit, double worst, std::vector<Index> points)
  {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const std::size_t count = counts.countPoints(points);
    verdict.checks.push_back({limit.name, limit.set, MeshPart::Points, limit.isError, limit.greaterFails, limit.limit,
                              worst, notANumber, std::move(points), count, Vec3::Zero()});
  }

  void judgeEdges()
  {
    step();
    const double limit = leastDistanceSquared();
    const std::vector<double> lengths = measure(m, CheckQuantity::EdgeLength, context);
    std::vector<Index> ends;
    for (std::size_t f = 0; f < lengths.size(); ++f)
    {
      // The search is generous, as a length is rounded twice; each edge is then judged by its square.
      if (lengths[f] * lengths[f] < 1.01 * limit)
      {
        addShortEdges(m.mesh.face(f), limit, ends);
      }
    }
    CountedValues counted;
    for (std::size_t f = 0; f < lengths.size(); ++f)
    {
      if (counts(MeshPart::Faces, f))
      {
        counted.add(lengths[f], false);
      }
    }
    counts.addOthers(counted);
    const double least = counted.count == 0 ? notANumber : counted.worst;
    addNote({"EdgeLength", "shortEdges", false, false, std::sqrt(limit)}, least, std::move(ends));
  }

  void addShortEdges(std::span<const Index> face, double limit, std::vector<Index>& ends) const
  {
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const Index next = face[i + 1 < face.size() ? i + 1 : 0];
      const Vec3 edge = m.mesh.points[face[i]] - m.mesh.points[next];
      if (dotInOrder(edge, edge) < limit)
      {
        ends.insert(ends.end(), {face[i], next});
      }
    }
  }

  /// Searches as checkMesh does: among points whose squared distances from the origin differ by less than the limit's
  /// square. This finds points in the same place, such as those on the two sides of a sheet, but not all near points.
  void judgeNearPoints()
  {
    step();
    const double limit = leastDistanceSquared();
    const std::vector<Vec3> guests = counts.pointsOfOthers(std::sqrt(limit));
    const std::size_t own = m.mesh.points.size();
    const auto place = [&](std::size_t i) -> const Vec3& { return i < own ? m.mesh.points[i] : guests[i - own]; };
    const std::vector<double> squares =
        valuesOf(own + guests.size(), [&](std::size_t i) { return dotInOrder(place(i), place(i)); });
    std::vector<Index> order(squares.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return squares[a] != squares[b] ? squares[a] < squares[b] : a < b; });
    std::vector<Index> near;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < order.size(); ++i)
    {
      for (std::size_t j = i; j-- > 0 && squares[order[j]] > squares[order[i]] - limit;)
      {
        const Vec3 way = place(order[i]) - place(order[j]);
        const double square = dotInOrder(way, way);
        if (square < limit)
        {
          least = std::min(least, square);
          near.insert(near.end(), {order[i], order[j]});
        }
      }
    }
    std::erase_if(near, [own](Index point) { return point >= own; });
    CountedValues counted;
    if (!near.empty())
    {
      counted.add(least, false);
    }
    counts.addOthers(counted);
    const double worst = counted.count == 0 ? notANumber : std::sqrt(counted.worst);
    addNote({"PointDistance", "nearPoints", false, false, std::sqrt(limit)}, worst, std::move(near));
  }

  const MeasuredMesh& m;
  const RunContext& context;
  PartCounts counts;
  MeshVerdict verdict;
  int done = 0;
};

} // namespace

const MeshCheck& MeshVerdict::operator[](const std::string& name) const
{
  for (const MeshCheck& check : checks)
  {
    if (name == check.name)
    {
      return check;
    }
  }
  throw Error("there is no check of the name " + name);
}

int MeshVerdict::failedChecks() const
{
  const auto failed = std::count_if(checks.begin(), checks.end(),
                                    [](const MeshCheck& check) { return check.isError && check.failingCount > 0; });
  const bool both = (*this)["Openness"].failingCount > 0 && (*this)["AreaAspectRatio"].failingCount > 0;
  return static_cast<int>(failed) - (both ? 1 : 0);
}

MeshVerdict checkMesh(const MeasuredMesh& mesh, const RunContext& context, const CheckedPart* part)
{
  return MeshChecker(mesh, context, part).run();
}

std::vector<std::uint32_t> failedChecksOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict)
{
  std::vector<std::uint32_t> bits(mesh.mesh.cellCount, 0);
  const std::size_t internalFaces = mesh.mesh.internalFaceCount();
  const auto markFace = [&](std::size_t f, std::uint32_t bit) {
    bits[mesh.mesh.owner[f]] |= bit;
    if (f < internalFaces)
    {
      bits[mesh.mesh.neighbor[f]] |= bit;
    }
  };
  std::vector<bool> marked(mesh.mesh.points.size());
  for (std::size_t i = 0; i < verdict.checks.size(); ++i)
  {
    const MeshCheck& check = verdict.checks[i];
    const std::uint32_t bit = 1U << i;
    for (const Index id : check.failing)
    {
      switch (check.part)
      {
        case MeshPart::Cells:
          bits[id] |= bit;
          break;
        case MeshPart::Faces:
          markFace(id, bit);
          break;
        case MeshPart::Points:
          marked[id] = true;
          break;
        case MeshPart::Mesh:
          break;
      }
    }
    if (check.part == MeshPart::Points && !check.failing.empty())
    {
      for (std::size_t f = 0; f < mesh.mesh.faceCount(); ++f)
      {
        const auto face = mesh.mesh.face(f);
        if (std::any_of(face.begin(), face.end(), [&](Index point) { return marked[point]; }))
        {
          markFace(f, bit);
        }
      }
      marked.assign(marked.size(), false);
    }
  }
  return bits;
}

std::vector<std::uint32_t> failedErrorsOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict)
{
  std::uint32_t errors = 0;
  for (std::size_t i = 0; i < verdict.checks.size(); ++i)
  {
    errors |= verdict.checks[i].isError ? 1U << i : 0U;
  }
  std::vector<std::uint32_t> failed = failedChecksOfCells(mesh, verdict);
  for (std::uint32_t& of : failed)
  {
    of &= errors;
  }
  return failed;
}

} // namespace atria
