#include "coordinator/core/ramps.hpp"

#include <algorithm>

#include "common/base/text.hpp"

namespace gyre::coordinator {
namespace {

/// Tried one after the other, until one keeps all limits.
constexpr double kLonger = 1.25;
/// What is at a limit keeps it; figures are proven, and rounded outwards.
constexpr double kRounding = 1.0 + 1e-4;

bool breaks(double value, const std::optional<double>& limit) {
  return limit && !(value <= kRounding * *limit);
}

}  // namespace

void RampLimits::include(const mechanics::CarrierFigures& carrier) {
  const auto asks_more = [](const mechanics::CarrierFigures& a, const mechanics::CarrierFigures& b) {
    return a.speed_m_s.max >= b.speed_m_s.max && a.acceleration_max_m_s2 >= b.acceleration_max_m_s2 &&
           a.winch_rate_max_m_s() >= b.winch_rate_max_m_s() && a.paid_out_rate_max_m_s() >= b.paid_out_rate_max_m_s() &&
           a.winch_acceleration_max_m_s2 >= b.winch_acceleration_max_m_s2;
  };
  for (const mechanics::CarrierFigures& other : figures) {
    if (asks_more(other, carrier)) return;
  }
  figures.erase(std::remove_if(figures.begin(), figures.end(), [&](const auto& c) { return asks_more(carrier, c); }),
                figures.end());
  figures.push_back(carrier);
}

std::optional<std::string> RampLimits::broken_by(const protocol::Ramp& ramp) const {
  for (const mechanics::CarrierFigures& c : figures) {
    const protocol::RampPeaks peak = protocol::peaks(ramp, c.speed_m_s.max, c.acceleration_max_m_s2);
    if (breaks(peak.acceleration_m_s2, limits.acceleration_max_m_s2)) {
      return text("carrier %u: acceleration up to %.4g m/s^2, allowed %.4g", c.id, peak.acceleration_m_s2,
                  *limits.acceleration_max_m_s2);
    }
    if (winch.acceleration_max_m_s2) {
      const double acceleration_m_s2 =
          protocol::peaks(ramp, c.paid_out_rate_max_m_s(), c.winch_acceleration_max_m_s2).acceleration_m_s2;
      if (breaks(acceleration_m_s2, winch.acceleration_max_m_s2)) {
        return text("carrier %u: its winch accelerated by up to %.4g m/s^2, allowed %.4g", c.id, acceleration_m_s2,
                    *winch.acceleration_max_m_s2);
      }
    }
    if (peak.pace > 1.0 && (breaks(peak.pace * c.speed_m_s.max, limits.speed_max_m_s) ||
                            breaks(peak.pace * c.winch_rate_max_m_s(), limits.winch_rate_max_m_s) ||
                            breaks(peak.pace * c.paid_out_rate_max_m_s(), winch.rate_max_m_s))) {
      return text("carrier %u: it would run at up to %.4g of its pace", c.id, peak.pace);
    }
  }
  return std::nullopt;
}

Result<Duration> ramp_duration(const protocol::Pace& pace, const RampWish& wish, const RampLimits& limits,
                               Duration longest) {
  const bool stops = wish.target == 0.0;
  for (Duration d = wish.shortest; d <= longest; d = from_seconds(kLonger * seconds(d))) {
    const auto why = limits.broken_by(pace.with_ramp(wish.start, d, wish.target).ramps.back());
    if (!why) return d;
    if (wish.fixed && !stops) return Error{"it would break a limit: " + *why};
  }
  if (!stops) return Error{"no ramp to that pace keeps the mission's limits"};
  return wish.shortest;
}

protocol::Pace stopped_at(PlanTime where, const protocol::Pace& pace, SwarmTime start, Duration duration) {
  constexpr double kFastest = 0.3;
  constexpr double kUnnoticed_s = 1e-3;
  constexpr Duration kGently = std::chrono::seconds(1);
  const SwarmTime end = start + duration;
  protocol::Pace out = pace.with_ramp(start, duration, 0.0);
  const double beyond_s = seconds(out.at(end).at - where);
  if (beyond_s < kUnnoticed_s) return out;
  const double back = std::min(kFastest, beyond_s);
  out = pace.with_ramp(start, duration, -back);
  // A ramp of a second that ends at rest goes half of what its first pace would.
  const double steady_s = seconds(out.at(end).at - where) / back - 0.5 * seconds(kGently);
  return out.with_ramp(end + from_seconds(std::max(0.0, steady_s)), kGently, 0.0);
}

Duration stopping_time(const RampLimits& limits, Duration shortest, Duration longest) {
  protocol::Ramp stop{SwarmTime{}, shortest, {PlanTime{}, 1.0, 0.0, 0.0}, 0.0};
  while (limits.broken_by(stop) && stop.duration < longest) {
    stop.duration = from_seconds(kLonger * seconds(stop.duration));
  }
  return stop.duration;
}

std::optional<std::string> too_slow(double pace, const mechanics::Limits& limits,
                                    const std::vector<mechanics::CarrierFigures>& figures) {
  const auto& least = limits.speed_min_m_s;
  if (!least || pace <= 0.0 || pace >= 1.0) return std::nullopt;
  for (const mechanics::CarrierFigures& c : figures) {
    if (pace * c.speed_m_s.min < *least) {
      return text("carrier %u would fly at %.3g m/s, at least %.3g are asked for", c.id, pace * c.speed_m_s.min,
                  *least);
    }
  }
  return std::nullopt;
}

std::optional<std::string> swing_grows(double pace, const std::optional<mechanics::Swings>& swings) {
  if (!swings || pace <= 0.0 || pace >= 1.0) return std::nullopt;
  const double growth_1_s = swings->growth_at(pace);
  if (growth_1_s <= mechanics::kNeutralGrowth_1_s) return std::nullopt;
  return text(
      "at %.3g of full pace a swing of the load grows by up to %.2g/s: it may be passed, and nobody stays there", pace,
      growth_1_s);
}

}  // namespace gyre::coordinator
