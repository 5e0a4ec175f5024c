#include "ground/swarm/account_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/text.hpp"

namespace gyre::ground {

std::string account_line(const Account& account) {
  std::string line = account.calm() ? "calm" : account.complaint;
  line += "; " + account.course;
  if (account.load.samples > 0) {
    line +=
        text("; load within %.3g mm and %.2g degrees, residual %.2g %% of the weight",
             1e3 * account.load.displacement_max_m, account.load.rotation_max_deg, 100.0 * account.load.residual_max);
  }
  using Late = std::pair<const std::string, Duration>;
  const auto latest = std::max_element(account.late_max.begin(), account.late_max.end(),
                                       [](const Late& a, const Late& b) { return a.second < b.second; });
  if (latest != account.late_max.end()) {
    line += "; " + latest->first + text(" woke at most %.1f ms late", 1e3 * seconds(latest->second));
  }
  if (account.skew > std::chrono::hours(1)) return line + "; clocks unknown";
  line += text("; clocks within %.3g ms", 1e3 * seconds(account.skew));
  if (account.skew_budget > Duration::zero()) line += text(" of %.3g", 1e3 * seconds(account.skew_budget));
  return line;
}

std::string account_json(const Account& account) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["time_s"] = account.time_s;
  json["calm"] = account.calm();
  json["complaint"] = account.complaint;
  json["course"] = account.course;
  json["term"] = account.term;
  json["silent"] = account.silent;
  json["complaints"] = Json::object();
  for (const auto& [process, words] : account.complaints) json["complaints"][process] = words;
  json["late_s"] = Json::object();
  for (const auto& [process, late] : account.late_max) json["late_s"][process] = seconds(late);
  json["load"] = {{"displacement_max_m", account.load.displacement_max_m},
                  {"displacement_allowed_m", account.allowed.displacement_max_m},
                  {"rotation_max_deg", account.load.rotation_max_deg},
                  {"rotation_allowed_deg", account.allowed.rotation_max_deg},
                  {"residual_max", account.load.residual_max},
                  {"samples", account.load.samples}};
  json["skew_s"] = seconds(account.skew);
  json["skew_budget_s"] = account.skew_budget > Duration::zero() ? Json(seconds(account.skew_budget)) : Json();
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace gyre::ground
