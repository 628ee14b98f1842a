// SPDX-License-Identifier: GPL-3.0-or-later
#include "QualityPlot.h"

#include "OutputFiles.h"
#include "Picture.h"

#include <vtkDoubleArray.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace atria::tool {

namespace {

constexpr Color ink{40, 40, 40};
constexpr Color faint{215, 215, 215};
constexpr Color barColor{86, 126, 178};
constexpr Color lineColor{206, 74, 58};
constexpr double chartWidth = 440.0;
constexpr double chartHeight = 250.0;
constexpr double gap = 24.0;
constexpr std::size_t columns = 3;

/// A row of the table with its histogram.
struct Metric
{
  std::string name;
  std::string of;
  double minimum, maximum, mean, deviation;
  long long count;
  std::vector<double> centers, density, cumulative;

  double binWidth() const { return centers.size() > 1 ? centers[1] - centers[0] : 1.0; }
};

std::string format(const char* pattern, double value)
{
  char text[40];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string rounded(double value) { return format("%.5g", value); }

std::vector<double> columnOf(vtkTable* table, const std::string& name)
{
  auto* column = vtkDoubleArray::SafeDownCast(table->GetColumnByName(name.c_str()));
  return column ? std::vector<double>(column->GetPointer(0), column->GetPointer(0) + column->GetNumberOfValues())
                : std::vector<double>();
}

std::vector<Metric> metricsOf(vtkTable* summary, vtkTable* histogram)
{
  std::vector<Metric> metrics;
  for (vtkIdType row = 0; row < summary->GetNumberOfRows(); ++row)
  {
    const auto number = [&](const char* column) { return summary->GetValueByName(row, column).ToDouble(); };
    Metric m;
    m.name = summary->GetValueByName(row, "Metric").ToString();
    m.of = summary->GetValueByName(row, "Of").ToString();
    m.minimum = number("Minimum");
    m.maximum = number("Maximum");
    m.mean = number("Mean");
    m.deviation = number("StandardDeviation");
    m.count = summary->GetValueByName(row, "Count").ToLongLong();
    m.centers = columnOf(histogram, m.name);
    m.density = columnOf(histogram, m.name + "_PDF");
    m.cumulative = columnOf(histogram, m.name + "_CDF");
    metrics.push_back(std::move(m));
  }
  return metrics;
}

/// Returns steps of 1, 2 or 5 times a power of ten, four to eight of them over a length.
double niceStep(double length)
{
  const double rough = length / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double digit = rough / power;
  return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

/// Position of a chart's axes, and the mapping of values to them.
struct Axes
{
  double left = 58.0, right = chartWidth - 40.0, top = 46.0, bottom = chartHeight - 28.0;
  double low, high, greatest;

  double x(double value) const { return left + (value - low) / (high - low) * (right - left); }
  double y(double share) const { return bottom - share * (bottom - top); }
};

void drawAxes(Picture& chart, const Axes& axes)
{
  constexpr double size = 11.0;
  const double stepY = niceStep(axes.greatest);
  for (double value = 0.0; value <= axes.greatest; value += stepY)
  {
    const double y = axes.y(value / axes.greatest);
    chart.shapes.push_back(Line{{{axes.left, y}, {axes.right, y}}, 1.0, faint});
    chart.shapes.push_back(Text{axes.left - 6, y, rounded(value), size, Anchor::Right, barColor, false});
  }
  for (const double share : {0.0, 0.5, 1.0})
  {
    chart.shapes.push_back(
        Text{axes.right + 6, axes.y(share), format("%.1f", share), size, Anchor::Left, lineColor, false});
  }
  const double stepX = niceStep(axes.high - axes.low);
  for (double k = std::ceil(axes.low / stepX); k * stepX <= axes.high + 1e-9 * stepX; ++k)
  {
    const double x = axes.x(k * stepX);
    chart.shapes.push_back(Line{{{x, axes.bottom}, {x, axes.bottom + 4}}, 1.0, ink});
    chart.shapes.push_back(
        Text{x, axes.bottom + 15, rounded(k == 0.0 ? 0.0 : k * stepX), size, Anchor::Middle, ink, false});
  }
  chart.shapes.push_back(Line{{{axes.left, axes.bottom}, {axes.right, axes.bottom}}, 1.0, ink});
}

Picture drawChart(const Metric& metric)
{
  Picture chart{chartWidth, chartHeight, {}};
  const std::string unit =
      metric.name.find("Orthogonality") != std::string::npos || metric.name.find("Angle") != std::string::npos
          ? ", degrees"
          : "";
  chart.shapes.push_back(
      Text{chartWidth / 2, 12, metric.name + " of " + metric.of + unit, 14, Anchor::Middle, ink, true});
  if (metric.count == 0)
  {
    chart.shapes.push_back(Text{chartWidth / 2, chartHeight / 2, "no values", 12, Anchor::Middle, ink, false});
    return chart;
  }
  const double half = 0.5 * metric.binWidth();
  Axes axes;
  axes.low = metric.centers.front() - half;
  axes.high = metric.centers.back() + half;
  axes.greatest = *std::max_element(metric.density.begin(), metric.density.end());
  chart.shapes.push_back(Text{axes.left, 32, "PDF", 11, Anchor::Right, barColor, true});
  chart.shapes.push_back(Text{axes.right, 32, "CDF", 11, Anchor::Left, lineColor, true});
  drawAxes(chart, axes);
  Line cumulative{{{axes.left, axes.bottom}}, 2.0, lineColor};
  for (std::size_t b = 0; b < metric.centers.size(); ++b)
  {
    const double from = axes.x(metric.centers[b] - half);
    const double to = axes.x(metric.centers[b] + half);
    const double top = axes.y(metric.density[b] / axes.greatest);
    const double share = metric.density[b] * metric.binWidth();
    chart.shapes.push_back(Bar{from, top, std::max(0.5, to - from - 1.0), axes.bottom - top, barColor,
                               rounded(metric.centers[b]) + ": " + format("%.4g %%", 100.0 * share)});
    cumulative.points.push_back({to, axes.y(metric.cumulative[b])});
  }
  chart.shapes.push_back(std::move(cumulative));
  return chart;
}

const char* const headings[] = {"metric", "of", "min", "max", "mean", "std", "number"};

std::vector<std::string> cellsOf(const Metric& m)
{
  return {m.name,
          m.of,
          rounded(m.minimum),
          rounded(m.maximum),
          rounded(m.mean),
          rounded(m.deviation),
          std::to_string(m.count)};
}

Picture drawTable(const std::vector<Metric>& metrics)
{
  constexpr double rowHeight = 22.0;
  constexpr double size = 13.0;
  const double right[] = {0.0, 190.0, 380.0, 510.0, 640.0, 770.0, 900.0};
  Picture table{920.0, rowHeight * static_cast<double>(metrics.size() + 1), {}};
  const auto addRow = [&](double y, std::size_t column, const std::string& text, bool bold) {
    table.shapes.push_back(Text{right[column], y, text, size, column < 2 ? Anchor::Left : Anchor::Right, ink, bold});
  };
  for (std::size_t column = 0; column < std::size(headings); ++column)
  {
    addRow(rowHeight / 2, column, headings[column], true);
    for (std::size_t row = 0; row < metrics.size(); ++row)
    {
      addRow(rowHeight * (static_cast<double>(row) + 1.5), column, cellsOf(metrics[row])[column], false);
    }
  }
  table.shapes.push_back(Line{{{0.0, rowHeight}, {table.width, rowHeight}}, 1.0, ink});
  return table;
}

Picture drawAll(const std::string& title, const std::vector<Metric>& metrics)
{
  const Picture table = drawTable(metrics);
  const std::size_t rows = (metrics.size() + columns - 1) / columns;
  const double chartsTop = 60.0 + table.height + gap;
  Picture all{gap + columns * (chartWidth + gap), chartsTop + static_cast<double>(rows) * (chartHeight + gap), {}};
  all.shapes.push_back(Text{gap, 28, title, 20, Anchor::Left, ink, true});
  all.add(table, gap, 60.0);
  for (std::size_t i = 0; i < metrics.size(); ++i)
  {
    all.add(drawChart(metrics[i]), gap + static_cast<double>(i % columns) * (chartWidth + gap),
            chartsTop + static_cast<double>(i / columns) * (chartHeight + gap));
  }
  return all;
}

std::string pageOf(const std::string& title, const std::vector<Metric>& metrics)
{
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" + escaped(title) +
      "</title>\n<style>\nbody { font-family: Arial, Helvetica, sans-serif; margin: 24px; color: #282828; }\n"
      "table { border-collapse: collapse; margin-bottom: 24px; }\n"
      "th, td { padding: 3px 14px; text-align: right; } th { border-bottom: 1px solid; }\n"
      "th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left; }\n"
      ".charts { display: flex; flex-wrap: wrap; gap: 24px; }\n</style></head>\n<body>\n<h1>" +
      escaped(title) + "</h1>\n<table>\n<tr>";
  for (const char* heading : headings)
  {
    page += std::string("<th>") + heading + "</th>";
  }
  page += "</tr>\n";
  for (const Metric& metric : metrics)
  {
    page += "<tr>";
    for (const std::string& cell : cellsOf(metric))
    {
      page += "<td>" + escaped(cell) + "</td>";
    }
    page += "</tr>\n";
  }
  page += "</table>\n<div class=\"charts\">\n";
  for (const Metric& metric : metrics)
  {
    page += toSvg(drawChart(metric));
  }
  return page + "</div>\n</body></html>\n";
}

} // namespace

void writeQualityPlot(const std::string& file, const std::string& title, vtkTable* summary, vtkTable* histogram)
{
  const std::vector<Metric> metrics = metricsOf(summary, histogram);
  if (std::filesystem::path(file).extension() == ".png")
  {
    writePng(drawAll(title, metrics), file);
  }
  else
  {
    writeText(file, pageOf(title, metrics));
  }
}

} // namespace atria::tool
