#include "ground/plot/core/chart.hpp"

#include <algorithm>
#include <cmath>

#include "ground/plot/core/polyline.hpp"
#include "ground/plot/core/scale.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using mechanics::Range;

constexpr double kAxisFont = 11.0, kTitleFont = 13.0, kLimitFont = 10.5;
constexpr double kLeft = 44.0, kTop = 26.0, kBottom = 34.0, kBands = 56.0, kGap = 10.0;  // around the curves
constexpr double kRim = 18.0;  // above and below them, for what is written at a limit

std::optional<Range> united(const std::vector<ChartLine>& lines, std::optional<Range> ChartLine::*part) {
  std::optional<Range> out;
  for (const ChartLine& line : lines) {
    if (!(line.*part)) continue;
    if (!out) out.emplace();
    out->include(*(line.*part));
  }
  return out;
}

/// What is certified, and what else there is.
Range of_all(const Chart& chart) {
  Range out;
  for (const auto& range :
       {united(chart.lines, &ChartLine::certified), united(chart.lines, &ChartLine::flown), chart.shows}) {
    if (range) out.include(*range);
  }
  return out.min <= out.max ? out : Range{0.0, 1.0};
}

/// As figures are printed, with a minus sign as axes have it.
std::string signed_text(double figure) {
  constexpr double kZero = 1e-9;
  return (figure < -kZero ? kMinus : "") + number_text(std::abs(figure), kZero);
}

std::string span_text(const Range& range) {
  const std::string min = signed_text(range.min), max = signed_text(range.max);
  return min == max ? min : min + " .. " + max;
}

/// What the curves need, and a limit where that leaves them a third of the height.
struct Shown {
  Range range;
  bool limit_min = false, limit_max = false;
};

Shown shown(const Chart& chart) {
  constexpr double kShare = 3.0, kOfSize = 0.25, kZero = 1e-9;
  const Range needed = of_all(chart);
  const double size = std::max(std::abs(needed.min), std::abs(needed.max));
  const double most = kShare * std::max(needed.span(), kOfSize * size);
  Shown out{needed};
  const auto take = [&](const std::optional<double>& limit) {
    Range wider = out.range;
    if (limit) wider.include(*limit);
    if (!limit || (wider.span() > most && size > kZero)) return false;
    out.range = wider;
    return true;
  };
  out.limit_min = take(chart.limit_min);
  out.limit_max = take(chart.limit_max);
  if (out.range.span() <= 1e-3 * size || out.range.span() < kZero) {
    const double half = size > kZero ? 0.1 * size : 1.0;
    out.range.include({out.range.min - half, out.range.max + half});
  }
  return out;
}

bool below(const std::optional<Range>& range, const std::optional<double>& limit) {
  return range && limit && range->min < *limit;
}

bool above(const std::optional<Range>& range, const std::optional<double>& limit) {
  return range && limit && range->max > *limit;
}

void draw_title(Svg& svg, const Chart& chart, const Box& place) {
  const double y = place.top + 13.0;
  const std::string title = chart.title + ", " + chart.unit;
  svg.begin(kInk);
  svg.words({place.left + kLeft, y}, title, {kTitleFont, Anchor::kStart, true});
  svg.end();
  const auto certified = united(chart.lines, &ChartLine::certified), flown = united(chart.lines, &ChartLine::flown);
  const bool broken = below(certified, chart.limit_min) || above(certified, chart.limit_max) ||
                      below(flown, chart.limit_min) || above(flown, chart.limit_max);
  const std::string last = broken ? ", outside its limits" : "";
  std::string words = certified ? span_text(*certified) + (broken || flown ? "" : ", certified") : "";
  if (flown) {
    const std::string flown_words = "flown " + span_text(*flown);
    const std::string both = certified ? flown_words + ", certified " + words : flown_words;
    const double room = place.width() - kLeft - width_of(title, kTitleFont);
    words = width_of(both + last, kAxisFont) < room ? both : flown_words;
  }
  svg.begin(broken ? kBad : kMuted);
  svg.words({place.right, y}, words + last, {kAxisFont, Anchor::kEnd});
  svg.end();
}

