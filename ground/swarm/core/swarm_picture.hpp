#pragma once
// What a swarm has said lately, put into a table for a person.
//
// Pure: it is told each message and asked for text.

#include <map>
#include <optional>
#include <string>

#include "common/protocol/messages.hpp"

namespace gyre::ground {

class SwarmPicture {
 public:
  void see(const protocol::CoordinatorStatus& status) { coordinator_ = status; }
  void see(const protocol::Beacon& beacon) { beacon_ = beacon; }
  void see(const protocol::AgentStatus& status) { agents_[status.carrier] = status; }
  void see(const protocol::LoadState& load);
  void see(const protocol::Health& health) { health_[health.process] = health; }

  [[nodiscard]] const std::optional<protocol::CoordinatorStatus>& coordinator() const { return coordinator_; }
  /// Everybody the coordinator counts on has been heard, and so has the load.
  [[nodiscard]] bool complete() const;
  [[nodiscard]] std::string table() const;

 private:
  [[nodiscard]] std::string wish_line() const;
  [[nodiscard]] std::string load_line() const;
  [[nodiscard]] std::string clock_line() const;
  [[nodiscard]] std::string woke_late(const std::string& process) const;

  std::optional<protocol::CoordinatorStatus> coordinator_;
  std::optional<protocol::Beacon> beacon_;
  std::map<CarrierId, protocol::AgentStatus> agents_;
  std::optional<protocol::LoadState> load_;
  std::map<std::string, protocol::Health> health_;
};

}  // namespace gyre::ground
