#pragma once
// Says how this process is: what keeps it from its work, what it dropped and why, how late it woke. Its core's counts,
// its node's, its inbox's in one place; once per second on the wire, and at once to whoever asks at its seat (`gyre
// health`).

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

  /// Publishes when it is due: at the first call, kPeriod after the last publication, and when a complaint comes up or
  /// is settled. Call it as often as the main loop turns, because a loop that does not turn answers nobody. `dropped`
  /// are the core's counts, `overrun` and `late` the inbox's.
  void step(LocalTime now, const std::optional<std::string>& complaint, const protocol::DropCounts& dropped,
            std::uint64_t overrun, Duration late);

 private:
  Node& node_;
  const std::string process_;
  Writer<protocol::Health> writer_;
  std::optional<LocalTime> published_;
  bool complained_ = false;
  Duration late_max_{};  // since then
};

}  // namespace gyre::dds
