#include "harness/film/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/film/fitted_text.hpp"
#include "harness/film/paint.hpp"
#include "sim/render/renderer.hpp"

namespace harness {

namespace {

using Overlay = std::vector<render::OverlayItem>;

/// The vertical axis. It maps a value to a height between 0 (bottom) and 1 (top).
struct Axis {
  Scale scale = Scale::linear;
  double bottom = 0.0;
  double top = 1.0;
  std::vector<double> ticks;

  double position(double value) const {
    const double share = scale == Scale::linear ? (value - bottom) / (top - bottom)
                                                : std::log(value / bottom) / std::log(top / bottom);
    return std::clamp(share, 0.0, 1.0);
  }
};

/// The smallest of 1, 2, 5 times a power of ten that is not below the value.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (value <= digit * decade * (1.0 + 1e-9)) return digit * decade;
  }
  return 10.0 * decade;
}

std::optional<double> extreme(const Chart& chart, std::optional<double> (Series::*of)() const, bool largest) {
  std::optional<double> result;
  const auto take = [&](const Series* series) {
    if (series == nullptr || !(series->*of)()) return;
    const double value = *(series->*of)();
    result = !result ? value : largest ? std::max(*result, value) : std::min(*result, value);
  };
  for (const Curve& curve : chart.curves) {
    take(curve.values);
    if (largest) take(curve.band);
  }
  return result;
}

Axis axis_of(const Chart& chart) {
  Axis axis;
  axis.scale = chart.scale;
  const double largest = extreme(chart, &Series::largest, true).value_or(1.0);
  if (chart.scale == Scale::linear) {
    axis.top = round_up(std::max(largest, 1e-3));
    for (const double share : {0.0, 0.5, 1.0}) axis.ticks.push_back(share * axis.top);
    return axis;
  }
  const double smallest = extreme(chart, &Series::smallest, false).value_or(1.0);
  const int lowest = std::min(0, static_cast<int>(std::floor(std::log10(std::max(smallest, 1e-3)))));
  const int highest = std::max(2, static_cast<int>(std::ceil(std::log10(std::max(largest, 1e-3)))));
  for (int decade = lowest; decade <= highest; ++decade) axis.ticks.push_back(std::pow(10.0, decade));
  axis.bottom = axis.ticks.front();
  axis.top = axis.ticks.back();
  return axis;
}

/// A short text for a number.
std::string tick_label(double value) {
  if (value >= 1e6) return fmt::format("{:.3g}M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.3g}k", value / 1e3);
  return fmt::format("{:.3g}", value);
}

class Plot {
 public:
  Plot(const Chart& chart, float scale)
      : chart_(chart),
        axis_(axis_of(chart)),
        scale_(scale),
        area_{chart.frame.x + 40.0F * scale, chart.frame.y + 26.0F * scale, chart.frame.width - 52.0F * scale,
              chart.frame.height - 50.0F * scale} {}

  void append_axes(Overlay& overlay) const {
    append_time_axis(overlay);
    for (const double tick : axis_.ticks) {
      const float y = y_of(tick);
      overlay.push_back(
          render::Polyline{{{area_.x, y}, {area_.x + area_.width, y}}, scale_, paint(paints::hairline)});
      overlay.push_back(render::Text{{area_.x - 6.0F * scale_, y + 4.0F * scale_},
                                     11.0F * scale_,
                                     render::Align::right,
                                     render::Weight::regular,
                                     paint(paints::faint_ink),
                                     tick_label(tick)});
    }
  }

  void append_band(const Curve& curve, Overlay& overlay) const {
    if (curve.band == nullptr) return;
    render::Band band;
    band.colour = paint(curve.colour, band_alpha);
    for (int bin = 0; bin < curve.band->bins(); ++bin) {
      const std::optional<double> value = curve.band->value(bin);
      if (value) band.points.emplace_back(x_of(*curve.band, bin), y_of(*value), y_of(0.0));
    }
    if (band.points.size() > 1) overlay.push_back(std::move(band));
  }

  void append_edge(const Curve& curve, Overlay& overlay) const {
    if (curve.band == nullptr) return;
    std::vector<Eigen::Vector2f> points;
    for (int bin = 0; bin < curve.band->bins(); ++bin) {
      const std::optional<double> value = curve.band->value(bin);
      if (value) points.emplace_back(x_of(*curve.band, bin), y_of(*value));
    }
    append_dashes(points, chart_dashes(scale_, curve.colour), overlay);
  }

  void append_curve(const Curve& curve, Overlay& overlay) const {
    render::Polyline line;
    line.width = 1.8F * scale_;
    line.colour = paint(curve.colour);
    for (int bin = 0; bin < curve.values->bins(); ++bin) {
      const std::optional<double> value = curve.values->value(bin);
      if (value) line.points.emplace_back(x_of(*curve.values, bin), y_of(*value));
    }
    if (line.points.size() > 1) overlay.push_back(std::move(line));
  }

