// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/AuditReport.h"

#include "Octree/Sizing/SizeRules.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace atria {

namespace {

/// Share of a surface's area that must be in the mesh or explained. As much above the area as drawn is too much.
constexpr double leastCoverage = 0.95;
/// Largest difference between the area of a surface and the area that air sees of it, over the latter.
constexpr double areaTolerance = 0.005;
/// Largest difference between the volumes of the mesh and of the model, over the latter.
constexpr double volumeTolerance = 0.01;
/// Largest distance between a mesh and its model, in elements and over the extent of a surface.
constexpr double mostElements = 0.5;
constexpr double mostOfExtent = 0.02;

/// A surface with what there is to say of it; the gravest have the largest weight.
struct Finding
{
  double weight;
  Index surface;
  std::string text;
};

template <typename... T> std::string textOf(const T&... parts)
{
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

/// Names the six findings of largest weight, each with its text, and counts the others.
std::string namesOf(std::vector<Finding> findings, const std::vector<std::string>& names)
{
  constexpr std::size_t most = 6;
  std::ranges::stable_sort(findings, [](const Finding& l, const Finding& r) { return l.weight > r.weight; });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, findings.size()); ++i)
  {
    text += (i == 0 ? "" : ", ") + names[findings[i].surface] + " (" + findings[i].text + ")";
  }
  return text + (findings.size() > most ? textOf(" and ", findings.size() - most, " more") : "");
}

/// Counts the surfaces, as in `3 surfaces`, and names the first of them.
std::string listOf(std::vector<Finding> findings, const std::vector<std::string>& names, const char* what)
{
  const std::size_t count = findings.size();
  return textOf(count, count == 1 ? " surface " : " surfaces ", what, ": ") + namesOf(std::move(findings), names);
}

constexpr const char* underGround = "on or under the ground";

/// Returns why most of the missing area of a surface is not in the mesh.
std::string reasonOf(const SurfaceAudit& surface)
{
  struct Reason
  {
    double area;
    const char* text;
  };
  const std::array reasons{
      Reason{surface.lost, "finer than the mesh"},       Reason{surface.leftOut, "small parts left out"},
      Reason{surface.shared, "another face lies there"}, Reason{surface.inSolid, "inside a solid"},
      Reason{surface.underGround, underGround},          Reason{surface.inRoom, "in a closed room that is not meshed"}};
  return std::ranges::max_element(reasons, {}, &Reason::area)->text;
}

/// Weight and text for one surface; empty if there is nothing to say.
using Said = std::optional<std::pair<double, std::string>>;

/// Returns the findings of `judge` on all surfaces.
template <typename Judge> std::vector<Finding> findingsOf(const MeshAudit& audit, Judge&& judge)
{
  std::vector<Finding> found;
  for (Index i = 0; i < audit.surfaces.size(); ++i)
  {
    if (Said said = judge(audit.surfaces[i]))
    {
      found.push_back({said->first, i, std::move(said->second)});
    }
  }
  return found;
}

/// Reasons why a surface has no face.
enum class Without : std::uint8_t
{
  elements, ///< its elements are too coarse
  air,      ///< no air is meshed there
  sky       ///< it is a base on the ground, or under the ground
};

std::vector<Finding> withoutFaces(const MeshAudit& audit, Without what)
{
  return findingsOf(audit, [what](const SurfaceAudit& surface) -> Said {
    if (surface.meshArea != 0.0 || surface.drawnArea == 0.0)
    {
      return std::nullopt;
    }
    const bool isMissing = surface.lost + surface.leftOut > (1.0 - leastCoverage) * surface.drawnArea;
    const std::string reason = reasonOf(surface);
    const Without why = isMissing ? Without::elements : reason == underGround ? Without::sky : Without::air;
    return why == what ? Said({surface.drawnArea, textOf(surface.drawnArea, " m², ", reason)}) : std::nullopt;
  });
}

/// Finds surfaces that are drawn, but not where the mesh is.
Said outsideOfDomain(const SurfaceAudit& surface)
{
  if (surface.extent > 0.0 && surface.drawnArea == 0.0 && surface.meshArea == 0.0)
  {
    return std::pair(surface.extent, textOf(surface.outside, " m², ", surface.extent, " m across"));
  }
  return std::nullopt;
}

/// Finds surfaces with a missing area that is larger than a face of the mesh, as nothing smaller can be shown.
Said withPartsMissing(const SurfaceAudit& surface)
{
  const double missing = surface.lost + surface.leftOut;
  if (surface.meshArea > 0.0 && missing > (1.0 - leastCoverage) * surface.drawnArea &&
      missing > std::pow(surface.meanSize, 2))
  {
    return std::pair(missing,
                     textOf(missing, " of ", surface.drawnArea, " m² missing, most of it ",
                            surface.lost >= surface.leftOut ? "finer than the mesh" : "in small parts left out"));
  }
  return std::nullopt;
}

/// Finds surfaces whose faces stand in folds, or on both sides where there is air on one side only.
Said largerThanDrawn(const SurfaceAudit& surface)
{
  const double most = std::max(surface.drawnArea, surface.placedArea);
  const double excess = surface.meshArea - most;
  if (excess > (1.0 - leastCoverage) * most && excess > std::pow(surface.meanSize, 2))
  {
    return std::pair(excess, textOf(surface.meshArea, " m² for ", most, " m²"));
  }
  return std::nullopt;
}

Said farAway(const SurfaceAudit& surface)
{
  const auto& [faces, model] = surface.distances;
  const FarthestPlace& place = faces.inElements > model.inElements ? faces : model;
  if (place.inElements > mostElements || place.distance > mostOfExtent * surface.extent)
  {
    return std::pair(place.inElements,
                     textOf(place.distance, " m, ", place.inElements, " elements, at ", place.at.transpose()));
  }
  return std::nullopt;
}

