// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Slivers.h"

#include <map>
#include <set>

namespace atria {

namespace {

/// Collects the points on edges, by edge.
class Slivers
{
public:
  Slivers(const TriangleSoup& soup_, std::vector<EdgeContact>& contacts_) : soup(soup_), contacts(contacts_) {}

  void align()
  {
    const std::vector<Index> slivers = find();
    if (slivers.empty())
    {
      return;
    }
    for (const EdgeContact& c : contacts)
    {
      points[c.edge].insert(c.point);
    }
    for (bool more = true; more;)
    {
      more = false;
      for (const Index t : slivers)
      {
        for (int i = 0; i < 3; ++i)
        {
          more = alignAt(t, i) || more;
        }
      }
    }
    contacts.clear();
    for (const auto& [edge, on] : points)
    {
      for (const Index p : on)
      {
        contacts.push_back({edge, p});
      }
    }
  }

private:
  bool isOn(const EdgeKey& edge, Index p) const
  {
    return std::binary_search(contacts.begin(), contacts.end(), EdgeContact{edge, p});
  }

  std::vector<Index> find() const
  {
    const std::vector<char> begins = beginsOfEdges(contacts, soup.points.size());
    std::vector<Index> found;
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      const auto& corners = soup.triangles[t];
      if (!begins[corners[0]] && !begins[corners[1]] && !begins[corners[2]])
      {
        continue;
      }
      if (isOn(edgeKey(corners, 0), corners[2]) || isOn(edgeKey(corners, 1), corners[0]) ||
          isOn(edgeKey(corners, 2), corners[1]))
      {
        found.push_back(t);
      }
    }
    return found;
  }

  /// Aligns the triangle if edge i is its long one. Returns true if an edge got a point.
  bool alignAt(Index t, int i)
  {
    const auto& corners = soup.triangles[t];
    const EdgeKey edge = edgeKey(corners, i);
    const Index apex = corners[(i + 2) % 3];
    const auto known = points.find(edge);
    if (known == points.end() || known->second.count(apex) == 0)
    {
      return false;
    }
    bool more = false;
    const std::set<Index> on = known->second;
    const Vec3 along = between(soup.points[edge.first], soup.points[edge.second]);
    const auto place = [&](Index p) { return along.dot(between(soup.points[edge.first], soup.points[p])); };
    const EdgeKey low = edgeKey(edge.first, apex), high = edgeKey(apex, edge.second);
    for (const Index p : on)
    {
      more = (p != apex && points[place(p) < place(apex) ? low : high].insert(p).second) || more;
    }
    for (const EdgeKey& part : {low, high})
    {
      for (const Index p : points[part])
      {
        more = (p != edge.first && p != edge.second && points[edge].insert(p).second) || more;
      }
    }
    return more;
  }

  const TriangleSoup& soup;
  std::vector<EdgeContact>& contacts;
  std::map<EdgeKey, std::set<Index>> points;
};

} // namespace

void alignSlivers(const TriangleSoup& soup, std::vector<EdgeContact>& contacts) { Slivers(soup, contacts).align(); }

} // namespace atria
