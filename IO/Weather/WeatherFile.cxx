// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherFile.h"

#include "EpwFile.h"
#include "Support/Error.h"
#include "Tmy3File.h"
#include "WeatherText.h"

#include <fstream>

namespace atria::weather {

namespace {

/// Throws Error with advice for what is found in place of weather files.
[[noreturn]] void refuse(std::string_view text, const std::string& file)
{
  if (text.find_first_not_of(" \t\r\n") == text.npos)
  {
    throw Error(file + " is empty; get it again");
  }
  if (text.starts_with("PK\x03\x04"))
  {
    throw Error(file + " is a ZIP archive: unpack it, and name the weather file in it");
  }
  throw Error(file + ":1: this is neither an EPW file, whose first line begins with LOCATION, nor a TMY3 file, whose "
                     "second line begins with 'Date (MM/DD/YYYY)'; get the weather as EPW");
}

} // namespace

std::optional<WeatherFormat> formatOf(std::string_view text)
{
  LineReader lines(text, {});
  if (lines.next() && isEpw(lines.line()))
  {
    return WeatherFormat::Epw;
  }
  return lines.next() && isTmy3(lines.line()) ? std::optional(WeatherFormat::Tmy3) : std::nullopt;
}

bool isWeather(const std::filesystem::path& file)
{
  constexpr std::size_t longestStart = 65536; // two lines, and blank ones
  std::string start(longestStart, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return formatOf(start).has_value();
}

Weather weatherFrom(std::string_view text, const std::string& file)
{
  const std::optional<WeatherFormat> format = formatOf(text);
  if (!format)
  {
    refuse(text, file);
  }
  LineReader lines(text, file);
  lines.next();
  return *format == WeatherFormat::Epw ? readEpw(lines) : readTmy3(lines);
}

Weather readWeather(const std::filesystem::path& file) { return weatherFrom(bytesOf(file.string()), file.string()); }

} // namespace atria::weather
