#include "ground/report/core/sheets.hpp"

#include <algorithm>

#include "ground/plot/core/chart.hpp"
#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"
#include "ground/report/core/flown_charts.hpp"
#include "ground/report/core/flown_paths.hpp"

namespace gyre::ground {
namespace {

constexpr double kWidth = 1000.0, kMargin = 20.0, kInner = kWidth - 2.0 * kMargin, kGap = 28.0;
constexpr double kNameFont = 17.0, kNameHeight = 34.0, kChartHeight = 214.0, kBetweenCharts = 10.0;
constexpr double kLegendFont = 12.0, kLegendRow = 20.0, kBelowFrame = 44.0, kIndent = 44.0;
constexpr std::size_t kBeside = 2;

struct Outline {
  const char* name;
  const char* title;
  const char* caption;
  std::vector<Quantity> quantities;
};

/// Each carrier's tone; where the rows end.
double draw_legend(Svg& svg, const Places& places, double top) {
  constexpr double kSwatch = 22.0, kPitch = 56.0;
  const auto in_a_row = static_cast<std::size_t>((kInner - kIndent) / kPitch);
  std::size_t rows = 0;
  for (const auto& [id, place] : places) {
    const double x = kMargin + kIndent + static_cast<double>(place % in_a_row) * kPitch;
    const std::size_t row = place / in_a_row;
    const double y = top + 14.0 + static_cast<double>(row) * kLegendRow;
    rows = std::max(rows, row + 1);
    svg.begin(carrier_tone(place));
    svg.line({x, y - 4.0}, {x + kSwatch, y - 4.0}, {2.4, 1.0, carrier_dash(place)});
    svg.words({x + kSwatch + 6.0, y}, std::to_string(id), {kLegendFont, Anchor::kStart, true});
    svg.end();
  }
  return top + static_cast<double>(rows) * kLegendRow;
}

/// A tick, a cross or a question mark before the words, for those who cannot tell green from red.
void draw_name(Svg& svg, const Account& account, double left, double width, double baseline) {
  const char* const sign = account.standing == Standing::kInside    ? "\u2713 "
                           : account.standing == Standing::kOutside ? "\u2717 "
                                                                    : "? ";
  const Tone& tone = account.standing == Standing::kInside    ? kGood
                     : account.standing == Standing::kOutside ? kBad
                                                              : kMuted;
  const std::string words = shortened(sign + account.standing_words, kLegendFont, 0.6 * width);
  const double room = width - width_of(words, kLegendFont) - 16.0;
  svg.begin(kInk);
  svg.words({left, baseline}, shortened(account.name, kNameFont, room), {kNameFont, Anchor::kStart, true});
  svg.end();
  svg.begin(tone);
  svg.words({left + width, baseline}, words, {kLegendFont, Anchor::kEnd, true});
  svg.end();
}

Sheet finished(Svg&& svg, const Outline& outline, const std::vector<Account>& accounts, double height) {
  std::string names;
  for (const Account& account : accounts) names += (names.empty() ? "" : ", ") + account.name;
  std::string caption = outline.caption;
  if (accounts.size() > 1) {
    caption += of_one_size(accounts) ? " All flights in one scale."
                                     : " The flights differ much in size: each in a scale of its own.";
  }
  std::string picture = std::move(svg).finished(kWidth, height, std::string(outline.title) + ": " + names, caption);
  return {outline.name, outline.title, std::move(caption), std::move(picture)};
}

Sheet paths_sheet(const std::vector<Account>& accounts, const Places& all) {
  Svg svg;
  Extents every;
  for (const Account& account : accounts) every.include(flown_extents(account));
  const bool one_scale = of_one_size(accounts);
  double y = draw_legend(svg, all, 6.0);
  for (const Account& account : accounts) {
    const Extents shown = one_scale ? every : flown_extents(account);
    draw_name(svg, account, kMargin + kIndent, kInner - kIndent, y + 22.0);
    const Frames views = frames(shown, {kMargin, y + kNameHeight}, kInner);
    draw_paths(svg, account, all, views.above);
    draw_paths(svg, account, all, views.side);
    y = views.above.plot.bottom + kBelowFrame;
  }
  return finished(std::move(svg),
                  {"paths",
                   "Where the carriers flew",
                   "Fine lines: flown. Broad faint lines: the plan's orbits. Dots and thin cables: where the "
                   "recording begins.",
                   {}},
                  accounts, y);
}

Sheet charts_sheet(const Outline& outline, const std::vector<Account>& accounts, const Places& all) {
  const std::size_t columns = std::min(accounts.size(), kBeside);
  const double width = (kInner - kGap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  const double width_px = chart_width_px({0.0, 0.0, width, 1.0});
  std::vector<std::vector<Chart>> charts;  // by quantity, then by flight
  for (const Quantity quantity : outline.quantities) {
    charts.emplace_back();
    for (const Account& account : accounts) charts.back().push_back(flown_chart(quantity, account, all, width_px));
    if (of_one_size(accounts)) bring_to_one_scale(charts.back());
  }
  Svg svg;
  double y = draw_legend(svg, all, 6.0);
  for (std::size_t first = 0; first < accounts.size(); first += columns) {
    const std::size_t end = std::min(first + columns, accounts.size());
    for (std::size_t k = first; k < end; ++k) {
      const double left = kMargin + static_cast<double>(k - first) * (width + kGap);
      draw_name(svg, accounts[k], left + kIndent, width - kIndent, y + 22.0);
      for (std::size_t row = 0; row < charts.size(); ++row) {
        const double top = y + kNameHeight + static_cast<double>(row) * kChartHeight;
        draw_chart(svg, charts[row][k], {left, top, left + width, top + kChartHeight - kBetweenCharts});
      }
    }
    y += kNameHeight + static_cast<double>(charts.size()) * kChartHeight + kBetweenCharts;
  }
  return finished(std::move(svg), outline, accounts, y);
}

}  // namespace

std::vector<Sheet> sheets(const std::vector<Account>& accounts) {
  constexpr const char* kHowToRead =
      "Grey: certified for all time. At the right each carrier's certified band, and in it what was flown. The bar on "
      "the time axis: the motion at full pace.";
  const Places all = places(accounts);
  const std::vector<Outline> outlines{
      {"motion", "Altitudes and speeds", kHowToRead, {Quantity::kAltitude, Quantity::kSpeed}},
      {"cables", "Cables and winches", kHowToRead, {Quantity::kLength, Quantity::kWinchRate}},
      {"load",
       "Tensions, and the load's pose",
       kHowToRead,
       {Quantity::kTension, Quantity::kDisplacement, Quantity::kRotation}}};
  std::vector<Sheet> out{paths_sheet(accounts, all)};
  for (const Outline& outline : outlines) out.push_back(charts_sheet(outline, accounts, all));
  return out;
}

}  // namespace gyre::ground