void draw_axes(Svg& svg, const Chart& chart, const Box& plot, const Scale& time, const Scale& up) {
  const auto heights = ticks(up.shown, 5);
  svg.begin(kGrid);
  for (const Tick& tick : heights) svg.line({plot.left, up(tick.figure)}, {plot.right, up(tick.figure)}, {0.6});
  svg.end();
  svg.begin(kMuted);
  svg.line({plot.left, plot.bottom}, {plot.right, plot.bottom}, {1.0, 0.6});
  for (const Tick& tick : heights)
    svg.words({plot.left - 6.0, up(tick.figure) + 4.0}, tick.words, {kAxisFont, Anchor::kEnd});
  for (const Tick& tick : ticks(time.shown, 8)) {
    svg.line({time(tick.figure), plot.bottom}, {time(tick.figure), plot.bottom + 3.0}, {1.0, 0.6});
    svg.words({time(tick.figure), plot.bottom + 15.0}, tick.words, {kAxisFont, Anchor::kMiddle});
  }
  svg.words({plot.right, plot.bottom + 30.0}, chart.time_name, {kAxisFont, Anchor::kEnd});
  svg.end();
}

/// One bar for each line, from its least to its greatest; what was flown beside it, as fine as what is measured.
void draw_bands(Svg& svg, const Chart& chart, const Box& bands, const Scale& up) {
  constexpr double kWidest = 7.0, kLeast = 2.0, kFlown = 2.0;
  const double pitch = std::min(kWidest + 3.0, bands.width() / static_cast<double>(chart.lines.size()));
  const double width = 0.7 * pitch;
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const ChartLine& line = chart.lines[i];
    const double left = bands.left + static_cast<double>(i) * pitch;
    const auto bar = [&](const Range& range, double from, double wide, double opacity) {
      const double middle = 0.5 * (up(range.min) + up(range.max));
      const double half = std::max(0.5 * kLeast, 0.5 * (up(range.min) - up(range.max)));
      svg.box({from, middle - half, from + wide, middle + half}, opacity, std::min(2.0, 0.4 * wide));
    };
    svg.begin(line.tone);
    if (line.certified) bar(*line.certified, left, width, line.flown ? 0.35 : 0.85);
    if (line.flown) bar(*line.flown, left + 0.5 * (width - kFlown), kFlown, 1.0);
    svg.end();
  }
}

/// A limit as a line with its name; one that is far away as a word at the rim it lies beyond.
void draw_limit(Svg& svg, double limit, bool is_shown, bool is_max, bool broken, const Box& plot, const Scale& up) {
  const std::string words = (is_max ? "max " : "min ") + signed_text(limit);
  const double y = is_shown ? up(limit) : is_max ? plot.top + kRim - 4.0 : plot.bottom - kRim + 4.0;
  svg.begin(broken ? kBad : kInk);
  if (is_shown) svg.line({plot.left, y}, {plot.right, y}, {1.1, 0.8, "7 4"});
  svg.words({plot.right - 4.0, is_max ? y - 4.5 : y + 12.5},
            is_shown ? words : words + (is_max ? " \u2191" : " \u2193"), {kLimitFont, Anchor::kEnd, false, true});
  svg.end();
}

using Curve = std::vector<std::vector<Point>>;

bool look_alike(const Curve& a, const Curve& b) {
  constexpr double kNobodySees = 0.35;  // px
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](const Point& p, const Point& q) { return std::abs(p.y - q.y) < kNobodySees; });
  });
}

/// Where several do the same, they take turns along the line. Of many lines are fine, to be seen through.
void draw_curves(Svg& svg, const Chart& chart, const std::vector<Curve>& curves) {
  constexpr int kTurn = 9;  // px
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Stroke stroke = curves.size() <= kFewCarriers ? Stroke{1.7, 0.95} : Stroke{0.9, 0.6};
    if (chart.fine) stroke.width = std::min(stroke.width, 1.3);
    int alike = 0, before = 0;
    for (std::size_t j = 0; j < curves.size() && curves.size() <= kFewCarriers; ++j) {
      if (!look_alike(curves[i], curves[j])) continue;
      ++alike;
      if (j < i) ++before;
    }
    if (alike > 1) {
      stroke.dash = std::to_string(kTurn) + " " + std::to_string(kTurn * (alike - 1));
      stroke.dash_offset = -1.0 * kTurn * before;
    }
    svg.begin(chart.lines[i].tone);
    for (const auto& piece : curves[i]) svg.path(chart.fine ? simplified(piece, 0.05) : piece, stroke);
    svg.end();
  }
}

