// SPDX-License-Identifier: GPL-3.0-or-later
/// Time and memory of reading a large VRML file.
///
/// Usage: benchmark_vrml_reader [MEGABYTES | FILE] [hills | walls]
/// Without a file, one of about that size (default 100) is written to the temporary folder: hills of triangles and of
/// quads, 20,000 points a shape, as exporters write them; or walls, a shape of eight points each.
#include "vtkAtriaVRMLReader.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

constexpr int rows = 100;
constexpr int columns = 200;

void writePoints(std::FILE* out, int shape)
{
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < columns; ++j)
    {
      const double x = 0.731 * j + 150.0 * (shape % 10);
      const double y = 0.517 * i + 55.0 * (shape / 10);
      std::fprintf(out, "\t\t\t%.6f %.6f %.6f,\n", x, y, 10.0 * std::sin(0.1 * x) * std::cos(0.13 * y));
    }
  }
}

void writeFaces(std::FILE* out, bool quads)
{
  for (int i = 0; i + 1 < rows; ++i)
  {
    for (int j = 0; j + 1 < columns; ++j)
    {
      const int a = i * columns + j;
      if (quads)
      {
        std::fprintf(out, "\t\t\t%d, %d, %d, %d, -1,\n", a, a + 1, a + columns + 1, a + columns);
      }
      else
      {
        std::fprintf(out, "\t\t\t%d, %d, %d, -1,\n\t\t\t%d, %d, %d, -1,\n", a, a + 1, a + columns + 1, a,
                     a + columns + 1, a + columns);
      }
    }
  }
}

void writeHill(std::FILE* out, int shape)
{
  std::fprintf(out, "DEF Hill%d Shape {\n\tgeometry IndexedFaceSet {\n\t\tcoord Coordinate { point [\n", shape);
  writePoints(out, shape);
  std::fprintf(out, "\t\t] }\n\t\tcoordIndex [\n");
  writeFaces(out, shape % 2 == 1);
  std::fprintf(out, "\t\t]\n\t}\n}\n");
}

void writeWall(std::FILE* out, int shape)
{
  std::fprintf(
      out,
      "DEF Wall%d Transform {\n\ttranslation %d %d 0\n\tchildren [ Shape {\n\t\tappearance Appearance { material "
      "Material { diffuseColor 0.8 0.2 0.1 } }\n\t\tgeometry IndexedFaceSet {\n\t\t\tcoord Coordinate { point [",
      shape, 10 * (shape % 1000), 10 * (shape / 1000));
  for (int corner = 0; corner < 8; ++corner)
  {
    const bool right = corner % 4 == 1 || corner % 4 == 2;
    std::fprintf(out, "\n\t\t\t\t%.6f %.6f %.6f,", right ? 5.123456 : 0.0, corner % 4 > 1 ? 0.25 : 0.0,
                 corner > 3 ? 3.0 : 0.0);
  }
  std::fprintf(out,
               " ] }\n\t\t\tcoordIndex [ 0 3 2 1 -1 4 5 6 7 -1 0 1 5 4 -1 1 2 6 5 -1 2 3 7 6 -1 3 0 4 7 -1 ]\n\t\t}\n"
               "\t} ]\n}\n");
}

fs::path writeModel(double megabytes, bool walls)
{
  const fs::path file = fs::temp_directory_path() / "atria_benchmark.wrl";
  std::FILE* out = std::fopen(file.c_str(), "w");
  std::fprintf(out, "#VRML V2.0 utf8\n");
  for (int shape = 0; static_cast<double>(std::ftell(out)) < 1e6 * megabytes; ++shape)
  {
    walls ? writeWall(out, shape) : writeHill(out, shape);
  }
  std::fclose(out);
  return file;
}

rusage usageNow()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

/// Of the processor, which other programs on the machine do not change much.
double processorSeconds()
{
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const rusage usage = usageNow();
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peakMegabytes() { return static_cast<double>(usageNow().ru_maxrss) / 1024.0; }

void readOnce(const fs::path& file)
{
  const double before = peakMegabytes();
  vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetFileName(file.c_str());
  const auto start = std::chrono::steady_clock::now();
  const double processorBefore = processorSeconds();
  reader->Update();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double processor = processorSeconds() - processorBefore;
  const double size = static_cast<double>(fs::file_size(file)) / 1e6;
  std::printf("%.1f MB in %.3f s (%.3f s of the processor): %.0f MB/s (%.0f MB/s)\n", size, seconds, processor,
              size / seconds, size / processor);
  std::printf("  %lld triangles, %lld points; output %.0f MB, peak %.0f MB (before: %.0f)\n",
              static_cast<long long>(reader->GetOutput()->GetNumberOfCells()),
              static_cast<long long>(reader->GetOutput()->GetNumberOfPoints()),
              static_cast<double>(reader->GetOutput()->GetActualMemorySize()) / 1024.0, peakMegabytes(), before);
}

} // namespace

int main(int argc, char* argv[])
{
  const std::string argument = argc > 1 ? argv[1] : "100";
  const bool walls = argc > 2 && std::string(argv[2]) == "walls";
  const bool isFile = fs::exists(argument);
  const fs::path file = isFile ? fs::path(argument) : writeModel(std::atof(argument.c_str()), walls);
  for (int i = 0; i < 3; ++i)
  {
    readOnce(file);
  }
  if (!isFile)
  {
    fs::remove(file);
  }
  return 0;
}
