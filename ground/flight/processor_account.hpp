#pragma once
// The kernel's account of processor time, for this process and all that it has started.
//
//   used     the process's own clock, of all of its threads                    clock_getcpuclockid
//   waited   of its main thread                                                /proc/PID/schedstat, second figure
//   stolen   of each processor, by a hypervisor                                /proc/stat, eighth figure
//
// A process that has ended is gone from the account, and so is one whose parent has ended before it. What a kernel does
// not tell counts as nothing: then nobody is said to be starved.

#include "ground/flight/core/starvation.hpp"

namespace gyre::ground {

[[nodiscard]] ProcessorAccount processor_account();

}  // namespace gyre::ground
