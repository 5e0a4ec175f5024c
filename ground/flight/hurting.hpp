#pragma once
// Hurts a flight on purpose, as a person at the page asks: its processes, which are this program's own, by signals;
// their packets, their clocks and the load by the laboratory (common/protocol/disturbance.hpp), which they were started
// with.

#include <set>
#include <string>
#include <vector>

#include "common/dds/node.hpp"
#include "ground/flight/supervisor.hpp"
#include "ground/page/page_json.hpp"
#include "ground/page/page_requests.hpp"

namespace gyre::ground {

class Hurting {
 public:
  /// `programs`: those that may be hurt, as they were started. All outlive it.
  Hurting(dds::Node& node, Supervisor& supervisor, std::vector<Program> programs);

  /// Does it, and says what was done: "agent 3 was killed"; or why not.
  [[nodiscard]] Answer perform(const HurtRequest& wish);

  /// Whether this process ended because it was asked for.
  [[nodiscard]] bool meant(const std::string& process) const { return killed_.count(process) > 0; }

  /// How the processes are, for who shows them.
  [[nodiscard]] std::vector<OwnProcess> processes();

 private:
  [[nodiscard]] Answer to_process(const HurtRequest& wish);
  [[nodiscard]] Answer disturb(const HurtRequest& wish);
  [[nodiscard]] Answer restart(const Program& program);

  dds::Writer<protocol::Disturbance> laboratory_;
  Supervisor& supervisor_;
  std::vector<Program> programs_;
  std::set<std::string> killed_;
  std::set<std::string> stopped_;
};

}  // namespace gyre::ground
