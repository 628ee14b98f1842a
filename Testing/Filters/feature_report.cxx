// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes a VRML model and prints how well the mesh keeps its features. For work on the mesher; not installed.
#include "Domain/Domain.h"
#include "Support/DualMeshChecks.h"
#include "Support/FeatureChecks.h"
#include "SurfaceInput.h"
#include "VtkSurface.h"

#include <vtkPolyData.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>

namespace {

using namespace atria;
using namespace atria::testing;

struct Arguments
{
  std::string model;
  std::string site;
  std::string openings;
  GridOptions grid;
  std::size_t misses = 30;
};

constexpr const char* usage =
    "usage: feature_report IN.wrl [--site NAME] [--openings IN.csv] [--misses N] SIZE_MIN SIZE_MID SIZE_MAX\n"
    "Without a site the domain is the model's bounds with two largest octants about them.\n";

Arguments parse(int count, char** values)
{
  Arguments out;
  std::vector<std::string> plain;
  for (int i = 1; i < count; ++i)
  {
    const std::string word = values[i];
    const auto next = [&] {
      return i + 1 < count ? std::string(values[++i]) : throw std::runtime_error(word + " needs a value");
    };
    if (word == "--site")
    {
      out.site = next();
    }
    else if (word == "--openings")
    {
      out.openings = next();
    }
    else if (word == "--misses")
    {
      out.misses = std::stoul(next());
    }
    else
    {
      plain.push_back(word);
    }
  }
  if (plain.size() != 4)
  {
    throw std::runtime_error(usage);
  }
  out.model = plain[0];
  out.grid.sizeMin = std::stod(plain[1]);
  out.grid.sizeMid = std::stod(plain[2]);
  out.grid.sizeMax = std::stod(plain[3]);
  return out;
}

void printMesh(const Meshed& meshed)
{
  const DualMesh& mesh = meshed.mesh();
  std::vector<Index> all(mesh.elementCount());
  std::size_t inverted = 0, thin = 0;
  const std::vector<double> volume = volumes(mesh);
  for (Index e = 0; e < all.size(); ++e)
  {
    all[e] = e;
    inverted += volume[e] < 0.0 ? 1 : 0;
    thin += std::abs(volume[e]) < 1e-6 * std::pow(meshed.frame.finestSize, 3) ? 1 : 0;
  }
  const ElementCounts counts = countElements(mesh, all);
  std::printf("elements %zu (hexahedra %zu, pyramids %zu, wedges %zu, polyhedra %zu), points %zu, boundary faces %zu\n",
              all.size(), counts.hexahedra, counts.pyramids, counts.wedges, counts.polyhedra, mesh.points.size(),
              mesh.boundaryFaces.size());
  std::printf("volume %.3f, of negative volume %zu, without volume %zu\n", totalVolume(mesh), inverted, thin);
  const auto zones = meshed.result.keptZones;
  std::printf("zones %zu, kept %td\n", zones.size(), std::count(zones.begin(), zones.end(), 1));
  std::map<std::string, std::size_t> diagnostics;
  for (const Diagnostic& d : meshed.result.diagnostics)
  {
    ++diagnostics[diagnosticNames[d.kind]];
  }
  for (const auto& [kind, count] : diagnostics)
  {
    std::printf("%s %zu\n", kind.c_str(), count);
  }
  const auto holds = [](const char* what, const ::testing::AssertionResult& result) {
    std::printf("%s: %s\n", what, result ? "yes" : result.message());
  };
  holds("conformal", isConformal(mesh));
  holds("elements closed", elementsAreClosed(mesh));
  holds("boundary watertight", boundaryIsWatertight(mesh));
}

void printSurfaces(const FeatureChecks& checks)
{
  const auto areas = checks.areas();
  const auto names = checks.names();
  std::printf("\n%-24s %11s %11s %11s %11s | own name: front back either\n", "surface", "model m2", "once", "front",
              "back");
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const SurfaceArea& a = areas[i];
    std::printf("%-24s %11.3f %11.3f %11.3f %11.3f | %.4f %.4f %.4f\n", a.name.c_str(), a.model, a.once, a.front,
                a.back, names[i].front, names[i].back, names[i].either);
  }
}

void printOpenings(const FeatureChecks& checks, const std::string& file)
{
  double area = 0.0, blocked = 0.0;
  std::printf("\n%-24s %9s %9s %9s %9s\n", "opening", "m2", "blocked", "outline", "corner m");
  for (const OpeningFigures& o : checks.openings(readOpenings(file)))
  {
    area += o.area;
    blocked += o.blocked;
    std::printf("%-24s %9.4f %9.4f %9.4f %9.4f\n", o.name.c_str(), o.area, o.blocked, o.outline, o.corner);
  }
  std::printf("%-24s %9.4f %9.4f\n", "all openings", area, blocked);
}

void printCurves(const FeatureChecks& checks, std::size_t most)
{
  const CurveCoverage curves = checks.curves();
  const auto print = [](const char* name, const CurveFigures& f) {
    std::printf("%-10s %11.2f %9.5f %9.5f\n", name, f.length, f.featureRatio(), f.anyRatio());
  };
  std::printf("\n%-10s %11s %9s %9s\n", "curves", "length m", "feature", "any edge");
  for (std::size_t kind = 0; kind < curves.ofKind.size(); ++kind)
  {
    print(curveKindNames[kind], curves.ofKind[kind]);
  }
  print("all", curves.total);
  for (std::size_t i = 0; i < std::min(most, curves.misses.size()); ++i)
  {
    const CurveMiss& m = curves.misses[i];
    std::printf("missed %6.2f of %6.2f m, by up to %.3f m, about (%.3f %.3f %.3f); %s (%.3f %.3f %.3f) - (%.3f %.3f "
                "%.3f), %s\n",
                m.missed, m.length, m.farthest, m.middle[0], m.middle[1], m.middle[2],
                curveKindNames[static_cast<int>(m.kind)], m.begin[0], m.begin[1], m.begin[2], m.end[0], m.end[1],
                m.end[2], m.names.c_str());
  }
}

void report(Arguments& arguments)
{
  const TriangleSurface surface = surfaceFromVtk({readModel(arguments.model)}).surface;
  if (arguments.site.empty())
  {
    arguments.grid.domain = boundsOf(surface);
    arguments.grid.domain.min.array() -= 2.0 * arguments.grid.sizeMax;
    arguments.grid.domain.max.array() += 2.0 * arguments.grid.sizeMax;
  }
  else
  {
    arguments.grid.domain = siteDomain(surface, arguments.site);
  }
  const Meshed meshed = meshIt(surface, arguments.grid, {}, 2);
  printMesh(meshed);
  const FeatureChecks checks(meshed);
  printSurfaces(checks);
  if (!arguments.openings.empty())
  {
    printOpenings(checks, arguments.openings);
  }
  printCurves(checks, arguments.misses);
}

} // namespace

int main(int count, char** values)
{
  try
  {
    Arguments arguments = parse(count, values);
    report(arguments);
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
