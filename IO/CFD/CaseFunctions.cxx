// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseSystem.h"

#include <algorithm>

namespace atria {

namespace {

/// Of air at 15 degrees Celsius, kg/m3.
constexpr double airDensity = 1.225;

/// The name as OpenFOAM takes it in a list of words or patterns.
std::string quoted(const std::string& name) { return '"' + name + '"'; }

void everyStep(FoamText& text) { text.entry("writeControl", "timeStep").entry("writeInterval", "1"); }

/// The sum over faces of the flow, m3/s: with its sign, or without.
void addFlow(FoamText& text, const std::string& function, const char* region, const std::string& name,
             const char* operation)
{
  text.open(function).entry("type", "surfaceFieldValue").entry("libs", "(\"libfieldFunctionObjects.so\")");
  everyStep(text);
  text.entry("log", "no").entry("writeFields", "no");
  text.entry("regionType", region).entry("name", name).entry("operation", operation).entry("fields", "(phi)");
  text.close();
}

void addFlows(FoamText& text, const CaseOfDirection& flow)
{
  // What comes in and goes out follows from both sums.
  for (const CaseOpening& opening : flow.mesh.openings)
  {
    addFlow(text, "flow_" + opening.name, "faceZone", opening.name, "sum");
    addFlow(text, "flowBothWays_" + opening.name, "faceZone", opening.name, "sumMag");
  }
  for (const PatchRole role : {PatchRole::Inlet, PatchRole::Outlet, PatchRole::InletOutlet})
  {
    for (const std::string& patch : flow.namesOf(role))
    {
      addFlow(text, "flow_" + patch, "patch", patch, "sum");
    }
  }
}

void addForces(FoamText& text, const CaseOfDirection& flow)
{
  std::vector<std::string> walls;
  for (const PatchRole role : {PatchRole::Wall, PatchRole::RoughWall})
  {
    for (const std::string& name : flow.namesOf(role))
    {
      walls.push_back(quoted(name));
    }
  }
  if (walls.empty())
  {
    return;
  }
  const Vec3 center = flow.mesh.bounds.center();
  text.open("forces").entry("type", "forces").entry("libs", "(\"libforces.so\")");
  everyStep(text);
  text.entry("log", "no").entry("patches", foamList(walls)).entry("rho", "rhoInf").entry("rhoInf", airDensity);
  text.entry("CofR", foamVector({center[0], center[1], flow.mesh.bounds.min[2]})).close();
}

void addProbes(FoamText& text, const CaseOfDirection& flow)
{
  if (flow.probes.empty())
  {
    return;
  }
  text.open("pedestrians").entry("type", "probes").entry("libs", "(\"libsampling.so\")");
  text.entry("writeControl", "timeStep").entry("writeInterval", "10");
  text.entry("fields", "(U)").line("probeLocations").line("(");
  for (const Vec3& place : flow.probes)
  {
    text.line("    " + foamVector(place));
  }
  text.line(");").close();
}

/// The transport of a scalar that grows by one second a second.
void addAge(FoamText& text)
{
  text.open("age").entry("type", "scalarTransport").entry("libs", "(\"libsolverFunctionObjects.so\")");
  text.entry("field", "age").entry("nut", "nut").entry("resetOnStartUp", "no");
  text.entry("writeControl", "writeTime");
  text.open("fvOptions").open("oneSecondEachSecond").entry("type", "scalarSemiImplicitSource");
  text.entry("selectionMode", "all").entry("volumeMode", "specific");
  text.open("injectionRateSuSp").entry("age", "(1 0)").close();
  text.close().close().close();
}

void addAverage(FoamText& text, const CaseOfDirection& flow)
{
  text.open("average").entry("type", "fieldAverage").entry("libs", "(\"libfieldFunctionObjects.so\")");
  text.entry("timeStart", std::max(1, flow.settings.iterations * 4 / 5)).entry("writeControl", "writeTime");
  text.line("fields").line("(");
  for (const char* field : {"U", "p"})
  {
    text.line(std::string("    ") + field + " { mean on; prime2Mean off; base time; }");
  }
  text.line(");").close();
}

} // namespace

void addFunctions(FoamText& text, const CaseOfDirection& flow)
{
  text.open("functions");
  addForces(text, flow);
  addProbes(text, flow);
  if (flow.settings.dialect != OpenFOAMDialect::Foundation) // where these are spelled in other ways
  {
    addFlows(text, flow);
    addAverage(text, flow);
    text.open("yPlus").entry("type", "yPlus").entry("libs", "(\"libfieldFunctionObjects.so\")");
    text.entry("writeControl", "writeTime").close();
    if (flow.settings.ageOfAir)
    {
      addAge(text);
    }
  }
  text.close();
}

} // namespace atria
