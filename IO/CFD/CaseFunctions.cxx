// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseSystem.h"

#include <algorithm>

namespace atria {

namespace {

/// Density of air at 15 degrees Celsius, kg/m3.
constexpr double airDensity = 1.225;

/// Returns a name for OpenFOAM's lists of words or patterns.
std::string quoted(const std::string& name) { return '"' + name + '"'; }

void everyStep(FoamText& text) { text.entry("writeControl", "timeStep").entry("writeInterval", "1"); }

/// Sum of flows: with their signs (Net), or of their magnitudes (BothWays).
enum class Flow
{
  Net,
  BothWays
};

/// Adds a function that sums the flow over faces, m3/s.
void addFlow(FoamText& text, OpenFOAMDialect dialect, const std::string& function, const char* region,
             const std::string& name, Flow kind)
{
  const bool isFoundations = isFoundation(dialect);
  text.open(function).entry("type", "surfaceFieldValue").entry("libs", "(\"libfieldFunctionObjects.so\")");
  everyStep(text);
  text.entry("log", "no").entry("writeFields", "no");
  if (!isFoundations)
  {
    text.entry("regionType", region).entry("name", name);
  }
  else if (dialect == OpenFOAMDialect::Foundation)
  {
    // Versions 11 and 13 need different keywords; each ignores the other's.
    text.entry("select", region).entry("name", name).entry(region, name);
  }
  else
  {
    text.entry(region, name);
  }
  // OpenCFD's sum respects the orientation of a zone's faces.
  const char* const net = isFoundations ? "orientedSum" : "sum";
  text.entry("operation", kind == Flow::Net ? net : "sumMag").entry("fields", "(phi)");
  text.close();
}

void addFlows(FoamText& text, const CaseOfDirection& flow)
{
  const auto add = [&](const std::string& function, const char* region, const std::string& name, Flow kind) {
    addFlow(text, flow.settings.dialect, function, region, name, kind);
  };
  // Inflow and outflow follow from both sums.
  for (const CaseOpening& opening : flow.mesh.openings)
  {
    add("flow_" + opening.name, "faceZone", opening.name, Flow::Net);
    add("flowBothWays_" + opening.name, "faceZone", opening.name, Flow::BothWays);
  }
  for (const PatchRole role : {PatchRole::Inlet, PatchRole::Outlet, PatchRole::InletOutlet})
  {
    for (const std::string& patch : flow.namesOf(role))
    {
      add("flow_" + patch, "patch", patch, Flow::Net);
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

/// Adds the transport of a scalar that grows by one second per second. The Foundation has a function of its own, which
/// begins at zero each time it writes. Version 14 has it in another library, and reads nCorr in fvSolution.
void addAge(FoamText& text, OpenFOAMDialect dialect)
{
  if (isFoundation(dialect))
  {
    text.open("age").entry("type", "age");
    text.entry("libs", "(\"libfieldFunctionObjects.so\" \"libsolverFunctionObjects.so\")");
    text.entry("diffusion", "yes").entry("nCorr", ageCorrectors).entry("tolerance", "1e-06");
    text.entry("executeControl", "writeTime").entry("writeControl", "writeTime").close();
    return;
  }
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
  const bool isFoundations = isFoundation(flow.settings.dialect);
  text.open("average").entry("type", "fieldAverage").entry("libs", "(\"libfieldFunctionObjects.so\")");
  text.entry(isFoundations ? "startTime" : "timeStart", std::max(1, flow.settings.iterations * 4 / 5));
  text.entry("writeControl", "writeTime");
  if (isFoundations)
  {
    text.entry("mean", "yes").entry("prime2Mean", "no").entry("base", "time").entry("fields", "(U p)").close();
    return;
  }
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
  addFlows(text, flow);
  addAverage(text, flow);
  text.open("yPlus").entry("type", "yPlus").entry("libs", "(\"libfieldFunctionObjects.so\")");
  text.entry("writeControl", "writeTime").close();
  if (flow.settings.ageOfAir)
  {
    addAge(text, flow.settings.dialect);
  }
  text.close();
}

} // namespace atria