/// Stretches of the time axis that are something of their own.
void draw_marked(Svg& svg, const Chart& chart, const Box& plot, const Scale& time) {
  svg.begin(kInk);
  for (const Range& marked : chart.marked_s) {
    const double left = std::max(plot.left, time(marked.min)), right = std::min(plot.right, time(marked.max));
    if (left < right) svg.box({left, plot.bottom - 1.5, right, plot.bottom + 1.5}, 0.75);
  }
  svg.end();
}

}  // namespace

std::vector<Figure> figures(const mechanics::Limits& limits) {
  using mechanics::CarrierFigures;
  const auto& rate = limits.winch_rate_max_m_s;
  return {{"Tension", "N", [](const Moment& m) { return m.tension_n; },
           [](const CarrierFigures& f) { return f.tension_n; }, limits.tension_min_n, limits.tension_max_n},
          {"Cable length", "m", [](const Moment& m) { return m.length_m; },
           [](const CarrierFigures& f) { return f.length_m; }, limits.length_min_m, limits.length_max_m},
          {"Speed", "m/s", [](const Moment& m) { return m.speed_m_s; },
           [](const CarrierFigures& f) { return f.speed_m_s; }, limits.speed_min_m_s, limits.speed_max_m_s},
          {"Winch rate", "m/s", [](const Moment& m) { return m.winch_rate_m_s; },
           [](const CarrierFigures& f) { return f.winch_rate_m_s; },
           rate ? std::optional<double>(-*rate) : std::nullopt, rate}};
}

Chart chart(const Figure& figure, const Motion& motion, const mechanics::Certificate& certificate) {
  Chart out;
  out.title = figure.title;
  out.unit = figure.unit;
  out.limit_min = figure.limit_min;
  out.limit_max = figure.limit_max;
  out.time_s = {0.0, motion.period_s};
  for (std::size_t i = 0; i < motion.carriers.size(); ++i) {
    ChartLine line;
    line.tone = carrier_tone(i);
    line.certified = figure.certified(certificate.carriers[i]);
    line.pieces.emplace_back();
    for (const Moment& moment : motion.carriers[i].moments)
      line.pieces.back().push_back({moment.t_s, figure.of(moment)});
    out.lines.push_back(std::move(line));
  }
  return out;
}

double chart_width_px(const Box& place) {
  return place.width() - kLeft - kBands - kGap;
}

mechanics::Range chart_shows(const Chart& chart) {
  return shown(chart).range;
}

void draw_chart(Svg& svg, const Chart& chart, const Box& place) {
  const Box plot{place.left + kLeft, place.top + kTop, place.right - kBands - kGap, place.bottom - kBottom};
  const auto certified = united(chart.lines, &ChartLine::certified);
  const Shown shows = shown(chart);
  // the rims are part of the axis, and of what it says
  const double rim = shows.range.span() * kRim / (plot.height() - 2.0 * kRim);
  const Scale up{{shows.range.min - rim, shows.range.max + rim}, plot.bottom, plot.top};
  const Scale time{chart.time_s, plot.left, plot.right};

  draw_title(svg, chart, place);
  draw_axes(svg, chart, plot, time, up);
  if (certified) {
    svg.begin(kMuted);
    svg.box({plot.left, up(certified->max), plot.right, up(certified->min)}, 0.12);
    svg.end();
  }
  std::vector<Curve> curves(chart.lines.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const std::vector<Point>& piece : chart.lines[i].pieces) {
      curves[i].emplace_back();
      for (const Point& point : piece) curves[i].back().push_back({time(point.x), up(point.y)});
    }
  }
  draw_curves(svg, chart, curves);
  if (!chart.marked_s.empty()) draw_marked(svg, chart, plot, time);
  draw_bands(svg, chart, {plot.right + kGap, plot.top, place.right, plot.bottom}, up);
  const auto flown = united(chart.lines, &ChartLine::flown);
  const auto& least = chart.limit_min;
  const auto& most = chart.limit_max;
  if (most) draw_limit(svg, *most, shows.limit_max, true, above(certified, most) || above(flown, most), plot, up);
  if (least) draw_limit(svg, *least, shows.limit_min, false, below(certified, least) || below(flown, least), plot, up);
}

}  // namespace gyre::ground
