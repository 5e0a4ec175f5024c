#include "ground/check/certificate_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/mechanics/lag.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using mechanics::CarrierFigures;
using mechanics::Certificate;
using mechanics::Limits;
using mechanics::Range;
using Limit = std::optional<double>;

constexpr std::size_t kTextWidth = 100;

std::string limit(const Limit& min, const Limit& max) {
  if (min && max) return number_text(*min) + " .. " + number_text(*max);
  if (min) return ">= " + number_text(*min);
  if (max) return "<= " + number_text(*max);
  return "-";
}

std::string marked(const std::string& figure, bool broken) {
  return broken ? figure + " !" : figure;
}

std::string judged(const Range& figure, const Limit& min, const Limit& max) {
  return marked(range_text(figure), (min && !(figure.min >= *min)) || (max && !(figure.max <= *max)));
}

std::string judged_max(double figure, const Limit& max) {
  return marked(number_text(figure), max && !(figure <= *max));
}

/// |q_z| keeps its sign in any motion that is allowed.
double least_vertical_cosine(const CarrierFigures& figures) {
  return std::max(0.0, std::max(figures.vertical_cosine.min, -figures.vertical_cosine.max));
}

using Row = std::vector<std::string>;

std::vector<Row> rows(const Limits& limits, const Certificate& certificate) {
  std::vector<Row> out;
  out.push_back({"", "tension", "length", "winch rate", "speed", "acceleration", "altitude", "|q_z|"});
  out.push_back({"", "N", "m", "m/s", "m/s", "m/s^2", "m", ""});
  out.push_back({"limit", limit(limits.tension_min_n, limits.tension_max_n),
                 limit(limits.length_min_m, limits.length_max_m), limit({}, limits.winch_rate_max_m_s),
                 limit(limits.speed_min_m_s, limits.speed_max_m_s), limit({}, limits.acceleration_max_m_s2), "-",
                 limit(limits.vertical_cosine_min, {})});
  for (const CarrierFigures& figures : certificate.carriers) {
    const double cosine = least_vertical_cosine(figures);
    out.push_back(
        {"carrier " + std::to_string(figures.id), judged(figures.tension_n, limits.tension_min_n, limits.tension_max_n),
         judged(figures.length_m, limits.length_min_m, limits.length_max_m),
         judged_max(figures.winch_rate_max_m_s(), limits.winch_rate_max_m_s),
         judged(figures.speed_m_s, limits.speed_min_m_s, limits.speed_max_m_s),
         judged_max(figures.acceleration_max_m_s2, limits.acceleration_max_m_s2), range_text(figures.altitude_m),
         marked(number_text(cosine), limits.vertical_cosine_min && cosine < *limits.vertical_cosine_min)});
  }
  return out;
}

/// Words filled into lines, every line after the first behind `indent`.
std::string filled(const std::string& words, const std::string& indent) {
  std::string out;
  for (const std::string& line : wrapped(words, kTextWidth - indent.size())) {
    if (!out.empty()) out.append("\n").append(indent);
    out += line;
  }
  return out;
}

std::string listed(const std::vector<mechanics::Reason>& reasons) {
  std::string out;
  for (const mechanics::Reason& reason : reasons) {
    out += "  - " + filled(std::string(mechanics::name(reason.rule)) + ": " + reason.text, "    ") + "\n";
  }
  return out;
}

std::string approach_line(const std::optional<mechanics::Approach>& approach, const Limit& least_m) {
  if (!approach) return "-";
  std::string line = number_text(approach->min_m) + " m, " + mechanics::who(*approach);
  if (!least_m) return line;
  line += " (limit >= " + number_text(*least_m) + ")";
  return marked(line, approach->min_m < *least_m);
}

std::string clearance_line(const Limits& limits, const Certificate& certificate) {
  std::string line = approach_line(certificate.clearance, limits.clearance_min_m);
  if (certificate.above_load_min_m)
    line += "; vehicles " + number_text(*certificate.above_load_min_m) + " m above the load";
  return line;
}

std::string stiffness_line(const std::optional<double>& stiffness_min_1_s2) {
  return stiffness_min_1_s2 ? number_text(*stiffness_min_1_s2) + " 1/s^2 at its softest" : "-";
}

std::string growth_text(double growth_1_s) {
  if (growth_1_s > mechanics::kNeutralGrowth_1_s) return "one grows by " + number_text(growth_1_s) + " 1/s";
  if (growth_1_s < -mechanics::kNeutralGrowth_1_s)
    return "all die out, the slowest by " + number_text(-growth_1_s) + " 1/s";
  return "none grows";
}

