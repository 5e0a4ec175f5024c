#include "ground/flight/core/flight_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/text.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using mechanics::Range;

/// A micrometre, a micronewton: what is smaller has no meaning in a flight.
constexpr double kSmallest = 1e-6;

std::string marked(const std::string& figure, bool inside) {
  return inside ? figure : figure + " !";
}

std::string magnitude(const Range& range) {
  return number_text(std::max(std::abs(range.min), std::abs(range.max)), kSmallest);
}

std::vector<std::vector<std::string>> rows(const FlightReport& report) {
  std::vector<std::vector<std::string>> out;
  out.push_back({"", "", "tension", "length", "speed", "winch rate", "altitude swing"});
  out.push_back({"", "", "N", "m", "m/s", "m/s", "m"});
  for (const CarrierReport& carrier : report.carriers) {
    const auto figures = [](const Range& range) { return range_text(range, kSmallest); };
    const auto span = [](const Range& range) { return number_text(range.span(), kSmallest); };
    out.push_back({text("carrier %u", carrier.id), "certified", figures(carrier.tension_n.certified),
                   figures(carrier.length_m.certified), figures(carrier.speed_m_s.certified),
                   magnitude(carrier.winch_rate_m_s.certified), span(carrier.altitude_m.certified)});
    out.push_back({"", "flown", marked(figures(carrier.tension_n.flown), carrier.tension_n.inside),
                   marked(figures(carrier.length_m.flown), carrier.length_m.inside),
                   marked(figures(carrier.speed_m_s.flown), carrier.speed_m_s.inside),
                   marked(magnitude(carrier.winch_rate_m_s.flown), carrier.winch_rate_m_s.inside),
                   marked(span(carrier.altitude_m.flown), carrier.altitude_m.inside)});
  }
  return out;
}

std::string timing_line(const TimingRecord& timing) {
  const auto milliseconds = [](Duration duration) { return text("%.1f ms", seconds(duration) * 1e3); };
  return text("%llu carrier states and %llu beacons seen, %llu beacons missed by agents; ",
              static_cast<unsigned long long>(timing.carrier_states), static_cast<unsigned long long>(timing.beacons),
              static_cast<unsigned long long>(timing.beacons_missed)) +
         "simulator at most " + milliseconds(timing.simulator_lag_max) + " late, clocks uncertain by at most " +
         milliseconds(timing.clock_uncertainty_max) +
         (timing.latest.empty() ? ""
                                : ", " + timing.latest + " woke at most " + milliseconds(timing.late_max) + " late");
}

}  // namespace

FlightWords flight_words(const FlightReport& report) {
  const LoadRecord& load = report.load;
  return {rows(report),
          "displaced by at most " + text("%.3g mm", load.displacement_max_m * 1e3) +
              text(" (allowed %.4g), turned by at most %.2g degrees (allowed %.4g)",
                   report.load_tolerance.displacement_max_m * 1e3, load.rotation_max_deg,
                   report.load_tolerance.rotation_max_deg) +
              (report.load_inside ? "" : " !"),
          timing_line(report.timing)};
}

std::string flight_table(const FlightReport& report, Verdict verdict) {
  const FlightWords words = flight_words(report);
  std::string out = report.mission + text(": flown for %.1f s\n\n", report.flown_s) + aligned(words.rows) + "\n";
  out += "  load       " + words.load + "\n";
  out += "  timing     " + words.timing + "\n";
  if (verdict == Verdict::kLeftOut) return out + "\n";
  if (report.good()) return out + "\nGOOD: the flight stayed inside its certificate.\n";
  out += "\nOUTSIDE its certificate:\n";
  for (const std::string& violation : report.violations) out += "  - " + violation + "\n";
  return out;
}

}  // namespace gyre::ground
