#include "ground/report/core/flown_charts.hpp"

#include <algorithm>
#include <optional>

namespace gyre::ground {
namespace {

using mechanics::CarrierFigures;
using mechanics::Limits;
using mechanics::Range;

/// Where a quantity of carriers stands in all that speaks of it.
struct Kind {
  const char* title;
  const char* unit;
  Envelope CarrierSeries::*series;
  Range CarrierFigures::*certified;
  JudgedRange CarrierReport::*judged;
};

Kind kind(Quantity quantity) {
  switch (quantity) {
    case Quantity::kAltitude:
      return {"Altitude", "m", &CarrierSeries::altitude_m, &CarrierFigures::altitude_m, &CarrierReport::altitude_m};
    case Quantity::kSpeed:
      return {"Speed", "m/s", &CarrierSeries::speed_m_s, &CarrierFigures::speed_m_s, &CarrierReport::speed_m_s};
    case Quantity::kLength:
      return {"Cable length", "m", &CarrierSeries::length_m, &CarrierFigures::length_m, &CarrierReport::length_m};
    case Quantity::kWinchRate:
      return {"Winch rate", "m/s", &CarrierSeries::winch_rate_m_s, &CarrierFigures::winch_rate_m_s,
              &CarrierReport::winch_rate_m_s};
    default:
      return {"Tension", "N", &CarrierSeries::tension_n, &CarrierFigures::tension_n, &CarrierReport::tension_n};
  }
}

void put_limits(Quantity quantity, const Limits& limits, Chart& chart) {
  const auto both = [&chart](const std::optional<double>& least, const std::optional<double>& most) {
    chart.limit_min = least;
    chart.limit_max = most;
  };
  const auto& rate = limits.winch_rate_max_m_s;
  if (quantity == Quantity::kSpeed) both(limits.speed_min_m_s, limits.speed_max_m_s);
  if (quantity == Quantity::kLength) both(limits.length_min_m, limits.length_max_m);
  if (quantity == Quantity::kTension) both(limits.tension_min_n, limits.tension_max_n);
  if (quantity == Quantity::kWinchRate) both(rate ? std::optional<double>(-*rate) : std::nullopt, rate);
}

const CarrierFigures* certified_of(const Account& account, CarrierId id) {
  if (!account.certified) return nullptr;
  const auto& all = account.certified->certificate.carriers;
  const auto found = std::find_if(all.begin(), all.end(), [id](const CarrierFigures& f) { return f.id == id; });
  return found == all.end() ? nullptr : &*found;
}

const CarrierReport* verdict_of(const Account& account, CarrierId id) {
  if (!account.verdict) return nullptr;
  const auto& all = account.verdict->carriers;
  const auto found = std::find_if(all.begin(), all.end(), [id](const CarrierReport& r) { return r.id == id; });
  return found == all.end() ? nullptr : &*found;
}

/// One that is told for a single moment is a dot's length long.
ChartLine line(const Envelope& envelope, double zero_s, double width_s) {
  ChartLine out;
  out.pieces = envelope.pieces(width_s);
  for (std::vector<Point>& piece : out.pieces) {
    for (Point& point : piece) point.x -= zero_s;
    if (piece.size() == 1) piece.push_back({piece.front().x + width_s, piece.front().y});
  }
  return out;
}

void add_carriers(Quantity quantity, const Account& account, const Places& places, double zero_s, double width_s,
                  Chart& chart) {
  const Kind about = kind(quantity);
  chart.title = about.title;
  chart.unit = about.unit;
  if (account.certified) put_limits(quantity, account.digest->mission()->plan.limits, chart);
  for (const auto& [id, series] : account.digest->carriers()) {
    const Envelope& envelope = series.*about.series;
    ChartLine drawn = line(envelope, zero_s, width_s);
    drawn.tone = carrier_tone(places.at(id));
    if (const auto* figures = certified_of(account, id)) drawn.certified = figures->*about.certified;
    const CarrierReport* verdict = verdict_of(account, id);
    drawn.flown = verdict ? (verdict->*about.judged).flown : envelope.figures();
    // The band is of the motion; what leads to it and away from it is to be seen, too.
    Range all = envelope.figures();
    if (chart.shows) all.include(*chart.shows);
    chart.shows = all;
    chart.lines.push_back(std::move(drawn));
  }
}

void add_load(Quantity quantity, const Account& account, double zero_s, double width_s, Chart& chart) {
  const bool displacement = quantity == Quantity::kDisplacement;
  const LoadSeries& load = account.digest->load();
  const Envelope& envelope = displacement ? load.displacement_mm : load.rotation_deg;
  chart.title = displacement ? "Load off its place" : "Load turned";
  chart.unit = displacement ? "mm" : "degrees";
  if (const auto& mission = account.digest->mission()) {
    const mission::LoadTolerance& allowed = mission->load_tolerance;
    chart.limit_max = displacement ? allowed.displacement_max_m * 1e3 : allowed.rotation_max_deg;
  }
  chart.shows = Range{0.0, 0.0};
  if (envelope.empty()) return;
  ChartLine drawn = line(envelope, zero_s, width_s);
  drawn.tone = kInk;
  drawn.flown = envelope.figures();
  chart.lines.push_back(std::move(drawn));
}

}  // namespace

Places places(const std::vector<Account>& accounts) {
  Places out;
  const auto meet = [&out](CarrierId id) { out.try_emplace(id, out.size()); };
  for (const Account& account : accounts) {
    if (account.digest->mission()) {
      for (const mechanics::Carrier& carrier : account.digest->mission()->plan.carriers) meet(carrier.id);
    }
    for (const auto& [id, series] : account.digest->carriers()) meet(id);
  }
  return out;
}

Chart flown_chart(Quantity quantity, const Account& account, const Places& places, double width_px) {
  const FlightDigest& digest = *account.digest;
  const bool moved = !digest.motion_s().empty();
  const double zero_s = digest.zero_s();
  const Range recorded = digest.recorded_s();
  Chart chart;
  chart.fine = true;
  chart.time_s = {recorded.min - zero_s, std::max(recorded.max, recorded.min + 1e-3) - zero_s};
  chart.time_name = moved ? "time since full pace, s" : "time, s";
  for (const Range& motion : digest.motion_s()) chart.marked_s.push_back({motion.min - zero_s, motion.max - zero_s});
  const double width_s = chart.time_s.span() / width_px;
  if (quantity == Quantity::kDisplacement || quantity == Quantity::kRotation) {
    add_load(quantity, account, zero_s, width_s, chart);
  } else {
    add_carriers(quantity, account, places, zero_s, width_s, chart);
  }
  return chart;
}

void bring_to_one_scale(std::vector<Chart>& charts) {
  // Once for what is shown, and once more because a limit may come in by that.
  for (int turn = 0; turn < 2; ++turn) {
    Range shows, time_s;
    for (const Chart& chart : charts) {
      shows.include(chart_shows(chart));
      time_s.include(chart.time_s);
    }
    for (Chart& chart : charts) {
      chart.shows = shows;
      chart.time_s = time_s;
    }
  }
}

}  // namespace gyre::ground
