#include "ground/plot/core/plot_svg.hpp"

#include <algorithm>
#include <vector>

#include "ground/plot/core/chart.hpp"
#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/scene.hpp"
#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using mechanics::Certificate;

constexpr double kWidth = 1000.0, kMargin = 28.0, kInner = kWidth - 2.0 * kMargin;
constexpr double kNameFont = 24.0, kFont = 13.0, kSmall = 12.0;
constexpr double kRow = 20.0, kBelowFrame = 52.0;
constexpr double kChartHeight = 214.0, kBetweenCharts = 12.0, kGap = 32.0;
constexpr double kIndent = kMargin + 44.0;  // where frames begin, behind what their axes say
constexpr std::size_t kMostReasonLines = 4;

std::string counted(std::size_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string verdict(const Certificate& certificate) {
  return certificate.admissible() ? "admissible"
                                  : "refused, " + counted(certificate.reasons.size(), "rule") + " broken";
}

/// The first reason in lines, and how many more there are.
std::vector<std::string> reason_lines(const Certificate& certificate) {
  if (certificate.admissible()) return {};
  const mechanics::Reason& first = certificate.reasons.front();
  std::vector<std::string> lines = wrapped(std::string(mechanics::name(first.rule)) + ": " + first.text,
                                           static_cast<std::size_t>(kInner / width_of("n", kFont)));
  if (lines.size() > kMostReasonLines) {
    lines.resize(kMostReasonLines);
    lines.back() += " ..";
  }
  for (std::string& line : lines) line = shortened(line, kFont, kInner);
  if (certificate.reasons.size() > 1) {
    lines.push_back("and " + std::to_string(certificate.reasons.size() - 1) + " more, which gyre check names");
  }
  return lines;
}

/// A tick or a cross, for those who cannot tell green from red.
void draw_verdict(Svg& svg, const Certificate& certificate, double right, double baseline) {
  const std::string words = verdict(certificate);
  const double left = right - width_of(words, kFont) - 40.0;
  const Point middle{left + 17.0, baseline - 5.0};
  svg.begin(certificate.admissible() ? kGood : kBad);
  svg.box({left, baseline - 21.0, right, baseline + 11.0}, 0.13, 16.0);
  if (certificate.admissible()) {
    svg.path({{middle.x - 5.0, middle.y}, {middle.x - 1.5, middle.y + 4.0}, {middle.x + 5.5, middle.y - 4.5}}, {2.2});
  } else {
    svg.line({middle.x - 4.5, middle.y - 4.5}, {middle.x + 4.5, middle.y + 4.5}, {2.2});
    svg.line({middle.x - 4.5, middle.y + 4.5}, {middle.x + 4.5, middle.y - 4.5}, {2.2});
  }
  svg.words({middle.x + 13.0, baseline}, words, {kFont, Anchor::kStart, true});
  svg.end();
}

std::string summary(const mechanics::Plan& plan, const Certificate& certificate) {
  return counted(plan.carriers.size(), "carrier") + " \u00b7 load " + number_text(plan.load.mass_kg) +
         " kg \u00b7 period " + number_text(certificate.period_s) + " s";
}

/// Where the header ends.
double draw_header(Svg& svg, const std::string& name, const mechanics::Plan& plan, const Certificate& certificate) {
  double y = kMargin + 20.0;
  const double verdict_width = width_of(verdict(certificate), kFont) + 56.0;
  svg.begin(kInk);
  svg.words({kMargin, y}, shortened(name, kNameFont, kInner - verdict_width), {kNameFont, Anchor::kStart, true});
  svg.end();
  draw_verdict(svg, certificate, kWidth - kMargin, y);
  y += 24.0;
  svg.begin(kMuted);
  svg.words({kMargin, y}, summary(plan, certificate), {14.0});
  svg.end();
  y += 4.0;
  svg.begin(kBad);
  for (const std::string& line : reason_lines(certificate)) svg.words({kMargin, y += kRow}, line, {kFont});
  svg.end();
  return y + 22.0;
}

/// Places in so many columns, row by row, from where frames begin.
class Rows {
 public:
  Rows(double top, int columns, double pitch) : top_(top), columns_(columns), pitch_(pitch) {}

  Point next() {
    const int row = taken_ / columns_, column = taken_ % columns_;
    ++taken_;
    return {kIndent + column * pitch_, top_ + row * kRow};
  }
  [[nodiscard]] double end() const {
    const int rows = (taken_ + columns_ - 1) / columns_;
    return top_ + rows * kRow;
  }

 private:
  double top_;
  int columns_;
  double pitch_;
  int taken_ = 0;
};

std::string within(const mechanics::Approach& approach) {
  return who(approach) + (approach.min_m > 0.0 ? " come within " + number_text(approach.min_m) + " m" : " touch");
}

/// How closely things come; whose line it is stands before the words.
double draw_captions(Svg& svg, const Certificate& certificate, double top) {
  constexpr double kMark = 32.0, kMarkLength = 22.0;
  Rows rows(top, 2, 0.5 * (kInner + kGap));
  const auto caption = [&svg](Point at, const std::string& words) {
    svg.begin(kInk);
    svg.words(at, words, {kSmall});
    svg.end();
  };
  for (const auto* approach : {&certificate.separation, &certificate.cable_distance}) {
    if (!*approach) continue;
    const Point at = rows.next();
    draw_approach(svg, {at.x + 2.5, at.y - 4.0}, {at.x + kMarkLength, at.y - 4.0},
                  (*approach)->what == mechanics::Touch::kCables);
    caption({at.x + kMark, at.y}, within(**approach));
  }
  const auto& clearance = certificate.clearance;
  if (clearance && clearance->min_m > 0.0) {
    caption(rows.next(), "one carrier may stray by " + number_text(clearance->min_m) +
                             " m before anything touches: " + who(*clearance) + " would be the first");
  }
  return rows.end();
}

double draw_legend(Svg& svg, const Motion& motion, double top) {
  constexpr double kSwatch = 22.0;
  constexpr int kInARow = 16;
  Rows rows(top, kInARow, (kWidth - kMargin - kIndent) / kInARow);
  for (std::size_t i = 0; i < motion.carriers.size(); ++i) {
    const Point at = rows.next();
    svg.begin(carrier_tone(i));
    svg.line({at.x, at.y - 4.0}, {at.x + kSwatch, at.y - 4.0}, {2.4, 1.0, carrier_dash(i)});
    svg.words({at.x + kSwatch + 6.0, at.y}, std::to_string(motion.carriers[i].id), {kSmall, Anchor::kStart, true});
    svg.end();
  }
  return rows.end();
}

/// Two beside each other.
double draw_charts(Svg& svg, const mechanics::Plan& plan, const Certificate& certificate, const Motion& motion,
                   double top) {
  const double width = 0.5 * (kInner - kGap);
  const std::vector<Figure> all = figures(plan.limits);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t row = i / 2, column = i % 2;
    const double left = kMargin + static_cast<double>(column) * (width + kGap);
    const double row_top = top + static_cast<double>(row) * kChartHeight;
    draw_chart(svg, chart(all[i], motion, certificate),
               {left, row_top, left + width, row_top + kChartHeight - kBetweenCharts});
  }
  const std::size_t rows = (all.size() + 1) / 2;
  return top + static_cast<double>(rows) * kChartHeight;
}

}  // namespace

std::string plot_svg(const std::string& mission_name, const mechanics::Plan& plan, const Certificate& certificate) {
  const Motion moves = motion(plan, certificate);
  Svg svg;
  double y = draw_header(svg, mission_name, plan, certificate);
  const Frames views = frames(extents(moves), {kMargin, y}, kInner);
  draw_scene(svg, moves, views.above);
  draw_scene(svg, moves, views.side);
  y = draw_captions(svg, certificate, views.above.plot.bottom + kBelowFrame);
  y = draw_legend(svg, moves, y + 2.0);
  y = draw_charts(svg, plan, certificate, moves, y);
  return std::move(svg).finished(kWidth, y, mission_name, summary(plan, certificate) + ", " + verdict(certificate));
}

}  // namespace gyre::ground
