// SPDX-License-Identifier: GPL-3.0-or-later
#include "OutputFile.h"

#include "OutputFolders.h"
#include "Support/Progress.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t bufferSize = std::size_t{1} << 20;
constexpr std::size_t longestNumber = 32;

} // namespace

OutputFile::OutputFile(std::filesystem::path path, const ProgressRange* progress)
    : path_(std::move(path)), progress_(progress), file(std::fopen(path_.c_str(), "wb")), buffer(bufferSize, '\0')
{
  if (!file)
  {
    fail();
  }
}

OutputFile& OutputFile::text(std::string_view characters) { return raw(characters.data(), characters.size()); }

/// Writes values with std::to_chars().
template <typename... Value> OutputFile& OutputFile::digits(Value... value)
{
  char* const first = room(longestNumber);
  used += static_cast<std::size_t>(std::to_chars(first, first + longestNumber, value...).ptr - first);
  return *this;
}

OutputFile& OutputFile::number(std::int64_t value) { return digits(value); }

OutputFile& OutputFile::number(double value) { return digits(value); }

OutputFile& OutputFile::hex(std::uint64_t value) { return digits(value, 16); }

OutputFile& OutputFile::raw(const void* bytes, std::size_t count)
{
  if (count == 0)
  {
    return *this;
  }
  const char* rest = static_cast<const char*>(bytes);
  if (count < bufferSize)
  {
    std::memcpy(room(count), rest, count);
    used += count;
    return *this;
  }
  flush();
  while (count > 0)
  {
    const std::size_t part = std::min(count, bufferSize);
    write(rest, part);
    rest += part;
    count -= part;
  }
  return *this;
}

void OutputFile::report(double first, double last, std::size_t i, std::size_t of, const char* phase) const
{
  constexpr std::size_t every = 65536; // entries
  if (i % every == 0)
  {
    progress_->report(first + (last - first) * static_cast<double>(i) / static_cast<double>(of), phase);
  }
}

void OutputFile::close()
{
  flush();
  if (std::fclose(file.release()) != 0)
  {
    fail();
  }
}

char* OutputFile::room(std::size_t count)
{
  if (used + count > bufferSize)
  {
    flush();
  }
  return buffer.data() + used;
}

void OutputFile::flush()
{
  write(buffer.data(), used);
  used = 0;
}

void OutputFile::write(const char* bytes, std::size_t count)
{
  if (progress_)
  {
    progress_->check();
  }
  if (std::fwrite(bytes, 1, count, file.get()) != count)
  {
    fail();
  }
}

void OutputFile::fail() const { throw OutputError("cannot write '" + path_.string() + "': " + std::strerror(errno)); }

} // namespace atria
