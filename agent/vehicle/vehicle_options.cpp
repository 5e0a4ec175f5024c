#include "agent/vehicle/vehicle_options.hpp"

namespace gyre::agent {

void add_vehicle_options(CLI::App& app, mechanics::Limits& limits) {
  const auto add = [&app](const char* option, const char* variable, std::optional<double>& limit, const char* what) {
    app.add_option(option, limit, what)->check(CLI::PositiveNumber)->envname(variable)->group("Vehicle limits");
  };
  add("--tension-max", "GYRE_TENSION_MAX", limits.tension_max_n, "strongest pull of the cable [N]");
  add("--length-min", "GYRE_LENGTH_MIN", limits.length_min_m, "shortest cable [m]");
  add("--length-max", "GYRE_LENGTH_MAX", limits.length_max_m, "longest cable [m]");
  add("--winch-rate-max", "GYRE_WINCH_RATE_MAX", limits.winch_rate_max_m_s, "fastest winch [m/s]");
  add("--speed-min", "GYRE_SPEED_MIN", limits.speed_min_m_s, "slowest flight of a plan that moves [m/s]");
  add("--speed-max", "GYRE_SPEED_MAX", limits.speed_max_m_s, "fastest flight [m/s]");
  add("--acceleration-max", "GYRE_ACCELERATION_MAX", limits.acceleration_max_m_s2, "strongest acceleration [m/s²]");
}

}  // namespace gyre::agent
