#include "agent/vehicle/vehicle_options.hpp"

namespace gyre::agent {

program::OptionGroup vehicle_options(mechanics::Limits& limits) {
  return {"Vehicle limits",
          {{"--tension-max", &limits.tension_max_n, "strongest pull of the cable [N]", program::kPositive},
           {"--length-min", &limits.length_min_m, "shortest cable [m]", program::kPositive},
           {"--length-max", &limits.length_max_m, "longest cable [m]", program::kPositive},
           {"--winch-rate-max", &limits.winch_rate_max_m_s, "fastest winch [m/s]", program::kPositive},
           {"--speed-min", &limits.speed_min_m_s, "slowest flight of a plan that moves [m/s]", program::kPositive},
           {"--speed-max", &limits.speed_max_m_s, "fastest flight [m/s]", program::kPositive},
           {"--acceleration-max", &limits.acceleration_max_m_s2, "strongest acceleration [m/s²]", program::kPositive}}};
}

}  // namespace gyre::agent
