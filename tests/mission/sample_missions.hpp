#pragma once
// Mission texts that the tests of this room start from.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/places.hpp"

namespace gyre::test {

/// Well formed, one field per line where a test wants to name the line; every kind of length law is in it.
inline const std::string kGoodMission = R"(name: "good"
load {
  mass_kg: 6
  inertia_kg_m2 { x: 0.8 y: 0.8 z: 1.2 }
  position_m { x: 0 y: 0 z: 4 }
  orientation { w: 1 x: 0 y: 0 z: 0 } shape { box { x_m: 1.8 y_m: 1.7 z_m: 0.35 centre_m { z: 0.075 } } }
}
gravity_m_s2: 9.81
cable { stiffness_n_m: 1e4 damping_n_s_m: 1e3 compensate_stretch: true }
carrier { id: 1 attachment_m { x: 0.9 y: 0.1 z: 0.3 } level { altitude_m: 14 } radius_m: 0.4 vehicle { mass_kg: 2.5 thrust_max_n: 80 bank_max_deg: 35 time_constant_s: 0.15 } }
carrier { id: 2 attachment_m { x: 0 y: 0.8 z: 0.35 } fixed { length_m: 11 } }
carrier { id: 3 attachment_m { x: -0.8 y: 0 z: 0.25 } sine { mean_m: 11 swing_m: 1 rate_rad_s: 1.5 phase_rad: 0.2 } }
carrier { id: 4 attachment_m { x: 0 y: -0.85 z: 0.25 } directional { direction { x: 0.3 y: 0.1 z: 2 } mean_m: 12 } }
cycle {
  rate_rad_s: 1
  edge { from: 1 to: 2 offset_n: 6 amplitude_n: 4 phase_rad: 0.1 }
  edge { from: 2 to: 3 offset_n: 6 amplitude_n: 4 phase_rad: 1.1 }
  edge { from: 3 to: 4 offset_n: 6 amplitude_n: 4 phase_rad: 2.1 }
  edge { from: 4 to: 1 offset_n: 6 amplitude_n: 4 phase_rad: 3.4 }
}
limits { tension_min_n: 1 tension_max_n: 50 length_min_m: 2 length_max_m: 30 clearance_min_m: 0.5 }
winch { time_constant_s: 0.05 rate_max_m_s: 2 acceleration_max_m_s2: 9 }
simulation { lag_error: 0.2 carrier_time_constant_s: 0.1 wind { force_n { x: 1 y: -2 z: 0 } gust_n: 0.5 gust_time_s: 2 seed: 7 } }
transition { duration_s: 20 }
silence { fly_on {} }
)";

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << "the test looks for text that is not in the mission: " << what;
  if (at != std::string::npos) text.replace(at, what.size(), with);
  return text;
}

/// Each with its requirements beside it.
inline const std::vector<std::string> kDesignedMissions = {
    "duo",       "multirotor-trio", "multirotor-quartet", "multirotor-sextet", "multirotor-octet", "tilted-quartet",
    "wing-trio", "wing-quartet",    "wing-quintet",       "wing-sextet"};

inline const std::vector<std::string> kShippedMissions = [] {
  std::vector<std::string> all{
      "paper", "paper-fixed", "paper-headings", "paper-enduring", "pair-unrestricted", "pair-level",
      "pair",  "single",      "tri-mixed",      "penta-tilted",   "fixed-wing-trio",   "hex-multirotor"};
  all.insert(all.end(), kDesignedMissions.begin(), kDesignedMissions.end());
  return all;
}();

inline std::string shipped_path(const std::string& name) {
  return source_directory() + "/deploy/missions/" + name + ".textproto";
}

inline std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace gyre::test
