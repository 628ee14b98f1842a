// SPDX-License-Identifier: GPL-3.0-or-later
#include "ReaderFuzzing.h"

#include "IO/SurfacePromises.h"
#include "vtkAtriaSurfaceReader.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace atria::fuzzing {

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

/// The file is alone in its folder, where files that it names are looked for.
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

  /// In place of the file written before.
  const fs::path& write(const std::string& name, const std::uint8_t* data, std::size_t size)
  {
    if (file != folder / name)
    {
      std::error_code ignored;
      fs::remove(file, ignored);
      file = folder / name;
    }
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file;
  }

private:
  fs::path folder;
  fs::path file;
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

void readAndJudge(vtkAtriaSurfaceReader* reader, const std::string& name, const std::uint8_t* data, std::size_t size)
{
  static Scratch scratch;
  static const vtkNew<CountingWindow> window;
  vtkOutputWindow::SetInstance(window);
  window->errors = 0;
  reader->SetFileName(scratch.write(name, data, size).c_str());
  reader->SetSurfaceBy(static_cast<int>(size % 4));
  reader->MergeDuplicateFacesOn();
  reader->RecenterOn();
  reader->SetUpAxis(vtkAtriaSurfaceReader::UnstatedUp); // both are guessed at
  reader->SetLengthUnit(vtkAtriaSurfaceReader::UnstatedUnit);
  reader->Update();
  require((window->errors != 0) == (reader->GetOutput()->GetNumberOfCells() == 0), "an error and surfaces, or neither");
  if (window->errors == 0)
  {
    const std::string broken = testing::brokenPromise(reader->GetOutput());
    require(broken.empty(), broken);
  }
}

} // namespace atria::fuzzing

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  return 0;
}
