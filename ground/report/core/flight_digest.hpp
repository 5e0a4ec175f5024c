#pragma once
// What a recording shows of a flight, gathered message by message, in memory that depends on the number of carriers and
// not on how long they flew: each figure over time, where everybody was, when the motion ran at full pace, and the
// record by which `gyre fly` judges.
//
// Whom to believe, which plan is the mission's and when the motion is on: all of it is asked of the same parts that
// `gyre fly` asks (swarm/core/swarm_view.hpp, flight/core/flight_monitor.hpp), so that both say the same of one flight.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mission/mission.hpp"
#include "ground/flight/core/flight_certificate.hpp"
#include "ground/flight/core/flight_monitor.hpp"
#include "ground/flight/core/flight_record.hpp"
#include "ground/flight/core/flight_report.hpp"
#include "ground/report/core/envelope.hpp"
#include "ground/report/core/time_axis.hpp"
#include "ground/report/core/trace.hpp"

namespace gyre::ground {

struct CarrierSeries {
  Envelope tension_n, length_m, speed_m_s, winch_rate_m_s, altitude_m;
  Trace path;
};

struct LoadSeries {
  Envelope displacement_mm, rotation_deg;  ///< from the mission's pose; without a mission from the first one told
  Trace path;
};

/// A silence of a stream of states, and whose.
struct Silence {
  std::string who;
  double begin_s = 0.0, duration_s = 0.0;
};

class FlightDigest {
 public:
  /// `mission`: what was flown; absent: nobody knows, and nothing is judged.
  explicit FlightDigest(std::optional<mission::Mission> mission);
  FlightDigest(const FlightDigest&) = delete;
  FlightDigest& operator=(const FlightDigest&) = delete;

  /// In the order in which they were heard, as near as the recording has it.
  void see(LocalTime heard, const SwarmMessage& message);

  [[nodiscard]] const std::optional<mission::Mission>& mission() const { return mission_; }
  [[nodiscard]] const std::map<CarrierId, CarrierSeries>& carriers() const { return carriers_; }
  [[nodiscard]] const LoadSeries& load() const { return load_; }
  [[nodiscard]] const SwarmView& view() const { return view_; }
  [[nodiscard]] const TimeAxis& axis() const { return axis_; }

  /// Seconds of this recording at which the motion was on at full pace.
  [[nodiscard]] const std::vector<mechanics::Range>& motion_s() const { return motion_s_; }
  /// From where a report counts: the first of these, and where there is none the recording's begin.
  [[nodiscard]] double zero_s() const { return motion_s_.empty() ? 0.0 : motion_s_.front().min; }
  [[nodiscard]] double flown_s() const { return flown_s_; }
  /// Of all that was believed; empty before the first message.
  [[nodiscard]] const mechanics::Range& recorded_s() const { return recorded_s_; }
  /// The longest of each stream, where it is a silence at all; also one that ends with the last of them.
  [[nodiscard]] std::vector<Silence> silences() const;
  /// Names of missions, in the order in which the coordinator named them.
  [[nodiscard]] const std::vector<std::string>& missions_told() const { return missions_told_; }
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

  /// Against the certificate; absent where there is no mission, or nothing of its motion was recorded.
  [[nodiscard]] std::optional<FlightReport> judged() const;

 private:
  struct Stream {
    std::optional<double> last_s;
    Silence longest;
  };
  void note_motion(LocalTime heard, double t_s);
  /// How long it was silent.
  double note_stream(const std::string& who, double t_s);
  void on(LocalTime heard, double t_s, const protocol::CarrierState& state);
  void on(LocalTime heard, double t_s, const protocol::LoadState& state);
  void on(const protocol::CoordinatorStatus& status);

  std::optional<mission::Mission> mission_;
  SwarmView view_;
  std::optional<FlightMonitor> monitor_;  // reads view_
  std::optional<FlightRecord> record_;
  std::optional<FlightCertificate> certificate_;
  TimeAxis axis_;
  std::map<CarrierId, CarrierSeries> carriers_;
  LoadSeries load_;
  std::optional<protocol::LoadState> load_reference_;
  std::map<std::string, Stream> streams_;
  std::vector<mechanics::Range> motion_s_;
  bool in_motion_ = false;
  double flown_s_ = 0.0;
  mechanics::Range recorded_s_;
  std::vector<std::string> missions_told_;
  std::uint64_t messages_ = 0;
};

}  // namespace gyre::ground
