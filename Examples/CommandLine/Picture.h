// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings of bars, lines and text, written as SVG or, without a display, as PNG.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace atria::tool {

/// Red, green, blue, 0 to 255.
using Color = std::array<unsigned char, 3>;

struct Bar
{
  double x, y, width, height;
  Color color;
  std::string tip; ///< shown by a browser under the pointer; empty for none
};

struct Line
{
  std::vector<std::pair<double, double>> points;
  double width;
  Color color;
};

enum class Anchor
{
  Left,
  Middle,
  Right
};

/// `y` is the middle of the line of text.
struct Text
{
  double x, y;
  std::string text;
  double size;
  Anchor anchor;
  Color color;
  bool bold;
};

/// Lengths in pixels; y points down. Later shapes cover earlier ones.
struct Picture
{
  double width = 0.0;
  double height = 0.0;
  std::vector<std::variant<Bar, Line, Text>> shapes;

  /// Adds the shapes of another picture, with its corner at x, y.
  void add(const Picture& other, double x, double y);
};

/// Returns an <svg> element for a page of HTML.
std::string toSvg(const Picture& picture);

/// Returns `text` with HTML's special characters replaced.
std::string escaped(const std::string& text);

/// Writes a PNG file. Needs no display. Throws Failure(Failed) if the file cannot be written.
void writePng(const Picture& picture, const std::string& file);

} // namespace atria::tool
