// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace atria {

class ProgressRange;

/// How lists are written. Both read back to the same bits.
enum class OpenFOAMFormat
{
  Ascii,
  Binary
};

/// A file with OpenFOAM's header, written through a large buffer. All that fails throws Error naming the
/// file.
class OpenFOAMFile
{
public:
  struct Header
  {
    std::string className; ///< what OpenFOAM calls the kind of content, such as vectorField
    std::string location;  ///< folder within the case
    std::string note;      ///< left out when empty
    OpenFOAMFormat format = OpenFOAMFormat::Ascii;
  };

  /// Creates the file; its name becomes the header's `object`. `progress` is asked whether to stop about once a
  /// megabyte.
  OpenFOAMFile(const std::filesystem::path& path, const Header& header, const ProgressRange* progress = nullptr);

  OpenFOAMFile& text(std::string_view characters);
  OpenFOAMFile& number(std::int64_t value);
  /// The shortest digits that read back to the same value.
  OpenFOAMFile& number(double value);
  OpenFOAMFile& raw(const void* bytes, std::size_t count);

  /// Writes what is left. Not leaving it to the destructor makes a full disk an error.
  void close();

private:
  struct Closer
  {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  char* room(std::size_t count);
  void flush();
  void write(const char* bytes, std::size_t count);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  const ProgressRange* progress_;
  std::unique_ptr<std::FILE, Closer> file;
  std::string buffer;
  std::size_t used = 0;
};

} // namespace atria
