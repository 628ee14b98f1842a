// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/WorstElements.h"

#include "Quality/Checks/CheckQuantities.h"
#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace atria {

namespace {

std::vector<Index> rankWorst(std::span<const double> values, const WorstElementsOptions& options)
{
  const auto worse = [&](double a, double b) { return options.greatestIsWorst ? a > b : a < b; };
  std::vector<Index> found;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!std::isnan(values[i]) && (!options.limit || worse(values[i], *options.limit)))
    {
      found.push_back(static_cast<Index>(i));
    }
  }
  const auto order = [&](Index a, Index b) { return values[a] != values[b] ? worse(values[a], values[b]) : a < b; };
  const std::size_t kept = std::min(found.size(), options.count.value_or(found.size()));
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(kept);
  std::partial_sort(found.begin(), last, found.end(), order);
  found.resize(kept);
  return found;
}

/// Adds the elements that share a point with the elements so far.
class Growth
{
public:
  Growth(const CellArrays& source, std::size_t pointCount)
      : cells(source), touched(pointCount), taken(source.types.size())
  {
  }

  void take(std::span<const Index> elements)
  {
    for (const Index e : elements)
    {
      taken[e] = true;
      anyPoint(e, [this](std::size_t point) {
        touched.at(point) = true;
        return false;
      });
    }
  }

  std::vector<Index> nextRing() const
  {
    std::vector<Index> ring;
    for (std::size_t e = 0; e < taken.size(); ++e)
    {
      if (!taken[e] && anyPoint(e, [this](std::size_t point) { return touched.at(point); }))
      {
        ring.push_back(static_cast<Index>(e));
      }
    }
    return ring;
  }

private:
  /// Tests an element's points, one after the other, until `has` is true for one.
  template <typename Has> bool anyPoint(std::size_t e, Has&& has) const
  {
    const auto end = static_cast<std::size_t>(cells.offsets[e + 1]);
    for (auto i = static_cast<std::size_t>(cells.offsets[e]); i < end; ++i)
    {
      if (has(static_cast<std::size_t>(cells.connectivity[i])))
      {
        return true;
      }
    }
    return false;
  }

  const CellArrays& cells;
  std::vector<bool> touched;
  std::vector<bool> taken;
};

} // namespace

bool greatestIsWorst(std::string_view arrayName)
{
  constexpr std::string_view smallestIsWorst[] = {"InverseAspectRatio", "OrthogonalQuality", "Volume",
                                                  "FacePyramids",       "ScaledJacobian",    "Valid"};
  const auto& quantities = checkQuantities();
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const CheckQuantityInfo& info) { return arrayName == info.name; });
  return found != quantities.end() ? found->greaterIsWorse
                                   : std::find(std::begin(smallestIsWorst), std::end(smallestIsWorst), arrayName) ==
                                         std::end(smallestIsWorst);
}

WorstElements findWorstElements(std::span<const double> values, const CellArrays& cells, std::size_t pointCount,
                                const WorstElementsOptions& options, const RunContext& context)
{
  if (values.size() != cells.types.size())
  {
    throw Error("there are " + std::to_string(values.size()) + " values for " + std::to_string(cells.types.size()) +
                " elements");
  }
  context.progress.report(0.0, "Ranking elements");
  WorstElements out;
  out.elements = rankWorst(values, options);
  out.worstCount = out.elements.size();
  for (std::size_t i = 0; i < out.worstCount; ++i)
  {
    out.ranks.push_back(static_cast<std::int32_t>(i + 1));
  }
  out.rings.assign(out.worstCount, 0);
  Growth growth(cells, pointCount);
  std::vector<Index> last = out.elements;
  for (int ring = 1; ring <= options.rings && !last.empty(); ++ring)
  {
    context.progress.report(static_cast<double>(ring) / (options.rings + 1), "Looking about them");
    growth.take(last);
    last = growth.nextRing();
    out.elements.insert(out.elements.end(), last.begin(), last.end());
    out.ranks.resize(out.elements.size(), 0);
    out.rings.resize(out.elements.size(), ring);
  }
  context.progress.report(1.0, "Worst elements known");
  return out;
}

} // namespace atria