std::string swing_line(const std::optional<mechanics::Swings>& swings) {
  if (!swings) return "-";
  const std::string margin = text("; within %.0f %% of rate and inertia ", 100.0 * mechanics::kSwingMargin);
  return marked(growth_text(swings->growth_1_s) + margin + growth_text(swings->worst_1_s),
                swings->worst_1_s > mechanics::kNeutralGrowth_1_s);
}

std::string skew_line(const std::optional<mechanics::SkewBudget>& budget) {
  if (!budget) return "-";
  const mechanics::SkewBudget& skew = *budget;
  if (!std::isfinite(skew.budget_s)) return "of any size";
  return "up to " + number_text(1e3 * skew.budget_s) + " ms keep the residual under " +
         text("%.0f %%", 100.0 * mechanics::kSkewShare) + " of the weight; " + number_text(skew.residual_n_per_s) +
         " N and " + number_text(1e3 * skew.displacement_m_per_s) + " mm per second of it";
}

std::string winches_line(const Certificate& certificate) {
  Range length, rate, acceleration;
  for (const CarrierFigures& figures : certificate.carriers) {
    length.include(figures.paid_out_m);
    rate.include(figures.paid_out_rate_max_m_s());
    acceleration.include(figures.winch_acceleration_max_m_s2);
  }
  if (!std::isfinite(length.min) || !std::isfinite(length.max)) return "-";
  return "pay out " + range_text(length) + " m, by up to " + number_text(rate.max) + " m/s and " +
         number_text(acceleration.max) + " m/s^2";
}

std::string vehicles_line(const Certificate& certificate) {
  Range thrust, bank;
  for (const CarrierFigures& figures : certificate.carriers) {
    if (figures.thrust_max_n) thrust.include(*figures.thrust_max_n);
    if (figures.bank_max_rad) bank.include(degrees(*figures.bank_max_rad));
  }
  if (!std::isfinite(thrust.max)) return "-";
  return "pull up to " + number_text(thrust.max) + " N, at up to " + number_text(bank.max) + " degrees";
}

std::string lag_line(const std::optional<double>& displacement_m) {
  if (!displacement_m || !std::isfinite(*displacement_m)) return "-";
  if (*displacement_m == 0.0) return "nothing is said to lag";
  return "lags that are " + text("%.0f %%", 100.0 * mechanics::kLagError) + " off move the load by " +
         number_text(1e3 * *displacement_m) + " mm";
}

/// What the swarm does without a word, and how long that is good for where it flies on.
std::string silence_line(const protocol::Silence& silence, const std::optional<mechanics::SkewBudget>& budget) {
  if (silence.stop_after) return "all stop together after " + number_text(seconds(*silence.stop_after)) + " s";
  if (!budget || !std::isfinite(budget->holdover_s)) return "all fly on";
  return "all fly on, and the clock skew stays within its bound for " + number_text(budget->holdover_s) +
         " s with clocks " + text("%.0f", 1e6 * mechanics::kHoldoverDrift) + " ppm apart";
}

}  // namespace

std::string certificate_table(const std::string& mission_name, const Limits& limits, const Certificate& certificate,
                              const protocol::Silence& silence) {
  const std::size_t broken = certificate.reasons.size();
  std::string out = mission_name + ": ";
  out += certificate.admissible()
             ? std::string("admissible")
             : "REFUSED, " + std::to_string(broken) + (broken == 1 ? " rule" : " rules") + " broken";
  out += "\n\n";
  out += aligned(rows(limits, certificate));
  out += "\n";
  out += "  period             " + number_text(certificate.period_s) + " s\n";
  out += "  separation         " + approach_line(certificate.separation, limits.separation_min_m) + "\n";
  out += "  cables apart       " + approach_line(certificate.cable_distance, {}) + "\n";
  out += "  clearance          " + clearance_line(limits, certificate) + "\n";
  out += "  wrench error       " + text("%.2g", certificate.wrench_error_max_n) + " N at most\n";
  out += "  load stiffness     " + stiffness_line(certificate.stiffness_min_1_s2) + "\n";
  out += "  swings             " + swing_line(certificate.swings) + "\n";
  out += "  clock skew         " + skew_line(certificate.skew) + "\n";
  out += "  winches            " + winches_line(certificate) + "\n";
  out += "  vehicles           " + vehicles_line(certificate) + "\n";
  out += "  lag                " + lag_line(certificate.lag_error_displacement_m) + "\n";
  out += "  silence            " + silence_line(silence, certificate.skew) + "\n";
  if (!certificate.admissible()) out += "\nWhy, and what would cure it:\n" + listed(certificate.reasons);
  if (!certificate.cautions.empty()) out += "\nNot forbidden, but look at it:\n" + listed(certificate.cautions);
  return out;
}

}  // namespace gyre::ground
