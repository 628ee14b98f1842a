// SPDX-License-Identifier: GPL-3.0-or-later
#include "WindProfile.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace atria {

namespace {

double turned(double angle)
{
  const double rest = std::fmod(angle, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

} // namespace

double WindProfile::frictionVelocity() const
{
  return vonKarman * speed / std::log((referenceHeight + roughness) / roughness);
}

double WindProfile::velocity(double z) const
{
  return frictionVelocity() / vonKarman * std::log((z + roughness) / roughness);
}

double WindProfile::kineticEnergy() const { return frictionVelocity() * frictionVelocity() / std::sqrt(turbulenceCmu); }

double WindProfile::dissipation(double z) const
{
  return std::pow(frictionVelocity(), 3) / (vonKarman * (z + roughness));
}

double WindProfile::specificDissipation(double z) const
{
  return frictionVelocity() / (vonKarman * std::sqrt(turbulenceCmu) * (z + roughness));
}

double windTowards(double from, double north) { return turned(270.0 + north - from); }

double windFrom(double towards, double north) { return turned(270.0 + north - towards); }

std::vector<double> windRose(int directions, double north)
{
  std::vector<double> towards;
  for (int i = 0; i < directions; ++i)
  {
    towards.push_back(windTowards(360.0 * i / directions, north));
  }
  return towards;
}

Vec3 windVector(double towards)
{
  const double angle = towards * std::numbers::pi / 180.0;
  // Rounds to 15 digits: 90 degrees give an exact axis.
  const auto rounded = [](double x) { return std::round(x * 1e15) / 1e15; };
  return {rounded(std::cos(angle)), rounded(std::sin(angle)), 0.0};
}

std::string windLabel(double from)
{
  char text[32];
  const double tenths = std::fmod(std::round(10.0 * from), 3600.0);
  std::snprintf(text, sizeof text, std::fmod(tenths, 10.0) == 0.0 ? "%03.0f" : "%05.1f", tenths / 10.0);
  return text;
}

} // namespace atria
