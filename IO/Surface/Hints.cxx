// SPDX-License-Identifier: GPL-3.0-or-later
#include "Hints.h"

#include "Support/Text.h"
#include "WallSizes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>

namespace atria::scene {

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

/// Returns runs of letters and digits.
std::vector<std::string_view> wordsOf(std::string_view text)
{
  const auto inWord = [](unsigned char c) { return std::isalnum(c) != 0; };
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size();)
  {
    std::size_t end = i;
    while (end < text.size() && inWord(static_cast<unsigned char>(text[end])))
    {
      ++end;
    }
    if (end > i)
    {
      words.push_back(text.substr(i, end - i));
    }
    i = end + 1;
  }
  return words;
}

using WordList = std::initializer_list<std::string_view>;

bool isOneOf(std::string_view word, WordList list) { return std::find(list.begin(), list.end(), word) != list.end(); }

/// Returns the unit that a header mentions, such as "units: inches" or "exported in mm".
std::string mentionedUnit(const std::vector<std::string_view>& words)
{
  const WordList units{"m",           "meter",      "meters",      "metre", "metres",     "mm",          "millimeter",
                       "millimeters", "millimetre", "millimetres", "cm",    "centimeter", "centimeters", "centimetre",
                       "centimetres", "inch",       "inches",      "ft",    "foot",       "feet"};
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
  {
    if (!isOneOf(words[i],
                 {"unit", "units", "exported", "measured", "dimension", "dimensions", "coordinates", "lengths"}))
    {
      continue;
    }
    std::size_t next = i + 1;
    while (next < words.size() && next < i + 3 && isOneOf(words[next], {"are", "in", "is", "of", "length"}))
    {
      ++next;
    }
    if (next < words.size() && isOneOf(words[next], units))
    {
      return std::string(words[next]);
    }
  }
  return {};
}

bool isMeters(std::string_view unit) { return isOneOf(unit, {"m", "meter", "meters", "metre", "metres"}); }

bool mentionsYUp(const std::vector<std::string_view>& words)
{
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    const auto follow = [&](WordList list) {
      return i + list.size() <= words.size() && std::equal(list.begin(), list.end(), words.begin() + i);
    };
    if (follow({"y", "up"}) || follow({"yup"}) || follow({"up", "axis", "y"}) || follow({"upaxis", "y"}))
    {
      return true;
    }
  }
  return false;
}

std::string lengths(const Vec3& size, double factor)
{
  return shortNumber(factor * size.x()) + " by " + shortNumber(factor * size.y()) + " by " +
         shortNumber(factor * size.z()) + " m";
}

/// Returns units in which walls of a size would be those of buildings.
std::string unitsFor(double wall, const Vec3& size)
{
  constexpr double lowest = 1.5; // meters, of a storey or a parapet
  constexpr double highest = 30.0;
  std::string units;
  for (const auto& [name, factor] : {std::pair("inches", 0.0254), {"centimeters", 0.01}, {"millimeters", 0.001}})
  {
    if (factor * wall >= lowest && factor * wall <= highest)
    {
      units += (units.empty() ? "" : " or ") + std::string(name) + " (" + lengths(size, factor) + ")";
    }
  }
  return units.empty() ? "another unit" : units;
}

/// A house in inches is no taller than a tower, but its walls are as high and as wide as no tower's. Grounds may be
/// taken for walls if the up axis is unknown.
bool judgeWalls(const Scene& scene, const Vec3& size, bool axisKnown, const std::string& advice,
                std::vector<std::string>& hints)
{
  constexpr double largest = 80.0;
  double wall = wallSize(scene, 2, largest);
  wall = wall < largest || axisKnown ? wall : std::min(wall, wallSize(scene, 1, largest));
  if (wall < largest)
  {
    return false;
  }
  hints.push_back("the model would measure " + lengths(size, 1.0) +
                  ", and a third of its walls are in faces that are at least " + shortNumber(wall) +
                  " m high and wide, which " + unitsFor(wall, size) + " would explain" + advice);
  return true;
}

/// The length below which a model has no rooms.
constexpr double shortest = 0.5;

