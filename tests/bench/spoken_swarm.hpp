#pragma once
// What benchmarks of those who look on share: 48 carriers at 100 Hz, said by one process for 49, and what another
// process costs.
//
// Per carrier setpoint and state at 100 Hz, status at 10 Hz, plans once; beacons at 50 Hz, the load at 100 Hz, the
// coordinator's word at 2 Hz, the mission once; and to who records, each agent's journal, 40 pieces a second. Beside
// who is measured, at the same time, runs his floor: a process that has the same readers and throws away what they
// bring.

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/dds/node.hpp"
#include "tests/ground/heard_swarm.hpp"

namespace gyre::bench {

inline constexpr CarrierId kSpokenCarriers = 48;

/// The first from 70 on that no coordinator has.
[[nodiscard]] int free_domain();
[[nodiscard]] std::string own_program();

/// What the threads of a process had of the processors so far; 0 where there is none.
[[nodiscard]] double cpu_s(pid_t pid);

class SpokenSwarm {
 public:
  explicit SpokenSwarm(int domain);

  /// Says what it says for so long, and returns.
  void say(double duration_s);

 private:
  void tick();

  ground::test::HeardSwarm swarm_{kSpokenCarriers};
  std::unique_ptr<dds::Node> node_;
  dds::Writer<protocol::Beacon> beacons_;
  dds::Writer<protocol::LoadState> loads_;
  dds::Writer<protocol::CoordinatorStatus> words_;
  dds::Writer<protocol::MissionText> missions_;
  std::vector<dds::Writer<protocol::Setpoint>> setpoints_;
  std::vector<dds::Writer<protocol::CarrierState>> states_;
  std::vector<dds::Writer<protocol::AgentStatus>> statuses_;
  std::vector<dds::Writer<protocol::HeldPlans>> plans_;
  std::vector<dds::Writer<protocol::JournalPiece>> journals_;
  std::uint64_t ticks_ = 0;
};

}  // namespace gyre::bench
