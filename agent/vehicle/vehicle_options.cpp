#include "agent/vehicle/vehicle_options.hpp"

#include "common/base/angle.hpp"

namespace gyre::agent {

Machines VehicleOptions::machines() const {
  Machines out{winch, vehicle};
  out.winch.rate_max_m_s = limits.winch_rate_max_m_s;  // the drum does not know what stretches
  if (bank_max_deg) out.vehicle.bank_max_rad = radians(*bank_max_deg);
  return out;
}

std::optional<std::string> VehicleOptions::objection() const {
  if (vehicle.mass_kg || (!vehicle.thrust_max_n && !bank_max_deg)) return std::nullopt;
  return "thrust and bank cannot be judged without the vehicle's mass; give --mass";
}

program::OptionGroup vehicle_options(VehicleOptions& options) {
  mechanics::Limits& limits = options.limits;
  constexpr program::Bounds kUpright{0.0, 90.0};
  return {"Vehicle limits",
          {{"--tension-max", &limits.tension_max_n, "strongest pull of the cable [N]", program::kPositive},
           {"--length-min", &limits.length_min_m, "shortest cable [m]", program::kPositive},
           {"--length-max", &limits.length_max_m, "longest cable [m]", program::kPositive},
           {"--winch-rate-max", &limits.winch_rate_max_m_s, "fastest winch [m/s]", program::kPositive},
           {"--winch-acceleration-max", &options.winch.acceleration_max_m_s2,
            "strongest acceleration of the winch [m/s²]", program::kPositive},
           {"--speed-min", &limits.speed_min_m_s, "slowest flight of a plan that moves [m/s]", program::kPositive},
           {"--speed-max", &limits.speed_max_m_s, "fastest flight [m/s]", program::kPositive},
           {"--acceleration-max", &limits.acceleration_max_m_s2, "strongest acceleration [m/s²]", program::kPositive},
           {"--mass", &options.vehicle.mass_kg, "of the vehicle, which thrust and bank follow from [kg]",
            program::kPositive},
           {"--thrust-max", &options.vehicle.thrust_max_n, "strongest pull, its own weight included [N]",
            program::kPositive},
           {"--bank-max", &options.bank_max_deg, "greatest angle of that pull from the vertical [degrees]", kUpright}}};
}

}  // namespace gyre::agent
