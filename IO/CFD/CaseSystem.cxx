// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseSystem.h"

#include "Decomposition.h"

#include <algorithm>

namespace atria {

namespace {

/// Kinematic viscosity of air at 15 degrees Celsius, m2/s.
constexpr double airViscosity = 1.5e-5;

const char* modelName(TurbulenceModel model)
{
  return model == TurbulenceModel::KEpsilon             ? "kEpsilon"
         : model == TurbulenceModel::RealizableKEpsilon ? "realizableKE"
                                                        : "kOmegaSST";
}

/// Returns the number of iterations between written fields. It divides `iterations`: OpenFOAM does not write at the end
/// by itself.
int iterationsBetweenFields(int iterations)
{
  constexpr int most = 500;
  const int times = (iterations + most - 1) / most;
  return times > 1 && iterations % times == 0 ? iterations / times : std::max(1, iterations);
}

bool isFoundation(const CaseOfDirection& flow) { return isFoundation(flow.settings.dialect); }

void writeControl(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  FoamText text;
  if (isFoundation(flow))
  {
    text.entry("solver", "incompressibleFluid");
  }
  else
  {
    text.entry("application", "simpleFoam");
  }
  const int iterations = flow.settings.iterations;
  text.entry("startFrom", "latestTime").entry("startTime", "0").entry("stopAt", "endTime");
  text.entry("endTime", iterations).entry("deltaT", "1");
  text.entry("writeControl", "timeStep").entry("writeInterval", iterationsBetweenFields(iterations));
  text.entry("purgeWrite", "2").entry("writeFormat", "binary").entry("writePrecision", "10");
  text.entry("writeCompression", "off").entry("timeFormat", "general").entry("timePrecision", "6");
  text.entry("runTimeModifiable", "yes").blank();
  if (!flow.isRoom())
  {
    text.entry("libs", "(\"libatmosphericModels.so\")").blank();
  }
  addFunctions(text, flow);
  writeFoamFile(folder, "system", "controlDict", "dictionary", text);
}

void writeSchemes(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  const OrthogonalityRule rule = ruleForAngle(flow.mesh.worstNonOrthogonality);
  const std::string turbulence = flow.usesOmega() ? "omega" : "epsilon";
  FoamText text;
  text.comment("For a mesh whose worst non-orthogonality is " + foamNumber(flow.mesh.worstNonOrthogonality) +
               " degrees.");
  text.open("ddtSchemes").entry("default", "steadyState").close().blank();
  text.open("gradSchemes").entry("default", "cellLimited Gauss linear 1").close().blank();
  text.open("divSchemes").entry("default", "none");
  text.entry("div(phi,U)", "bounded Gauss linearUpwind grad(U)").entry("div(phi,k)", "bounded Gauss upwind");
  text.entry("div(phi," + turbulence + ")", "bounded Gauss upwind");
  if (flow.settings.ageOfAir)
  {
    text.entry("div(phi,age)", "bounded Gauss upwind");
  }
  text.entry("div((nuEff*dev2(T(grad(U)))))", "Gauss linear").close().blank();
  text.open("laplacianSchemes").entry("default", "Gauss linear " + rule.correction);
  text.entry("\"laplacian\\(.*,(k|" + turbulence + ")\\)\"", "Gauss linear " + rule.turbulenceCorrection)
      .close()
      .blank();
  text.open("interpolationSchemes").entry("default", "linear").close().blank();
  text.open("snGradSchemes").entry("default", rule.correction).close().blank();
  text.open("wallDist").entry("method", "meshWave").close();
  writeFoamFile(folder, "system", "fvSchemes", "dictionary", text);
}

void solver(FoamText& text, const char* field, bool isPressure, const char* relative, int correctors = 0)
{
  text.open(field);
  text.entry("solver", isPressure ? "GAMG" : "smoothSolver");
  text.entry("smoother", isPressure ? "GaussSeidel" : "symGaussSeidel");
  text.entry("tolerance", isPressure ? "1e-07" : "1e-08").entry("relTol", relative);
  if (correctors > 0)
  {
    text.entry("nCorr", correctors);
  }
  text.close();
}

void writeSolution(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  const OrthogonalityRule rule = ruleForAngle(flow.mesh.worstNonOrthogonality);
  const std::string correctors = std::to_string(rule.correctors);
  FoamText text;
  text.open("solvers");
  solver(text, "p", true, "0.05");
  if (flow.settings.dialect == OpenFOAMDialect::Foundation14)
  {
    solver(text, "\"(U|k|epsilon|omega)\"", false, "0.1");
    solver(text, "age", false, "0.1", ageCorrectors);
  }
  else
  {
    solver(text, "\"(U|k|epsilon|omega|age)\"", false, "0.1");
  }
  text.close().blank();
  text.open("SIMPLE").entry("consistent", "yes").entry("nNonOrthogonalCorrectors", correctors);
  text.entry("pRefCell", "0").entry("pRefValue", "0"); // for cases that fix no pressure
  text.blank().open("residualControl");
  text.entry("p", "1e-05").entry("U", "1e-06").entry("\"(k|epsilon|omega)\"", "1e-06").close();
  text.close().blank();
  text.open("relaxationFactors");
  text.open("fields").entry("p", rule.pressureRelaxation).close();
  text.open("equations").entry("U", rule.equationRelaxation);
  text.entry("\"(k|epsilon|omega)\"", rule.turbulenceRelaxation).entry("age", rule.equationRelaxation).close();
  text.close();
  writeFoamFile(folder, "system", "fvSolution", "dictionary", text);
}

} // namespace

OrthogonalityRule ruleForAngle(double worst)
{
  if (worst <= 60.0)
  {
    return {"corrected", "limited corrected 0.3", 0, 0.9, 0.8, 0.7};
  }
  if (worst <= 70.0)
  {
    return {"limited corrected 0.5", "limited corrected 0.3", 1, 0.9, 0.8, 0.7};
  }
  return {"limited corrected 0.333", "limited corrected 0.333", 2, 0.7, 0.7, 0.5};
}

void writeConstant(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  FoamText transport;
  transport.entry(isFoundation(flow) ? "viscosityModel" : "transportModel",
                  isFoundation(flow) ? "constant" : "Newtonian");
  transport.entry("nu", "[0 2 -1 0 0 0 0] " + foamNumber(airViscosity));
  writeFoamFile(folder, "constant", isFoundation(flow) ? "physicalProperties" : "transportProperties", "dictionary",
                transport);
  FoamText turbulence;
  turbulence.entry("simulationType", "RAS").blank();
  turbulence.open("RAS").entry(isFoundation(flow) ? "model" : "RASModel", modelName(flow.settings.turbulence));
  turbulence.entry("turbulence", "on");
  if (flow.settings.dialect != OpenFOAMDialect::Foundation14)
  {
    turbulence.entry("printCoeffs", "on");
  }
  turbulence.close();
  writeFoamFile(folder, "constant", isFoundation(flow) ? "momentumTransport" : "turbulenceProperties", "dictionary",
                turbulence);
  if (flow.settings.dialect == OpenFOAMDialect::Foundation14 && !flow.isRoom())
  {
    FoamText layer;
    const WindProfile& wind = flow.settings.wind;
    layer.entry("flowDir", foamVector(flow.wind)).entry("zDir", "(0 0 1)");
    layer.entry("Uref", wind.speed).entry("Zref", wind.referenceHeight);
    layer.entry("z0", "constant " + foamNumber(wind.roughness));
    layer.entry("zGround", "constant " + foamNumber(flow.mesh.bounds.min[2]));
    writeFoamFile(folder, "constant", "atmosphericBoundaryLayerProperties", "dictionary", layer);
  }
}

void writeSystem(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  writeControl(folder, flow);
  writeSchemes(folder, flow);
  writeSolution(folder, flow);
  if (flow.settings.processors > 1)
  {
    writeDecomposition(folder, static_cast<std::size_t>(flow.settings.processors), flow.mesh.bounds.size());
  }
}

} // namespace atria
