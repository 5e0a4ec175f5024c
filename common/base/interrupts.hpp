#pragma once
// Requests to stop, read where the main loop wants them instead of interrupting it anywhere. For mains only.
//
// Two kinds, because they mean different things to a flight. A person's (ctrl-c, a terminal that closes) ends what the
// program does: the coordinator's brings the load to rest first. The system's (SIGTERM: a service manager, a container
// engine) ends this process, soon, and says nothing about the flight: the others fly on.

namespace gyre {

/// Blocks SIGINT, SIGTERM and SIGHUP, and SIGPIPE: a reader of our output that left is no reason to drop a load.
/// Call before other threads exist: they inherit it. Blocked signals reach PID 1 of a container, too.
void block_interrupts();

/// Requests since the last call.
struct Interrupts {
  int by_person = 0;  ///< SIGINT, SIGHUP
  int by_system = 0;  ///< SIGTERM

  [[nodiscard]] int total() const { return by_person + by_system; }
};
[[nodiscard]] Interrupts take_interrupts();

}  // namespace gyre
