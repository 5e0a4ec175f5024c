#pragma once
// A process's part in a laboratory: hears what it has to suffer, and performs it.
//
// Only a process that was started with --laboratory listens; in any other this is nothing, and no message can disturb
// a real flight. What may be asked for is judged in common/protocol/disturbance.hpp.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/dds/inbox.hpp"
#include "common/dds/node.hpp"
#include "common/protocol/disturbance.hpp"

namespace gyre::program {

/// What only the simulator can perform.
struct AskedPush {
  LocalTime arrived;
  protocol::Disturbance push;
};

class Laboratory {
 public:
  /// `process` is its name as people know it: "agent 3". `node` outlives it.
  Laboratory(dds::Node& node, const std::string& process, bool listens);

  /// Loses packets and shifts the clock as it was told, and says so. For the main loop, between two beats.
  std::vector<AskedPush> perform();

  /// Disturbances that were dropped.
  [[nodiscard]] std::uint64_t nonsense() const;

 private:
  struct Bench;
  dds::Node& node_;
  std::shared_ptr<Bench>
      bench_;  // shared with the handler, which may run until the node is gone; absent: no laboratory
};

}  // namespace gyre::program
