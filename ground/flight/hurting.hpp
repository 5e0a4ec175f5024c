#pragma once
// Hurts a flight on purpose, as a person at the page asks: its processes, which are this program's own, by signals;
// their packets, their clocks and the load by the laboratory (common/protocol/disturbance.hpp), which they were started
// with. What may be done, and its words, is for the judge; this performs it.

#include <string>
#include <vector>

#include "common/dds/node.hpp"
#include "ground/flight/core/hurt_judge.hpp"
#include "ground/flight/supervisor.hpp"
#include "ground/page/page_json.hpp"

namespace gyre::ground {

class Hurting {
 public:
  /// `programs`: those that may be hurt, as they were started. `load_weight_n`: of the load that they were started
  /// with. Node and supervisor outlive it.
  Hurting(dds::Node& node, Supervisor& supervisor, std::vector<Program> programs, double load_weight_n);

  /// Does it, and says what was done: "agent 3 was killed"; or why not.
  [[nodiscard]] Answer perform(LocalTime now, const HurtRequest& wish);

  /// Whether this process ended because it was asked for.
  [[nodiscard]] bool meant(const std::string& process) const { return judge_.meant(process); }

  /// How the processes are, for who shows them.
  [[nodiscard]] std::vector<OwnProcess> processes();

 private:
  [[nodiscard]] Answer restart(const std::string& name);

  dds::Writer<protocol::Disturbance> laboratory_;
  Supervisor& supervisor_;
  std::vector<Program> programs_;
  HurtJudge judge_;
};

}  // namespace gyre::ground
