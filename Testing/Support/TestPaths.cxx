// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/TestPaths.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace atria::testing {

namespace fs = std::filesystem;

fs::path dataFolder() { return fs::path(ATRIA_SOURCE_DIR) / "Testing" / "Data"; }

std::optional<fs::path> corpusFolder()
{
  const char* set = std::getenv("ATRIA_CORPUS");
  const fs::path folder = set ? fs::path(set) : fs::path(ATRIA_SOURCE_DIR).parent_path() / "shared" / "corpus";
  return fs::is_directory(folder) ? std::optional(folder) : std::nullopt;
}

std::string bytesOf(const fs::path& file)
{
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

ScratchFolder::ScratchFolder()
{
  std::string pattern = (fs::temp_directory_path() / "atria-test-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
  {
    throw std::runtime_error("cannot make a folder like " + pattern);
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

} // namespace atria::testing
