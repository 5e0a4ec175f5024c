#pragma once
// Requests to stop, read where the main loop wants them instead of interrupting it anywhere. For mains only.

namespace gyre {

/// Blocks SIGINT, SIGTERM and SIGHUP, and SIGPIPE: a reader of our output that left is no reason to drop a load.
/// Call before other threads exist: they inherit it.
void block_interrupts();

/// How many requests to stop have come since the last call.
[[nodiscard]] int take_interrupts();

}  // namespace gyre