  /// The title on the left, the latest value of each curve on the right.
  void append_head(Overlay& overlay) const {
    const float y = chart_.frame.y + 15.0F * scale_;
    const float size = 13.0F * scale_;
    const auto text = [&](float x, render::Align align, render::Weight weight, Rgb colour,
                          std::string words) {
      overlay.push_back(render::Text{{x, y}, size, align, weight, paint(colour), std::move(words)});
    };
    const std::string title = fmt::format("{} [{}]", chart_.title, chart_.unit);
    const float left = chart_.frame.x + 12.0F * scale_;
    text(left, render::Align::left, render::Weight::bold, paints::ink, title);
    const float gap = 10.0F * scale_;
    const float room = area_.x + area_.width - left - render::text_width(title, size, render::Weight::bold);
    float x = area_.x + area_.width;
    for (auto curve = chart_.curves.rbegin(); curve != chart_.curves.rend(); ++curve) {
      const std::string words = latest(*curve, size, room - gap * static_cast<float>(chart_.curves.size()));
      text(x, render::Align::right, render::Weight::bold, curve->colour, words);
      x -= render::text_width(words, size, render::Weight::bold) + gap;
    }
  }

 private:
  static std::string latest(const Curve& curve, const std::string& label, int decimals) {
    const std::optional<double> value = curve.values->last();
    return value ? fmt::format("{} {:.{}f}", label, *value, decimals) : std::string();
  }

  /// The name and the latest value of a curve. If they do not fit for all curves together, each curve gets an
  /// equal part of the room.
  std::string latest(const Curve& curve, float size, float room) const {
    const auto width = [&](const std::string& words) {
      return render::text_width(words, size, render::Weight::bold);
    };
    float all = 0.0F;
    for (const Curve& each : chart_.curves) all += width(latest(each, each.label, chart_.decimals));
    if (all <= room) return latest(curve, curve.label, chart_.decimals);
    const float part = room / static_cast<float>(chart_.curves.size());
    const std::string label =
        fitted(curve.label, size, render::Weight::bold, part - width(latest(curve, "", chart_.decimals)));
    return latest(curve, label, chart_.decimals);
  }

  /// The times at which the run begins and ends.
  void append_time_axis(Overlay& overlay) const {
    if (chart_.curves.empty()) return;
    const Series& series = *chart_.curves.front().values;
    const float y = area_.y + area_.height + 14.0F * scale_;
    const auto label = [&](float x, render::Align align, std::string words) {
      overlay.push_back(render::Text{{x, y},
                                     11.0F * scale_,
                                     align,
                                     render::Weight::regular,
                                     paint(paints::faint_ink),
                                     std::move(words)});
    };
    label(area_.x, render::Align::left, "0");
    label(area_.x + area_.width, render::Align::right,
          fmt::format("{:.4g} s", series.end() - series.start()));
  }

  float x_of(const Series& series, int bin) const {
    const double share = (series.time_of(bin) - series.start()) / (series.end() - series.start());
    return area_.x + static_cast<float>(share) * area_.width;
  }
  float y_of(double value) const {
    return area_.y + static_cast<float>(1.0 - axis_.position(value)) * area_.height;
  }

  const Chart& chart_;
  Axis axis_;
  float scale_;
  Frame area_;  // for the curves
};

}  // namespace

Dashes chart_dashes(float scale, Rgb colour) {
  return {1.5F * scale, 5.0F * scale, 3.5F * scale, paint(colour)};
}

void append_dashes(const std::vector<Eigen::Vector2f>& points, const Dashes& dashes, Overlay& overlay) {
  float left = dashes.length;  // of the present dash or gap
  bool is_dash = true;
  render::Polyline line{{}, dashes.width, dashes.colour};
  const auto end_dash = [&] {
    if (line.points.size() > 1) overlay.push_back(line);
    line.points.clear();
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    Eigen::Vector2f from = points[i - 1];
    for (float rest = (points[i] - from).norm(); rest > 0.0F; rest = (points[i] - from).norm()) {
      const float step = std::min(rest, left);
      const Eigen::Vector2f to =
          step == rest ? points[i] : Eigen::Vector2f(from + step / rest * (points[i] - from));
      if (is_dash && line.points.empty()) line.points.push_back(from);
      if (is_dash) line.points.push_back(to);
      left -= step;
      from = to;
      if (left > 1e-3F) continue;
      if (is_dash) end_dash();
      is_dash = !is_dash;
      left = is_dash ? dashes.length : dashes.gap;
    }
  }
  end_dash();
}

void append_chart(const Chart& chart, float scale, Overlay& overlay) {
  const Plot plot(chart, scale);
  plot.append_axes(overlay);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    if (i == 0) plot.append_band(chart.curves[i], overlay);
    if (i > 0) plot.append_edge(chart.curves[i], overlay);
  }
  for (const Curve& curve : chart.curves) plot.append_curve(curve, overlay);
  plot.append_head(overlay);
}

}  // namespace harness
