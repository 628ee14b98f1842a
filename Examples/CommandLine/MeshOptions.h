// SPDX-License-Identifier: GPL-3.0-or-later
/// The options of `atria mesh`.
#pragma once

#include "ExportOptions.h"
#include "LayerOptions.h"
#include "ModelOptions.h"
#include "SizeOptions.h"

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

class vtkAtriaDualMesher;
class vtkPolyData;

namespace atria::tool {

class Console;

struct MeshOptions
{
  std::string input;
  ModelOptions model;
  std::string output;
  std::optional<double> sizeMax;
  std::optional<double> sizeMid;
  std::optional<double> sizeMin;
  SizeOptions sizes;
  LayerOptions layers;
  bool estimate = false;
  double gap = 0.0;
  double smallParts = 0.0;
  double crack = 0.0;
  std::vector<double> domain;
  std::string site;
  std::string ground;
  bool automatic = false; ///< also the default
  bool modelBounds = false;
  double domainAngle = 0.0;
  std::optional<int> domainSides;
  std::vector<double> cylinder;
  std::string polygon;
  std::vector<std::array<double, 2>> corners; ///< corners of `polygon`
  std::vector<double> heights;
  double wind = 0.0;
  std::string terrain;
  double groundSnap = 0.0;
  std::string align = "axes";
  bool preflight = false;
  std::string zone = "outside";
  std::vector<std::tuple<double, double, double>> seeds;
  std::vector<std::tuple<double, double, double>> sealedSeeds;
  std::vector<std::string> faceZones;
  std::vector<std::string> cellZones;
  bool openings = false;
  std::vector<std::string> withoutOpenings;
  std::string patches;
  ExportOptions exports;
  std::string report;
  std::string writeConfig;
  int threads = 0;

  bool makesMesh() const { return !preflight && !estimate; }
  bool hasSize() const { return sizeMax || sizeMid || sizeMin; }
  bool hasAllSizes() const { return sizeMax && sizeMid && sizeMin; }
};

void declareMeshOptions(CLI::App& command, MeshOptions& options);

/// Names the output after the model if it has no name. Throws Failure(Usage) for options that contradict each other.
void completeMeshOptions(MeshOptions& options);

/// Does the part of that which a mesher needs, sizes apart.
void completeDomain(MeshOptions& options);

/// Throws Failure(Usage) if the model has no surface of that name.
void checkSite(const std::string& site, vtkPolyData* model);

/// Sets the options of the grid. Without an option the domain is the filter's default, the automatic one; missing sizes
/// are 0.
void configureGrid(vtkAtriaGridAlgorithm* filter, const MeshOptions& options);
void configure(vtkAtriaDualMesher* mesher, const MeshOptions& options);

} // namespace atria::tool
