// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Clusters.h"

#include "Surface/Search/BoxPairs.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

/// Largest number of meetings of three triangles by boundOfTriples(): about the number of pieces they are cut into.
constexpr std::size_t mostTriples = 5'000'000;

/// Returns, per box, how many it touches among every `step`th box; empty if these are more than `limit` in all.
std::vector<std::size_t> countTouching(const std::vector<NumberedBox>& boxes, std::size_t triangles, std::size_t step,
                                       std::size_t limit, const RunContext& context)
{
  std::vector<NumberedBox> asking;
  for (std::size_t i = 0; i < boxes.size(); i += step)
  {
    asking.push_back(boxes[i]);
  }
  std::vector<std::size_t> counts(triangles, 0);
  std::size_t total = 0;
  try
  {
    forBoxPairs(asking, boxes, context, [&](Index, Index b) {
      ++counts[b];
      if (++total > limit)
      {
        throw TooManyPairs{};
      }
    });
  }
  catch (const TooManyPairs&)
  {
    return {};
  }
  return counts;
}

/// Marks the triangles that cost most until the cost of the others is within the limit.
void leaveOutDearest(const std::vector<std::size_t>& costs, std::size_t limit, std::vector<char>& isOut)
{
  std::vector<Index> order;
  for (Index t = 0; t < costs.size(); ++t)
  {
    if (!isOut[t] && costs[t] > 0)
    {
      order.push_back(t);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return costs[a] < costs[b]; });
  std::size_t sum = 0;
  for (const Index t : order)
  {
    sum += std::min(costs[t], limit);
    isOut[t] = sum > limit ? 1 : 0;
  }
}

/// Hides the sources of marked triangles. Returns true if any was marked.
bool hide(const TriangleSoup& soup, const std::vector<char>& isOut, ClusterCells& clusters)
{
  for (Index t = 0; t < isOut.size(); ++t)
  {
    if (isOut[t])
    {
      clusters.hide(soup.sources[t]);
    }
  }
  return std::ranges::find(isOut, 1) != isOut.end();
}

std::vector<std::size_t> costsOf(std::size_t count, const TrianglePairs& pairs)
{
  std::vector<std::size_t> degrees(count, 0);
  for (const auto& [a, b] : pairs)
  {
    ++degrees[a];
    ++degrees[b];
  }
  std::vector<std::size_t> costs(count, 0);
  for (const auto& [a, b] : pairs)
  {
    const std::size_t lower = std::min(degrees[a], degrees[b]);
    costs[a] += lower;
    costs[b] += lower;
  }
  return costs;
}

} // namespace

std::vector<char> findClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit,
                               const RunContext& context, std::vector<char> isOut)
{
  isOut.resize(soup.triangles.size(), 0);
  for (std::size_t allowed = limit;; allowed /= 2) // lower still if a sample did not show enough
  {
    std::vector<NumberedBox> boxes;
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (!isOut[t])
      {
        boxes.push_back(boxOf(soup, t, margin));
      }
    }
    // Pairs are seen from both sides. If all would be too many, a sample is counted: every second box, or every second
    // of these.
    std::size_t step = 1;
    std::vector<std::size_t> counts = countTouching(boxes, isOut.size(), step, 2 * limit, context);
    while (counts.empty() && !boxes.empty())
    {
      context.progress.check();
      step *= 2;
      // One box touches no more than there are.
      counts = countTouching(boxes, isOut.size(), step, step < boxes.size() ? 2 * limit : boxes.size(), context);
    }
    if (step == 1)
    {
      return isOut;
    }
    if (allowed == 0)
    {
      // The samples do not show enough even now: the later half goes.
      std::for_each(boxes.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2), boxes.end(),
                    [&](const NumberedBox& box) { isOut[box.id] = 1; });
      continue;
    }
    std::transform(counts.begin(), counts.end(), counts.begin(), [&](std::size_t count) { return count * step; });
    leaveOutDearest(counts, allowed, isOut);
  }
}

std::size_t boundOfTriples(std::size_t count, const TrianglePairs& pairs)
{
  const std::vector<std::size_t> costs = costsOf(count, pairs);
  return std::accumulate(costs.begin(), costs.end(), std::size_t{0}) / 2;
}

std::vector<char> findTangles(std::size_t count, const TrianglePairs& pairs, std::size_t limit)
{
  std::vector<char> isOut(count, 0);
  if (boundOfTriples(count, pairs) > limit)
  {
    leaveOutDearest(costsOf(count, pairs), limit, isOut);
  }
  return isOut;
}

void checkPairs(std::size_t pairs)
{
  if (pairs > mostPairs)
  {
    throw TooManyPairs{};
  }
}

void hideClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit, ClusterCells& clusters,
                  const RunContext& context)
{
  std::vector<char> isOut(soup.triangles.size());
  std::ranges::transform(soup.sources, isOut.begin(), [&](Index source) { return clusters.isHidden(source) ? 1 : 0; });
  hide(soup, findClusters(soup, margin, limit, context, std::move(isOut)), clusters);
}

bool hideTangles(const TriangleSoup& soup, const TrianglePairs& pairs, ClusterCells& clusters)
{
  return hide(soup, findTangles(soup.triangles.size(), pairs, mostTriples), clusters);
}

} // namespace atria
