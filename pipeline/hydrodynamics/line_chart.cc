#include "pipeline/hydrodynamics/line_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

constexpr double width = 420, height = 250;
constexpr double left = 66, top = 26, bottom = 40, room_for_legend = 48;
constexpr std::array<const char*, 8> colours = {"#1f5fa8", "#c8501e", "#2d8a4e", "#8b3fa0",
                                                "#b8860b", "#2a8c94", "#b03060", "#555555"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '<') {
      result += "&lt;";
    } else if (letter == '&') {
      result += "&amp;";
    } else {
      result += letter;
    }
  }
  return result;
}

struct Extent {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void take(double value) {
    if (!std::isfinite(value)) return;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  void widen_to(const std::vector<double>& figures) {
    for (const double figure : figures) take(figure);
  }
  double fraction(double value) const { return (value - lowest) / (highest - lowest); }
};

/// Value to place on the page.
struct Scales {
  Extent x, y;
  double right = 12;  ///< margin
  double across(double value) const { return left + (width - left - right) * x.fraction(value); }
  double down(double value) const {
    return height - bottom - (height - top - bottom) * y.fraction(value);
  }
};

std::string axes(const LineChart& chart, const Scales& scales, const std::vector<double>& x,
                 const std::vector<double>& y) {
  std::string svg;
  for (const double value : x) {
    const double at = scales.across(value);
    svg += fmt::format(R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}"/>)"
                       R"(<text x="{0:.1f}" y="{3}" text-anchor="middle">{4:.4g}</text>)",
                       at, top, height - bottom, height - bottom + 14, value);
  }
  for (const double value : y) {
    const double at = scales.down(value);
    svg += fmt::format(R"(<line class="grid" x1="{1}" x2="{2}" y1="{0:.1f}" y2="{0:.1f}"/>)"
                       R"(<text x="{3}" y="{4:.1f}" text-anchor="end">{5:.4g}</text>)",
                       at, left, width - scales.right, left - 5, at + 4, value);
  }
  svg += fmt::format(
      R"svg(<text class="title" x="{}" y="14">{}</text>)svg"
      R"svg(<text x="{}" y="{}" text-anchor="middle">{}</text>)svg"
      R"svg(<text transform="translate(11 {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      left, escaped(chart.title), (left + width - scales.right) / 2, height - 8,
      escaped(chart.x_label), (top + height - bottom) / 2, escaped(chart.y_label));
  return svg;
}

std::string path_of(const Curve& curve, const Scales& scales) {
  std::string path;
  bool pen_down = false;
  for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k) {
    if (!std::isfinite(curve.x[k]) || !std::isfinite(curve.y[k])) {
      pen_down = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", scales.across(curve.x[k]),
                        scales.down(curve.y[k]));
    pen_down = true;
  }
  return path;
}

}  // namespace

std::vector<double> round_figures(double lowest, double highest, int count) {
  if (!std::isfinite(lowest) || !std::isfinite(highest)) return {0.0, 1.0};
  if (!(highest > lowest)) {
    const double half = lowest == 0.0 ? 0.5 : 0.5 * std::abs(lowest);
    lowest -= half;
    highest += half;
  }
  const double raw = (highest - lowest) / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  const auto first = std::llround(std::floor(lowest / step + 1e-9));
  const auto last = std::llround(std::ceil(highest / step - 1e-9));
  std::vector<double> figures;
  for (long long k = first; k <= last; ++k) figures.push_back(static_cast<double>(k) * step);
  return figures;
}

std::string to_svg(const LineChart& chart) {
  Scales scales;
  for (const Curve& curve : chart.curves) {
    for (const double value : curve.x) scales.x.take(value);
    for (const double value : curve.y) scales.y.take(value);
  }
  const auto x = round_figures(scales.x.lowest, scales.x.highest, 6);
  const auto y = chart.y_figures.empty() ? round_figures(scales.y.lowest, scales.y.highest, 5)
                                         : chart.y_figures;
  if (chart.legend_outside) scales.right += room_for_legend;
  scales.x.widen_to(x);
  scales.y.widen_to(y);
  std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img">)", width, height) +
                    axes(chart, scales, x, y);
  double legend = top + 6;
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const Curve& curve = chart.curves[k];
    const char* const colour = colours[k % colours.size()];
    svg += fmt::format(R"(<path d="{}" stroke="{}"/>)", path_of(curve, scales), colour);
    if (curve.name.empty()) continue;
    svg +=
        fmt::format(R"(<text class="legend" x="{}" y="{}" text-anchor="end" fill="{}">{}</text>)",
                    (chart.legend_outside ? width : width - scales.right) - 4, legend += 12, colour,
                    escaped(curve.name));
  }
  return svg + "</svg>\n";
}

}  // namespace blocklift::pipeline
