#pragma once
// A mission: a plan, the things that fly it, and what to do when something is lost; read from text, written back.
//
// Intuition: the file is judged once, here, and completely. Whoever holds a Mission holds a plan that is well formed
// (plan.hpp says what that means); whether it is admissible is the certificate's question. A bad file is answered
// with every complaint in it, one per line, as `file:line:column: field: what is wrong; what would be right`.
//
// Units and frames are in the names; the schema and the meaning of absent fields stand in idl/mission.proto.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "common/base/result.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/silence.hpp"

namespace gyre::mission {

/// Force on the load, W. The same seed gives the same gusts.
struct Wind {
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();
  double gust_n = 0.0;  ///< standard deviation per axis
  double gust_time_s = 1.0;
  std::uint64_t seed = 1;
};

struct Simulation {
  std::optional<double> carrier_time_constant_s;  ///< that no agent knows of; absent: as their vehicles say
  double lag_error = 0.0;                         ///< true lags are 1 + this times the declared ones
  std::optional<Wind> wind;                       ///< absent: calm
};

/// How far the load may leave its pose in a flight that counts as good.
struct LoadTolerance {
  double displacement_max_m = 0.01;
  double rotation_max_deg = 1.0;
};

struct Mission {
  std::string name = "unnamed";
  mechanics::Plan plan;
  Simulation simulation;
  std::set<CarrierId> holds;                    ///< whose vehicles brake without setpoints; the others go on
  std::optional<double> transition_duration_s;  ///< absent: the coordinator chooses
  protocol::Silence silence;
  LoadTolerance load_tolerance;
};

/// Larger files are refused unread; the largest sensible mission has a hundred carriers.
inline constexpr std::size_t kMaxMissionBytes = std::size_t{1} << 20;

/// `source_name` is what complaints call the text, the file's name as a rule.
[[nodiscard]] Result<Mission> parse_mission(const std::string& text, const std::string& source_name);

[[nodiscard]] Result<Mission> read_mission_file(const std::string& path);

/// The mission as a file that parse_mission reads back to the same mission.
[[nodiscard]] std::string to_text(const Mission& mission);

}  // namespace gyre::mission
