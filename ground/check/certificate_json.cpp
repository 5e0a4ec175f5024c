#include "ground/check/certificate_json.hpp"

#include <cmath>
#include <optional>

#include "common/base/angle.hpp"

namespace gyre::ground {
namespace {

using Json = nlohmann::ordered_json;

Json figure(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json figure(const std::optional<double>& value) {
  return value ? figure(*value) : Json(nullptr);
}

/// A member of something that may be absent.
template <class Whole>
Json figure(const std::optional<Whole>& whole, double Whole::*member) {
  return whole ? figure((*whole).*member) : Json(nullptr);
}

/// Who comes close to whom; the load is null.
Json pair_json(const std::optional<mechanics::Approach>& approach) {
  if (!approach) return nullptr;
  return Json::array({approach->first, approach->second != 0 ? Json(approach->second) : Json(nullptr)});
}

Json reasons_json(const std::vector<mechanics::Reason>& reasons) {
  Json out = Json::array();
  for (const mechanics::Reason& reason : reasons) {
    out.push_back({{"rule", mechanics::name(reason.rule)},
                   {"carrier", reason.carrier ? Json(*reason.carrier) : Json(nullptr)},
                   {"text", reason.text}});
  }
  return out;
}

Json carrier_json(const mechanics::CarrierFigures& carrier) {
  return {{"id", carrier.id},
          {"tension_min_n", figure(carrier.tension_n.min)},
          {"tension_max_n", figure(carrier.tension_n.max)},
          {"length_min_m", figure(carrier.length_m.min)},
          {"length_max_m", figure(carrier.length_m.max)},
          {"winch_rate_max_m_s", figure(carrier.winch_rate_max_m_s())},
          {"speed_min_m_s", figure(carrier.speed_m_s.min)},
          {"speed_max_m_s", figure(carrier.speed_m_s.max)},
          {"acceleration_max_m_s2", figure(carrier.acceleration_max_m_s2)},
          {"altitude_min_m", figure(carrier.altitude_m.min)},
          {"altitude_max_m", figure(carrier.altitude_m.max)},
          {"altitude_swing_m", figure(carrier.altitude_m.span())},
          {"vertical_cosine_min", figure(carrier.vertical_cosine.min)},
          {"vertical_cosine_max", figure(carrier.vertical_cosine.max)},
          {"direction_cosine_min", figure(carrier.direction_cosine_min)},
          {"winch_paid_out_min_m", figure(carrier.paid_out_m.min)},
          {"winch_paid_out_max_m", figure(carrier.paid_out_m.max)},
          {"winch_paid_out_rate_max_m_s", figure(carrier.paid_out_rate_max_m_s())},
          {"winch_acceleration_max_m_s2", figure(carrier.winch_acceleration_max_m_s2)},
          {"thrust_max_n", figure(carrier.thrust_max_n)},
          {"bank_max_deg", carrier.bank_max_rad ? figure(degrees(*carrier.bank_max_rad)) : Json(nullptr)}};
}

Json paces_json(const std::optional<mechanics::Swings>& swings) {
  if (!swings) return nullptr;
  Json out = Json::array();
  for (const mechanics::PaceGrowth& p : swings->paces) {
    out.push_back({{"pace", p.pace}, {"growth_1_s", figure(p.growth_1_s)}});
  }
  return out;
}

}  // namespace

Json certificate_json(const std::string& mission_name, const mechanics::Certificate& certificate,
                      const protocol::Silence& silence) {
  Json carriers = Json::array();
  for (const mechanics::CarrierFigures& carrier : certificate.carriers) carriers.push_back(carrier_json(carrier));

  const auto& separation = certificate.separation;
  const auto& clearance = certificate.clearance;
  const auto& skew = certificate.skew;
  return {{"name", mission_name},
          {"verdict", certificate.admissible() ? "admissible" : "refused"},
          {"reasons", reasons_json(certificate.reasons)},
          {"cautions", reasons_json(certificate.cautions)},
          {"period_s", figure(certificate.period_s)},
          {"wrench_error_max_n", figure(certificate.wrench_error_max_n)},
          {"skew_budget_s", figure(skew, &mechanics::SkewBudget::budget_s)},
          {"skew_residual_n_per_s", figure(skew, &mechanics::SkewBudget::residual_n_per_s)},
          {"skew_displacement_m_per_s", figure(skew, &mechanics::SkewBudget::displacement_m_per_s)},
          {"skew_moment_n_m_per_s", figure(skew, &mechanics::SkewBudget::residual_n_m_per_s)},
          {"lag_error_displacement_m", figure(certificate.lag_error_displacement_m)},
          {"holdover_s", figure(skew, &mechanics::SkewBudget::holdover_s)},
          {"silence_stop_after_s", silence.stop_after ? Json(seconds(*silence.stop_after)) : Json(nullptr)},
          {"carrier_separation_min_m", figure(separation, &mechanics::Approach::min_m)},
          {"carrier_separation_pair", pair_json(separation)},
          {"cable_distance_min_m", figure(certificate.cable_distance, &mechanics::Approach::min_m)},
          {"cable_distance_pair", pair_json(certificate.cable_distance)},
          {"clearance_min_m", figure(clearance, &mechanics::Approach::min_m)},
          {"clearance_of", clearance ? Json(mechanics::name(clearance->what)) : Json(nullptr)},
          {"clearance_pair", pair_json(clearance)},
          {"clearance_at_s", figure(clearance, &mechanics::Approach::at_s)},
          {"above_load_min_m", figure(certificate.above_load_min_m)},
          {"stiffness_min_1_s2", figure(certificate.stiffness_min_1_s2)},
          {"swing_growth_1_s", figure(certificate.swings, &mechanics::Swings::growth_1_s)},
          {"swing_growth_worst_1_s", figure(certificate.swings, &mechanics::Swings::worst_1_s)},
          {"swing_paces", paces_json(certificate.swings)},
          {"carriers", carriers}};
}

}  // namespace gyre::ground
