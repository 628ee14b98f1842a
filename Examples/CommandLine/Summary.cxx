// SPDX-License-Identifier: GPL-3.0-or-later
#include "Summary.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

namespace atria::tool {

namespace fs = std::filesystem;

namespace {

/// Adds a label and its text.
void line(std::ostringstream& out, const char* label, const std::string& text)
{
  out << std::left << std::setw(14) << label << text << '\n';
}

std::string number(double value, int digits = 3)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string bytesText(double bytes)
{
  return bytes < 1e6   ? number(std::max(bytes / 1e3, 0.1)) + " kB"
         : bytes < 1e9 ? number(bytes / 1e6) + " MB"
                       : number(bytes / 1e9) + " GB";
}

std::string elementsText(const Json& counts)
{
  const auto all = counts["elements"].get<double>();
  std::string text = std::to_string(counts["elements"].get<long long>());
  bool first = true;
  for (const char* kind : {"hexahedra", "wedges", "pyramids", "tetrahedra", "polyhedra"})
  {
    if (const auto count = counts[kind].get<long long>(); count > 0)
    {
      text += (first ? ": " : ", ") + std::to_string(count) + ' ' + kind;
      text += first ? " (" + number(100.0 * static_cast<double>(count) / all) + " %)" : "";
      first = false;
    }
  }
  return text + "; " + std::to_string(counts["vertices"].get<long long>()) + " vertices";
}

std::string worstText(const Json& quality)
{
  std::string text;
  const auto add = [&](const char* metric, const char* extreme, const char* words, const char* unit) {
    if (quality.contains(metric))
    {
      text +=
          (text.empty() ? "" : ", ") + std::string(words) + ' ' + number(quality[metric][extreme].get<double>()) + unit;
    }
  };
  add("NonOrthogonality", "max", "non-orthogonality", " degrees");
  add("Skewness", "max", "skewness", "");
  add("CellSquish", "max", "cell squish", "");
  add("ScaledJacobian", "min", "scaled Jacobian", "");
  return text;
}

/// Returns the failed checks of the OpenFOAM case.
std::string checksText(const Json& openfoam)
{
  if (openfoam.is_null())
  {
    return "not judged; --openfoam judges what it writes, atria quality --checks a mesh";
  }
  std::string text;
  for (const std::string& name : failedIn(openfoam["checks"]))
  {
    const Json& check = openfoam["checks"][name];
    text += (text.empty() ? "fail: " : ", ") + name + " at " + std::to_string(check["failing"].get<long long>()) + ' ' +
            check["of"].get<std::string>();
  }
  return text.empty() ? "all of checkMesh's pass" : text;
}

/// Returns the number of names and the first of them.
std::string namesText(const Json& names)
{
  constexpr std::size_t most = 6;
  std::string text = std::to_string(names.size());
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
  {
    text += (i == 0 ? ": " : ", ") + (names[i].is_string() ? names[i] : names[i]["name"]).get<std::string>();
  }
  return text + (names.size() > most ? " …" : "");
}

std::string repairText(const Json& repair)
{
  constexpr std::array words{
      std::pair{"WeldedPoints", "points welded"},
      std::pair{"DegenerateTriangles", "triangles without area dropped"},
      std::pair{"DuplicateTriangles", "duplicate triangles dropped"},
      std::pair{"OverlappingTriangles", "overlapping pieces dropped"},
      std::pair{"SplitTriangles", "triangles cut at others"},
      std::pair{"ClosedGaps", "points moved across gaps"},
      std::pair{"FlippedTriangles", "triangles turned"},
      std::pair{"UnresolvedContacts", "contacts left unresolved"},
  };
  std::string text;
  for (const auto& [name, word] : words)
  {
    if (const auto count = repair.value(name, 0LL); count > 0)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + word;
    }
  }
  return text.empty() ? "nothing" : text;
}

std::string leftOutText(const Json& zones, const Json& diagnostics)
{
  constexpr std::array words{std::pair{"open", "open spaces"}, std::pair{"ground", "spaces under the ground"},
                             std::pair{"room", "closed rooms"}, std::pair{"solid", "insides of solids"},
                             std::pair{"narrow", "narrow spaces"}};
  std::string text;
  for (const auto& [kind, word] : words)
  {
    const auto count = std::count_if(zones.begin(), zones.end(), [&, name = kind](const Json& zone) {
      return !zone["kept"].get<bool>() && zone["kind"] == name;
    });
    text += count == 0 ? "" : std::string(text.empty() ? "" : ", ") + word + " " + std::to_string(count);
  }
  if (const auto count = diagnostics["LeftOutElement"].get<long long>(); count > 0)
  {
    text += std::string(text.empty() ? "" : ", ") + "elements that would not be valid " + std::to_string(count);
  }
  if (const Json& withoutFaces = diagnostics["SurfaceWithoutFaces"]; !withoutFaces.empty())
  {
    text += std::string(text.empty() ? "" : ", ") + "surfaces without faces " + namesText(withoutFaces);
  }
  return text.empty() ? "nothing" : text;
}

std::string hiddenText(const Json& hidden)
{
  long long leftOut = 0;
  long long clustered = 0;
  for (const Json& detail : hidden)
  {
    leftOut += detail["left_out"]["triangles"].get<long long>();
    clustered += detail["clustered"]["triangles"].get<long long>();
  }
  return hidden.empty() ? "nothing"
                        : std::to_string(leftOut) + " triangles in small parts left out, " + std::to_string(clustered) +
                              " in clusters, of surfaces " + std::to_string(hidden.size());
}

std::string areasText(const Json& surfaces)
{
  constexpr std::array words{
      std::pair{"in_solid", "inside solids"},       std::pair{"under_ground", "on or under the ground"},
      std::pair{"in_room", "in closed rooms"},      std::pair{"shared", "shared"},
      std::pair{"left_out", "in small parts"},      std::pair{"lost", "too fine"},
      std::pair{"outside", "outside of the domain"}};
  const auto sum = [&](const char* what) {
    double all = 0.0;
    for (const Json& surface : surfaces)
    {
      all += surface[what].get<double>();
    }
    return all;
  };
  const double drawn = sum("drawn_area");
  std::string text = number(sum("mesh_area"), 5) + " m² in the mesh, " + number(drawn, 5) + " m² drawn";
  for (const auto& [what, word] : words)
  {
    const double area = sum(what);
    text += area > 1e-3 * drawn ? ", " + number(area) + " m² " + word : "";
  }
  return text;
}

std::string volumesText(const Json& volumes)
{
  const auto volume = [&](const char* name) { return number(volumes[name].get<double>(), 5) + " m³"; };
  return volume("Air") + " of air in " + volume("Domain") + "; displaced " + volume("Displaced") + ", by the model " +
         volume("DisplacedByModel");
}

/// Returns the first three names.
std::string namesOf(const std::vector<const Json*>& bodies)
{
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i)
  {
    text += (i == 0 ? "" : ", ") + (*bodies[i])["body"].get<std::string>();
  }
  return text + (bodies.size() > most ? " and others" : "");
}

