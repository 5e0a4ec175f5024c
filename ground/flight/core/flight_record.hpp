#pragma once
// What a flight did: extremes of every figure that the certificate speaks of, gathered sample by sample.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/mechanics/range.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct FlownFigures {
  mechanics::Range tension_n;
  mechanics::Range length_m;  ///< attachment to carrier
  mechanics::Range speed_m_s;
  mechanics::Range winch_rate_m_s;
  mechanics::Range altitude_m;  ///< of the carrier, W
  std::uint64_t samples = 0;

  void include(const protocol::CarrierState& state);
};

struct CarrierRecord {
  CarrierId id = 0;
  FlownFigures motion;  ///< at full pace
  FlownFigures whole;   ///< all of the flight
};

struct LoadRecord {
  double displacement_now_m = 0.0;  ///< from the mission's pose
  double rotation_now_deg = 0.0;
  double displacement_max_m = 0.0;
  double rotation_max_deg = 0.0;
  std::uint64_t samples = 0;
};

/// How the processes kept time.
struct TimingRecord {
  std::uint64_t carrier_states = 0;
  std::uint64_t beacons = 0;         ///< heard here
  std::uint64_t beacons_missed = 0;  ///< by all agents together, in the flight
  Duration clock_uncertainty_max{};  ///< of any agent, in the flight
  Duration simulator_lag_max{};      ///< the load's state against the earliest it ever was
  Duration late_max{};               ///< how late a main loop woke, at worst
  std::string latest;                ///< whose; "agent 3"
};

class FlightRecord {
 public:
  explicit FlightRecord(const mechanics::Plan& plan);

  /// `motion_proper`: at full pace. A carrier that is not of this mission is not recorded,
  /// nonsense of anybody (protocol/sanity.hpp) neither.
  void see(const protocol::CarrierState& state, bool motion_proper);
  void see(const protocol::LoadState& state, LocalTime arrived);
  void see(const protocol::AgentStatus& status);
  void see(const protocol::Health& health);
  void see_beacon() { ++timing_.beacons; }

  [[nodiscard]] const std::vector<CarrierRecord>& carriers() const { return carriers_; }
  [[nodiscard]] const LoadRecord& load() const { return load_; }
  [[nodiscard]] TimingRecord timing() const;

 private:
  struct Missed {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
  };

  Eigen::Vector3d position_w_m_;
  Eigen::Quaterniond orientation_w_b_;
  std::vector<CarrierRecord> carriers_;
  LoadRecord load_;
  TimingRecord timing_;
  std::map<CarrierId, Missed> missed_;
  std::optional<Duration> least_delay_;
};

}  // namespace gyre::ground