/// Judges a model whose file states meters; the program that wrote it may be wrong.
void judgeUnitOfFile(const Scene& scene, const Vec3& size, const Stated& stated, std::vector<std::string>& hints)
{
  const std::string advice = std::string("; by its file lengths are meters: if they are not, ") +
                             (stated.unitConverted ? "correct them by Scale" : "state the unit (LengthUnit)");
  if (!judgeWalls(scene, size, true, advice, hints) && size.maxCoeff() < shortest)
  {
    hints.push_back("the model would measure " + lengths(size, 1.0) + ", less than anything with rooms" + advice);
  }
}

void judgeUnit(const Scene& scene, const std::string& head, const std::vector<std::string_view>& words,
               const Vec3& size, bool axisKnown, std::vector<std::string>& hints)
{
  constexpr double tallest = 1000.0; // no building is
  constexpr double longest = 20000.0;
  const std::string advice = "; lengths are taken to be meters: state the unit (LengthUnit), if only meters";
  const std::string unit = mentionedUnit(words);
  if (!unit.empty())
  {
    if (!isMeters(unit))
    {
      hints.push_back("the file mentions the unit '" + unit + "'" + advice);
    }
    return;
  }
  const auto contains = [&](const char* text) { return head.find(text) != std::string::npos; };
  if (contains("sketchup") && !contains(".0254"))
  {
    hints.push_back("the file comes from SketchUp, which writes inches without saying so" + advice);
    return;
  }
  if (judgeWalls(scene, size, axisKnown, advice, hints))
  {
    return;
  }
  const std::string extents = lengths(size, 1.0);
  if (size.z() > tallest || size.maxCoeff() > longest)
  {
    hints.push_back("the model would measure " + extents + ", which millimeters or inches would explain" + advice);
  }
  else if (size.maxCoeff() < shortest)
  {
    hints.push_back("the model would measure " + extents + ", less than anything with rooms" + advice);
  }
}

/// Ground, floors and roofs share one axis, walls have the two others. If the first is y, and the model is flat along
/// it, it was drawn y up. Walls are compared with all that stands on the ground, which can be of any size.
bool looksYUp(const Scene& scene, const Box3& box)
{
  const Vec3 size = box.size();
  if (!(size.y() < 0.6 * std::min(size.x(), size.z())))
  {
    return false;
  }
  Vec3 area = Vec3::Zero();
  double all = 0.0;
  Box3 ground;
  double groundArea = 0.0;
  const double groundLevel = box.min.y() + 1e-3 * size.y();
  for (const auto& [a, b, c] : scene.triangles)
  {
    const Vec3 n = (scene.points[b] - scene.points[a]).cross(scene.points[c] - scene.points[a]);
    const double length = n.norm();
    int axis = 0;
    const bool along = n.cwiseAbs().maxCoeff(&axis) > 0.99 * length;
    area[axis] += along ? length : 0.0;
    all += length;
    if (along && axis == 1 && scene.points[a].y() < groundLevel)
    {
      groundArea += length;
      for (const Index p : {a, b, c})
      {
        ground.extend(scene.points[p]);
      }
    }
  }
  const bool underAll = !ground.empty() && ground.size().x() > 0.99 * size.x() && ground.size().z() > 0.99 * size.z();
  const double least = 0.03 * (underAll ? all - groundArea : all);
  return area.y() > 0.4 * all && area.x() > least && area.z() > least && area.y() > 1.5 * std::max(area.x(), area.z());
}

/// Returns the bounds of the faces across an axis that lie at one end of the box.
Box3 endOf(const Scene& scene, const Box3& box, int axis, bool isUpper)
{
  const double level = isUpper ? box.max[axis] : box.min[axis];
  const double near = 1e-3 * box.size()[axis];
  Box3 end;
  for (const auto& t : scene.triangles)
  {
    if (std::ranges::all_of(t, [&](Index p) { return std::abs(scene.points[p][axis] - level) <= near; }))
    {
      std::ranges::for_each(t, [&](Index p) { end.extend(scene.points[p]); });
    }
  }
  return end;
}

