// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/ElementBudget.h"

#include "Octree/Sizing/Estimate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace atria {

namespace {

/// Bounds of the number of elements over the number of leaves of a sample, which are not balanced and may reach out of
/// the domain. Values of 0.97 to 1.6 were measured.
constexpr double leastGrowth = 0.9;
constexpr double mostGrowth = 2.0;

/// Neighbors of elements are numbers of 32 bits with a sign.
constexpr std::size_t mostNumbers = std::size_t{1} << 31;

/// Returns the number of leaves of refined octants. Leaves outside of the domain count too.
std::size_t mostLeaves(std::span<const std::span<const MortonKey>> refined)
{
  std::size_t leaves = 1;
  for (const std::span<const MortonKey> level : refined)
  {
    leaves += 7 * level.size();
  }
  return leaves;
}

std::size_t leavesInDomain(std::span<const std::span<const MortonKey>> refined, const GridFrame& frame,
                           const RunContext& context)
{
  std::size_t leaves = 1;
  for (std::size_t l = 0; l < refined.size(); ++l)
  {
    leaves += childrenInDomain(refined[l], static_cast<int>(l), frame, context) - refined[l].size();
  }
  return leaves;
}

} // namespace

std::string inGigabytes(double bytes)
{
  std::ostringstream text;
  text.precision(3);
  bytes<1e11 || bytes> 1e18 ? text << bytes * 1e-9 : text << std::llround(bytes * 1e-9);
  return text.str() + " GB";
}

std::string inWords(double count)
{
  std::ostringstream text;
  text.precision(3);
  if (count >= 1e6)
  {
    text << (count < 1e9    ? count * 1e-6
             : count < 1e12 ? count * 1e-9
                            : count)
         << (count < 1e9    ? " million"
             : count < 1e12 ? " billion"
                            : "");
    return text.str();
  }
  return std::to_string(std::lround(count));
}

ElementBudget::ElementBudget(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options)
    : model_(model), frame_(frame), options_(options)
{
  const std::size_t fit =
      options.memoryLimit == 0 ? mostNumbers : std::min(options.memoryLimit / bytesPerElement, mostNumbers);
  // MaxElements already keeps the mesh within the memory if it is the lower limit.
  if (options.maxElements == 0 || options.maxElements > fit)
  {
    most = fit;
  }
}

void ElementBudget::check(std::span<const std::span<const MortonKey>> refined, const RunContext& context)
{
  // With fewer leaves a look ahead would cost more than the octants.
  constexpr std::size_t many = 500'000;
  if (!most || mostLeaves(refined) <= std::min(*most, many))
  {
    return;
  }
  if (!hasLooked)
  {
    hasLooked = true;
    ahead = sampleOctants(model_, frame_, options_, {context.executor, context.progress.part(0.0, 0.0)});
    if (leastGrowth * ahead.leaves() > static_cast<double>(*most))
    {
      refuse(ahead.leaves());
    }
  }
  const std::size_t leaves = mostLeaves(refined) > *most ? leavesInDomain(refined, frame_, context) : 0;
  if (leaves > *most)
  {
    refuse(static_cast<double>(leaves));
  }
}

void ElementBudget::refuse(double elements) const { throw TooManyElements(textFor(elements), elements, ahead); }

std::string ElementBudget::textFor(double elements) const
{
  Box3 box;
  for (const LatticePoint& p : model_.points)
  {
    box.extend(toVector(p) * frame_.latticeUnit());
  }
  const Vec3 domain = frame_.domain.size();
  std::ostringstream text;
  text.precision(4);
  text << "the requested sizes make about " << inWords(elements) << " elements or more, which take "
       << inGigabytes(elements * bytesPerElement) << " of memory; "
       << (most == mostNumbers ? "2.1 billion are the most there can be"
                               : "there are " + inGigabytes(static_cast<double>(options_.memoryLimit)))
       << ". " << adviceFor()
       << " MaxElements takes coarser sizes, first away from the model, MemoryLimit says that there "
          "is more memory. The domain measures "
       << domain[0] << " by " << domain[1] << " by " << domain[2] << " m";
  if (!box.empty())
  {
    text << ", the model " << box.size()[0] << " by " << box.size()[1] << " by " << box.size()[2]
         << " m: if that is not what it should, state its unit (LengthUnit)";
  }
  return text.str();
}

/// Returns a text with the finest sizes that fit.
std::string ElementBudget::adviceFor() const
{
  int depth = frame_.depth;
  while (depth > 0 && mostGrowth * ahead.leavesDownTo(static_cast<std::size_t>(depth)) > static_cast<double>(*most))
  {
    --depth;
  }
  std::ostringstream text;
  text.precision(4);
  text << "Octants of " << frame_.sizeOf(depth) << " m fit, ";
  if (depth < std::max(frame_.topLevel, frame_.startLevel))
  {
    text << "but SizeMax or StartLevel requires finer ones everywhere: raise SizeMax, lower StartLevel, or make the "
            "domain smaller.";
    return text.str();
  }
  text << "finer ones do not: raise SizeMin" << (frame_.midLevel > depth ? " and SizeMid" : "")
       << (frame_.depth > frame_.featureLevel ? ", and finer requested sizes," : "") << " to that.";
  return text.str();
}

} // namespace atria
