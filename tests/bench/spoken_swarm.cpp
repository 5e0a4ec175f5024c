#include "tests/bench/spoken_swarm.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include "common/dds/clock.hpp"

namespace gyre::bench {
namespace {

using namespace std::chrono_literals;

protocol::Setpoint setpoint_of(const protocol::CarrierState& state, std::uint64_t sequence) {
  protocol::Setpoint setpoint;
  setpoint.carrier = state.carrier;
  setpoint.incarnation = 1;
  setpoint.sequence = sequence;
  setpoint.position_w_m = state.position_w_m;
  setpoint.velocity_w_m_s = state.velocity_w_m_s;
  setpoint.direction_w = state.position_w_m.normalized();
  setpoint.tension_n = state.tension_n;
  return setpoint;
}

/// As full as pieces are, of bytes that no two have alike.
protocol::JournalPiece piece_of(const protocol::CarrierState& state, std::uint64_t tick) {
  protocol::JournalPiece piece{"agent " + std::to_string(state.carrier), 1, tick * protocol::kMaxJournalBytes, {}};
  piece.bytes.resize(protocol::kMaxJournalBytes);
  for (std::size_t i = 0; i < piece.bytes.size(); ++i) piece.bytes[i] = static_cast<std::uint8_t>((tick * i) >> 3U);
  return piece;
}

}  // namespace

int free_domain() {
  int domain = 70;
  while (dds::seat_holder({dds::Hub::kCoordinator, std::nullopt}, domain).taken) ++domain;
  return domain;
}

std::string own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

double cpu_s(pid_t pid) {
  double sum_s = 0.0;
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", gone)) {
    double cpu_ns = 0.0;
    std::ifstream(task.path() / "schedstat") >> cpu_ns;
    sum_s += 1e-9 * cpu_ns;
  }
  return sum_s;
}

SpokenSwarm::SpokenSwarm(int domain)
    : node_(std::move(dds::Node::open({{dds::Hub::kCoordinator, std::nullopt}, domain, "127.0.0.1", {}})).value()),
      beacons_(node_->writer<protocol::Beacon>()),
      loads_(node_->writer<protocol::LoadState>()),
      words_(node_->writer<protocol::CoordinatorStatus>()),
      missions_(node_->writer<protocol::MissionText>()) {
  for (const auto& [id, held] : swarm_.held) {
    setpoints_.push_back(node_->writer<protocol::Setpoint>(id));
    states_.push_back(node_->writer<protocol::CarrierState>(id));
    statuses_.push_back(node_->writer<protocol::AgentStatus>(id));
    plans_.push_back(node_->writer<protocol::HeldPlans>(id));
    plans_.back().write(held);
    journals_.push_back(node_->writer<protocol::JournalPiece>());
  }
  words_.write(swarm_.status);
  missions_.write(swarm_.text);
}

void SpokenSwarm::say(double duration_s) {
  const LocalTime end = dds::now() + from_seconds(duration_s);
  for (LocalTime next = dds::now(); next < end; next += 10ms) {
    std::this_thread::sleep_until(std::chrono::steady_clock::time_point(next.time_since_epoch()));
    tick();
  }
}

void SpokenSwarm::tick() {
  ++ticks_;
  swarm_.pass(10ms);
  for (auto& [id, state] : swarm_.vehicles) {
    state.sequence = ticks_;
    setpoints_[id - 1].write(setpoint_of(state, ticks_));
    states_[id - 1].write(state);
    if (ticks_ % 10 == id % 10) statuses_[id - 1].write(swarm_.agents.at(id));
    // A piece each 25 ms, so four in ten ticks.
    if ((ticks_ + id) % 5 < 2) journals_[id - 1].write(piece_of(state, ticks_));
  }
  swarm_.load.sequence = ticks_;
  loads_.write(swarm_.load);
  if (ticks_ % 2 == 0) beacons_.write(swarm_.beacon);
  if (ticks_ % 50 == 0) words_.write(swarm_.status);
}

}  // namespace gyre::bench
