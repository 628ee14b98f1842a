// SPDX-License-Identifier: GPL-3.0-or-later
/// libFuzzer's entry: whatever bytes a file holds, the reader ends without undefined behaviour, and either keeps the
/// promises of its output or reports an error and gives none. Run by fuzz.sh.
#include "IO/VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;

/// Counts errors. VTK logs them as well unless told not to.
class CountingWindow : public vtkOutputWindow
{
public:
  static CountingWindow* New();
  vtkTypeMacro(CountingWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayErrorText(const char*) override { ++errors; }

  int errors = 0;
};
vtkStandardNewMacro(CountingWindow);

/// The file is alone in its folder, where inlined files are looked for.
class Scratch
{
public:
  Scratch()
  {
    const fs::path memory = "/dev/shm";
    const fs::path parent = fs::is_directory(memory) ? memory : fs::temp_directory_path();
    std::string pattern = (parent / "atria-fuzz-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
    {
      std::perror("atria-fuzz");
      std::exit(1);
    }
    folder = pattern;
  }
  ~Scratch()
  {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }

  fs::path write(const std::uint8_t* data, std::size_t size) const
  {
    const fs::path file = folder / "model.wrl";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file;
  }

private:
  fs::path folder;
};

void require(bool holds, const std::string& text)
{
  if (!holds)
  {
    std::fprintf(stderr, "the reader broke a promise: %s\n", text.c_str());
    std::abort();
  }
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Scratch scratch;
  static const vtkNew<CountingWindow> window;
  vtkOutputWindow::SetInstance(window);
  window->errors = 0;
  const atria::testing::VRMLModel model(scratch.write(data, size), [size](vtkAtriaVRMLReader& reader) {
    reader.SetTessellationAngle(45.0);
    reader.SetSurfaceBy(static_cast<int>(size % 4)); // all kinds get their share
    reader.MergeDuplicateFacesOn();
    reader.RecentreOn();
    reader.SetUpAxis(vtkAtriaVRMLReader::UnstatedUp); // both are guessed at
    reader.SetLengthUnit(vtkAtriaVRMLReader::UnstatedUnit);
  });
  require((window->errors != 0) == (model.triangles() == 0), "an error and surfaces, or neither");
  if (window->errors == 0)
  {
    const std::string broken = model.brokenPromise();
    require(broken.empty(), broken);
  }
  return 0;
}
