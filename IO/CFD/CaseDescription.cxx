// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseDescription.h"

#include "FoamText.h"
#include "Support/Text.h"

#include <algorithm>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace atria {

namespace {

using Json = nlohmann::ordered_json;

const char* roleName(PatchRole role)
{
  constexpr const char* names[] = {"inlet", "outlet", "inletOutlet", "slip", "ground", "wall", "rough", "constraint"};
  return names[static_cast<std::size_t>(role)];
}

/// Returns the inlets with a supply, by index of the patch, except those whose velocity a condition of the user gives.
std::vector<std::size_t> suppliesOf(const CaseOfDirection& flow)
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    if (flow.choices[i].supply && !conditionOf(flow.settings, "U", flow.mesh.patches[i].name))
    {
      found.push_back(i);
    }
  }
  return found;
}

double flowRateOf(const CaseOfDirection& flow, std::size_t patch)
{
  return flow.choices[patch].supply->flowRate(flow.mesh.patches[patch].area);
}

/// Returns the mean speed over the inlets of a room, m/s.
double supplySpeed(const CaseOfDirection& flow)
{
  double flowRate = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    if (flow.choices[i].supply)
    {
      flowRate += flowRateOf(flow, i);
      area += flow.mesh.patches[i].area;
    }
  }
  return flowRate / area;
}

void describeWind(const WindProfile& wind, Json& report)
{
  report["kind"] = "wind";
  report["reference_speed"] = wind.speed;
  report["reference_height"] = wind.referenceHeight;
  report["roughness_length"] = wind.roughness;
  report["friction_velocity"] = wind.frictionVelocity();
}

/// Returns a typical speed of calm air, m/s: by heat, or where the pressure of the strongest fan becomes speed.
double speedOfCalmAir(const CaseOfDirection& flow)
{
  double speed = speedOfWarmAir(flow.heat, flow.settings.outdoorTemperature, flow.mesh.bounds.size()[2]);
  for (const CaseBaffle& baffle : flow.baffles)
  {
    speed = std::max(speed, speedOf(baffle));
  }
  return speed;
}

void describeRoom(const CaseOfDirection& flow, Json& report)
{
  report["kind"] = "room";
  report["reference_speed"] = suppliesOf(flow).empty() && flow.settings.calm ? speedOfCalmAir(flow) : supplySpeed(flow);
}

/// Describes a domain whose air only heat moves.
void describeCalm(const CaseOfDirection& flow, Json& report)
{
  report["kind"] = "calm";
  report["reference_speed"] = speedOfCalmAir(flow);
}

void describeHeat(const CaseOfDirection& flow, Json& report)
{
  const FlowCaseSettings& settings = flow.settings;
  if (!settings.warmAir)
  {
    return;
  }
  report["calm"] = settings.calm;
  report["warm_air"] = {{"outdoor_temperature", settings.outdoorTemperature},
                        {"heat_capacity", warmAirAt(settings.outdoorTemperature).heatCapacity},
                        {"diffusivities", heatDiffusivities()},
                        {"zones", flow.heat.zones},
                        {"surfaces", flow.heat.surfaces},
                        {"temperatures", flow.heat.temperatures},
                        {"incoming", flow.heat.incoming},
                        {"duration", settings.transientDuration},
                        {"speed", speedOfCalmAir(flow)}};
}

void describeScalars(const CaseOfDirection& flow, Json& report)
{
  for (const CaseScalar& scalar : flow.scalars)
  {
    Json sources = scalar.zones;
    sources.update(scalar.surfaces);
    report["scalars"].push_back({{"name", scalar.name}, {"sources", sources}, {"incoming", Json::object()}});
  }
}

/// Leaves slow the air. The description says whether they are sources of turbulence too.
void describeCanopies(const CaseOfDirection& flow, Json& report)
{
  for (const CaseCanopy& canopy : flow.canopies)
  {
    report["canopies"].push_back({{"zone", canopy.zone},
                                  {"leaf_area_density", canopy.leafAreaDensity},
                                  {"drag_coefficient", canopy.dragCoefficient},
                                  {"volume", canopy.volume},
                                  {"sources", flow.leavesMakeTurbulence() ? "momentum, k, epsilon" : "momentum"}});
  }
}

void describeBaffles(const CaseOfDirection& flow, Json& report)
{
  for (const CaseBaffle& baffle : flow.baffles)
  {
    if (!baffle.isFan())
    {
      report["screens"].push_back(
          {{"zone", baffle.zone}, {"resistance", baffle.resistance}, {"linear", baffle.linear}});
      continue;
    }
    report["fans"].push_back({{"zone", baffle.zone}, {"blows_back", baffle.blowsBack}, {"curve", baffle.curve}});
  }
}

/// Returns a number with three digits.
std::string shortNumber(double value)
{
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

} // namespace

std::string listed(const std::vector<std::string>& texts)
{
  constexpr std::size_t most = 6;
  const auto last = texts.begin() + static_cast<std::ptrdiff_t>(std::min(most, texts.size()));
  return joined({texts.begin(), last}) +
         (texts.size() > most ? " and " + std::to_string(texts.size() - most) + " more" : "");
}

