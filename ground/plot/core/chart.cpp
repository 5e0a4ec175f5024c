#include "ground/plot/core/chart.hpp"

#include <algorithm>
#include <cmath>

#include "ground/plot/core/scale.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using mechanics::Certificate;
using mechanics::Range;

constexpr double kAxisFont = 11.0, kTitleFont = 13.0, kLimitFont = 10.5;
constexpr double kLeft = 44.0, kTop = 26.0, kBottom = 34.0, kBands = 56.0, kGap = 10.0;  // around the curves
constexpr double kRim = 18.0;  // above and below them, for what is written at a limit

Range of_all(const Figure& figure, const Certificate& certificate) {
  Range out;
  for (const mechanics::CarrierFigures& carrier : certificate.carriers) out.include(figure.certified(carrier));
  return out;
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

Shown shown(const Figure& figure, const Range& certified) {
  constexpr double kShare = 3.0, kOfSize = 0.25, kZero = 1e-9;
  const double size = std::max(std::abs(certified.min), std::abs(certified.max));
  const double most = kShare * std::max(certified.span(), kOfSize * size);
  Shown out{certified};
  const auto take = [&](const std::optional<double>& limit) {
    Range wider = out.range;
    if (limit) wider.include(*limit);
    if (!limit || (wider.span() > most && size > kZero)) return false;
    out.range = wider;
    return true;
  };
  out.limit_min = take(figure.limit_min);
  out.limit_max = take(figure.limit_max);
  if (out.range.span() <= 1e-3 * size || out.range.span() < kZero) {
    const double half = size > kZero ? 0.1 * size : 1.0;
    out.range.include({out.range.min - half, out.range.max + half});
  }
  return out;
}

bool outside(const Figure& figure, const Range& certified) {
  return (figure.limit_min && certified.min < *figure.limit_min) ||
         (figure.limit_max && certified.max > *figure.limit_max);
}

void draw_title(Svg& svg, const Figure& figure, const Range& certified, const Box& place) {
  const double y = place.top + 13.0;
  svg.begin(kInk);
  svg.words({place.left + kLeft, y}, std::string(figure.title) + ", " + figure.unit,
            {kTitleFont, Anchor::kStart, true});
  svg.end();
  const bool broken = outside(figure, certified);
  svg.begin(broken ? kBad : kMuted);
  svg.words({place.right, y}, span_text(certified) + (broken ? ", outside its limits" : ", certified"),
            {kAxisFont, Anchor::kEnd});
  svg.end();
}

void draw_axes(Svg& svg, const Box& plot, const Scale& time, const Scale& up) {
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
  svg.words({plot.right, plot.bottom + 30.0}, "time, s", {kAxisFont, Anchor::kEnd});
  svg.end();
}

/// One bar per carrier, from its least to its greatest.
void draw_bands(Svg& svg, const Figure& figure, const Certificate& certificate, const Box& bands, const Scale& up) {
  constexpr double kWidest = 7.0, kLeast = 2.0;
  const double pitch = std::min(kWidest + 3.0, bands.width() / static_cast<double>(certificate.carriers.size()));
  const double width = 0.7 * pitch;
  for (std::size_t i = 0; i < certificate.carriers.size(); ++i) {
    const Range range = figure.certified(certificate.carriers[i]);
    const double left = bands.left + static_cast<double>(i) * pitch;
    const double middle = 0.5 * (up(range.min) + up(range.max));
    const double half = std::max(0.5 * kLeast, 0.5 * (up(range.min) - up(range.max)));
    svg.begin(carrier_tone(i));
    svg.box({left, middle - half, left + width, middle + half}, 0.85, std::min(2.0, 0.4 * width));
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

using Curve = std::vector<Point>;

bool look_alike(const Curve& a, const Curve& b) {
  constexpr double kNobodySees = 0.35;  // px
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const Point& p, const Point& q) { return std::abs(p.y - q.y) < kNobodySees; });
}

/// Where carriers do the same, they take turns along the line. Of many carriers lines are fine, to be seen through.
void draw_curves(Svg& svg, const std::vector<Curve>& curves) {
  constexpr int kTurn = 9;  // px
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Stroke stroke = curves.size() <= kFewCarriers ? Stroke{1.7, 0.95} : Stroke{0.9, 0.6};
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
    svg.begin(carrier_tone(i));
    svg.path(curves[i], stroke);
    svg.end();
  }
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

void draw_chart(Svg& svg, const Figure& figure, const Motion& motion, const Certificate& certificate,
                const Box& place) {
  const Box plot{place.left + kLeft, place.top + kTop, place.right - kBands - kGap, place.bottom - kBottom};
  const Range certified = of_all(figure, certificate);
  const Shown shows = shown(figure, certified);
  // the rims are part of the axis, and of what it says
  const double rim = shows.range.span() * kRim / (plot.height() - 2.0 * kRim);
  const Scale up{{shows.range.min - rim, shows.range.max + rim}, plot.bottom, plot.top};
  const Scale time{{0.0, motion.period_s}, plot.left, plot.right};

  draw_title(svg, figure, certified, place);
  draw_axes(svg, plot, time, up);
  svg.begin(kMuted);
  svg.box({plot.left, up(certified.max), plot.right, up(certified.min)}, 0.12);
  svg.end();
  std::vector<Curve> curves(motion.carriers.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const Moment& moment : motion.carriers[i].moments)
      curves[i].push_back({time(moment.t_s), up(figure.of(moment))});
  }
  draw_curves(svg, curves);
  draw_bands(svg, figure, certificate, {plot.right + kGap, plot.top, place.right, plot.bottom}, up);
  const auto& least = figure.limit_min;
  const auto& most = figure.limit_max;
  if (most) draw_limit(svg, *most, shows.limit_max, true, certified.max > *most, plot, up);
  if (least) draw_limit(svg, *least, shows.limit_min, false, certified.min < *least, plot, up);
}

}  // namespace gyre::ground
