// SPDX-License-Identifier: GPL-3.0-or-later
/// Damaged copies of models: whatever is in a file, the reader ends, keeps its promises or says why not.
/// ATRIA_MUTATIONS sets the number of copies made of each model (default 20).
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> models()
{
  std::vector<fs::path> folders{atria::testing::dataFolder() / "VRML"};
  if (const auto corpus = atria::testing::corpusFolder())
  {
    folders.push_back(*corpus);
  }
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
  {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && name.find(".wr") != std::string::npos)
      {
        files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Mutator
{
public:
  explicit Mutator(unsigned seed) : random(seed) {}

  std::string damage(std::string text)
  {
    const int times = 1 + static_cast<int>(random() % 6);
    for (int i = 0; i < times && !text.empty(); ++i)
    {
      damageOnce(text);
    }
    return text;
  }

private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random() % limit; }

  void damageOnce(std::string& text)
  {
    static const std::vector<std::string> pieces{"{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 "\"",
                                                 "#",
                                                 "DEF ",
                                                 "USE ",
                                                 "IS ",
                                                 "NULL",
                                                 "PROTO P [] {",
                                                 "EXTERNPROTO",
                                                 "ROUTE ",
                                                 "Group {",
                                                 "children [",
                                                 "1e308",
                                                 "-1",
                                                 "nan",
                                                 "99999999999",
                                                 "0x",
                                                 "Shape {",
                                                 "\0",
                                                 "Switch {",
                                                 "scale 0 1 0",
                                                 "scale -1e200 1e200 1",
                                                 "geometry ",
                                                 "Inline { url \"mutant.wrl\" }",
                                                 "USE A",
                                                 "DEF A ",
                                                 "-0",
                                                 ".",
                                                 "1e-400",
                                                 "\xff\xfe"};
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(below(200), text.size() - at);
    switch (random() % 6)
    {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, " " + pieces[below(pieces.size())] + " ");
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        removeOne(text, at);
        break;
      default:
        if (random() % 8 == 0)
        {
          text.resize(at);
        }
    }
  }

  /// Takes away the next bracket, quote or keyword's first letter.
  void removeOne(std::string& text, std::size_t from)
  {
    const std::size_t at = text.find_first_of("{}[]\"DUI", from);
    if (at != std::string::npos)
    {
      text.erase(at, 1);
    }
  }

  std::mt19937 random;
};

TEST(VRMLMutations, NeitherCrashNorHang)
{
  constexpr std::size_t largest = 200'000;
  const char* wanted = std::getenv("ATRIA_MUTATIONS");
  const int copies = wanted ? std::atoi(wanted) : 20;
  const char* seed = std::getenv("ATRIA_MUTATION_SEED");
  Mutator mutator(seed ? static_cast<unsigned>(std::atoi(seed)) : 1);
  const atria::testing::ScratchFolder scratch;
  for (const fs::path& file : models())
  {
    const std::string text = atria::testing::bytesOf(file);
    const int rounds = text.size() > largest ? std::max(1, copies / 20) : copies;
    for (int i = 0; i <= rounds; ++i) // the first as it is
    {
      const std::string name = file.extension() == ".wrl" ? "mutant.wrl" : "mutant.wrz";
      const fs::path mutant = atria::testing::writeFile(scratch.path(), name, i == 0 ? text : mutator.damage(text));
      SCOPED_TRACE(file.string() + ", copy " + std::to_string(i));
      const auto start = std::chrono::steady_clock::now();
      atria::testing::VtkErrorGuard messages;
      const atria::testing::VRMLModel model(mutant, [&](vtkAtriaVRMLReader& reader) {
        reader.MergeDuplicateFacesOn();
        reader.SetUpAxis(vtkAtriaVRMLReader::UnstatedUp);
        reader.SetLengthUnit(vtkAtriaVRMLReader::UnstatedUnit);
        reader.SetRecenter(i % 2 == 0);
        reader.SetSurfaceBy(i % 4);
      });
      messages.takeWarnings();
      const bool failed = !messages.takeErrors().empty();
      EXPECT_EQ(failed, model.triangles() == 0);
      if (!failed)
      {
        EXPECT_EQ(model.brokenPromise(), "");
      }
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      EXPECT_LT(seconds, 20.0);
      if (::testing::Test::HasFailure())
      {
        fs::copy_file(mutant, "failed-" + name, fs::copy_options::overwrite_existing);
        return;
      }
    }
  }
}

} // namespace
