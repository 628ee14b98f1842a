// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

class vtkAtriaVRMLReader;
class vtkPolyData;

namespace atria::testing {

/// A model run through the reader, with what tests ask about it. Unless the settings say otherwise, duplicate faces
/// stay and the unit and axis are stated, so that everything comes as the file has it.
class VRMLModel
{
public:
  using Settings = std::function<void(vtkAtriaVRMLReader&)>;

  explicit VRMLModel(const std::filesystem::path& file, double tessellationAngle = 10.0);
  VRMLModel(const std::filesystem::path& file, const Settings& settings);
  ~VRMLModel();

  vtkPolyData* output() const;
  long long triangles() const;
  /// Of all triangles, or of those of one surface.
  double area() const;
  double area(const std::string& surface) const;
  /// Volume enclosed; positive where fronts look outwards.
  double volume() const;
  /// xmin, xmax, ymin, …; of the points triangles use.
  std::vector<double> bounds() const;
  std::vector<double> bounds(const std::string& surface) const;
  std::vector<std::string> names() const;
  std::vector<std::string> materials() const;
  /// A field array's values, all components in a row.
  std::vector<double> numbers(const char* array) const;
  std::vector<std::string> warnings() const;
  std::vector<std::string> notes() const;
  std::vector<std::string> skipped() const;
  /// What is wrong with the output's arrays; empty if it keeps the reader's promises.
  std::string brokenPromise() const;

private:
  template <class Visitor> void forTriangles(int surface, Visitor&& visit) const;
  int idOf(const std::string& surface) const;
  std::vector<std::string> fieldStrings(const char* array) const;

  vtkSmartPointer<vtkAtriaVRMLReader> reader;
};

/// Text for a failed comparison of warnings.
std::string joined(const std::vector<std::string>& lines);

/// Writes `text` to a file of the scratch folder and returns its path.
std::filesystem::path writeFile(const std::filesystem::path& folder, const std::string& name, const std::string& text);

} // namespace atria::testing
