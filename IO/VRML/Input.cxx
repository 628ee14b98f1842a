// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input.h"

#include "Support/Error.h"
#include "Support/Memory.h"
#include "Support/Text.h"

#include <vtksys/SystemTools.hxx>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace atria::vrml {

namespace fs = std::filesystem;

namespace {

FileText readBytes(const fs::path& file)
{
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
  {
    throw Error("'" + file.string() + "' does not exist or is not a file");
  }
  std::ifstream in(file, std::ios::binary);
  FileText out;
  out.size = static_cast<std::size_t>(fs::file_size(file));
  out.bytes = std::make_unique_for_overwrite<char[]>(out.size);
  useLargePages(out.bytes.get(), out.size);
  in.read(out.bytes.get(), static_cast<std::streamsize>(out.size));
  if (!in && out.size > 0)
  {
    throw Error("cannot read '" + file.string() + "'");
  }
  return out;
}

/// Unpacks all members of a gzip stream.
FileText unpack(std::string_view packed)
{
  FileText out;
  out.isPacked = true;
  z_stream stream{};
  constexpr int gzipOnly = 16 + MAX_WBITS;
  if (inflateInit2(&stream, gzipOnly) != Z_OK)
  {
    throw Error("zlib cannot start");
  }
  std::array<char, 1 << 16> buffer;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  std::size_t left = packed.size();
  int state = Z_OK;
  while (state == Z_OK || (state == Z_STREAM_END && left + stream.avail_in > 0))
  {
    if (state == Z_STREAM_END && inflateReset(&stream) != Z_OK)
    {
      break;
    }
    if (stream.avail_in == 0)
    {
      stream.avail_in = static_cast<uInt>(std::min<std::size_t>(left, 1u << 30));
      left -= stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.unpacked.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  // Bytes after the last member that are not gzip are padding, not damage.
  out.truncated = state != Z_STREAM_END && stream.total_out > 0;
  inflateEnd(&stream);
  return out;
}

bool startsWith(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

/// Returns `folder / name`, or the entry that differs from it in case only.
std::optional<fs::path> findEntry(const fs::path& folder, const fs::path& name)
{
  std::error_code error;
  if (fs::exists(folder / name, error))
  {
    return folder / name;
  }
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    if (sameButForCapitals(entry->path().filename().string(), name.string()))
    {
      return entry->path();
    }
  }
  return std::nullopt;
}

std::optional<fs::path> findPath(const fs::path& folder, const fs::path& relative)
{
  fs::path at = relative.is_absolute() ? relative.root_path() : folder.empty() ? fs::path(".") : folder;
  for (const fs::path& part : relative.relative_path())
  {
    const std::optional<fs::path> next = findEntry(at, part);
    if (!next)
    {
      return std::nullopt;
    }
    at = *next;
  }
  std::error_code error;
  return fs::is_regular_file(at, error) ? std::optional(at) : std::nullopt;
}

/// Returns the path within a URL.
std::string pathOf(std::string_view url)
{
  for (const std::string_view scheme : {"file://localhost", "file://", "file:"})
  {
    if (startsWith(url, scheme))
    {
      url.remove_prefix(scheme.size());
      break;
    }
  }
  std::string path(url.substr(0, url.find('#')));
  std::replace(path.begin(), path.end(), '\\', '/');
  return vtksys::SystemTools::DecodeURL(path);
}

/// Returns a local path; empty for network addresses, and for texts that can be no path.
std::string localPathOf(std::string_view url)
{
  const std::size_t colon = url.find(':');
  const bool network = colon != std::string_view::npos && colon > 1 && !startsWith(url, "file:");
  const std::string path = network ? std::string() : pathOf(url);
  return path.find('\0') == std::string::npos ? path : std::string();
}

} // namespace

void FileText::forget(std::size_t characters)
{
  char* const first = (isPacked ? unpacked.data() : bytes.get()) + forgotten;
  forgotten += forgetPages(first, start + characters - forgotten);
}

FileText readText(const fs::path& file)
{
  FileText out = readBytes(file);
  if (startsWith(out.text(), "\x1f\x8b"))
  {
    out = unpack(out.text());
  }
  if (startsWith(out.text(), "\xff\xfe") || startsWith(out.text(), "\xfe\xff"))
  {
    throw Error("'" + file.string() + "' is encoded in UTF-16; save it as UTF-8");
  }
  out.start = startsWith(out.text(), "\xef\xbb\xbf") ? 3 : 0;
  return out;
}

std::string readStart(const fs::path& file)
{
  std::error_code ignored;
  std::string start(512, '\0');
  // zlib passes plain files through.
  const gzFile in = fs::is_regular_file(file, ignored) ? gzopen(file.c_str(), "rb") : nullptr;
  const int length = in ? gzread(in, start.data(), static_cast<unsigned>(start.size())) : 0;
  start.resize(static_cast<std::size_t>(std::max(length, 0)));
  if (in)
  {
    gzclose(in);
  }
  return startsWith(start, "\xef\xbb\xbf") ? start.substr(3) : start;
}

std::optional<fs::path> findFile(const fs::path& folder, std::string_view url)
{
  const std::string path = localPathOf(url);
  return path.empty() ? std::nullopt : findPath(folder, path);
}

std::optional<fs::path> findNamesake(const fs::path& folder, std::string_view url)
{
  const fs::path name = fs::path(localPathOf(url)).filename();
  return name.empty() ? std::nullopt : findPath(folder, name);
}

} // namespace atria::vrml
