// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks values of options: refuses NaN and infinity, and states the range in plain words.
#pragma once

#include "Support/NamePattern.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace atria::tool {

/// Reads a finite number; false if the text is none. CLI11 2.4 and later skip what may separate thousands: 0,5 would
/// be 5.
inline bool readNumber(const std::string& text, double& value)
{
  return text.find_first_of(",'_") == text.npos && CLI::detail::lexical_cast(text, value) && std::isfinite(value);
}

/// Returns the error message for a text that is no number, `range` included.
inline std::string notANumber(const std::string& input, const std::string& range)
{
  std::string text = "'" + input + "' is not a number" + (range.empty() ? "" : " " + range);
  std::string pointed = input;
  double value = 0.0;
  if (std::count(input.begin(), input.end(), ',') == 1)
  {
    pointed[input.find(',')] = '.';
    text += readNumber(pointed, value) ? "; decimals follow a point: " + pointed : "";
  }
  return text;
}

/// Accepts numbers in [least, most], or in (least, most] with `above`. Without `most` there is no upper limit.
inline CLI::Validator numberIn(double least, double most, bool above = false)
{
  const bool open = most >= static_cast<double>(std::numeric_limits<int>::max());
  std::ostringstream range;
  range << (open ? above ? "more than " : "at least " : above ? "more than " : "from ") << least;
  open ? range : range << (above ? " and at most " : " to ") << most;
  const std::string shown = open ? "" : range.str().substr(above ? 0 : 5); // after the type in the help
  return CLI::Validator(
      [=, text = range.str()](std::string& input) {
        double value = 0.0;
        const bool fits =
            readNumber(input, value) && (above ? value > least : value >= least) && (open || value <= most);
        return fits ? std::string() : notANumber(input, text);
      },
      shown);
}

inline CLI::Validator atLeast(double least) { return numberIn(least, std::numeric_limits<double>::infinity()); }
inline CLI::Validator positive() { return numberIn(0.0, std::numeric_limits<double>::infinity(), true); }

/// Accepts temperatures outdoors, and recognizes kelvin.
inline CLI::Validator celsius(double least, double most)
{
  constexpr double absoluteZero = -273.15;
  return CLI::Validator(
      [=](std::string& input) {
        double value = 0.0;
        std::ostringstream text;
        if (!readNumber(input, value) || value < least || value > most)
        {
          text << "'" << input << "' is no temperature outdoors from " << least << " to " << most << " degrees Celsius";
        }
        if (value + absoluteZero >= least && value + absoluteZero <= most && value > most)
        {
          text << "; " << value << " kelvin are " << value + absoluteZero;
        }
        return text.str();
      },
      "");
}

inline CLI::Validator anyNumber()
{
  return CLI::Validator(
      [](std::string& input) {
        double value = 0.0;
        return readNumber(input, value) ? std::string() : notANumber(input, "");
      },
      "");
}

/// Accepts one of some words, which the option's type lists.
inline CLI::Validator oneOf(std::vector<std::string> words)
{
  return CLI::Validator(
      [words = std::move(words)](std::string& input) {
        if (std::find(words.begin(), words.end(), input) != words.end())
        {
          return std::string();
        }
        return "'" + input + "': " + namesInstead(input, words);
      },
      "");
}

} // namespace atria::tool
