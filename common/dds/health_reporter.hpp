#pragma once
// Says once per second what this process dropped, and why: its core's counts, its node's, its inbox's, in one place.

#include <optional>
#include <string>

#include "common/dds/node.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::dds {

class HealthReporter {
 public:
  static constexpr Duration kPeriod = std::chrono::seconds(1);

  /// `process` is its name as people know it: "agent 3". `node` outlives the reporter.
  HealthReporter(Node& node, std::string process);

  /// Publishes when it is due, at the first call and kPeriod after the last publication; call it as often as the main
  /// loop turns. `dropped` are the core's counts, `overrun` the inbox's.
  void step(LocalTime now, const protocol::DropCounts& dropped, std::uint64_t overrun);

 private:
  const Node& node_;
  const std::string process_;
  Writer<protocol::Health> writer_;
  std::optional<LocalTime> published_;
};

}  // namespace gyre::dds
