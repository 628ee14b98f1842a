// SPDX-License-Identifier: GPL-3.0-or-later
#include "TemporaryFile.h"

#include "Support/Error.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

namespace atria::model {

namespace {

namespace fs = std::filesystem;

std::string randomName()
{
  std::random_device random;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x%08x", random(), random());
  return std::string("atria-") + digits.data();
}

/// Opens a file that must not exist yet. Returns null if it cannot be made.
std::FILE* openNew(const fs::path& file) { return std::fopen(file.string().c_str(), "wbx"); }

bool writeAll(std::FILE* file, const fs::path& path, std::string_view bytes)
{
  std::error_code failure;
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write, failure);
  const bool good = !failure && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && good;
}

} // namespace

TemporaryFile::TemporaryFile(std::string_view bytes, const std::string& ending)
{
  std::error_code none;
  const fs::path told = fs::temp_directory_path(none);
  const fs::path folder = none ? fs::path("/tmp") : told;
  const fs::path file = folder / (randomName() + ending);
  name = file.string();
  std::FILE* const opened = openNew(file);
  if (!opened)
  {
    throw Error("no file can be made in " + folder.string() + ": " + std::strerror(errno));
  }
  if (!writeAll(opened, file, bytes))
  {
    const std::string what = std::strerror(errno);
    fs::remove(file, none);
    throw Error("'" + name + "' cannot be written: " + what);
  }
}

TemporaryFile::~TemporaryFile()
{
  std::error_code ignored;
  std::filesystem::remove(name, ignored);
}

} // namespace atria::model
