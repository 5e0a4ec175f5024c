#pragma once
// Whether a machine had no time for our processes: what tells a starved machine from a defect.
//
// Intuition: a process that is ready to run and has no processor waits through no fault of its own. The kernel keeps
// account of that, and neither a long computation nor a process that somebody has stopped counts as waiting. What is
// left to ask is who had the processors meanwhile: neighbours, or our own processes, which would be a defect of ours.
// So what ours used is taken off a wait.
//
//   symbol   meaning                                                                                  unit
//   w        one process's wait for a processor, told when it ends; or a processor that the
//            hypervisor kept                                                                            s
//   u        processor time that all of our processes used since the last account, or in w where
//            that is longer                                                                             s
//   n        processors we may use                                                                      1
//
//   late = max(0, w − u / n)
//
// Pure: told the time and the kernel's accounts (processor_account.hpp).

#include <deque>
#include <map>
#include <vector>

#include "common/base/time.hpp"

namespace gyre::ground {

/// What the kernel has counted so far. Each figure grows from its own beginning; only differences have a meaning.
struct ProcessorAccount {
  struct Process {
    Duration used{};    ///< of processors, by all of its threads
    Duration waited{};  ///< by its main thread: ready to run, and no processor
  };
  std::map<int, Process> processes;  ///< ours that live now, by their numbers
  std::vector<Duration> stolen;      ///< of each processor of the machine, by a hypervisor
  int processors = 1;                ///< that we may use
};

class StarvationJudge {
 public:
  /// Ten setpoints. A vehicle goes on along a parabola for so long and is then off its orbit by r (rate T)³ / 6, which
  /// is 0.2 mm at 1 m and 1 rad/s: what is later than this, the tests of flights begin to feel.
  static constexpr Duration kSpoils = std::chrono::milliseconds(100);

  /// Accounts in order, a few tens of milliseconds apart: the times between are what waits are told from.
  void see(LocalTime now, const ProcessorAccount& account);

  /// The worst a processor came late through others.
  [[nodiscard]] Duration late_max() const { return late_max_; }
  [[nodiscard]] bool starved() const { return late_max_ >= kSpoils; }

 private:
  struct Used {
    LocalTime at{};
    Duration by_us{};  // since the first account
  };
  [[nodiscard]] Duration used_by_us(Duration wait) const;

  ProcessorAccount before_;  // a process that is missing in one account has not begun anew in the next
  std::deque<Used> used_;
  Duration late_max_{};
};

}  // namespace gyre::ground
