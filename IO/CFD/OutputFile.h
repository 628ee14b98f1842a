// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes text, numbers and bytes to a file through a buffer.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace atria {

class ProgressRange;

/// A file that is written through a large buffer. All failures throw OutputError naming the file.
class OutputFile
{
public:
  /// Creates the file. About once a megabyte, an abort requested through `progress` stops the writing.
  explicit OutputFile(std::filesystem::path path, const ProgressRange* progress = nullptr);

  OutputFile& text(std::string_view characters);
  OutputFile& number(std::int64_t value);
  /// The shortest digits that read back to the same value.
  OutputFile& number(double value);
  /// Writes the value in base 16, without a prefix.
  OutputFile& hex(std::uint64_t value);
  OutputFile& raw(const void* bytes, std::size_t count);

  /// Reports the progress of entry i of so many, within [first, last] of the run, once in many entries. Needs the
  /// `progress` of the constructor.
  void report(double first, double last, std::size_t i, std::size_t of, const char* phase) const;

  /// Writes the rest and closes the file. Unlike the destructor, it reports a full disk.
  void close();

private:
  struct Closer
  {
    void operator()(std::FILE* open) const { std::fclose(open); }
  };

  template <typename... Value> OutputFile& digits(Value... value);
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
