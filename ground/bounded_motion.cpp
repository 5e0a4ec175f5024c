#include "ground/bounded_motion.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::ground {

bool has_bounded_motion(const mechanics::Certificate& certificate) {
  return std::all_of(certificate.carriers.begin(), certificate.carriers.end(), [](const auto& carrier) {
    return std::isfinite(carrier.length_m.max) && std::isfinite(carrier.speed_m_s.max);
  });
}

std::string unbounded_text(const std::string& mission_file, const mechanics::Certificate& certificate) {
  std::string out = mission_file + ": there is no bounded motion to show:\n";
  for (const mechanics::Reason& reason : certificate.reasons)
    out += "  " + std::string(mechanics::name(reason.rule)) + ": " + reason.text + "\n";
  return out;
}

}  // namespace gyre::ground