/// Finds surfaces whose area is off, but by too little for a warning.
Said inexactArea(const SurfaceAudit& surface)
{
  const double seen = surface.seenArea();
  const double difference = surface.meshArea - seen;
  if (surface.meshArea == 0.0 || seen <= 0.0 || std::abs(difference) <= areaTolerance * seen ||
      withPartsMissing(surface) || largerThanDrawn(surface))
  {
    return std::nullopt;
  }
  const FarthestPlace& place = surface.distances.ofFaces;
  return std::pair(std::abs(difference),
                   textOf(difference > 0.0 ? "+" : "", 100.0 * difference / seen, " % of ", seen, " m², faces up to ",
                          place.distance, " m off at ", place.at.transpose()));
}

/// Returns the advice for elements that are too large.
std::string finerSizes(const GridFrame& frame)
{
  return textOf("lower SizeMin, which is ", frame.sizeOf(frame.featureLevel),
                ", or give these surfaces a size of their own (SurfaceSizeRules)");
}

std::string bodiesWarning(const MeshAudit& audit)
{
  return textOf("the mesh leaves out ", audit.volumes.displaced(),
                " m³ of the domain, but the closed bodies of the model have ", audit.bodies.volume,
                " m³ there: some are too thin for the mesh, or meshed hollow");
}

std::string volumeWarning(const VolumeAudit& volumes)
{
  return textOf("the mesh leaves out ", volumes.displaced(), " m³ of the domain, but the model encloses ",
                volumes.displacedByModel,
                " m³: something is meshed hollow, or closed by the mesh alone; look at the zones, and for open bodies "
                "with inspect");
}

} // namespace

void completeAudit(const DrawnModel& drawn, const std::vector<ZoneSummary>& zones, const SurfaceModel& model,
                   const GridFrame& frame, const ModelOptions& options, MeshAudit& audit)
{
  finishAudit(measureDrawn(drawn.surface, frame.prism(), frame.latticeUnit()), model.repair, audit);
  audit.bodies = auditBodies(drawn, frame.prism(), zones, frame.sizeOf(frame.featureLevel));
  const ModelLevels levels = modelLevels(model, frame, options.sizing);
  for (std::size_t i = 0; i < audit.surfaces.size(); ++i)
  {
    audit.surfaces[i].requestedSize = frame.sizeOf(levels.ofSurface[i]);
  }
}

std::vector<std::string> warningsOf(const MeshAudit& audit, const std::vector<std::string>& names,
                                    const GridFrame& frame)
{
  std::vector<std::string> warnings;
  const auto add = [&](std::vector<Finding> findings, const char* what, const std::string& advice) {
    if (!findings.empty())
    {
      warnings.push_back(listOf(std::move(findings), names, what) + "; " + advice);
    }
  };
  const std::string sizes = finerSizes(frame);
  add(withoutFaces(audit, Without::elements), "without a face in the mesh",
      "if boundary conditions are to stand on them, " + sizes);
  add(withoutFaces(audit, Without::sky), "without a face in the mesh",
      "no air is meshed there; leave these surfaces out if nothing else is meant (ExcludedSurfaces)");
  add(withoutFaces(audit, Without::air), "without a face in the mesh",
      "finer elements do not change that; where there should be air, look for what closes it in, or give a seed there "
      "by Seeds");
  add(findingsOf(audit, outsideOfDomain), "without a face in the mesh, outside of the domain or below its bottom",
      "give a larger domain if they belong into it, or leave them out (ExcludedSurfaces)");
  add(findingsOf(audit, withPartsMissing), "of which parts are missing", sizes);
  add(findingsOf(audit, largerThanDrawn), "with more faces than drawn", sizes);
  const VolumeAudit& volumes = audit.volumes;
  const double element = std::pow(frame.sizeOf(frame.featureLevel), 3);
  const double difference = std::abs(volumes.displaced() - volumes.displacedByModel);
  if (difference > volumeTolerance * std::abs(volumes.displacedByModel) && difference > element)
  {
    warnings.push_back(volumeWarning(volumes));
  }
  const BodyAudit& bodies = audit.bodies;
  const double missing = bodies.volume - volumes.displaced();
  if (bodies.isOnFlatGround && bodies.hollow.empty() && missing > volumeTolerance * bodies.volume && missing > element)
  {
    warnings.push_back(bodiesWarning(audit) + "; " + sizes);
  }
  add(findingsOf(audit, farAway), "farther from the mesh than half an element or a fiftieth of their extent", sizes);
  return warnings;
}

std::vector<std::string> notesOf(const MeshAudit& audit, const std::vector<std::string>& names, const GridFrame& frame)
{
  std::vector<std::string> notes;
  const std::vector<AiredBody>& open = audit.bodies.open;
  if (!open.empty())
  {
    std::vector<Finding> found;
    found.reserve(open.size());
    for (const AiredBody& body : open)
    {
      found.push_back({body.volume, body.surface, textOf("about ", body.place.transpose())});
    }
    notes.push_back(textOf(open.size(), open.size() == 1 ? " body is" : " bodies are",
                           " open, and air is meshed inside of ", open.size() == 1 ? "it: " : "them: ") +
                    namesOf(std::move(found), names) + "; close what is meant to be solid");
  }
  if (std::vector<Finding> found = findingsOf(audit, inexactArea); !found.empty())
  {
    notes.push_back(
        listOf(std::move(found), names, "with an area that is more than 0.5 % off") +
        "; faces cut off what is round or finer than they are, and some stay off their surface to be valid: " +
        finerSizes(frame));
  }
  return notes;
}

} // namespace atria
