// SPDX-License-Identifier: GPL-3.0-or-later
/// A file for another program to read, deleted with its object.
#pragma once

#include <string>
#include <string_view>

namespace atria::model {

class TemporaryFile
{
public:
  /// Writes `bytes` to a new file whose name ends with `ending`. Throws Error on failure.
  TemporaryFile(std::string_view bytes, const std::string& ending);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return name; }

private:
  std::string name;
};

} // namespace atria::model
