// SPDX-License-Identifier: GPL-3.0-or-later
#include "Hints.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>

namespace atria::vrml {

namespace {

std::string shortNumber(double value)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

Box3 boundsOf(const Scene& scene)
{
  Box3 box;
  for (const auto& t : scene.triangles)
  {
    for (const Index p : t)
    {
      box.extend(scene.points[p]);
    }
  }
  return box;
}

/// The unit a header mentions, such as "# Units: inches" or "exported in mm".
std::string mentionedUnit(const std::string& head)
{
  static const std::regex pattern(
      "(units?|scale|exported|measured|dimensions?|coordinates)[ \t]*(are)?[ \t]*[:=(]?[ \t]*(in)?"
      "[ \t\"]*(millimet(er|re)s?|mm|centimet(er|re)s?|cm|inch(es)?|f(oo|ee)t|ft|met(er|re)s?|m)\\b",
      std::regex::icase);
  std::smatch match;
  return std::regex_search(head, match, pattern) ? match[4].str() : "";
}

bool isMetres(const std::string& unit)
{
  return std::tolower(static_cast<unsigned char>(unit[0])) == 'm' &&
         (unit.size() == 1 || std::tolower(static_cast<unsigned char>(unit[1])) == 'e');
}

void judgeUnit(const std::string& head, const Vec3& size, std::vector<std::string>& hints)
{
  constexpr double tallest = 1000.0; // no building is
  constexpr double longest = 20000.0;
  constexpr double shortest = 0.5;
  const std::string advice =
      "; lengths are taken to be metres: set LengthUnit, if only to Metres, to say which they are";
  const std::string unit = mentionedUnit(head);
  if (!unit.empty())
  {
    if (!isMetres(unit))
    {
      hints.push_back("the file mentions the unit '" + unit + "'" + advice);
    }
    return;
  }
  static const std::regex sketchUp("sketchup", std::regex::icase);
  static const std::regex inchScale("0?\\.0254");
  if (std::regex_search(head, sketchUp) && !std::regex_search(head, inchScale))
  {
    hints.push_back("the file comes from SketchUp, which writes inches without saying so" + advice);
    return;
  }
  const std::string extents =
      shortNumber(size.x()) + " by " + shortNumber(size.y()) + " by " + shortNumber(size.z()) + " m";
  if (size.z() > tallest || size.maxCoeff() > longest)
  {
    hints.push_back("the model would measure " + extents + ", which millimetres or inches would explain" + advice);
  }
  else if (size.maxCoeff() < shortest)
  {
    hints.push_back("the model would measure " + extents + ", less than anything with rooms" + advice);
  }
}

/// Ground, floors and roofs share one axis, walls have the two others. Where the first is y, and the model is flat
/// along it, it was drawn y up.
bool looksYUp(const Scene& scene, const Vec3& size)
{
  Vec3 area = Vec3::Zero();
  double all = 0.0;
  for (const auto& [a, b, c] : scene.triangles)
  {
    const Vec3 n = (scene.points[b] - scene.points[a]).cross(scene.points[c] - scene.points[a]);
    const double length = n.norm();
    int axis = 0;
    const bool along = n.cwiseAbs().maxCoeff(&axis) > 0.99 * length;
    area[axis] += along ? length : 0.0;
    all += length;
  }
  return size.y() < 0.6 * std::min(size.x(), size.z()) && area.y() > 0.4 * all && area.x() > 0.03 * all &&
         area.z() > 0.03 * all && area.y() > 1.5 * std::max(area.x(), area.z());
}

void judgeUpAxis(const Scene& scene, const std::string& head, const Vec3& size, std::vector<std::string>& hints)
{
  static const std::regex pattern("(\\by[ -]?up\\b|up[ -]?axis[ \t]*[:=]?[ \t]*\"?\\+?y\\b)", std::regex::icase);
  const std::string advice = "; z is taken to be up: set UpAxis, if only to Z, to say which is";
  if (std::regex_search(head, pattern))
  {
    hints.push_back("the file mentions that y is up" + advice);
  }
  else if (looksYUp(scene, size))
  {
    hints.push_back("most horizontal faces would be walls, as if y were up" + advice);
  }
}

} // namespace

std::vector<std::string> hintsOf(const Scene& scene, std::string_view head, const Stated& stated)
{
  std::vector<std::string> hints;
  const Box3 box = boundsOf(scene);
  if (box.empty())
  {
    return hints;
  }
  const std::string text(head);
  if (!stated.unit)
  {
    judgeUnit(text, box.size(), hints);
  }
  if (!stated.upAxis)
  {
    judgeUpAxis(scene, text, box.size(), hints);
  }
  // Single precision, which viewers and some solvers use, has seven digits.
  constexpr double far = 1e5;
  const double distance = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  if (!stated.recentred && distance > far && distance > 10.0 * box.size().norm())
  {
    hints.push_back("the model lies " + shortNumber(distance) +
                    " m from the origin, where single precision loses centimetres; Recentre moves it there");
  }
  return hints;
}

} // namespace atria::vrml
