// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerCoverage.h"

#include "Layer/ConformingLayer.h"
#include "Layer/LayerHeights.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

class Reporter
{
public:
  Reporter(const LayerMesh& l, const LayerWalls& w, const std::vector<double>& s, const LayerOptions& o)
      : layer(l), walls(w), sizes(s), options(o)
  {
    out.counts.assign(layer.mesh.boundaryFaces.size(), 0);
    out.thicknesses.assign(layer.mesh.boundaryFaces.size(), 0.0);
  }

  LayerReport report(const std::vector<std::string>& names, const OwnElements& part)
  {
    std::vector<LayerCoverage> ofTag(options.ofTag.size());
    for (Index f = 0; f < walls.roles.size(); ++f)
    {
      if (walls.roles[f] == FaceRole::wall)
      {
        LayerCoverage ofOthers;
        const BoundaryFace& face = layer.mesh.boundaryFaces[f];
        add(f, part.owns(face.element) ? ofTag[face.tag] : ofOthers);
      }
    }
    sumUp(part.exchange, ofTag);
    for (LayerCoverage& surface : ofTag)
    {
      surface.thickness = surface.layered > 0.0 ? surface.thickness / surface.layered : 0.0;
      surface.firstHeight = surface.area > 0.0 ? lengthUnit() * surface.firstHeight / surface.area : 0.0;
    }
    addSheets(ofTag);
    for (std::size_t tag = 0; tag < ofTag.size(); ++tag)
    {
      LayerCoverage& surface = ofTag[tag];
      const bool isSupporting = options.isSupporting(static_cast<Index>(tag));
      const bool isNamed = tag < names.size() || tag >= options.surfaceCount(); // others are within the mesh
      if (isNamed && (isSupporting ? surface.layered > 0.0 : surface.area > 0.0))
      {
        surface.surface = tag < names.size() ? names[tag] : sideName(static_cast<Index>(tag) - options.surfaceCount());
        surface.layers = isSupporting ? 0 : options.ofTag[tag].layers;
        out.surfaces.push_back(std::move(surface));
      }
    }
    return std::move(out);
  }

private:
  static void sumUp(RankExchange& exchange, std::vector<LayerCoverage>& ofTag)
  {
    std::vector<double> values;
    for (const LayerCoverage& surface : ofTag)
    {
      values.insert(values.end(),
                    {surface.area, surface.layered, surface.full, surface.thickness, surface.firstHeight});
    }
    const std::vector<double> sums = sumAll(exchange, std::move(values));
    for (std::size_t tag = 0; tag < ofTag.size(); ++tag)
    {
      LayerCoverage& surface = ofTag[tag];
      auto sum = sums.begin() + static_cast<std::ptrdiff_t>(5 * tag);
      surface.area = *sum++;
      surface.layered = *sum++;
      surface.full = *sum++;
      surface.thickness = *sum++;
      surface.firstHeight = *sum++;
    }
  }

  Index countAt(Index point) const
  {
    const Index copy = layer.copies[point];
    return copy == noIndex ? 0 : layer.places[copy - layer.plainPoints];
  }

  double inUnits(double area) const
  {
    return options.areaUnit > 0.0 ? options.areaUnit * std::round(area / options.areaUnit) : area;
  }

  /// Returns the length by which volumes are divided to be summed like areas: about the domain's longest side.
  double lengthUnit() const { return options.areaUnit > 0.0 ? std::sqrt(options.areaUnit) * 0x1p22 : 1.0; }

  /// Returns the area of a wall face times the mean distance of its element's corners from it.
  double volumeUnder(const BoundaryFace& face, const Vec3& areaVector) const
  {
    Vec3 corners = Vec3::Zero();
    for (const Index p : layer.mesh.corners[face.element])
    {
      corners += layer.mesh.points[p] / 8.0;
    }
    Vec3 ofFace = Vec3::Zero();
    for (int i = 0; i < 4; ++i)
    {
      ofFace += layer.mesh.points[cornerOf(layer.mesh, face, i)] / 4.0;
    }
    return (corners - ofFace).dot(areaVector);
  }

  void add(Index f, LayerCoverage& surface)
  {
    const BoundaryFace& face = layer.mesh.boundaryFaces[f];
    const WallLayers& asked = options.ofTag[face.tag];
    const ReducedFace reduced = faceOf(layer.mesh.corners[face.element], face.direction);
    const std::vector<Vec3>& points = layer.mesh.points;
    const Vec3 areaVector = wallNormal(layer.mesh, face);
    const double area = areaVector.norm();
    Index most = 0;
    double got = 0.0;
    double wanted = 0.0;
    for (int i = 0; i < reduced.count; ++i)
    {
      const Index p = layer.creaseSheets.sourceOf(reduced.points[i]);
      most = std::max(most, countAt(p));
      wanted += thicknessAsked(asked, sizes[p], options) / reduced.count;
      if (layer.copies[p] != noIndex && area > 0.0)
      {
        got += (points[layer.copies[p]] - points[p]).dot(areaVector) / (area * reduced.count);
      }
    }
    out.counts[f] = static_cast<std::int32_t>(most);
    out.thicknesses[f] = got;
    surface.area += inUnits(area);
    surface.firstHeight += inUnits(2.0 * volumeUnder(face, areaVector) / lengthUnit());
    if (most > 0)
    {
      surface.layered += inUnits(area);
      surface.full += most >= static_cast<Index>(asked.layers) ? inUnits(area) : 0.0;
      surface.thickness += wanted > 0.0 ? inUnits(area * got / wanted) : 0.0;
    }
  }

  /// Gives faces of crease sheets the layer of the face they were taken from.
  void addSheets(std::vector<LayerCoverage>& ofTag)
  {
    for (std::size_t i = 0; i < layer.creaseSheets.wallFaces.size(); ++i)
    {
      const std::size_t f = layer.creaseSheets.firstFace + i;
      const Index like = layer.creaseSheets.wallFaces[i];
      if (like == noIndex)
      {
        continue;
      }
      out.counts[f] = out.counts[like];
      out.thicknesses[f] = out.thicknesses[like];
      LayerCoverage& surface = ofTag[layer.mesh.boundaryFaces[like].tag];
      const double area = wallNormal(layer.mesh, layer.mesh.boundaryFaces[f]).norm();
      surface.area += area;
      surface.layered += area;
      surface.full += area;
    }
  }

  const LayerMesh& layer;
  const LayerWalls& walls;
  const std::vector<double>& sizes;
  const LayerOptions& options;
  LayerReport out;
};

} // namespace

std::vector<double> sizesBesideWalls(const DualMesh& plain, const LayerWalls& walls, const RunContext& context)
{
  std::vector<Index> onWall(plain.points.size(), 0);
  for (Index f = 0; f < walls.roles.size(); ++f)
  {
    for (int i = 0; i < 4 && walls.roles[f] == FaceRole::wall; ++i)
    {
      onWall[cornerOf(plain, plain.boundaryFaces[f], i)] = 1;
    }
  }
  return findWallSizes(plain, walls, onWall, elementsAt(plain, {onWall.begin(), onWall.end()}, context.executor),
                       context);
}

LayerReport reportLayers(const LayerMesh& layer, const LayerWalls& walls, const std::vector<double>& sizes,
                         const LayerOptions& options, const std::vector<std::string>& surfaceNames,
                         const OwnElements& part)
{
  return Reporter(layer, walls, sizes, options).report(surfaceNames, part);
}

} // namespace atria