/// Returns the number of bodies in each state, with the first of them.
std::string bodiesText(const Json& audit)
{
  const Json& volumes = audit["volumes"];
  std::string text = std::to_string(audit["closed_bodies"].get<long long>()) + " closed, " +
                     number(volumes["ClosedBodies"].get<double>(), 5) + " m³";
  const auto overlap = volumes["Overlap"].get<double>();
  text += overlap > 1e-3 * volumes["ClosedBodies"].get<double>() ? " and " + number(overlap) + " m³ that overlap" : "";
  const auto standing = audit["standing_bodies"].get<long long>();
  text += "; " + std::to_string(standing) + (standing == 1 ? " connected part" : " connected parts") + " on the ground";
  constexpr std::array states{std::pair{"let down", "let down to it"}, std::pair{"hovering", "hovering"},
                              std::pair{"below ground", "reaching below it"}, std::pair{"hollow", "with air inside"},
                              std::pair{"open", "open, with air inside"}};
  for (const auto& [state, words] : states)
  {
    std::vector<const Json*> some;
    double volume = 0.0;
    for (const Json& body : audit["bodies"])
    {
      if (body["state"] == state)
      {
        some.push_back(&body);
        volume += body["volume"].get<double>();
      }
    }
    if (some.empty())
    {
      continue;
    }
    const auto distance = (*some.front())["distance"].get<double>();
    text += ", " + std::to_string(some.size()) + " " + words + " (" + namesOf(some) +
            (distance > 0.0 ? ", " + number(distance) + " m" : "") +
            (std::string_view(state) == "hovering" ? " over " + number(volume) + " m³ of air" : "") + ")";
  }
  return text;
}