Json describeCase(const CaseOfDirection& flow)
{
  const FlowCaseSettings& settings = flow.settings;
  const CaseMesh& mesh = flow.mesh;
  Json report;
  flow.isRoom()    ? describeRoom(flow, report)
  : flow.hasWind() ? describeWind(settings.wind, report)
                   : describeCalm(flow, report);
  report["turbulence"] = modelName(settings.turbulence);
  report["iterations"] = settings.iterations;
  report["pedestrian_height"] = settings.pedestrianHeight;
  report["age_of_air"] = settings.ageOfAir;
  report["mesh"] = {{"cells", mesh.cells},
                    {"faces", mesh.faces},
                    {"bounds",
                     {mesh.bounds.min[0], mesh.bounds.max[0], mesh.bounds.min[1], mesh.bounds.max[1],
                      mesh.bounds.min[2], mesh.bounds.max[2]}},
                    {"volume", mesh.volume},
                    {"worst_non_orthogonality", mesh.worstNonOrthogonality},
                    {"mean_non_orthogonality", mesh.meanNonOrthogonality},
                    {"worst_skewness", mesh.worstSkewness},
                    {"failed_checks", mesh.failedChecks}};
  report["openings"] = Json::array();
  for (const CaseOpening& opening : mesh.openings)
  {
    report["openings"].push_back({{"name", opening.name}, {"area", opening.area}, {"rooms", opening.rooms}});
  }
  report["rooms"] = Json::array();
  for (const CaseRoom& room : mesh.rooms)
  {
    report["rooms"].push_back({{"name", room.name}, {"volume", room.volume}});
  }
  describeScalars(flow, report);
  describeHeat(flow, report);
  describeCanopies(flow, report);
  describeBaffles(flow, report);
  report["directions"] = Json::array();
  return report;
}

void addIncoming(const CaseOfDirection& flow, Json& report)
{
  for (std::size_t i = 0; i < flow.scalars.size(); ++i)
  {
    report["scalars"][i]["incoming"].update(Json(flow.scalars[i].incoming));
  }
}

/// `towards` is the direction the wind blows to. Rooms and calm air have none.
Json describeDirection(const CaseOfDirection& flow, double towards, const std::string& folder)
{
  Json described = {{"folder", folder}};
  if (flow.hasWind())
  {
    described["towards"] = towards;
    described["from"] = windFrom(towards, flow.settings.north);
  }
  described["patches"] = Json::object();
  described["areas"] = Json::object();
  described["supplies"] = Json::object();
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    described["patches"][flow.mesh.patches[i].name] = roleName(flow.choices[i].role);
    described["areas"][flow.mesh.patches[i].name] = flow.mesh.patches[i].area;
  }
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    if (flow.choices[i].roughness)
    {
      described["roughness_lengths"][flow.mesh.patches[i].name] = *flow.choices[i].roughness;
    }
  }
  for (const std::size_t i : suppliesOf(flow))
  {
    described["supplies"][flow.mesh.patches[i].name] = flowRateOf(flow, i);
  }
  return described;
}

std::vector<std::string> warnOfSheets(const CaseOfDirection& flow)
{
  std::vector<std::string> warnings;
  constexpr std::string_view front = "_front";
  for (const std::size_t i : suppliesOf(flow))
  {
    const std::string& name = flow.mesh.patches[i].name;
    const std::string other = name.ends_with(front) ? name.substr(0, name.size() - front.size()) + "_back" : "";
    for (const std::size_t j : suppliesOf(flow))
    {
      if (flow.mesh.patches[j].name == other)
      {
        std::ostringstream text;
        text << '\'' << name << "' and '" << other << "' are the sides of one sheet, and air is blown from both, "
             << foamNumber(flowRateOf(flow, i) + flowRateOf(flow, j))
             << " m3/s in all. To blow from one side, say PatchRules " << other << " wall";
        warnings.push_back(text.str());
      }
    }
  }
  return warnings;
}

std::vector<std::string> warnOfWindless(const Windless& windless, const std::vector<std::string>& folders)
{
  std::vector<std::string> warnings;
  for (const auto& [name, where] : windless)
  {
    std::ostringstream text;
    text << "the wind does not enter at inlet '" << name << '\'';
    if (where.size() < folders.size())
    {
      text << " in " << listed(where);
    }
    text << ": it blows along it or out of it, and no air comes in there. Turn the wind, or let the inlet blow by "
            "itself, "
            "such as PatchRules "
         << name << " inlet:1m/s";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::string summaryOfRoom(const CaseOfDirection& flow)
{
  const std::vector<std::size_t> known = suppliesOf(flow);
  std::vector<std::string> in;
  double flowRate = 0.0;
  for (const std::size_t i : known)
  {
    const CasePatch& patch = flow.mesh.patches[i];
    flowRate += flowRateOf(flow, i);
    in.push_back(patch.name + " (" + shortNumber(flow.choices[i].supply->speed(patch.area)) + " m/s, " +
                 shortNumber(flowRateOf(flow, i)) + " m3/s)");
  }
  const std::vector<std::string> inlets = flow.namesOf(PatchRole::Inlet);
  std::ranges::copy_if(inlets, std::back_inserter(in),
                       [&](const std::string& name) { return conditionOf(flow.settings, "U", name); });
  std::vector<std::string> out = flow.namesOf(PatchRole::Outlet);
  std::ranges::copy(flow.namesOf(PatchRole::InletOutlet), std::back_inserter(out));
  if (known.empty() && flow.settings.calm)
  {
    return "Room of " + shortNumber(flow.mesh.volume) + " m3, whose air heat moves through " + listed(out);
  }
  const std::string changes = known.size() == inlets.size()
                                  ? ", " + shortNumber(flowRate * 3600.0 / flow.mesh.volume) + " air changes per hour"
                                  : "";
  return "Room of " + shortNumber(flow.mesh.volume) + " m3" + changes + ": in through " + listed(in) +
         "; out through " + listed(out);
}

} // namespace atria
