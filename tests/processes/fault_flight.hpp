#pragma once
// A flight of the real programs, each started and ended on its own, so that any of them can be killed, stopped and
// started again; `gyre fly` would end the flight.
//
// Everything happens in the network this process is in, on domain 0. Nobody survives the object.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/mission/mission.hpp"
#include "ground/flight/child_process.hpp"
#include "tests/processes/flight_observer.hpp"

namespace gyre::test {

struct ClockFault {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
};

/// Names of the processes: "coordinator", "simulator", "agent 3".
[[nodiscard]] std::string agent_name(CarrierId carrier);

class FaultFlight {
 public:
  struct Options {
    std::string mission;        ///< path
    std::string log_directory;  ///< exists
    std::string program_directory;
    std::map<std::string, ClockFault> clocks;  ///< by process
    bool engage = true;                        ///< as soon as all are ready
    bool simulator = true;
    Watch watch = Watch::kEverything;
    bool laboratory = false;  ///< the processes listen to disturbances
  };

  /// Starts the observer and every process.
  [[nodiscard]] static Result<std::unique_ptr<FaultFlight>> start(const Options& options);

  void start_process(const std::string& name, const std::vector<std::string>& more = {});
  void send(const std::string& name, int signal) { processes_.at(name).send(signal); }
  void kill(const std::string& name);  ///< and buries it
  [[nodiscard]] pid_t pid(const std::string& name) const { return processes_.at(name).pid(); }
  /// Of its present life; all lives together in the log.
  [[nodiscard]] std::string said(const std::string& name) const;
  [[nodiscard]] std::string said_by_all() const;

  [[nodiscard]] const mission::Mission& mission() const { return mission_; }
  [[nodiscard]] const std::vector<CarrierId>& carriers() const { return carriers_; }
  [[nodiscard]] FlightObserver& observer() { return *observer_; }
  [[nodiscard]] const FlightObserver& observer() const { return *observer_; }

  /// How long it took until it held; absent when it did not within the limit.
  [[nodiscard]] static std::optional<double> seconds_until(double limit_s, const std::function<bool()>& condition);

  /// Every agent's newest status, not older than 300 ms, is so.
  [[nodiscard]] bool every_agent(const std::function<bool(const protocol::AgentStatus&)>& is_so) const;
  /// At full pace, with no change under way.
  [[nodiscard]] bool all_flying() const;
  /// At rest, and hearing the coordinator.
  [[nodiscard]] bool all_ready() const;
  /// At rest, whoever hears whom.
  [[nodiscard]] bool all_at_rest() const;
  /// The newest.
  [[nodiscard]] std::optional<protocol::Beacon> beacon() const;
  [[nodiscard]] std::optional<protocol::CommandReply> reply(std::uint64_t command) const;
  [[nodiscard]] std::uint64_t term() const;

 private:
  FaultFlight(Options options, mission::Mission mission, std::unique_ptr<FlightObserver> observer);

  Options options_;
  mission::Mission mission_;
  std::vector<CarrierId> carriers_;
  std::unique_ptr<FlightObserver> observer_;
  std::map<std::string, ground::ChildProcess> processes_;
  std::map<std::string, int> lives_;
};

}  // namespace gyre::test