/// Returns the surface that is farthest from its faces, or these from it, in elements.
std::string distanceText(const Json& surfaces)
{
  double most = 0.0;
  std::string text = "none";
  for (const Json& surface : surfaces)
  {
    for (const char* which : {"faces_from_model", "model_from_faces"})
    {
      const Json& place = surface[which];
      if (const auto inElements = place["in_elements"].get<double>(); inElements > most && inElements >= 1e-3)
      {
        most = inElements;
        text = number(place["distance"].get<double>()) + " m at most, " + number(inElements, 2) + " elements, " +
               surface["surface"].get<std::string>();
      }
    }
  }
  return text;
}

std::string timeText(const Json& seconds)
{
  std::string text = number(seconds["Total"].get<double>()) + " s";
  std::vector<std::pair<double, std::string>> stages;
  for (const auto& [stage, value] : seconds.items())
  {
    if (stage != "Total")
    {
      stages.emplace_back(value.get<double>(), stage);
    }
  }
  std::stable_sort(stages.begin(), stages.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, stages.size()); ++i)
  {
    text += (i == 0 ? ", most of it " : ", ") + stages[i].second + ' ' + number(stages[i].first, 2);
  }
  return text;
}

double sizeOf(const fs::path& path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    const auto size = fs::file_size(path, error);
    return error ? 0.0 : static_cast<double>(size);
  }
  double sum = 0.0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, error))
  {
    sum += entry.is_regular_file(error) ? static_cast<double>(entry.file_size(error)) : 0.0;
  }
  return sum;
}

} // namespace

std::string summaryOf(const Json& report, const std::vector<std::string>& files)
{
  std::ostringstream out;
  line(out, "elements", elementsText(report["counts"]));
  const auto invalid = report["invalid_elements"].get<long long>();
  line(out, "not valid", invalid == 0 ? "none" : std::to_string(invalid));
  line(out, "checks", checksText(report["openfoam"]));
  line(out, "worst", worstText(report["quality"]));
  line(out, "patches", namesText(report["patches"]));
  for (const char* kind : {"openings", "rooms"})
  {
    if (!report[kind].empty())
    {
      line(out, kind, namesText(report[kind]));
    }
  }
  const Json& audit = report["audit"];
  line(out, "areas", areasText(audit["surfaces"]));
  line(out, "volumes", volumesText(audit["volumes"]));
  line(out, "bodies", bodiesText(audit));
  line(out, "off the model", distanceText(audit["surfaces"]));
  line(out, "repaired", repairText(report["repair"]));
  line(out, "too fine", hiddenText(report["hidden_detail"]));
  line(out, "left out", leftOutText(report["zones"], report["diagnostics"]));
  line(out, "time", timeText(report["seconds"]));
  line(out, "memory",
       bytesText(report["peak_memory_bytes"].get<double>()) + " at most, " +
           std::to_string(report["threads"].get<int>()) + " threads");
  const char* label = "files";
  for (const std::string& file : files)
  {
    if (!file.empty() && fs::exists(file))
    {
      line(out, label, file + " (" + bytesText(sizeOf(file)) + ')');
      label = "";
    }
  }
  return out.str();
}

} // namespace atria::tool
