#pragma once
// A figure over time of several that are told apart by their tones, under the limits it is held to, with its certified
// extremes beside it, and with what was flown where something was.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"
#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

struct ChartLine {
  Tone tone = kInk;
  std::vector<std::vector<Point>> pieces;  ///< through time [s] and figure; nothing is known between two
  std::optional<mechanics::Range> certified, flown;
};

struct Chart {
  std::string title, unit;
  std::vector<ChartLine> lines;
  std::optional<double> limit_min, limit_max;
  mechanics::Range time_s;
  std::string time_name = "time, s";
  std::optional<mechanics::Range> shows;   ///< what the axis shows in any case
  std::vector<mechanics::Range> marked_s;  ///< stretches of time that are marked at the axis
  bool fine = false;                       ///< of many points, those that nobody would miss are left out
};

/// `place` takes in the axes and the title.
void draw_chart(Svg& svg, const Chart& chart, const Box& place);

/// What is left of a place for the curves.
[[nodiscard]] double chart_width_px(const Box& place);

/// What the chart's axis shows: another one that shows it too is in the same scale.
[[nodiscard]] mechanics::Range chart_shows(const Chart& chart);

/// What a certificate speaks of, of every carrier.
struct Figure {
  const char* title;
  const char* unit;
  std::function<double(const Moment&)> of;
  std::function<mechanics::Range(const mechanics::CarrierFigures&)> certified;
  std::optional<double> limit_min, limit_max;
};

/// Tension, length, speed, winch rate.
[[nodiscard]] std::vector<Figure> figures(const mechanics::Limits& limits);

/// Over one period of a plan.
[[nodiscard]] Chart chart(const Figure& figure, const Motion& motion, const mechanics::Certificate& certificate);

}  // namespace gyre::ground
