// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherFile.h"

#include "EpwFile.h"
#include "Support/Error.h"
#include "Tmy3File.h"
#include "WeatherText.h"

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

Weather weatherFrom(std::string_view text, const std::string& file)
{
  LineReader lines(text, file);
  if (lines.next() && isEpw(lines.line()))
  {
    return readEpw(lines);
  }
  if (lines.next() && isTmy3(lines.line()))
  {
    LineReader again(text, file);
    again.next();
    return readTmy3(again);
  }
  refuse(text, file);
}

Weather readWeather(const std::filesystem::path& file) { return weatherFrom(bytesOf(file.string()), file.string()); }

} // namespace atria::weather
