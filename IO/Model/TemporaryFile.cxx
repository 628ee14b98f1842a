// SPDX-License-Identifier: GPL-3.0-or-later
#include "TemporaryFile.h"

#include "Support/Error.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace atria::model {

namespace {

/// False where not all of it can be written.
bool writeAll(int descriptor, std::string_view bytes)
{
  while (!bytes.empty())
  {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR)
    {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

} // namespace

TemporaryFile::TemporaryFile(std::string_view bytes, const std::string& ending)
{
  std::error_code none;
  std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  name = ((none ? "/tmp" : folder) / ("atria-XXXXXX" + ending)).string();
  const int descriptor = mkstemps(name.data(), static_cast<int>(ending.size()));
  if (descriptor < 0)
  {
    throw Error("no file can be made in " + folder.string() + ": " + std::strerror(errno));
  }
  const bool good = writeAll(descriptor, bytes);
  const std::string what = std::strerror(errno);
  close(descriptor);
  if (!good)
  {
    unlink(name.c_str());
    throw Error("'" + name + "' cannot be written: " + what);
  }
}

TemporaryFile::~TemporaryFile() { unlink(name.c_str()); }

} // namespace atria::model