/// Returns the share of the box that a part of it spans across an axis, in the direction in which it spans less.
double spanAcross(const Box3& part, const Box3& box, int axis)
{
  double least = part.empty() ? 0.0 : 1.0;
  for (int other = 0; other < 3 && !part.empty(); ++other)
  {
    least = other == axis ? least : std::min(least, part.size()[other] / box.size()[other]);
  }
  return least;
}

/// True if the model lies on its side. Standing models have a base under all of them, and towers taper off. A model
/// lies if it has such a base at an end along y, and less at the other one, and its lowest faces along z are under a
/// part only.
bool liesOnSide(const Scene& scene, const Box3& box)
{
  constexpr double all = 0.9;
  constexpr double part = 0.5;
  const Box3 lowest = endOf(scene, box, 2, false);
  if (!(box.size().minCoeff() > 0.0) || lowest.empty() || spanAcross(lowest, box, 2) > part ||
      spanAcross(endOf(scene, box, 2, true), box, 2) > part)
  {
    return false;
  }
  const double low = spanAcross(endOf(scene, box, 1, false), box, 1);
  const double high = spanAcross(endOf(scene, box, 1, true), box, 1);
  return std::max(low, high) > all && std::min(low, high) < part;
}

/// True for id and a number, SketchUp's names of objects in groups.
bool isNumbered(const std::string& name)
{
  const std::string text = lowered(name);
  return text.size() > 2 && text.compare(0, 2, "id") == 0 &&
         std::all_of(text.begin() + 2, text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

const std::string lyingText = "the model would lie on its side: all of it has a base along y, and along z only a part";

void judgeUpAxis(const Scene& scene, const std::vector<std::string_view>& words, const Box3& box,
                 std::vector<std::string>& hints)
{
  const std::string advice = "; z is taken to be up: state which is (UpAxis), if only z";
  if (mentionsYUp(words))
  {
    hints.push_back("the file mentions that y is up" + advice);
  }
  else if (looksYUp(scene, box))
  {
    hints.push_back("most horizontal faces would be walls, as if y were up" + advice);
  }
  else if (liesOnSide(scene, box))
  {
    hints.push_back(lyingText + advice);
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
  const std::string text = lowered(head);
  const std::vector<std::string_view> words = wordsOf(text);
  if (!stated.unit && stated.unitByFile)
  {
    judgeUnitOfFile(scene, box.size(), stated, hints);
  }
  else if (!stated.unit)
  {
    judgeUnit(scene, text, words, box.size(), stated.upAxis || stated.axisByFile, hints);
  }
  if (!stated.upAxis && stated.axisByFile)
  {
    if (liesOnSide(scene, box))
    {
      hints.push_back(lyingText + "; if another axis is up than its file says, state it (UpAxis)");
    }
  }
  else if (!stated.upAxis)
  {
    judgeUpAxis(scene, words, box, hints);
  }
  // Single precision, which viewers and some solvers use, has seven digits.
  constexpr double far = 1e5;
  const double distance = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  if (!stated.recentered && distance > far && distance > 10.0 * box.size().norm())
  {
    hints.push_back("the model lies " + shortNumber(distance) +
                    " m from the origin, where single precision loses centimeters; Recenter moves it there");
  }
  return hints;
}

std::string hintAtGroupNames(const Scene& scene)
{
  std::vector<std::string> groups;
  for (const Shape& shape : scene.shapes)
  {
    const std::string& group = shape.group == noIndex ? std::string() : scene.groups[shape.group].name;
    if (!isNumbered(shape.name) || isNumbered(group))
    {
      return {};
    }
    if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
    {
      groups.push_back(group);
    }
  }
  if (groups.size() < 2)
  {
    return {};
  }
  const std::string more = groups.size() > 3 ? " and " + std::to_string(groups.size() - 3) + " more" : "";
  groups.resize(std::min<std::size_t>(groups.size(), 3));
  return "surfaces are called '" + scene.shapes.front().name +
         "' and the like; the groups that hold them have names (" + joined(groups) + more +
         "): take those (SurfaceBy Group)";
}

} // namespace atria::scene
