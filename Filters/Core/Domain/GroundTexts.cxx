// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/GroundTexts.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace atria {

namespace {

std::string lengthOf(double meters)
{
  std::ostringstream text;
  text.precision(3);
  text << meters << " m";
  return text.str();
}

std::string countOf(std::size_t count, const char* one, const char* many)
{
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

/// Returns text such as "'A' by 0.4 m, 'B' by 1.8 m and 3 more".
std::string listOf(const std::vector<BodyAtGround>& bodies)
{
  constexpr std::size_t most = 6;
  std::string text;
  const std::size_t shown = std::min(most, bodies.size());
  for (std::size_t i = 0; i < shown; ++i)
  {
    const bool isLast = i + 1 == bodies.size();
    text += (i == 0 ? "'" : isLast ? " and '" : ", '") + bodies[i].name + "' by " + lengthOf(bodies[i].distance);
  }
  return text + (bodies.size() > shown ? " and " + std::to_string(bodies.size() - shown) + " more" : "");
}

std::string adviceFor(const std::vector<BodyAtGround>& bodies, const GroundTextOptions& options)
{
  const std::string rest = "; correct their bases, or leave it where air is meant to pass below them";
  return options.isGiven
             ? "; raise the domain's bottom to them (DomainBounds), or take the domain that follows from the "
               "buildings (DomainMode Automatic), which lets them down to the ground" +
                   rest
             : "; a larger GroundSnapRatio lets " + std::string(bodies.size() == 1 ? "it" : "them") +
                   " down to the ground" + rest;
}

void addHovering(GroundReport& report, const GroundTextOptions& options)
{
  std::vector<BodyAtGround> thin;
  std::vector<BodyAtGround> others;
  for (const BodyAtGround& body : report.hovering)
  {
    if (body.isDoubtful)
    {
      (body.distance < options.sizeMin ? thin : others).push_back(body);
    }
  }
  if (!thin.empty())
  {
    report.warnings.push_back(countOf(thin.size(), "body hovers", "bodies hover") +
                              " above the ground on a film of air that is thinner than an element (SizeMin, " +
                              lengthOf(options.sizeMin) + "), so that the mesh closes it in part: " + listOf(thin) +
                              adviceFor(thin, options));
  }
  if (!others.empty() && !options.isGiven)
  {
    report.warnings.push_back(countOf(others.size(), "body hovers", "bodies hover") +
                              " above the ground: " + listOf(others) + adviceFor(others, options));
  }
}

} // namespace

void addTexts(GroundReport& report, const GroundTextOptions& options)
{
  addHovering(report, options);
  const std::string ground = options.hasTerrain ? "the terrain" : "the ground at z = " + lengthOf(report.floor);
  if (!report.letDown.empty())
  {
    report.notes.push_back(countOf(report.letDown.size(), "body that hovers was", "bodies that hover were") +
                           " let down to " + ground + ": " + listOf(report.letDown) +
                           "; GroundSnapRatio 0 leaves them as drawn");
  }
  if (!report.belowGround.empty())
  {
    report.notes.push_back(countOf(report.belowGround.size(), "body reaches", "bodies reach") + " below " + ground +
                           ", where nothing is meshed: " + listOf(report.belowGround));
  }
  if (!report.slabs.empty())
  {
    std::string names;
    for (const std::string& name : report.slabs)
    {
      names += (names.empty() ? "'" : ", '") + name + "'";
    }
    report.notes.push_back(names + (report.slabs.size() == 1 ? " is" : " are") +
                           " ground drawn as a solid: of it the upper side alone is meshed");
  }
}

} // namespace atria
